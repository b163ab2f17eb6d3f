# SPDX-License-Identifier: GPL-2.0-or-later
"""Force, birth and death of a liquid bridge between two bodies, for every shape.

Bodies are moved as prescribed; what acts on them is Hertz's force less the bridge's attraction.
"""
from __future__ import annotations

import math
from dataclasses import replace

import bridge_scenes as bs
import contact_scenes as cs
import numpy as np
import pytest
from yade import O, utils

from grainfall.projectiles import make_projectile, projectile_forces, sphere

R = bs.RADIUS
MOISTURE = 0.01


def partner(shape: str):
    """Body below the origin that a grain touches at z = R: returns the radius it shows [m]."""
    material = O.materials["partner"]
    if shape == "sphere":
        O.bodies.append(utils.sphere((0, 0, -R), R, fixed=True, material=material))
        return R
    if shape == "large sphere":
        O.bodies.append(utils.sphere((0, 0, -3 * R), 3 * R, fixed=True, material=material))
        return 3 * R
    if shape == "wall":
        O.bodies.append(utils.wall(0, axis=2, material=material))
    elif shape == "box":
        O.bodies.append(utils.box((0, 0, -R), (9 * R, 9 * R, R), fixed=True, material=material))
    elif shape == "facet":
        corners = [(-9 * R, -9 * R, 0), (9 * R, -9 * R, 0), (0, 18 * R, 0)]
        O.bodies.append(utils.facet(corners, fixed=True, material=material))
    return math.inf


def drawn_apart(
    shape: str, speed: float, steps: int, **attributes
) -> tuple[np.ndarray, np.ndarray]:
    """Draw a grain off its partner; returns separations [m] and forces on both, shape (steps, 2)."""
    O.materials.append(
        [
            bs.SOLID.rigid_material(label="partner", gravimetricMoisture=MOISTURE, **attributes),
            bs.moist(MOISTURE, label="grain", **attributes),
        ]
    )
    partner(shape)
    grain = cs.add_sphere((0, 0, R - 2e-7), R, "grain", velocity=(0, 0, speed), fixed=True)
    O.bodies[grain].state.blockedDOFs = "xyzXY"  # two bodies that cannot move are not looked at
    separations, forces = [], []

    def record():
        separations.append(O.bodies[grain].state.pos[2] - R)
        forces.append((cs.force_on(grain)[2], cs.force_on(0)[2]))

    bs.set_engines(record=record)
    O.run(steps, True)
    return np.array(separations), np.array(forces)


def expected(shape: str, **changes) -> bs.Expected:
    shown = {"sphere": R, "large sphere": 3 * R}.get(shape, math.inf)
    radius = 2 * R if math.isinf(shown) else 2 * R * shown / (R + shown)
    volume = bs.grain_share(MOISTURE)
    if shape in ("sphere", "large sphere"):
        volume += bs.grain_share(MOISTURE, shown)
    return bs.Expected(radius, volume, **changes)


@pytest.mark.parametrize("form", ["willett", "willett-closed"])
@pytest.mark.parametrize("shape", ["sphere", "large sphere", "wall", "box", "facet"])
def test_attraction_follows_willett_from_contact_to_rupture_and_is_gone_beyond(shape, form):
    bridge = expected(shape, form=form)
    steps = 200
    separation, force = drawn_apart(
        shape, 1.2 * bridge.rupture / steps / 1e-6, steps, bridgeModel=form
    )
    held = (separation > 0) & (separation < bridge.rupture)
    assert np.count_nonzero(held) > 100
    assert -force[held, 0] == pytest.approx(bridge.force(separation[held]), rel=1e-10)
    assert np.all(force[separation > bridge.rupture] == 0)
    assert np.all(force[:, 0] == -force[:, 1])
    assert O.interactions.countReal() == 0


@pytest.mark.parametrize("shape", ["sphere", "wall"])
def test_attraction_on_overlap_is_that_at_contact(shape):
    bridge = expected(shape)
    separation, force = drawn_apart(shape, 1e-3, 400)  # 0.4 um in steps of 1 nm
    overlap = np.maximum(-separation, 0)
    modulus = bs.SOLID.plane_modulus
    radius = R / 2 if shape == "sphere" else R
    hertz = 4 / 3 * modulus * math.sqrt(radius) * overlap**1.5
    attraction = hertz - force[:, 0]
    # The rigid partner is stiffer by 1e6, not rigid.
    assert attraction == pytest.approx(bridge.force(separation), rel=1e-3, abs=2e-6 * hertz.max())
    assert np.abs(np.diff(attraction)).max() < 0.01 * bridge.force(0)


@pytest.mark.parametrize("shape", ["sphere of revolution", "sphere"])
def test_dry_projectile_is_held_by_the_water_of_the_grain_alone(shape):
    big = 4 * R
    O.materials.append([bs.SOLID.rigid_material(label="steel"), bs.moist(MOISTURE, label="grain")])
    if shape == "sphere":
        O.bodies.append(utils.sphere((0, 0, -big), big, fixed=True, material="steel"))
    else:
        body = make_projectile(
            replace(sphere(2 * big), mass=1e-3),
            position=(0, 0, -big),
            material=O.materials["steel"],
        )
        body.state.blockedDOFs = "xyzXYZ"
        O.bodies.append(body)
    grain = cs.add_sphere((0, 0, R - 1e-8), R, "grain", fixed=True)
    O.bodies[grain].state.blockedDOFs = "xyzXY"
    bs.set_engines()
    O.run(2, True)
    bridge = bs.Expected(2 * R * big / (R + big), bs.grain_share(MOISTURE))
    for fraction in (0.1, 0.5, 0.9):
        O.bodies[grain].state.pos = (0, 0, R + fraction * bridge.rupture)
        O.run(1, True)
        attraction = -cs.force_on(grain)[2]
        assert attraction == pytest.approx(float(bridge.force(fraction * bridge.rupture)), rel=1e-9)
        if shape != "sphere":
            assert projectile_forces(0)["total"][2] == pytest.approx(attraction)


def test_a_grain_of_a_clump_gives_the_water_of_its_own_volume():
    O.materials.append(bs.moist(MOISTURE, label="grain"))
    _, members = O.bodies.appendClumped(
        [utils.sphere((x, 0, -R), R, material="grain") for x in (0, -1.5 * R)]
    )
    cs.add_sphere((0, 0, R - 1e-8), R, "grain", fixed=True)
    law = bs.set_engines()
    O.run(1, True)
    bridge = O.interactions[members[0], 3].phys.bridge
    assert bridge.volume == pytest.approx(2 * bs.grain_share(MOISTURE), rel=1e-12)
    assert law.water()["total"] == pytest.approx(3 * 6 * bs.grain_share(MOISTURE), rel=1e-12)


def test_bridge_forms_by_touch_and_not_by_nearness():
    O.materials.append(bs.moist(MOISTURE, label="grain"))
    cs.add_sphere((0, 0, -R), R, "grain", fixed=True)
    grain = cs.add_sphere((0, 0, R + 1e-5), R, "grain", velocity=(0, 0, -0.1))
    O.bodies[grain].state.blockedDOFs = "XY"
    law = bs.set_engines(factor=1.3)
    O.run(80, True)
    assert O.interactions.countReal() == 1
    assert O.bodies[grain].state.vel[2] == -0.1
    assert law.water()["bridges"] == 0
    O.run(30, True)
    assert law.water()["bridges"] == 1
    assert O.interactions[0, grain].phys.bridge.attraction > 0


def test_nothing_is_left_where_grains_part_before_they_touch():
    O.materials.append(bs.moist(MOISTURE, label="grain"))
    cs.add_sphere((0, 0, -R), R, "grain", fixed=True)
    cs.add_sphere((0, 0, R + 1e-5), R, "grain", velocity=(0, 0, 10))
    bs.set_engines(factor=1.05)
    O.run(200, True)
    assert O.interactions.countReal() == 0


def test_contact_angles_are_averaged_and_the_liquid_is_that_of_the_wet_body():
    O.materials.append(
        [
            bs.SOLID.rigid_material(label="wall", contactAngle=0.6, surfaceTension=0.03),
            bs.moist(MOISTURE, label="grain", contactAngle=0.2),
        ]
    )
    cs.add_plane("wall")
    grain = cs.add_sphere((0, 0, R - 1e-8), R, "grain", fixed=True)
    bs.set_engines()
    O.run(1, True)
    bridge = bs.Expected(2 * R, bs.grain_share(MOISTURE), angle=0.4)
    told = O.interactions[0, grain].phys.bridge
    assert told.ruptureDistance == pytest.approx(bridge.rupture, rel=1e-12)
    assert told.attraction == pytest.approx(float(bridge.force(0)), rel=1e-12)


def test_coarse_grains_carry_the_suction_stress_of_the_real_ones():
    """Ten times larger: the same separation over radius gives a hundred times the force."""
    factor, fraction, forces = 10, 0.3, []
    for scale in (1, factor):
        O.reset()
        material = bs.moist(MOISTURE, label="grain", referenceRadius=R if scale > 1 else 0)
        O.materials.append(material)
        radius = scale * R
        cs.add_sphere((0, 0, -radius), radius, "grain", fixed=True)
        grain = cs.add_sphere((0, 0, radius - scale * 1e-8), radius, "grain", fixed=True)
        O.bodies[grain].state.blockedDOFs = "xyzXY"
        bs.set_engines()
        O.run(1, True)
        rupture = O.interactions[0, grain].phys.bridge.ruptureDistance
        O.bodies[grain].state.pos = (0, 0, radius + fraction * rupture)
        O.run(1, True)
        forces.append(-cs.force_on(grain)[2])
    assert forces[1] / forces[0] == pytest.approx(factor**2, rel=1e-12)


def test_stated_volume_is_that_of_the_real_bridge():
    O.materials.append(bs.moist(0, label="grain", referenceRadius=R / 10, bridgeVolume=1e-14))
    cs.add_sphere((0, 0, -R), R, "grain", fixed=True)
    cs.add_sphere((0, 0, R - 1e-8), R, "grain")
    law = bs.set_engines()
    O.run(1, True)
    assert O.interactions[0, 1].phys.bridge.volume == pytest.approx(1e-11, rel=1e-12)
    assert law.water()["external"] == pytest.approx(1e-11, rel=1e-12)


@pytest.mark.parametrize("side", ["sphere", "plane"])
def test_bridges_can_be_switched_off_on_either_side(side):
    off = {"bridgeModel": "none"}
    O.materials.append(
        [
            bs.SOLID.rigid_material(label="plane", **(off if side == "plane" else {})),
            bs.moist(MOISTURE, label="sphere", **(off if side == "sphere" else {})),
        ]
    )
    cs.add_plane("plane")
    grain = cs.add_sphere((0, 0, R - 1e-8), R, "sphere", fixed=True)
    law = bs.set_engines()
    O.run(1, True)
    assert O.interactions[0, grain].phys.bridge is None
    assert cs.force_on(grain)[2] > 0
    assert law.water()["bridges"] == 0
