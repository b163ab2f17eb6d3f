# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes for the tests of HertzTimeStepper: preloaded clusters that are set to vibrate, and impacts."""
from __future__ import annotations

import itertools
import math

import contact_scenes as cs
import numpy as np
from yade import HertzTimeStepper, O, utils

#: Quartz-like but soft, so that preloads of some per cent of the radius are reached at moderate speeds.
SOLID = cs.Solid(1e8, 0.2, 2650)
RADIUS = 5e-3
#: Far more friction than any vibration can overcome: contacts stay linear.
STICKING = math.atan(1e6)


def set_engines(law: dict | None = None, record=None, gravity=(0, 0, 0), **stepper):
    """Engines of `contact_scenes` with a HertzTimeStepper before the integrator; returns the stepper."""
    cs.set_engines(cs.grain_law(**(law or {})), record, gravity)
    engine = HertzTimeStepper(**stepper)
    O.engines = O.engines[:-1] + [engine, O.engines[-1]]
    return engine


def exact(**stepper) -> dict:
    """Attributes with which the engine takes its own critical step times `safety`, step by step."""
    return {**dict(timeStepUpdateInterval=1, deadBand=0, maxGrowth=1e9, maxApproach=1e9), **stepper}


def fcc_directions() -> list[np.ndarray]:
    """The twelve unit vectors, shape (3,), to the neighbours in a face-centred cubic packing."""
    signs = list(itertools.product((-1, 1), repeat=2))
    vectors = [np.insert([a, b], hole, 0) for hole in range(3) for a, b in signs]
    return [v / math.sqrt(2) for v in vectors]


def add_cluster(overlap: float) -> int:
    """A free grain pressed by twelve held ones, each by `overlap` [of the radius]; returns its id."""
    centre = cs.add_sphere((0, 0, 0), RADIUS, "grain")
    for direction in fcc_directions():
        cs.add_sphere((2 - overlap) * RADIUS * direction, RADIUS, "grain", fixed=True)
    return centre


def add_block(overlap: float, cells: int) -> list[int]:
    """Face-centred cubic block, `cells` cubes wide, its outer layer held; ids of the free grains."""
    edge = (2 - overlap) * RADIUS * math.sqrt(2)
    free = []
    for point in itertools.product(range(2 * cells + 1), repeat=3):
        if sum(point) % 2:
            continue
        outer = any(p in (0, 2 * cells) for p in point)
        position = edge / 2 * np.array(point)
        body = cs.add_sphere(position, RADIUS, "grain", fixed=outer)
        if not outer:
            free.append(body)
    return free


def add_squeezed(kind: str) -> list[int]:
    """Bodies that hold each other, preloaded and in equilibrium; returns the ids of those that are free.

    Each scene has its stiffest mode in a place where Eq 7-8 does not look for it.
    """
    squeeze = 0.1 * RADIUS
    if kind == "light between heavy":
        return _row([(5, "grain"), (1, "grain"), (5, "grain")], 2 * squeeze)
    if kind == "mass ratio 1e6":
        return _row([(1, "heavy"), (1, "grain"), (1, "heavy")], 2 * squeeze)
    if kind == "stiffness ratio 1e4":
        for axis, material in ((2, "grain"), (0, "soft")):
            for side in (-1, 1):
                position = np.eye(3)[axis] * side * (2 * RADIUS - squeeze)
                cs.add_sphere(position, RADIUS, material, fixed=True)
        return [cs.add_sphere((0, 0, 0), RADIUS, "grain")]
    if kind == "walls":
        O.bodies.append(
            [utils.wall(s * (RADIUS - squeeze), axis=2, material="grain") for s in (-1, 1)]
        )
        return [cs.add_sphere((0, 0, 0), RADIUS, "grain")]
    if kind == "boxes":
        half = (3 * RADIUS, 3 * RADIUS, RADIUS)
        for side in (-1, 1):
            height = side * (2 * RADIUS - squeeze)
            O.bodies.append(utils.box((0, 0, height), half, fixed=True, material="grain"))
        return [cs.add_sphere((0, 0, 0), RADIUS, "grain")]
    assert kind == "clump", kind
    members = [utils.sphere((x * RADIUS, 0, 0), RADIUS, material="grain") for x in (-0.8, 0.8)]
    clump, _ = O.bodies.appendClumped(members)
    for x, side in itertools.product((-0.8, 0.8), (-1, 1)):
        height = side * (2 * RADIUS - squeeze)
        cs.add_sphere((x * RADIUS, 0, height), RADIUS, "grain", fixed=True)
    return [clump]


def _row(grains: list[tuple[float, str]], squeeze: float) -> list[int]:
    """Spheres (radius over RADIUS, material) in a row along z between two held ones.

    They move along the row only: a row of rolling spheres under load buckles, whatever the step.
    """
    grains = [(1, "grain"), *grains, (1, "grain")]
    z, ids = 0.0, []
    for number, (size, material) in enumerate(grains):
        radius = size * RADIUS
        z += radius if number else 0
        ids.append(cs.add_sphere((0, 0, z), radius, material))
        held = number in (0, len(grains) - 1)
        O.bodies[ids[-1]].state.blockedDOFs = "xyzXYZ" if held else "xyXYZ"
        z += radius - squeeze
    return ids[1:-1]


def add_materials(friction_angle: float = STICKING) -> None:
    """Elastic 'grain', 'soft' (1e-4 of its modulus) and 'heavy' (1e6 times its density)."""
    for label, solid in (
        ("grain", SOLID),
        ("soft", cs.Solid(1e-4 * SOLID.young, SOLID.poisson, SOLID.density)),
        ("heavy", cs.Solid(SOLID.young, SOLID.poisson, 1e6 * SOLID.density)),
    ):
        O.materials.append(solid.material(label=label, frictionAngle=friction_angle))


def add_colliding_grains() -> list[int]:
    """64 damped, frictional grains that rush together above a floor; their ids."""
    O.materials.append(SOLID.material(label="grain", friction=0.5, restitution=0.7))
    cs.add_plane("grain", -1.01 * RADIUS)
    random = np.random.default_rng(2)
    ids = []
    for place in itertools.product(range(4), repeat=3):
        centre = (np.array(place) * 2.02 + 0.02 * random.standard_normal(3)) * RADIUS
        velocity = 2.0 * (np.array([1.5, 1.5, 1.5]) - place)
        ids.append(cs.add_sphere(centre, RADIUS, "grain", velocity))
    return ids


def shake(ids: list[int], speed: float = 1e-7) -> None:
    """Give the bodies velocities and spins of about `speed` [m/s], the same ones in every run."""
    random = np.random.default_rng(1)
    for body in ids:
        O.bodies[body].state.vel = tuple(speed * random.standard_normal(3))
        O.bodies[body].state.angVel = tuple(speed / RADIUS * random.standard_normal(3))


def kinetic_energy(ids: list[int]) -> float:
    """Translation and rotation of these bodies [J]."""
    total = 0.0
    for state in (O.bodies[i].state for i in ids):
        total += 0.5 * state.mass * state.vel.squaredNorm()
        total += 0.5 * sum(i * w * w for i, w in zip(state.inertia, state.angVel))
    return total


def growth(ids: list[int], steps: int) -> float:
    """Largest kinetic energy within `steps` over that of the start; ends early where it explodes."""
    start, largest = kinetic_energy(ids), 0.0
    for _ in range(steps // 50):
        O.run(50, True)
        now = kinetic_energy(ids) / start
        if not now < 1e6:  # or not a number any more
            return math.inf
        largest = max(largest, now)
    return largest
