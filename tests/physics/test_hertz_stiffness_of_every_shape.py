# SPDX-License-Identifier: GPL-2.0-or-later
"""A flat body gives Hertz's full stiffness, whatever radius its geometry functor reports for it.

YADE's wall and facet functors report by default the radius of the sphere (once, twice) for the flat
partner: 0.71 and 0.82 of Hertz's stiffness. Peak force goes as stiffness^0.4, so that would be 0.87
and 0.92 of the closed form, against a tolerance of 0.1 % (500 steps a collision err by 1e-5).
"""
from __future__ import annotations

import contact_scenes as cs
import pytest
from yade import O, utils

SOLID = cs.Solid(7.0e10, 0.3, 2700)
RADIUS = 0.01
SPEED = 1.0
STEPS_PER_CONTACT = 500


def wall():
    return utils.wall(0, axis=2, sense=0, material="plane")


def box():
    return utils.box(
        (0, 0, -RADIUS), (5 * RADIUS, 5 * RADIUS, RADIUS), fixed=True, material="plane"
    )


def facet():
    corners = [(-9 * RADIUS, -9 * RADIUS, 0), (9 * RADIUS, -9 * RADIUS, 0), (0, 9 * RADIUS, 0)]
    return utils.facet(corners, fixed=True, material="plane")


def peak_force(body_id: int, duration: float, **engines) -> float:
    """Largest z force [N] on a body while the scene runs for `duration` [s]."""
    forces = [0.0]
    cs.set_engines(cs.grain_law(), record=lambda: forces.append(cs.force_on(body_id)[2]), **engines)
    O.dt = duration / STEPS_PER_CONTACT
    cs.run_for(1.2 * duration)
    return max(forces)


@pytest.mark.parametrize("hertzian", [False, True])
@pytest.mark.parametrize("plane", [wall, box, facet])
def test_flat_body_has_the_full_stiffness_of_hertz(plane, hertzian):
    O.materials.append([SOLID.material(label="sphere"), SOLID.rigid_material(label="plane")])
    O.bodies.append(plane())
    sphere = cs.add_sphere((0, 0, RADIUS), RADIUS, "sphere", velocity=(0, 0, -SPEED))
    hertz = cs.HertzImpact.on_rigid_plane(SOLID, RADIUS, SPEED)
    force = peak_force(sphere, hertz.duration, hertzian=hertzian)
    assert force == pytest.approx(hertz.force, rel=1e-3)


def test_plane_of_the_same_material_halves_the_modulus():
    O.materials.append(SOLID.material())
    cs.add_plane(0)
    sphere = cs.add_sphere((0, 0, RADIUS), RADIUS, 0, velocity=(0, 0, -SPEED))
    rigid = cs.HertzImpact.on_rigid_plane(SOLID, RADIUS, SPEED)
    hertz = cs.HertzImpact(SOLID.plane_modulus / 2, RADIUS, rigid.effective_mass, SPEED)
    assert peak_force(sphere, hertz.duration) == pytest.approx(hertz.force, rel=1e-3)


def test_clump_member_has_the_stiffness_of_its_own_radius_and_the_mass_of_the_clump():
    """Two spheres, one above the other, fall as one body: one contact carries the mass of both."""
    O.materials.append([SOLID.material(label="sphere"), SOLID.rigid_material(label="plane")])
    cs.add_plane("plane")
    members = [
        utils.sphere((0, 0, height * RADIUS), RADIUS, material="sphere") for height in (1, 3)
    ]
    clump, (lower, _) = O.bodies.appendClumped(members, discretization=0)
    O.bodies[clump].state.vel = (0, 0, -SPEED)
    mass = 2 * cs.sphere_mass(SOLID.density, RADIUS)
    assert O.bodies[clump].state.mass == pytest.approx(mass, rel=1e-9)
    hertz = cs.HertzImpact(SOLID.plane_modulus, RADIUS, mass, SPEED)
    assert peak_force(lower, hertz.duration) == pytest.approx(hertz.force, rel=1e-3)
    assert O.bodies[clump].state.vel[2] == pytest.approx(SPEED, rel=1e-5)


def test_clump_rebounds_with_the_restitution_of_its_material():
    """The dashpot of a member's contact is tuned to the mass that moves, the clump's."""
    O.materials.append(
        [
            SOLID.material(label="sphere", restitution=0.5),
            SOLID.rigid_material(label="plane", restitution=0.5),
        ]
    )
    cs.add_plane("plane")
    members = [
        utils.sphere((0, 0, height * RADIUS), RADIUS, material="sphere") for height in (1, 3)
    ]
    clump, (lower, _) = O.bodies.appendClumped(members, discretization=0)
    O.bodies[clump].state.vel = (0, 0, -SPEED)
    mass = 2 * cs.sphere_mass(SOLID.density, RADIUS)
    hertz = cs.HertzImpact(SOLID.plane_modulus, RADIUS, mass, SPEED)
    peak_force(lower, 2 * hertz.duration)
    assert O.bodies[clump].state.vel[2] / SPEED == pytest.approx(0.5, rel=0.005)
