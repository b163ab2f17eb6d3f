# SPDX-License-Identifier: GPL-2.0-or-later
"""YADE script: a damped, frictional pack settles; writes its positions and velocities as JSON.

usage: yade -n -x [-j2] friction_pack.py <output.json> <tangential law> <gravimetric moisture>
"""
import json
import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(sys.argv[0]).resolve().parent))

import grainfall  # noqa: E402, F401
import contact_scenes as cs  # noqa: E402
from yade import ExponentialFriction, GrainMat, O, utils  # noqa: E402

RADIUS = 0.005
STEPS = 3000


def build() -> None:
    """343 grains, a little out of order, over the floor of a box."""
    friction = ExponentialFriction(0.8, 0.2, 0.05)
    O.materials.append(
        GrainMat(
            young=1e8,
            poisson=0.25,
            density=2500,
            restitution=0.6,
            friction=friction,
            gravimetricMoisture=float(sys.argv[3]),
        )
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
    cs.set_engines(cs.grain_law(tangentialLaw=sys.argv[2]), gravity=(0, 0, -9.81))
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
