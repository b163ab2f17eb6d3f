# SPDX-License-Identifier: GPL-2.0-or-later
"""Table 1's drop on one path in YADE; started by `speed.table1`, which see.

usage: yade -j2 -n -x benchmarks/speed/table1_run.py <stock|general|flat> <bed> <side> <seconds> <report>
"""
import json
import sys
import time

import grainfall  # noqa: F401  registers the classes
import numpy as np
import yade.wrapper as w
from grainfall.projectiles import make_projectile
from speed import bed as beds
from speed.yade_scene import add_bodies, contact_loop, integrator, require_flat
from yade import O

# Of the collider [m]; the drop test's own choice, 0.15 of the grains' radius.
VERLET = 0.15 * beds.RADIUS
# The flat loop gives moving grains room besides, so it needs less for those at rest.
FLAT_ROOM = 0.05 * beds.RADIUS
CHUNK = 500  # steps between two lines of progress


def main(path: str, bed: str, side: str, seconds: str, report: str) -> None:
    """Drop, time, write the numbers."""
    rows = np.fromfile(bed).reshape(-1, 11)
    add_bodies(path, rows, float(side))
    top = float(rows[:, 2].max()) + beds.RADIUS
    projectile = make_projectile(
        "table1",
        nose_at=(0, 0, top),
        velocity=(0, 0, -beds.IMPACT_SPEED),
        material=O.bodies[0].material,
    )
    O.bodies.append(projectile)
    shapes = [w.Ig2_SolidOfRevolution_Sphere_ScGeom(), w.Ig2_Wall_SolidOfRevolution_ScGeom()]
    bounds = [w.Bo1_Sphere_Aabb(), w.Bo1_Wall_Aabb(), w.Bo1_SolidOfRevolution_Aabb()]
    O.engines = [
        w.ForceResetter(),
        w.InsertionSortCollider(bounds, verletDist=VERLET),
        contact_loop(path, VERLET if path != "flat" else FLAT_ROOM, shapes),
        integrator(path),
    ]
    O.dt = beds.TIME_STEP
    start_height = projectile.state.pos[2]
    steps = round(float(seconds) / beds.TIME_STEP)
    wall, processor = time.perf_counter(), time.process_time()
    while O.iter < steps:
        O.run(min(CHUNK, steps - O.iter), True)
        depth = start_height - projectile.state.pos[2]
        print(
            f"{path}: {O.time:.3f} s, {1e3 * depth:.1f} mm deep, {time.perf_counter() - wall:.0f} s of wall time",
            flush=True,
        )
    require_flat()
    numbers = {
        "wall_seconds": time.perf_counter() - wall,
        "processor_seconds": time.process_time() - processor,
        "threads": O.numThreads,
        "steps": steps,
        "depth_m": start_height - projectile.state.pos[2],
        "speed_m_per_s": -projectile.state.vel[2],
    }
    with open(report, "w", encoding="utf-8") as file:
        json.dump(numbers, file)


main(*sys.argv[1:])
