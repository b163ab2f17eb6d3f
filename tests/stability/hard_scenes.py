# SPDX-License-Identifier: GPL-2.0-or-later
"""For the stability tests: what every hard case runs with, and scenes of many independent contacts.

A hard case is one scene that holds a copy of itself for every friction curve, far enough apart that the copies never
meet; it is run once for each tangential law. SI units throughout.
"""
from __future__ import annotations

from collections.abc import Iterable, Sequence

import contact_scenes as cs
import numpy as np
from grainfall.hertz import HertzImpact, Solid
from yade import (
    AsperityFriction,
    ConstantFriction,
    ExponentialFriction,
    GrainMat,
    GrainPair,
    Law2_ScGeom_GrainPhys_HertzMindlin,
    O,
    PowerLawFriction,
    TableFriction,
    Vector3,
    utils,
)

TANGENTIAL_LAWS = ("incremental", "mindlin-deresiewicz", "secant", "report", "none")
# Secant and report make energy by construction (secant on normal loading, the report's Eq 4 on unloading) and book what
# they make as negative grainRescaling.
ENERGY_SAFE = ("incremental", "mindlin-deresiewicz", "none")

CURVES = {
    "constant": lambda: ConstantFriction(0.5),
    "power law": lambda: PowerLawFriction(),  # after Cole: 0.8 at 1 N, 0.2 at 20 N
    "exponential": lambda: ExponentialFriction(0.8, 0.2, 5.0),
    "asperity": lambda: AsperityFriction(0.2, 0.3, 1.0),
    "table": lambda: TableFriction([1.0, 20.0], [0.0, 0.1], [[0.8, 0.6], [0.2, 0.1]]),
    "steep": lambda: TableFriction([9.99, 10.0], [0.0], [[0.8], [0.2]]),
    "frictionless": lambda: ConstantFriction(0.0),
    "very rough": lambda: ConstantFriction(1e6),
}

YOUNG = 70e9  # Pa, quartz
POISSON = 0.2
DENSITY = 2650.0  # kg/m3
RADIUS = 0.36e-3  # m, half of the D50 of ASTM 20-30 sand


def material(curve: str, label: str, **attributes) -> str:
    """Append quartz with a curve of CURVES; returns the label."""
    values = dict(young=YOUNG, poisson=POISSON, density=DENSITY, friction=CURVES[curve]())
    O.materials.append(GrainMat(**{**values, **attributes}, label=label))
    return label


def set_engines(
    law: str,
    gravity: float = 0.0,
    extra: Sequence = (),
    pairs: Sequence[GrainPair] = (),
    **law_attributes,
) -> Law2_ScGeom_GrainPhys_HertzMindlin:
    """Ordinary engines for spheres, walls and boxes; `extra` ones stand before the integrator. Returns the law."""
    functors = cs.grain_law({"pairs": list(pairs)}, tangentialLaw=law, **law_attributes)
    cs.set_engines(functors, gravity=(0, 0, -gravity))
    O.engines = [*O.engines[:-1], *extra, O.engines[-1]]
    O.trackEnergy = True
    return functors[1][0]


def sphere(
    centre: Iterable[float],
    radius: float,
    label: str,
    velocity: Iterable[float] = (0, 0, 0),
    spin: Iterable[float] = (0, 0, 0),
) -> int:
    """Append a sphere; returns its id."""
    body = utils.sphere(tuple(centre), radius, material=label)
    body.state.vel = Vector3(*velocity)
    body.state.angVel = Vector3(*spin)
    return O.bodies.append(body)


def impact_duration(speed: float, radius: float = RADIUS, young: float = YOUNG) -> float:
    """Duration [s] of the elastic impact of two equal quartz spheres closing at `speed` (Hertz)."""
    return HertzImpact.of_equal_spheres(Solid(young, POISSON, DENSITY), radius, speed).duration


def states(ids: Iterable[int]) -> list:
    """States of these bodies."""
    return [O.bodies[i].state for i in ids]


def kinetic_energy(ids: Iterable[int]) -> float:
    """Translation and rotation of these spheres [J]."""
    return sum(
        0.5 * s.mass * s.vel.squaredNorm() + 0.5 * s.inertia[0] * s.angVel.squaredNorm()
        for s in states(ids)
    )


def total_energy(law: Law2_ScGeom_GrainPhys_HertzMindlin, ids: Iterable[int]) -> float:
    """Kinetic energy of these spheres and what the contacts store, at one moment [J].

    Velocities stand half a step after the contacts; v_before . v_after is the kinetic energy of that moment.
    """
    kinetic = 0.0
    for i in ids:
        state = O.bodies[i].state
        velocity = state.vel - 0.5 * O.dt * O.forces.f(i) / state.mass
        spin = state.angVel - 0.5 * O.dt * O.forces.t(i) / state.inertia[0]
        kinetic += 0.5 * state.mass * state.vel.dot(2 * velocity - state.vel)
        kinetic += 0.5 * state.inertia[0] * state.angVel.dot(2 * spin - state.angVel)
    return kinetic + sum(law.elasticEnergy().values())


def momentum(ids: Iterable[int]) -> np.ndarray:
    """Linear momentum [kg m/s], shape (3,)."""
    return np.sum([s.mass * np.array(s.vel) for s in states(ids)], axis=0)


def angular_momentum(ids: Iterable[int], about: Iterable[float]) -> np.ndarray:
    """Of these spheres about a point [kg m2/s], shape (3,)."""
    origin = np.array(list(about))
    return np.sum(
        [
            s.mass * np.cross(np.array(s.pos) - origin, np.array(s.vel))
            + s.inertia[0] * np.array(s.angVel)
            for s in states(ids)
        ],
        axis=0,
    )


def all_finite() -> bool:
    """Is every position and velocity a number?"""
    return all(np.all(np.isfinite([*b.state.pos, *b.state.vel, *b.state.angVel])) for b in O.bodies)


def booked() -> dict[str, float]:
    """Energies that the law has booked [J]; names that were never used are missing."""
    return {name: value for name, value in O.energy.items() if name.startswith("grain")}


def made() -> float:
    """Energy [J] that the law says it has made: negative rescaling."""
    return max(0.0, -booked().get("grainRescaling", 0.0))
