# SPDX-License-Identifier: GPL-2.0-or-later
"""Chung & Ooi (2011) test 3: restitution on a rigid plane, and what it must not depend on.

The restitution that a material states is the one that is measured, whatever the speed, the partner
and the shape; the issue asks for 0.5 % from 0.2 to 0.98. Collisions take 400 steps of the elastic
contact's duration.
"""
from __future__ import annotations

import contact_scenes as cs
import pytest
from yade import GrainPair, O

RADIUS = 0.0025
SPEED = 3.9
SOLIDS = {
    "aluminium oxide": cs.Solid(3.8e11, 0.23, 4000),
    "cast iron": cs.Solid(1.0e11, 0.25, 7000),
}
RESTITUTIONS = (0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 0.98)
STEPS_PER_CONTACT = 400
TOLERANCE = 0.005


def measured_on_plane(solid, restitutions, speed=SPEED, attraction=False) -> list[float]:
    """Rebound over impact speed of spheres of these restitutions, side by side over a plane."""
    hertz = cs.HertzImpact.on_rigid_plane(solid, RADIUS, speed)
    O.materials.append(solid.rigid_material(label="plane"))
    cs.add_plane("plane")
    pairs = []
    for i, restitution in enumerate(restitutions):
        label = f"sphere {i}"
        O.materials.append(solid.material(label=label))
        pairs.append(GrainPair(first=label, second="plane", restitution=restitution))
        cs.add_sphere((4 * RADIUS * i, 0, RADIUS), RADIUS, label, velocity=(0, 0, -speed))
    cs.set_engines(cs.grain_law({"pairs": pairs, "dashpotAttraction": attraction}))
    O.dt = hertz.duration / STEPS_PER_CONTACT
    cs.run_for(
        3 * hertz.duration
    )  # the slowest rebound (restitution 0.2) takes 1.9 elastic durations
    assert O.interactions.countReal() == 0
    return [O.bodies[1 + i].state.vel[2] / speed for i in range(len(restitutions))]


@pytest.mark.parametrize("attraction", [False, True], ids=["cut at zero force", "with attraction"])
@pytest.mark.parametrize("solid", SOLIDS.values(), ids=SOLIDS)
def test_measured_restitution_is_the_one_stated(solid, attraction):
    measured = measured_on_plane(solid, RESTITUTIONS, attraction=attraction)
    assert measured == pytest.approx(RESTITUTIONS, rel=TOLERANCE)


def test_restitution_is_independent_of_speed():
    solid = SOLIDS["aluminium oxide"]
    results = {}
    for speed in (0.039, 0.39, 3.9):
        O.reset()
        results[speed] = measured_on_plane(solid, (0.3, 0.6, 0.9), speed=speed)
    # The damped Hertz contact scales with speed exactly, so only round-off and the start of the run
    # may differ.
    assert results[0.039] == pytest.approx(results[3.9], rel=1e-3)
    assert results[0.39] == pytest.approx(results[3.9], rel=1e-3)


def test_two_unequal_spheres_part_at_the_stated_restitution():
    solid = cs.Solid(1.0e10, 0.25, 2500)
    O.materials.append(solid.material(restitution=0.6))
    small, large = 0.001, 0.003
    masses = [cs.sphere_mass(solid.density, r) for r in (small, large)]
    mass = masses[0] * masses[1] / sum(masses)
    radius = small * large / (small + large)
    hertz = cs.HertzImpact(solid.plane_modulus / 2, radius, mass, 2.0)
    a = cs.add_sphere((0, 0, -small), small, 0, velocity=(0, 0, 1.5))
    b = cs.add_sphere((0, 0, large), large, 0, velocity=(0, 0, -0.5))
    cs.set_engines(cs.grain_law())
    O.dt = hertz.duration / STEPS_PER_CONTACT
    cs.run_for(2 * hertz.duration)
    parting = O.bodies[b].state.vel[2] - O.bodies[a].state.vel[2]
    assert parting / hertz.speed == pytest.approx(0.6, rel=TOLERANCE)
    momentum = sum(m * O.bodies[i].state.vel[2] for m, i in zip(masses, (a, b)))
    assert momentum == pytest.approx(1.5 * masses[0] - 0.5 * masses[1], rel=1e-9)


def test_a_body_that_cannot_move_counts_as_infinitely_heavy():
    """A sphere of the same size, but held: the damped mass is the mover's own, not half of it."""
    solid = cs.Solid(1.0e10, 0.25, 2500)
    O.materials.append(solid.material(restitution=0.5))
    mass = cs.sphere_mass(solid.density, RADIUS)
    hertz = cs.HertzImpact(solid.plane_modulus / 2, RADIUS / 2, mass, 1.0)
    cs.add_sphere((0, 0, 0), RADIUS, 0, fixed=True)
    mover = cs.add_sphere((0, 0, 2 * RADIUS), RADIUS, 0, velocity=(0, 0, -1.0))
    cs.set_engines(cs.grain_law())
    O.dt = hertz.duration / STEPS_PER_CONTACT
    cs.run_for(2 * hertz.duration)
    assert O.bodies[mover].state.vel[2] == pytest.approx(0.5, rel=TOLERANCE)


def test_without_attraction_the_contact_never_pulls():
    solid = SOLIDS["cast iron"]
    hertz = cs.HertzImpact.on_rigid_plane(solid, RADIUS, SPEED)
    O.materials.append([solid.material(restitution=0.3), solid.rigid_material(restitution=0.3)])
    cs.add_plane(1)
    sphere = cs.add_sphere((0, 0, RADIUS), RADIUS, 0, velocity=(0, 0, -SPEED))
    forces = []
    cs.set_engines(cs.grain_law(), record=lambda: forces.append(cs.force_on(sphere)[2]))
    O.dt = hertz.duration / STEPS_PER_CONTACT
    cs.run_for(3 * hertz.duration)
    assert min(forces) == 0.0
    assert max(forces) > 0.5 * hertz.force
