# SPDX-License-Identifier: GPL-2.0-or-later
"""The bed as a YADE scene, with the law, loop and integrator of one contender, and its clock.

YADE's ``O.run`` answers up to 40 ms late, so the clock is the last engine of the scene: it is
read after the warm-up and again so many steps later, by the thread that runs the scene.
"""
from __future__ import annotations

import argparse
import json
import math
import os
import time
from collections.abc import Sequence
from typing import Any

import numpy as np
import yade.wrapper as w
from yade import O, utils

from speed import bed as beds

WALL_COUNT = 5
#: Words for the three ways to run the law: stock YADE, our law in YADE's loop, our law in the flat loop.
PATHS = ("stock", "general", "flat")
#: Restitution that gives our repulsive dashpot the coefficient of stock YADE's at 0.5 (laws/damping.hpp).
OUR_RESTITUTION = 0.550283
marks: list[dict[str, float]] = []


def has_flat_path() -> bool:
    """Whether this build has `GrainInteractionLoop` and `GrainIntegrator`."""
    return hasattr(w, "GrainInteractionLoop") and hasattr(w, "GrainIntegrator")


def tick() -> None:
    """Read the clocks; an engine of the scene calls it."""
    marks.append(
        {
            "wall": time.perf_counter(),
            "processor": time.process_time(),
            "searches": _searches(),
        }
    )


def _searches() -> int:
    """How often neighbours have been looked for: by the flat loop itself, else by the collider."""
    for engine in O.engines:
        if hasattr(engine, "statistics") and engine.path == "flat":
            return engine.statistics()["searches"]
    return next(e for e in O.engines if isinstance(e, w.InsertionSortCollider)).numAction


def require_flat() -> None:
    """Raise if a loop that was asked for the flat path left it."""
    for engine in O.engines:
        if hasattr(engine, "statistics") and engine.path != "flat":
            raise RuntimeError(f"the flat path did not run: {engine.path}")


def resident_bytes() -> int:
    """Memory of this process [bytes]."""
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def add_bodies(path: str, rows: np.ndarray, side: float) -> None:
    """Grains, the projectile if there is one, and the box; shape of `rows` (n, 11)."""
    angle = math.atan(beds.FRICTION)
    common = {"young": beds.YOUNG, "poisson": beds.POISSON, "frictionAngle": angle}
    if path == "stock":
        material = w.FrictMat(density=1.0, label="grains", **common)
    else:
        material = w.GrainMat(density=1.0, restitution=OUR_RESTITUTION, label="grains", **common)
    O.materials.append(material)
    bodies = []
    for row in rows.tolist():
        body = utils.sphere(row[:3], row[9], material=material)
        body.state.mass = row[10]
        body.state.inertia = (0.4 * row[10] * row[9] ** 2,) * 3
        body.state.vel, body.state.angVel = row[3:6], row[6:9]
        bodies.append(body)
    O.bodies.append(bodies)
    half = side / 2
    planes = ((-half, 0, 1), (half, 0, -1), (-half, 1, 1), (half, 1, -1), (0.0, 2, 1))
    O.bodies.append(
        [utils.wall(place, axis, sense=sense, material=material) for place, axis, sense in planes]
    )


def contact_loop(path: str, verlet: float, geometry: Sequence[Any] = ()) -> Any:
    """The interaction loop of a contender.

    Parameters
    ----------
    path : str
        One of `PATHS`.
    verlet : float
        Room that a search for neighbours leaves each grain [m]; the flat loop searches itself.
    geometry : sequence of Ig2 functors
        Further ones.
    """
    ig2 = [w.Ig2_Sphere_Sphere_ScGeom(), w.Ig2_Wall_Sphere_ScGeom(hertzian=True), *geometry]
    if path == "stock":
        damped = w.Ip2_FrictMat_FrictMat_MindlinPhys(en=beds.RESTITUTION, es=beds.RESTITUTION)
        return w.InteractionLoop(ig2, [damped], [w.Law2_ScGeom_MindlinPhys_Mindlin()])
    ip2, law = w.Ip2_GrainMat_GrainMat_GrainPhys(), w.Law2_ScGeom_GrainPhys_HertzMindlin()
    if path == "general":
        return w.InteractionLoop(ig2, [ip2], [law])
    loop = w.GrainInteractionLoop(ig2, [ip2], [law])
    loop.skin = verlet / beds.RADIUS
    loop.blindEngines = ["clock"]
    return loop


def integrator(path: str) -> Any:
    """The integrator of a contender."""
    kind = w.GrainIntegrator if path == "flat" else w.NewtonIntegrator
    return kind(gravity=(0, 0, -beds.GRAVITY), damping=0)


def set_engines(path: str, verlet: float, warm_up: int, steps: int) -> None:
    """YADE's usual engines, and the clock, read when `warm_up` steps are done and `steps` later."""
    O.engines = [
        w.ForceResetter(),
        w.InsertionSortCollider([w.Bo1_Sphere_Aabb(), w.Bo1_Wall_Aabb()], verletDist=verlet),
        contact_loop(path, verlet),
        integrator(path),
        w.PyRunner(
            command="import speed.yade_scene; speed.yade_scene.tick()",
            iterPeriod=steps,
            firstIterRun=warm_up - 1,
            nDo=2,
            label="clock",
        ),
    ]
    O.dt = beds.TIME_STEP


def final_bodies(rows: np.ndarray) -> np.ndarray:
    """The rows with the positions, velocities and spins of the moment, shape (n, 11)."""
    result = rows.copy()
    for index in range(len(rows)):
        state = O.bodies[index].state
        result[index, :9] = (*state.pos, *state.vel, *state.angVel)
    return result


def main(arguments: Sequence[str]) -> None:
    """Run one sample and write what was measured."""
    parser = argparse.ArgumentParser(prog="yade_run.py")
    parser.add_argument("path", choices=PATHS)
    parser.add_argument("bed", help="file of the bed")
    parser.add_argument("--side", type=float, required=True, help="of the box [m]")
    parser.add_argument("--verlet", type=float, default=-0.5, help="verletDist of the collider")
    parser.add_argument("--warm-up", type=int, default=20)
    parser.add_argument("--steps", type=int, default=80)
    parser.add_argument("--report", required=True, help="file for the numbers")
    parser.add_argument("--bodies", required=True, help="file for the bodies at the end")
    options = parser.parse_args(arguments)
    if options.warm_up < 2:
        parser.error("--warm-up must be at least 2: the clock is read at the end of its last step")
    if options.path != "stock":
        import grainfall  # noqa: F401  registers the classes

        if options.path == "flat" and not has_flat_path():
            raise SystemExit("this build has no flat path")
    rows = np.fromfile(options.bed).reshape(-1, 11)
    empty = resident_bytes()
    add_bodies(options.path, rows, options.side)
    with_bodies = resident_bytes()
    set_engines(options.path, options.verlet, options.warm_up, options.steps)
    O.run(options.warm_up + options.steps, True)
    with_contacts = resident_bytes()
    first, last = marks
    require_flat()
    final_bodies(rows).tofile(options.bodies)
    report = {
        "wall_seconds": (last["wall"] - first["wall"]) / options.steps,
        "processor_seconds": (last["processor"] - first["processor"]) / options.steps,
        "rebuilds": int(last["searches"] - first["searches"]),
        "contacts": O.interactions.countReal(),
        "pairs": len(O.interactions),
        "bytes_bodies": with_bodies - empty,
        "bytes_contacts": with_contacts - with_bodies,
    }
    with open(options.report, "w", encoding="utf-8") as file:
        json.dump(report, file)
