# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes that put the energy balance to the test; used by the tests and by benchmarks/energy_residual.py.

Each returns its ledger; the scene has then been run. SI units.
"""
from __future__ import annotations

import math

import contact_scenes as cs
import numpy as np
from grainfall.contacts import rayleigh_step
from yade import EnergyLedger, ExponentialFriction, O, utils

GRAVITY = 9.81
HARD = cs.Solid(1.0e11, 0.25, 2500)
SOFT = cs.Solid(1.0e8, 0.25, 2500)
RADIUS = 0.005
SPEED = 2.0


def add_ledger(**attributes) -> EnergyLedger:
    """Append a ledger to O.engines."""
    ledger = EnergyLedger(**attributes)
    O.engines = O.engines + [ledger]
    return ledger


def head_on(steps_per_contact: float, restitution: float = 1.0) -> EnergyLedger:
    """A sphere meets a rigid plane head-on and leaves it."""
    O.materials.append(
        [
            HARD.rigid_material(label="plane", restitution=restitution),
            HARD.material(label="sphere", restitution=restitution),
        ]
    )
    cs.add_plane("plane")
    cs.add_sphere((0, 0, 1.001 * RADIUS), RADIUS, "sphere", (0, 0, -SPEED))
    cs.set_engines(cs.grain_law())
    ledger = add_ledger(iterPeriod=1)
    duration = cs.HertzImpact.on_rigid_plane(HARD, RADIUS, SPEED).duration
    O.dt = duration / steps_per_contact
    cs.run_for(1.6 * duration)
    assert O.interactions.countReal() == 0
    return ledger


def oblique(steps_per_contact: float, restitution: float = 0.5) -> EnergyLedger:
    """Two spinning spheres collide off centre, one with a plane too, with friction and dashpots."""
    values = dict(friction=ExponentialFriction(0.6, 0.2, 20.0), restitution=restitution)
    O.materials.append(
        [HARD.rigid_material(label="plane", **values), HARD.material(label="sphere", **values)]
    )
    cs.add_plane("plane")
    lower = cs.add_sphere((0, 0, RADIUS), RADIUS, "sphere", (0.2, 0, -0.5))
    upper = cs.add_sphere(
        (0, 0.5 * RADIUS, 3.45 * RADIUS),
        1.5 * RADIUS,
        "sphere",
        (SPEED * math.sin(0.5), 0, -SPEED * math.cos(0.5)),
    )
    O.bodies[lower].state.angVel = (0, 200, 80)
    O.bodies[upper].state.angVel = (-100, 50, 0)
    cs.set_engines(cs.grain_law())
    ledger = add_ledger(iterPeriod=1)
    duration = cs.HertzImpact.of_equal_spheres(HARD, RADIUS, SPEED).duration
    O.dt = duration / steps_per_contact
    cs.run_for(8 * duration)
    return ledger


def sliding_pair(exact_kinematics: bool) -> EnergyLedger:
    """A sphere is led round a fixed equal one at constant overlap, without turning, sliding all the way.

    `exact_kinematics` switches YADE's remedy against ratcheting off.
    """
    O.materials.append(SOFT.material(frictionAngle=math.atan(0.3)))
    distance, rate = 1.98 * RADIUS, 10.0
    cs.add_sphere((0, 0, 0), RADIUS, 0, fixed=True)
    cs.add_sphere((distance, 0, 0), RADIUS, 0, fixed=True)
    state = O.bodies[1].state

    def lead() -> None:
        goal = rate * O.dt * (O.iter + 1)
        place = distance * np.array([math.cos(goal), math.sin(goal), 0])
        state.vel = tuple((place - np.array(state.pos)) / O.dt)

    cs.set_engines(cs.grain_law(), lead)
    O.engines[2].geomDispatcher.functors[0].avoidGranularRatcheting = not exact_kinematics
    ledger = add_ledger()
    O.dt = 1e-6
    O.run(2000, True)
    return ledger


def fill_box(grains_per_side: int) -> int:
    """Disordered cubic array of grains, a little apart, in a box without lid; returns the floor's id."""
    O.materials.append(SOFT.material(frictionAngle=math.atan(0.5), restitution=0.6))
    pitch = 2.12 * RADIUS
    for i in range(grains_per_side**3):
        x, y, z = (
            i % grains_per_side,
            i // grains_per_side % grains_per_side,
            i // grains_per_side**2,
        )
        shift_x, shift_y = 0.05 * RADIUS * math.sin(7 * i), 0.05 * RADIUS * math.cos(11 * i)
        radius = RADIUS * (1 + 0.05 * math.sin(3 * i))
        cs.add_sphere((pitch * x + shift_x, pitch * y + shift_y, pitch * z), radius, 0)
    for axis in (0, 1):
        for position in (-1.15 * RADIUS, (grains_per_side - 1) * pitch + 1.15 * RADIUS):
            O.bodies.append(utils.wall(position, axis=axis, sense=0))
    return O.bodies.append(utils.wall(-1.1 * RADIUS, axis=2, sense=0))


def box_step(rayleigh_fraction: float) -> float:
    """Time step [s] as a fraction of the smallest grain's Rayleigh step."""
    return rayleigh_fraction * rayleigh_step(0.95 * RADIUS, SOFT.density, SOFT.young, SOFT.poisson)


def settling_bed(
    rayleigh_fraction: float, grains_per_side: int = 8, duration: float = 0.1
) -> EnergyLedger:
    """Grains fall into a box and settle."""
    fill_box(grains_per_side)
    cs.set_engines(cs.grain_law(), gravity=(0, 0, -GRAVITY))
    ledger = add_ledger(iterPeriod=10)
    O.dt = box_step(rayleigh_fraction)
    cs.run_for(duration)
    return ledger


def shaken_box(
    rayleigh_fraction: float, grains_per_side: int = 5, duration: float = 0.08
) -> EnergyLedger:
    """The same box shaken on its floor at 50 Hz, 1 mm amplitude, after a start from rest."""
    floor = fill_box(grains_per_side)
    peak, rate = 1e-3 * 2 * math.pi * 50, 2 * math.pi * 50

    def shake() -> None:
        O.bodies[floor].state.vel = (0, 0, peak * math.sin(rate * O.time))

    cs.set_engines(cs.grain_law(), gravity=(0, 0, -GRAVITY))
    O.engines = [cs.recorder(shake)] + O.engines
    ledger = add_ledger(iterPeriod=10)
    O.dt = box_step(rayleigh_fraction)
    cs.run_for(duration)
    return ledger


def largest(ledger: EnergyLedger) -> float:
    """Largest residual so far over the energy in play [-]."""
    ledger.update()
    return ledger.largestResidual / ledger.energyInPlay
