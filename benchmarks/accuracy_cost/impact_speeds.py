# SPDX-License-Identifier: GPL-2.0-or-later
"""Oblique impacts of two equal spheres at 0.1 to 300 m/s: one fixed step for all, or one that adapts.

A fixed step must do for all speeds, as in a scene whose fastest grain is not known beforehand. The truth takes
2000 steps for each impact.
"""
from __future__ import annotations

import math
from typing import Any

import numpy as np
from grainfall.contacts import rayleigh_step
from grainfall.hertz import HertzImpact, Solid
from yade import (
    Bo1_Sphere_Aabb,
    EnergyLedger,
    ForceResetter,
    GrainMat,
    HertzTimeStepper,
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
QUARTZ = Solid(70e9, 0.2, 2650.0)
FRICTION = 0.3
RESTITUTION = 0.9
SPEEDS = (0.1, 1.0, 10.0, 100.0, 300.0)  # m/s, closing along the line of centres
SIDEWAYS = math.tan(math.radians(30))
COPIES = 40  # of each impact, so that a run lasts long enough to be timed


def build(speed: float, duration: float) -> EnergyLedger:
    """Pairs that touch after the duration [s] of an impact, and engines; returns the ledger."""
    O.reset()
    O.materials.append(
        GrainMat(
            young=QUARTZ.young,
            poisson=QUARTZ.poisson,
            density=QUARTZ.density,
            frictionAngle=math.atan(FRICTION),
            restitution=RESTITUTION,
        )
    )
    gap = speed * duration
    for copy in range(COPIES):
        # The tangential motion of the approach is made up for: all touch with the line of centres along z.
        at = Vector3(0.02 * copy, 0, 0)
        O.bodies.append(utils.sphere(at, RADIUS, material=0))
        start = at + Vector3(-SIDEWAYS * gap, 0, 2 * RADIUS + gap)
        other = utils.sphere(start, RADIUS, material=0)
        other.state.vel = (SIDEWAYS * speed, 0, -speed)
        O.bodies.append(other)
    ledger = EnergyLedger(iterPeriod=1)
    O.engines = [
        ForceResetter(),
        InsertionSortCollider([Bo1_Sphere_Aabb()], verletDist=0.2 * RADIUS),
        InteractionLoop(
            [Ig2_Sphere_Sphere_ScGeom()],
            [Ip2_GrainMat_GrainMat_GrainPhys()],
            [Law2_ScGeom_GrainPhys_HertzMindlin()],
        ),
        NewtonIntegrator(damping=0),
        ledger,
    ]
    return ledger


def run(control: str, value: float) -> Measurement:
    """Rebound at all speeds, shape (speeds, 3): velocity along and across the line of centres, of spin.

    Parameters
    ----------
    control : str
        'steps': `value` steps an impact; 'rayleigh': `value` of the Rayleigh step; 'hertz': HertzTimeStepper with
        `value` as its safety.
    value : float
        See `control`.
    """
    rebounds, residuals, steps, cpu = [], [], [], 0.0
    for speed in SPEEDS:
        duration = HertzImpact.of_equal_spheres(QUARTZ, RADIUS, speed).duration
        ledger = build(speed, duration)
        O.dt = value * rayleigh_step(RADIUS, QUARTZ.density, QUARTZ.young, QUARTZ.poisson)
        if control == "steps":
            O.dt = duration / value
        elif control == "hertz":
            stepper = HertzTimeStepper(safety=value)
            O.engines = O.engines[:3] + [stepper] + O.engines[3:]
        cpu += timed(lambda: run_until(2.3 * duration))
        assert O.interactions.countReal() == 0
        state = O.bodies[1].state
        rebounds.append(np.array([state.vel[2], state.vel[0], RADIUS * state.angVel[1]]) / speed)
        residuals.append(ledger.largestResidual / ledger.energyInPlay)
        steps.append(O.iter)
    extra = {
        "steps, slowest": steps[0],
        "steps, fastest": steps[-1],
        "energy residual, slowest": residuals[0],
        "energy residual, fastest": residuals[-1],
    }
    return Measurement(np.array(rebounds), cpu / COPIES, extra)


def run_until(end: float) -> None:
    """Run to a time [s]; the step may change meanwhile."""
    while O.time < end:
        O.run(max(1, min(10, math.ceil((end - O.time) / O.dt))), True)


def distance(result: Any, truth: Any) -> float:
    """Root mean square over speeds and components of the difference in rebound, over the speed."""
    return float(np.sqrt(np.mean((result - truth) ** 2)))


def control_knob(name: str, control: str, values: tuple[float, ...]) -> Knob:
    """One way to choose the step, with its values."""
    return Knob(name, {f"{v:g}": {"control": control, "value": v} for v in values})


CASE = Case(
    name="impact_speeds",
    error="rebound velocity, root mean square over impact speed [-]",
    cost="five impacts, 0.1 to 300 m/s",
    run=run,
    reference={"control": "steps", "value": 2000},
    distance=distance,
    knobs=(
        control_knob("fixed step over Rayleigh step", "rayleigh", (0.6, 0.3, 0.15, 0.075)),
        control_knob("HertzTimeStepper, safety", "hertz", (0.4, 0.2, 0.1, 0.05)),
    ),
)
