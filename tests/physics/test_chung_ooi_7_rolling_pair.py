# SPDX-License-Identifier: GPL-2.0-or-later
"""Chung & Ooi (2011) test 7: equal spheres collide head on, spinning like two gear wheels.

With equal and opposite spins the patches move together: there is no slip, so no tangential force may
act, however large the spin.
"""
from __future__ import annotations

import math

import contact_scenes as cs
import numpy as np
import pytest
from yade import O

RADIUS, SPEED, FRICTION, RESTITUTION = 0.1, 0.2, 0.4, 0.5
SPINS = np.array([0.175, 0.54, 1.15, 2.0, 3.46, 7.46, 22.86])  # rad/s
SOLIDS = {
    "aluminium alloy": cs.Solid(7.0e10, 0.33, 2700),
    "copper": cs.Solid(1.2e11, 0.35, 8900),
}


def collide(solid: cs.Solid, law: str, sense: float) -> tuple[np.ndarray, np.ndarray]:
    """Velocities [m/s] and spins [rad/s] after, shape (2, n, 3); the second sphere spins by sense times
    the first one's spin."""
    contact = dict(frictionAngle=math.atan(FRICTION), restitution=RESTITUTION)
    O.materials.append(solid.material(**contact))
    ids: tuple[list[int], list[int]] = ([], [])
    for i, spin in enumerate(SPINS):
        for side, height in enumerate((0.0, 2 * RADIUS)):
            velocity = (0, 0, SPEED if side == 0 else -SPEED)
            body = cs.add_sphere((0, 4 * RADIUS * i, height), RADIUS, 0, velocity=velocity)
            O.bodies[body].state.angVel = (0, spin if side == 0 else sense * spin, 0)
            ids[side].append(body)
    cs.set_engines(cs.grain_law(tangentialLaw=law))
    hertz = cs.HertzImpact.of_equal_spheres(solid, RADIUS, 2 * SPEED)
    O.dt = hertz.duration / 1000
    cs.run_for(1.3 * hertz.duration)
    assert O.interactions.countReal() == 0
    states = [[O.bodies[i].state for i in side] for side in ids]
    velocity = np.array([[state.vel for state in side] for side in states])
    spin = np.array([[state.angVel for state in side] for side in states])
    return velocity, spin


@pytest.mark.parametrize("law", ["incremental", "secant", "report"])
@pytest.mark.parametrize("name", SOLIDS)
def test_spheres_that_roll_on_each_other_keep_their_spin_and_part_straight(name, law):
    velocity, spin = collide(SOLIDS[name], law, -1.0)
    # The contact turns by the spin over the contact time, at most 0.02 rad, and nothing else moves.
    assert spin[0, :, 1] == pytest.approx(SPINS, rel=1e-9)
    assert spin[1, :, 1] == pytest.approx(-SPINS, rel=1e-9)
    assert np.max(np.abs(velocity[:, :, :2])) < 1e-9 * SPEED
    assert velocity[1, :, 2] == pytest.approx(RESTITUTION * SPEED, rel=2e-4)


@pytest.mark.parametrize("name", SOLIDS)
def test_spheres_that_spin_alike_rub_and_lose_spin(name):
    velocity, spin = collide(SOLIDS[name], "incremental", 1.0)
    assert np.all(spin[:, :, 1] < 0.9 * SPINS)
    # The impulse that brakes the spin turns both spheres aside: m v_x = 2/5 m R (spin lost).
    lost = SPINS - spin[0, :, 1]
    assert np.abs(velocity[0, :, 0]) == pytest.approx(0.4 * RADIUS * lost, rel=2e-3)
    # Momentum along x is kept.
    assert np.max(np.abs(velocity.sum(axis=0)[:, 0])) < 1e-12
