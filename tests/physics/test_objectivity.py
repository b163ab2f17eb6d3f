# SPDX-License-Identifier: GPL-2.0-or-later
"""A pair of grains that turns as one rigid body carries its tangential force with it.

Two sheared spheres are led through rotations by prescribed motion, with spins chosen so that their
surfaces do not move on each other. Any change of the force in the frame of the pair would be made
by the description alone.
"""
from __future__ import annotations

import math

import contact_scenes as cs
import numpy as np
import pytest
from yade import O

SOLID = cs.Solid(1.0e9, 0.25, 2500)
RADIUS = 0.01
OVERLAP = 2e-5
SHEAR = np.array([2e-6, 1e-6, 0.0])  # m
STEPS = 2000


def sheared_pair() -> tuple[int, int]:
    """Two equal spheres, one above the other, pressed on and then sheared; both are led."""
    O.materials.append(SOLID.material(frictionAngle=1.4))
    lower = cs.add_sphere((0, 0, 0), RADIUS, 0, fixed=True)
    upper = cs.add_sphere((0, 0, 2 * RADIUS - OVERLAP), RADIUS, 0, fixed=True)
    O.dt = 1e-6
    O.bodies[upper].state.vel = tuple(SHEAR / (50 * O.dt))
    cs.set_engines(cs.grain_law())
    O.run(51, True)
    O.bodies[upper].state.vel = (0, 0, 0)
    O.run(2, True)
    return lower, upper


def normal_and_shear(lower: int, upper: int) -> tuple[np.ndarray, np.ndarray]:
    """Unit normal from lower to upper, and the part of the upper's force that is tangential [N]."""
    branch = np.array(O.bodies[upper].state.pos) - np.array(O.bodies[lower].state.pos)
    normal = branch / np.linalg.norm(branch)
    force = np.array(O.interactions[lower, upper].phys.shearForce)
    return normal, force


def turn(lower: int, upper: int, axis: np.ndarray, angle: float, **law) -> None:
    """Turn the pair about `axis`, a unit vector square to its branch, by `angle` [rad] in STEPS
    steps.

    Positions follow the circle exactly. A chord has sin(step) of the branch along the tangent at
    its end, so spins of sin(step)/dt leave no slip.
    """
    step = angle / STEPS
    states = [O.bodies[i].state for i in (lower, upper)]
    start = [np.array(s.pos) for s in states]
    centre = sum(start) / 2
    first = O.iter

    def place(position: np.ndarray, phase: float) -> np.ndarray:
        arm = position - centre
        return centre + arm * math.cos(phase) + np.cross(axis, arm) * math.sin(phase)

    def lead() -> None:
        n = O.iter - first
        for state, position in zip(states, start):
            chord = place(position, (n + 1) * step) - place(position, n * step)
            state.vel = tuple(chord / O.dt)
            state.angVel = tuple(axis * math.sin(step) / O.dt)

    cs.set_engines(cs.grain_law(**law), lead)
    O.run(STEPS + 1, True)


@pytest.mark.parametrize("turns", [0.25, 1.0, 3.0])
@pytest.mark.parametrize("direction", ["along the shear", "across the shear", "oblique"])
def test_force_turns_with_a_pair_that_is_turned_about_an_axis_square_to_it(direction, turns):
    lower, upper = sheared_pair()
    normal, before = normal_and_shear(lower, upper)
    along = before / np.linalg.norm(before)
    across = np.cross(normal, along)
    axis = {"along the shear": along, "across the shear": across}.get(
        direction, (along + across) / math.sqrt(2)
    )
    angle = 2 * math.pi * turns
    turn(lower, upper, axis, angle)
    _, after = normal_and_shear(lower, upper)
    expected = (
        before * math.cos(angle)
        + np.cross(axis, before) * math.sin(angle)
        + axis * np.dot(axis, before) * (1 - math.cos(angle))
    )
    assert np.linalg.norm(after) == pytest.approx(np.linalg.norm(before), rel=1e-9)
    assert after == pytest.approx(expected, abs=1e-8 * np.linalg.norm(before))


@pytest.mark.parametrize("angle", [0.5, math.pi / 2, 2 * math.pi])
def test_force_turns_with_a_pair_that_spins_about_its_own_normal(angle):
    lower, upper = sheared_pair()
    normal, before = normal_and_shear(lower, upper)
    for i in (lower, upper):
        O.bodies[i].state.angVel = tuple(normal * angle / (STEPS * O.dt))
    O.run(STEPS, True)
    _, after = normal_and_shear(lower, upper)
    expected = before * math.cos(angle) + np.cross(normal, before) * math.sin(angle)
    assert np.linalg.norm(after) == pytest.approx(np.linalg.norm(before), rel=1e-9)
    assert after == pytest.approx(expected, abs=1e-5 * np.linalg.norm(before))
