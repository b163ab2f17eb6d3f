# SPDX-License-Identifier: GPL-2.0-or-later
"""For the tests of effects: a heap of moist grains in which every effect of the contact law acts.

As a script: yade -n -x [-j2] priced_heap.py <output.json> prices the heap and writes the prices.
"""
from __future__ import annotations

import json
import math
import sys
from collections.abc import Mapping
from typing import Any

import grainfall
from yade import (
    Bo1_Sphere_Aabb,
    Bo1_Wall_Aabb,
    EnergyLedger,
    ForceResetter,
    GrainMat,
    HertzTimeStepper,
    Ig2_Sphere_Sphere_ScGeom,
    Ig2_Wall_Sphere_ScGeom,
    InsertionSortCollider,
    InteractionLoop,
    Ip2_GrainMat_GrainMat_GrainPhys,
    Law2_ScGeom_GrainPhys_HertzMindlin,
    MoistureFactor,
    NewtonIntegrator,
    O,
    PowerLawFriction,
    utils,
)

RADIUS = 2.5e-3  # m
#: Everything that a material can ask for. Soft grains: the arithmetic does not depend on it.
ALL_EFFECTS: dict[str, Any] = dict(
    young=1e7,
    poisson=0.25,
    density=2650,
    restitution=0.7,
    gravimetricMoisture=0.01,
    liquidViscosity=1e-3,
    referenceRadius=0.5e-3,
)


def friction() -> PowerLawFriction:
    """A curve that falls with the load and with moisture, at the loads of this heap too."""
    return PowerLawFriction(
        muRef=0.5,
        loadRef=1e-3,
        exponent=0.2,
        muMin=0.1,
        muMax=2,
        moistureFactor=MoistureFactor([0, 0.1], [1, 0.5]),
    )


def heap(
    side: int = 4,
    material: Mapping[str, Any] | None = None,
    tangential_law: str = "mindlin-deresiewicz",
    engines: bool = True,
    pitch: float = 2.05 * RADIUS,
) -> None:
    """Grains that fall into a box, side^3 of them, `pitch` [m] apart; label of the law: ``law``."""
    values = {**ALL_EFFECTS, "friction": friction()} if material is None else material
    O.materials.append(GrainMat(label="sand", **values))
    for i in range(side**3):
        x, y, z = i % side, i // side % side, i // side**2
        shift = 0.1 * RADIUS * math.sin(7.0 * i)
        O.bodies.append(utils.sphere((pitch * x + shift, pitch * y - shift, pitch * z), RADIUS))
    for axis in (0, 1):
        for position in (-1.1 * RADIUS, (side - 1) * pitch + 1.1 * RADIUS):
            O.bodies.append(utils.wall(position, axis=axis, sense=0))
    O.bodies.append(utils.wall(-1.1 * RADIUS, axis=2, sense=0))
    law = Law2_ScGeom_GrainPhys_HertzMindlin(tangentialLaw=tangential_law, label="law")
    O.engines = [
        ForceResetter(),
        InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()], verletDist=0.1 * RADIUS),
        InteractionLoop(
            [Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom(hertzian=True)],
            [Ip2_GrainMat_GrainMat_GrainPhys()],
            [law],
            label="contacts",
        ),
        *([HertzTimeStepper()] if engines else []),
        NewtonIntegrator(gravity=(0, 0, -9.81), damping=0),
        *([EnergyLedger(iterPeriod=20, label="ledger")] if engines else []),
    ]
    O.dt = 1e-5


def main(output: str) -> None:
    """Settle the heap a little, price it, write what came out."""
    heap(side=3, pitch=1.99 * RADIUS)
    O.run(5, True)
    prices = grainfall.price(seconds=0.02, show=False)
    with open(output, "w", encoding="utf-8") as file:
        json.dump(prices.as_dict(), file)


if __name__ == "__main__" and sys.argv[0].endswith("priced_heap.py"):
    main(sys.argv[1])
