# SPDX-License-Identifier: GPL-2.0-or-later
"""What moist grains do: they hang, stick, slide, tear apart; momentum, energy and water are kept."""
from __future__ import annotations

import math

import bridge_scenes as bs
import contact_scenes as cs
import numpy as np
import pytest
from yade import O, utils

from grainfall.materials import PENDULAR_LIMIT, check_scene

R = bs.RADIUS
MOISTURE = 0.01
GRAVITY = 9.81
MASS = cs.sphere_mass(bs.SOLID.density, R)


def pair_bridge(moisture: float = MOISTURE) -> bs.Expected:
    """Between two equal grains."""
    return bs.Expected(R, 2 * bs.grain_share(moisture))


def hanging(gravity: float, gap: float = 0.0, **attributes):
    """A grain below a fixed one, held by a bridge and placed at rest at this gap [m]."""
    O.materials.append(bs.moist(MOISTURE, label="grain", restitution=0.2, **attributes))
    cs.add_sphere((0, 0, R), R, "grain", fixed=True)
    grain = cs.add_sphere((0, 0, -R + 1e-9), R, "grain")
    law = bs.set_engines(gravity=gravity)
    O.run(1, True)
    state = O.bodies[grain].state
    state.pos, state.vel = (0, 0, -R - gap), (0, 0, 0)
    return law, state


def test_grain_hangs_where_hertz_and_its_weight_balance_the_attraction():
    _, state = hanging(GRAVITY)
    O.run(20000, True)
    stiffness = 4 / 3 * bs.SOLID.plane_modulus / 2 * math.sqrt(R / 2)
    pressing = float(pair_bridge().force(0)) - MASS * GRAVITY
    assert pressing > 0
    overlap = (pressing / stiffness) ** (2 / 3)
    assert state.pos[2] + R == pytest.approx(overlap, rel=1e-4)
    assert O.interactions[0, 1].phys.normalForce.norm() == pytest.approx(pressing, rel=1e-4)


@pytest.mark.parametrize("offset, held", [(-0.01, True), (0.01, False)])
def test_gap_at_which_weight_equals_attraction_parts_return_from_fall(offset, held):
    """Attraction falls with the gap, so that this balance is unstable: inside it wins, outside weight does."""
    bridge = pair_bridge()
    gaps = np.linspace(1e-6, bridge.rupture, 20000)
    balance = gaps[np.argmin(np.abs(bridge.force(gaps) - MASS * GRAVITY))]
    assert 0.1 * bridge.rupture < balance < 0.9 * bridge.rupture
    law, state = hanging(GRAVITY, gap=(1 + offset) * balance)
    O.run(60000, True)
    assert (law.water()["bridges"] == 1) == held
    assert (state.pos[2] > -R - 1e-6) == held


def test_grain_too_heavy_for_its_bridge_falls():
    gravity = 1.01 * float(pair_bridge().force(0)) / MASS
    law, _ = hanging(gravity)
    O.run(40000, True)
    assert law.water()["bridges"] == 0


def test_friction_reads_what_presses_the_surfaces_together():
    """Without any weight a grain stuck to a wall resists dragging by mu times its bridge's force."""
    mu = 0.4
    O.materials.append(
        [
            bs.SOLID.rigid_material(label="plane", friction=mu),
            bs.moist(MOISTURE, label="grain", friction=mu, restitution=0.2),
        ]
    )
    cs.add_plane("plane")
    grain = cs.add_sphere((0, 0, R - 1e-8), R, "grain")
    bs.set_engines()
    O.run(10000, True)
    state = O.bodies[grain].state
    state.blockedDOFs = "xyXYZ"
    state.vel = (0.01, 0, 0)
    O.run(4000, True)
    attraction = float(bs.Expected(2 * R, bs.grain_share(MOISTURE)).force(0))
    assert cs.force_on(grain)[2] == pytest.approx(0, abs=1e-4 * attraction)
    assert -cs.force_on(grain)[0] == pytest.approx(mu * attraction, rel=1e-4)


def free_pair(spin: float, speed: float, **attributes):
    """Two free moist grains that meet off centre; returns the law."""
    O.trackEnergy = True
    O.materials.append(bs.moist(MOISTURE, label="grain", friction=0.5, **attributes))
    cs.add_sphere((0, 0, -1.5 * R), 1.5 * R, "grain", velocity=(0, 0.1, 0.05))
    cs.add_sphere((0, 0.3 * R, 1.001 * R), R, "grain", velocity=(0.05, 0, -speed))
    O.bodies[1].state.angVel = (spin, 0, 0.5 * spin)
    return bs.set_engines()


def momenta() -> np.ndarray:
    """Linear [kg m/s] and angular [kg m2/s] momentum, shape (6,)."""
    total = np.zeros(6)
    for body in O.bodies:
        s = body.state
        linear = s.mass * np.array(s.vel)
        # Positions stand half a step after the velocities.
        place = np.array(s.pos) - 0.5 * O.dt * np.array(s.vel)
        total += [
            *linear,
            *(np.cross(place, linear) + np.array(s.inertia) * np.array(s.angVel)),
        ]
    return total


@pytest.mark.parametrize("viscosity", [0.0, 1e-3])
def test_collision_that_forms_and_tears_a_bridge_conserves_momentum_and_balances_its_energy(
    viscosity,
):
    law = free_pair(30, 0.6, restitution=0.9, liquidViscosity=viscosity)
    before, energy = momenta(), bs.kinetic_energy()
    O.run(4000, True)
    assert law.water()["bridges"] == 0
    energies = dict(O.energy.items())
    assert energies["grainBridge"] > 0.005 * energy
    scale = np.repeat([np.abs(before[:3]).max(), np.abs(before[3:]).max()], 3)
    assert np.all(np.abs(momenta() - before) < 1e-9 * scale)
    assert bs.kinetic_energy() + bs.booked() == pytest.approx(energy, rel=2e-3)


def test_pair_that_stays_together_keeps_its_books():
    law = free_pair(10, 0.1, restitution=0.5)
    energy = bs.kinetic_energy()
    O.run(6000, True)
    assert law.water()["bridges"] == 1
    stored = law.elasticEnergy()
    assert stored["bridge"] != 0
    total = bs.kinetic_energy() + sum(stored.values()) + bs.booked()
    assert total == pytest.approx(energy, abs=2e-3 * energy)


def test_a_hundred_tears_lose_a_hundred_times_one():
    """A grain moved to and fro between touch and beyond rupture."""
    O.trackEnergy = True
    O.materials.append(bs.moist(MOISTURE, label="grain", bridgeModel="willett-closed"))
    cs.add_sphere((0, 0, -R), R, "grain", fixed=True)
    overlap = 1e-9
    bridge = bs.Expected(R, 2 * bs.grain_share(MOISTURE), form="willett-closed")
    steps = 400
    stride = 1.05 * bridge.rupture / steps
    grain = cs.add_sphere((0, 0, R - overlap - stride), R, "grain", fixed=True)
    bs.set_engines()
    state = O.bodies[grain].state
    state.blockedDOFs = "xyzXY"

    def cycle() -> float:
        for speed in (stride / O.dt, -stride / O.dt):
            state.vel = (0, 0, speed)
            O.run(steps + 1, True)
        return dict(O.energy.items())["grainBridge"]

    start = cycle()
    once = cycle() - start
    gaps = np.linspace(0, bridge.rupture, 20001)
    work = float(np.sum(bridge.force(gaps[:-1]) + bridge.force(gaps[1:])) / 2 * gaps[1])
    # In the stride that brings the touch the attraction acts half the way.
    work -= float(bridge.force(0)) * (stride / 2 - overlap)
    assert once == pytest.approx(work, rel=1e-3)
    for _ in range(99):
        total = cycle()
    assert total - start == pytest.approx(100 * once, rel=1e-6)


def test_squeeze_film_is_reynolds_with_the_factor_for_little_liquid():
    viscosity, gap, speed = 1e-3, 5e-6, 0.1
    O.materials.append(bs.moist(MOISTURE, label="grain", liquidViscosity=viscosity))
    cs.add_sphere((0, 0, -R), R, "grain", fixed=True)
    grain = cs.add_sphere((0, 0, R - 1e-9), R, "grain", fixed=True)
    bs.set_engines()
    state = O.bodies[grain].state
    state.blockedDOFs = "xyzXY"
    O.run(1, True)
    bridge = pair_bridge()
    for velocity in (speed, -speed):
        state.pos, state.vel = (0, 0, R + gap), (0, 0, velocity)
        O.run(1, True)
        x = 1 - gap / math.sqrt(gap**2 + 2 * bridge.volume / (math.pi * R))
        viscous = -1.5 * math.pi * viscosity * R**2 * velocity / gap * x**2
        assert cs.force_on(grain)[2] == pytest.approx(viscous - float(bridge.force(gap)), rel=1e-9)


def test_honey_between_grains_stops_them_and_makes_no_energy():
    """The step does not resolve its damping, by far: still nothing is thrown back."""
    law = free_pair(0, 0.6, liquidViscosity=10.0)
    energy = bs.kinetic_energy()
    speeds = []
    for _ in range(60):
        O.run(20, True)
        assert bs.kinetic_energy() < energy * (1 + 1e-9)
        speeds.append((O.bodies[1].state.vel - O.bodies[0].state.vel)[2])
    assert law.water()["bridges"] == 1
    assert speeds[0] < -0.5
    assert abs(speeds[-1]) < 0.05


def moist_heap(moisture: float, **attributes):
    """125 grains over the floor of a box; returns the law."""
    O.trackEnergy = True
    values = dict(young=1e8, friction=0.5, restitution=0.5, **attributes)
    O.materials.append(bs.moist(moisture, label="grain", **values))
    count, pitch = 5, 2.05 * R
    for i in range(count**3):
        x, y, z = i % count, i // count % count, i // count**2
        shift = 0.02 * R * math.sin(7.0 * i)
        cs.add_sphere((pitch * x + shift, pitch * y - shift, pitch * z), R, "grain")
    for axis in (0, 1):
        for position in (-1.1 * R, (count - 1) * pitch + 1.1 * R):
            O.bodies.append(utils.wall(position, axis=axis, sense=0))
    O.bodies.append(utils.wall(-1.1 * R, axis=2, sense=0))
    law = bs.set_engines(gravity=GRAVITY)
    O.dt = 4e-6
    return law


def test_settling_moist_heap_keeps_its_books_of_energy_and_water():
    law = moist_heap(MOISTURE)
    grains = [b.state for b in O.bodies if b.dynamic]
    start = sum(s.mass * GRAVITY * s.pos[2] for s in grains)
    total = 125 * 6 * bs.grain_share(MOISTURE)
    for _ in range(4):
        O.run(1500, True)
        released = start - sum(s.mass * GRAVITY * s.pos[2] for s in grains)
        stored = sum(law.elasticEnergy().values())
        in_play = released + abs(law.elasticEnergy()["bridge"])
        residual = released - bs.kinetic_energy() - stored - bs.booked()
        # Velocities stand half a step before the positions.
        assert abs(residual) < 5e-3 * in_play
        water = law.water()
        assert water["total"] == pytest.approx(total, rel=1e-12)
        assert water["inBridges"] + water["onGrains"] == pytest.approx(total, rel=1e-12)
    assert water["bridges"] > 150
    volumes = {i.phys.bridge.volume for i in O.interactions if i.isReal}
    # Grain on grain and grain on wall; equal grains, so that there are no others.
    assert sorted(volumes) == pytest.approx(
        [bs.grain_share(MOISTURE), 2 * bs.grain_share(MOISTURE)]
    )


def test_budget_tells_merged_bridges_and_overdrawn_grains():
    law = moist_heap(0.023, bridgesPerGrain=2)
    O.run(4000, True)
    water = law.water()
    assert water["beyondPendular"] > 0.5
    assert water["beyondFit"] > 0.5
    assert water["overdrawnGrains"] > 10
    assert water["deficit"] > 0
    assert water["total"] == pytest.approx(water["inBridges"] + water["onGrains"], rel=1e-12)


@pytest.mark.parametrize("factor, beyond", [(0.999, 0), (1.001, 1)])
def test_law_and_check_of_the_scene_mean_the_same_pendular_limit(factor, beyond):
    moisture = factor * PENDULAR_LIMIT * R**3 / (2 * bs.grain_share(1.0))
    O.materials.append(bs.moist(moisture, label="grain"))
    cs.add_sphere((0, 0, -R), R, "grain", fixed=True)
    cs.add_sphere((0, 0, R - 1e-8), R, "grain")
    law = bs.set_engines()
    O.run(1, True)
    assert law.water()["beyondPendular"] == beyond
    assert len(check_scene()) == beyond


def test_what_runs_is_told_by_the_law():
    O.materials.append(bs.moist(0.023, label="sand", liquidViscosity=1e-3))
    cs.add_sphere((0, 0, -R), R, "sand", fixed=True)
    cs.add_sphere((0, 0, R - 1e-8), R, "sand")
    law = bs.set_engines()
    O.run(1, True)
    effects = law.effects
    assert effects["liquid bridges: willett"] == "sand: gravimetricMoisture 0.023; 1 contacts now"
    assert "viscous film in bridges" in effects
    O.materials[0].bridgeModel = "none"
    O.interactions.clear()
    O.run(1, True)
    assert not any("bridge" in effect for effect in law.effects)


@pytest.mark.parametrize("suffix", [".xml", ".yade.gz"])
def test_stretched_bridge_saved_and_loaded_goes_on_to_the_last_bit(suffix, tmp_path):
    free_pair(30, 0.6, restitution=0.9, liquidViscosity=1e-3)
    while not any(
        i.isReal and i.phys.bridge.formed and i.geom.penetrationDepth < -1e-5
        for i in O.interactions
    ):
        O.run(20, True)
        assert O.iter < 4000
    file = str(tmp_path / f"bridge{suffix}")
    O.save(file)

    def end() -> list[float]:
        O.run(3000, True)
        numbers = [dict(O.energy.items())["grainBridge"]]
        for body in O.bodies:
            s = body.state
            numbers += [*s.pos, *s.ori, *s.vel, *s.angVel]
        return numbers

    expected = end()
    assert expected[0] > 0
    O.reset()
    O.load(file)
    assert end() == expected
