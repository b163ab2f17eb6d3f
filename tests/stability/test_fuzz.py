# SPDX-License-Identifier: GPL-2.0-or-later
"""A thousand short random scenes: no NaN, no crash, no energy from nowhere.

Radii, moduli, densities, speeds, friction curves, restitutions, moistures and tangential laws are drawn at
random, each scene from its own seed. A scene has no walls and no gravity, so that momentum is kept and energy
can only fall. The message of a failure names the seeds; GRAINFALL_FUZZ_SEED=N runs the thousand scenes from
another seed on.
"""
from __future__ import annotations

import math
import os

import hard_scenes as hs
import numpy as np
import pytest
from grainfall.hertz import HertzImpact
from yade import O

SCENES = 1000
BLOCK = 100
FIRST_SEED = int(os.environ.get("GRAINFALL_FUZZ_SEED", "0"))
# Share of its first energy that a scene may gain: the leapfrog's error at 30 steps for the briefest collision.
ENERGY_BOUND = 5e-3
MOMENTUM_BOUND = 1e-9
STEPS = 1500


def random_scene(seed: int) -> tuple[list[int], object, str]:
    """Make the scene of this seed; ids of its spheres, the law, and a description."""
    rng = np.random.default_rng(seed)
    law = str(rng.choice(hs.ENERGY_SAFE))
    speed = 10 ** rng.uniform(-2, 2)
    size = 10 ** rng.uniform(-4, -1)
    count = int(rng.integers(2, 9))
    spread = rng.uniform(0, 1)
    materials = []
    for n in range(int(rng.integers(1, 4))):
        curve = str(rng.choice(list(hs.CURVES)))
        materials.append(
            hs.material(
                curve,
                f"{curve} {n}",
                young=10 ** rng.uniform(7, 11),
                poisson=rng.uniform(0, 0.45),
                density=10 ** rng.uniform(3, 4),
                restitution=float(rng.choice([1.0, rng.uniform(0.05, 1)])),
                gravimetricMoisture=float(rng.choice([0.0, rng.uniform(0, 0.05)])),
            )
        )
    ids = []
    centres: list[np.ndarray] = []
    radii: list[float] = []
    while len(ids) < count:
        radius = size * 10 ** (-2 * spread * rng.uniform(0, 1))
        centre = np.zeros(3)
        if ids:
            # Beside one that is there: from an overlap of a tenth of the smaller radius to a little gap.
            n = int(rng.integers(len(ids)))
            direction = rng.normal(0, 1, 3)
            gap = rng.uniform(-0.1, 0.02) * min(radius, radii[n])
            distance = radius + radii[n] + gap
            centre = centres[n] + distance * direction / np.linalg.norm(direction)
        if any(
            np.linalg.norm(centre - c) < radius + r - 0.1 * min(radius, r)
            for c, r in zip(centres, radii)
        ):
            continue
        # Towards the middle, so that they meet.
        velocity = rng.normal(0, speed, 3) - speed * centre / size
        spin = rng.normal(0, speed / radius, 3)
        label = str(rng.choice(materials))
        ids.append(hs.sphere(centre, radius, label, velocity, spin))
        centres.append(centre)
        radii.append(radius)
    functor = hs.set_engines(law)
    O.dt = time_step(ids, speed)
    return ids, functor, f"{law}, {count} grains of {size:.1e} m, {speed:.1e} m/s"


def time_step(ids: list[int], speed: float) -> float:
    """A thirtieth of the briefest collision that any two of these grains can have [s]."""
    shortest = math.inf
    for i in ids:
        for j in ids:
            if i <= j:
                continue
            a, b = O.bodies[i], O.bodies[j]
            modulus = 1 / sum((1 - x.material.poisson**2) / x.material.young for x in (a, b))
            mass = 1 / (1 / a.state.mass + 1 / b.state.mass)
            radius = 1 / (1 / a.shape.radius + 1 / b.shape.radius)
            overlap = HertzImpact(modulus, radius, mass, 4 * speed).overlap
            # What overlaps at the start may be stiffer than any impact.
            overlap = max(overlap, 0.2 * radius)
            stiffness = 2 * modulus * math.sqrt(radius * overlap)
            shortest = min(shortest, math.pi * math.sqrt(mass / stiffness))
    # Several contacts and rotation: up to (7/2)^(1/2) times the frequency, and neighbours add.
    return shortest / 30 / 4


def run_scene(seed: int) -> str:
    """Run one scene; what went wrong, or nothing."""
    O.reset()
    ids, law, description = random_scene(seed)

    O.run(1, True)  # makes the contacts that are there from the start
    before, momentum = hs.total_energy(law, ids), hs.momentum(ids)
    O.run(STEPS, True)
    if not hs.all_finite():
        return f"{description}: a position or velocity is no number"
    gain = hs.total_energy(law, ids) / before - 1
    if gain > ENERGY_BOUND:
        return f"{description}: energy grew by {gain:.1e}"
    scale = sum(s.mass * s.vel.norm() for s in hs.states(ids))
    change = np.abs(hs.momentum(ids) - momentum).max() / scale
    if change > MOMENTUM_BOUND:
        return f"{description}: momentum changed by {change:.1e}"
    return ""


@pytest.mark.parametrize("first", range(FIRST_SEED, FIRST_SEED + SCENES, BLOCK))
def test_random_scenes_keep_momentum_and_gain_no_energy(first):
    failures, touched = [], 0
    for seed in range(first, first + BLOCK):
        error = run_scene(seed)
        touched += any(value != 0 for value in hs.booked().values())
        if error:
            failures.append(f"seed {seed}: {error}")
    assert not failures, "\n".join(failures)
    # Scenes in which nothing meets would prove nothing.
    assert touched > BLOCK / 2
