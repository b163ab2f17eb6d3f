# SPDX-License-Identifier: GPL-2.0-or-later
"""Oblique impacts of two equal spheres at 43 angles: step size and tangential law.

The truth is the partial-slip law at 2000 steps a collision, which is the solution of Maw, Barber & Fawcett (1976) for
elastic spheres (docs/physics/partial_slip.md). What a law cannot do stays as a floor, however small the step.
"""
from __future__ import annotations

import math
from typing import Any

import numpy as np
from grainfall.hertz import HertzImpact, Solid
from yade import (
    Bo1_Sphere_Aabb,
    ForceResetter,
    GrainMat,
    Ig2_Sphere_Sphere_ScGeom,
    InsertionSortCollider,
    InteractionLoop,
    Ip2_GrainMat_GrainMat_GrainPhys,
    Law2_ScGeom_GrainPhys_HertzMindlin,
    NewtonIntegrator,
    O,
    Vector3,
    utils,
)

from accuracy_cost.study import Case, Knob, Measurement, timed

RADIUS = 0.36e-3  # m
YOUNG, POISSON, DENSITY = 70e9, 0.2, 2650.0  # quartz
FRICTION = 0.3
SPEED = 1.0  # m/s, closing along the line of centres
ANGLES = np.radians(np.arange(0.0, 86.0, 2.0))  # of the velocity to the line of centres
COPIES = 5  # of each impact, so that a run lasts long enough to be timed


def run(steps: int, law: str) -> Measurement:
    """Rebound of all pairs, shape (angles, 3): normal and tangential velocity and surface velocity of spin, over SPEED.

    Parameters
    ----------
    steps : int
        Time steps in the duration of the impact.
    law : str
        tangentialLaw.
    """
    O.reset()
    O.materials.append(
        GrainMat(young=YOUNG, poisson=POISSON, density=DENSITY, frictionAngle=math.atan(FRICTION))
    )
    movers = []
    for copy in range(COPIES):
        for n, angle in enumerate(ANGLES):
            at = Vector3(0.01 * n, 0.01 * copy, 0)
            O.bodies.append(utils.sphere(at, RADIUS, material=0))
            other = utils.sphere(at + Vector3(0, 0, 2 * RADIUS), RADIUS, material=0)
            other.state.vel = (SPEED * math.tan(angle), 0, -SPEED)
            movers.append(O.bodies.append(other))
    O.engines = [
        ForceResetter(),
        InsertionSortCollider([Bo1_Sphere_Aabb()], verletDist=0.2 * RADIUS),
        InteractionLoop(
            [Ig2_Sphere_Sphere_ScGeom()],
            [Ip2_GrainMat_GrainMat_GrainPhys()],
            [Law2_ScGeom_GrainPhys_HertzMindlin(tangentialLaw=law)],
        ),
        NewtonIntegrator(damping=0),
    ]
    head_on = HertzImpact.of_equal_spheres(Solid(YOUNG, POISSON, DENSITY), RADIUS, SPEED)
    O.dt = head_on.duration / steps
    O.trackEnergy = False
    cpu = timed(lambda: O.run(math.ceil(1.1 * steps), True))
    assert O.interactions.countReal() == 0
    states = [O.bodies[i].state for i in movers[: len(ANGLES)]]
    rebound = np.array([[s.vel[2], s.vel[0], RADIUS * s.angVel[1]] for s in states]) / SPEED
    return Measurement(rebound, cpu / (COPIES * len(ANGLES)))


def distance(result: Any, truth: Any) -> float:
    """Root mean square over angles and components of the difference in rebound, over SPEED."""
    return float(np.sqrt(np.mean((result - truth) ** 2)))


def steps_of(law: str) -> Knob:
    """Step size, with this law."""
    counts = (8, 12, 20, 40, 80, 160, 320)
    return Knob(f"{law}: steps a collision", {str(n): {"steps": n, "law": law} for n in counts})


CASE = Case(
    name="two_sphere_impact",
    error="rebound velocity, root mean square over impact speed [-]",
    cost="one impact",
    run=run,
    reference={"steps": 2000, "law": "mindlin-deresiewicz"},
    distance=distance,
    knobs=tuple(steps_of(law) for law in ("mindlin-deresiewicz", "incremental", "secant", "none")),
)
