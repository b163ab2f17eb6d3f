# SPDX-License-Identifier: GPL-2.0-or-later
"""Grains that come and go, scenes far from the origin, scenes saved in the middle, spinning pairs."""
from __future__ import annotations

import math

import hard_scenes as hs
import numpy as np
import pytest
from yade import O, utils

ALL_LAWS = pytest.mark.parametrize("law", hs.TANGENTIAL_LAWS)
SPEED = 1.0


def add_cluster(origin: np.ndarray, curve: str, count: int, seed: int, e: float = 0.7) -> list[int]:
    """Grains of unlike sizes that fly together with spin; ids. Most of them touch at the start."""
    rng = np.random.default_rng(seed)
    label = hs.material(curve, f"{curve} {seed}", restitution=e)
    side = math.ceil(count ** (1 / 3))
    ids = []
    for n in range(count):
        cell = np.array([n % side, n // side % side, n // side**2]) - (side - 1) / 2
        radius = hs.RADIUS * rng.uniform(0.95, 1.0)
        velocity = -SPEED * cell + rng.normal(0, 0.2 * SPEED, 3)
        spin = rng.normal(0, SPEED / hs.RADIUS, 3)
        ids.append(hs.sphere(origin + 1.94 * hs.RADIUS * cell, radius, label, velocity, spin))
    return ids


def clusters(count: int, origin: float = 0.0) -> dict[str, list[int]]:
    """One cluster of grains for each curve."""
    return {
        curve: add_cluster(np.array([origin + n, origin, origin]), curve, count, seed=n)
        for n, curve in enumerate(hs.CURVES)
    }


@ALL_LAWS
def test_grains_that_vanish_or_appear_in_mid_impact_leave_a_sound_scene(law):
    groups = clusters(8)
    functor = hs.set_engines(law)
    O.dt = hs.impact_duration(4 * SPEED) / 40
    O.run(20, True)
    touching = [i for i in O.interactions if i.isReal]
    assert len(touching) > 10
    for contact in touching[::3]:
        if O.bodies[contact.id1] is not None:
            O.bodies.erase(contact.id1)
    left = [b.id for b in O.bodies]
    assert len(left) < 8 * len(groups)

    # New grains in the places of old ones, overlapping what is there by half a radius.
    for n, curve in enumerate(groups):
        new = hs.sphere((n, 0, 0), 0.5 * hs.RADIUS, f"{curve} {n}", (0, 0, SPEED))
        left.append(new)
    O.run(1, True)
    before, booked = hs.total_energy(functor, left), sum(hs.booked().values())
    momentum = hs.momentum(left)
    O.run(2000, True)
    assert hs.all_finite()
    balance = hs.total_energy(functor, left) + sum(hs.booked().values()) - before - booked
    # Half overlaps are stiffer than the step was made for: some ten steps a collision, an error of 3e-3.
    assert balance < 5e-3 * before
    scale = sum(s.mass * s.vel.norm() for s in hs.states(left))
    assert np.abs(hs.momentum(left) - momentum).max() < 1e-9 * scale


@ALL_LAWS
def test_a_million_metres_from_the_origin_impacts_are_the_same(law):
    """Rounding of positions is 1e-10 m there, a ten-thousandth of the overlaps of 1e-6 m of this impact."""

    def rebound(origin: float) -> tuple[np.ndarray, float]:
        O.reset()
        ids = []
        for n, curve in enumerate(hs.CURVES):
            label = hs.material(curve, curve, restitution=0.9)
            at = np.array([origin, origin + n, origin])
            ids.append(hs.sphere(at, hs.RADIUS, label))
            offset = 2.0 * hs.RADIUS * np.array([0.8, 0.6, 0.0])
            ids.append(hs.sphere(at + 1.001 * offset, hs.RADIUS, label, (-10.0, 0, 0)))
        hs.set_engines(law)
        before = hs.kinetic_energy(ids)
        O.dt = hs.impact_duration(10.0) / 60
        O.run(400, True)
        assert O.interactions.countReal() == 0
        velocities = np.array([[*s.vel, *(hs.RADIUS * s.angVel)] for s in hs.states(ids)])
        return velocities, hs.kinetic_energy(ids) / before

    near, ratio_near = rebound(0.0)
    far, ratio_far = rebound(1e6)
    assert np.abs(far - near).max() < 2e-3 * 10.0
    assert ratio_far < 1 and ratio_far == pytest.approx(ratio_near, abs=2e-3)


def motion(ids: list[int]) -> np.ndarray:
    """Positions, orientations, velocities and spins, every bit of them."""
    return np.array([[*s.pos, *s.ori, *s.vel, *s.angVel] for s in hs.states(ids)])


@ALL_LAWS
@pytest.mark.parametrize("suffix", [".xml", ".yade.gz"])
def test_a_scene_saved_in_mid_impact_continues_to_the_last_bit(law, suffix, tmp_path):
    ids = []
    for n, curve in enumerate(hs.CURVES):
        label = hs.material(curve, curve, restitution=0.7)
        ids.append(hs.sphere((0, n, 0), hs.RADIUS, label, spin=(0, 0, 500)))
        offset = 2.0 * hs.RADIUS * np.array([0.8, 0.6, 0.0])
        ids.append(hs.sphere(np.array([0, n, 0]) + 1.001 * offset, hs.RADIUS, label, (-3, 0, 1)))
    hs.set_engines(law)
    O.dt = hs.impact_duration(3.0) / 60
    O.run(70, True)
    assert O.interactions.countReal() == len(hs.CURVES)
    file = str(tmp_path / f"impact{suffix}")
    O.save(file)
    saved = motion(ids)
    O.run(200, True)
    expected = motion(ids)
    O.reset()
    O.load(file)
    assert np.array_equal(motion(ids), saved)
    O.run(200, True)
    assert np.array_equal(motion(ids), expected)


@ALL_LAWS
def test_a_pair_that_spins_about_its_line_of_centres_keeps_its_axis(law):
    """Head-on impact of two spheres that turn alike about their common axis: nothing turns them from it."""
    ids = []
    spin = 1000.0
    axis = np.array([2.0, -1.0, 2.0]) / 3
    for n, curve in enumerate(hs.CURVES):
        label = hs.material(curve, curve, restitution=0.8)
        centre = np.array([0.0, n, 0.0])
        ids.append(hs.sphere(centre, hs.RADIUS, label, spin=spin * axis))
        other = centre + 2.001 * hs.RADIUS * axis
        ids.append(hs.sphere(other, hs.RADIUS, label, -SPEED * axis, spin * axis))
    hs.set_engines(law)
    O.dt = hs.impact_duration(SPEED) / 60
    O.run(300, True)
    assert O.interactions.countReal() == 0
    for state in hs.states(ids):
        assert np.array(state.angVel) == pytest.approx(spin * axis, abs=1e-9 * spin)
        along = np.dot(state.vel, axis)
        assert np.linalg.norm(np.array(state.vel) - along * axis) < 1e-9 * SPEED


@ALL_LAWS
def test_motion_in_a_plane_stays_in_it(law):
    """Oblique impacts of spheres that spin about the plane's normal, over and over between two walls."""
    ids = []
    for n, curve in enumerate(hs.CURVES):
        label = hs.material(curve, curve, restitution=0.95)
        x = 10 * hs.RADIUS * n
        for k, height in enumerate((1.2, 3.5)):
            centre = (x + 0.3 * k * hs.RADIUS, 0, height * hs.RADIUS)
            ids.append(hs.sphere(centre, hs.RADIUS, label, (0.2, 0, -SPEED), (0, 800, 0)))
    for height in (0.0, 5 * hs.RADIUS):
        O.bodies.append(utils.wall(height, axis=2, material="constant"))
    hs.set_engines(law)
    O.dt = hs.impact_duration(SPEED) / 40
    O.run(20_000, True)
    assert hs.all_finite()
    for state in hs.states(ids):
        assert abs(state.pos[1]) < 1e-9 * hs.RADIUS
        assert np.abs([state.angVel[0], state.angVel[2]]).max() < 1e-9 * 800
