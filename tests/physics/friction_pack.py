# SPDX-License-Identifier: GPL-2.0-or-later
"""YADE script: a damped, frictional pack settles; writes its positions and velocities as JSON.

usage: yade -n -x [-j2] friction_pack.py <output.json> <tangential law>
"""
import json
import math
import sys

import grainfall  # noqa: F401
from yade import (
    Bo1_Sphere_Aabb,
    Bo1_Wall_Aabb,
    ExponentialFriction,
    ForceResetter,
    GrainMat,
    Ig2_Sphere_Sphere_ScGeom,
    Ig2_Wall_Sphere_ScGeom,
    InsertionSortCollider,
    InteractionLoop,
    Ip2_GrainMat_GrainMat_GrainPhys,
    Law2_ScGeom_GrainPhys_HertzMindlin,
    NewtonIntegrator,
    O,
    utils,
)

RADIUS = 0.005
STEPS = 3000


def build() -> None:
    """343 grains, a little out of order, over the floor of a box."""
    friction = ExponentialFriction(0.8, 0.2, 0.05)
    O.materials.append(
        GrainMat(young=1e8, poisson=0.25, density=2500, restitution=0.6, friction=friction)
    )
    count, pitch = 7, 2.02 * RADIUS
    for i in range(count**3):
        x, y, z = i % count, i // count % count, i // count**2
        shift = 0.05 * RADIUS * math.sin(7.0 * i)
        O.bodies.append(utils.sphere((pitch * x + shift, pitch * y - shift, pitch * z), RADIUS))
    for axis in (0, 1):
        for position in (-1.1 * RADIUS, (count - 1) * pitch + 1.1 * RADIUS):
            O.bodies.append(utils.wall(position, axis=axis, sense=0))
    O.bodies.append(utils.wall(-1.1 * RADIUS, axis=2, sense=0))
    O.engines = [
        ForceResetter(),
        InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()]),
        InteractionLoop(
            [Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()],
            [Ip2_GrainMat_GrainMat_GrainPhys()],
            [Law2_ScGeom_GrainPhys_HertzMindlin(tangentialLaw=sys.argv[2])],
        ),
        NewtonIntegrator(damping=0, gravity=(0, 0, -9.81)),
    ]
    O.dt = 1e-5


build()
O.run(STEPS, True)
grains = [b.state for b in O.bodies if b.dynamic]
with open(sys.argv[1], "w", encoding="utf-8") as file:
    json.dump(
        {
            "threads": O.numThreads,
            "contacts": O.interactions.countReal(),
            "position": [list(s.pos) for s in grains],
            "velocity": [list(s.vel) for s in grains],
        },
        file,
    )
