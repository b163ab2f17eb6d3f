# SPDX-License-Identifier: GPL-2.0-or-later
"""What a deformable wall costs in a YADE scene, and what solving it seldom changes, docs/physics/far_field.md.

usage: PYTHONPATH=build/python:benchmarks yade -j1 -n -x benchmarks/wall_scene.py

A bed of quartz grains of 10 mm, settled by gravity on soil of 20 MPa, then stepped on: on YADE's rigid wall, on walls
solved in every step and in every n-th. Each is timed in turn, three times, and the medians are taken.
"""
from __future__ import annotations

import json
import statistics
import sys
import time
from pathlib import Path
from typing import Any

import grainfall  # noqa: F401  registers the classes
import numpy as np
from grainfall import femlink
from speed.report import fill
from yade import (
    Bo1_Sphere_Aabb,
    Bo1_Wall_Aabb,
    EnergyLedger,
    ForceResetter,
    GrainIntegrator,
    GrainInteractionLoop,
    GrainMat,
    Ig2_Sphere_Sphere_ScGeom,
    Ig2_Wall_Sphere_ScGeom,
    InsertionSortCollider,
    Ip2_GrainMat_GrainMat_GrainPhys,
    Law2_ScGeom_GrainPhys_HertzMindlin,
    O,
    utils,
)

ROOT = Path(sys.argv[0]).resolve().parents[1]
RADIUS = 0.005  # m
YOUNG = 20e6  # Pa, of the soil
ROUNDS = 3
CONTACTS = (10, 100, 1000)
INTERVALS = (1, 2, 5, 10, 50)
STEPS_THROWN = 3000


def scene(
    across: int, layers: int, interval: int, restitution: float = 0.5, ledger: bool = False
) -> Any:
    """Grains over a wall (interval 0: a rigid one); the wall engine or None."""
    O.reset()
    quartz = {
        "young": 70e9,
        "poisson": 0.2,
        "density": 2650,
        "restitution": restitution,
        "friction": 0.5,
    }
    O.materials.append(GrainMat(**quartz, label="grain"))
    pitch = 2.02 * RADIUS
    side = pitch * (across + 2)
    walls, bounds, geometry, laws = (
        [],
        [Bo1_Wall_Aabb()],
        [Ig2_Wall_Sphere_ScGeom(hertzian=True)],
        [],
    )
    if interval:
        cells = max(4, round(side / (3 * 2 * RADIUS)))
        mesh = femlink.box((side, side, side / 2), (cells, cells, max(2, cells // 2)))
        model = femlink.cached_wall(mesh, {0: (YOUNG, 0.3, 1600.0)})
        walls = [femlink.add_wall(model, "grain", interval=interval)]
        bounds, geometry, laws = femlink.functors()
    else:
        O.bodies.append(utils.wall(0, axis=2, sense=1, material="grain"))
    for i in range(layers * across**2):
        column, layer = i % across**2, i // across**2
        x, y = pitch * (np.array([column % across, column // across]) - 0.5 * (across - 1))
        shift = 0.004 * RADIUS * np.sin(7.0 * i)
        body = utils.sphere(
            (x + shift, y - shift, RADIUS * (1 + 2.001 * layer)), RADIUS, material="grain"
        )
        O.bodies.append(body)
    O.engines = [
        ForceResetter(),
        InsertionSortCollider([Bo1_Sphere_Aabb(), *bounds]),
        *walls,
        GrainInteractionLoop(
            [Ig2_Sphere_Sphere_ScGeom(), *geometry],
            [Ip2_GrainMat_GrainMat_GrainPhys()],
            [Law2_ScGeom_GrainPhys_HertzMindlin(), *laws],
        ),
        GrainIntegrator(gravity=(0, 0, -9.81), label="newton"),
    ]
    if ledger:
        O.engines = [*O.engines, EnergyLedger(iterPeriod=10, label="ledger")]
    O.dt = 1e-6
    return walls[0] if walls else None


def step_costs() -> list[dict[str, Any]]:
    """ms a step by number of contacts, rigid and deformable."""
    rows = []
    for contacts in CONTACTS:
        across = round(contacts**0.5)
        times: dict[int, list[float]] = {}
        row: dict[str, Any] = {}
        for _ in range(ROUNDS):
            for interval in (0, 1, 10, 50):
                start = time.process_time()
                wall = scene(across, 2, interval)
                setup = time.process_time() - start
                newton.damping = 0.3  # noqa: F821
                O.run(400, True)
                steps = 200 if contacts < 1000 or interval != 1 else 50
                start = time.process_time()
                O.run(steps, True)
                times.setdefault(interval, []).append((time.process_time() - start) / steps * 1e3)
                if wall:
                    surface = femlink.load_wall(wall.file).surface
                    row |= {"contacts": wall.contacts, "sweeps": wall.sweeps, "setup_s": setup}
                    row["unknowns"] = 3 * (max(surface.loose) + 1)
        row |= {f"interval_{n}_ms": statistics.median(t) for n, t in times.items() if n}
        row["rigid_ms"] = statistics.median(times[0])
        rows.append(row)
        print(row, flush=True)
    return rows


def price_of_seldom() -> list[dict[str, Any]]:
    """Two layers of grains thrown on the soil at 0.5 m/s: energy and end by interval."""
    rows: list[dict[str, Any]] = []
    reference = None
    for interval in INTERVALS:
        wall = scene(10, 2, interval, ledger=True)
        for body in O.bodies:
            if body.dynamic:
                body.state.vel = (0, 0, -0.5)
        start = time.process_time()
        O.run(STEPS_THROWN, True)
        seconds = time.process_time() - start
        ends = np.array([tuple(b.state.pos) for b in O.bodies if b.dynamic])
        mean = ends.mean(axis=0)[2]
        reference = mean if reference is None else reference
        travelled = 0.5 * STEPS_THROWN * O.dt
        rows.append(
            {
                "interval": interval,
                "seconds": seconds,
                "steps": STEPS_THROWN,
                "residual": ledger.largestResidual / ledger.energyInPlay,  # noqa: F821
                "mean_height_off": abs(mean - reference) / travelled,
                "disagreement": wall.disagreement,
            }
        )
        print(rows[-1], flush=True)
    return rows


def table(rows: list[dict[str, Any]], columns: dict[str, str]) -> str:
    """Markdown of the chosen columns: name in the row -> heading."""

    def text(value: Any) -> str:
        return f"{value:.3g}" if isinstance(value, float) else str(value)

    lines = ["| " + " | ".join(columns.values()) + " |", "|" + "---|" * len(columns)]
    lines += ["| " + " | ".join(text(row[name]) for name in columns) + " |" for row in rows]
    return "\n".join(lines)


def main() -> None:
    """Measure, write the JSON and the tables of the documentation."""
    costs, seldom = step_costs(), price_of_seldom()
    (ROOT / "benchmarks/results/wall_scene.json").write_text(
        json.dumps({"step_costs": costs, "interval": seldom}, indent=1) + "\n"
    )
    text = "\n\n".join(
        [
            table(
                costs,
                {
                    "contacts": "contacts on the wall",
                    "unknowns": "unknowns on the surface",
                    "setup_s": "scene set up, s",
                    "rigid_ms": "rigid wall, ms a step",
                    "interval_1_ms": "interval 1",
                    "interval_10_ms": "interval 10",
                    "interval_50_ms": "interval 50",
                    "sweeps": "sweeps",
                },
            ),
            table(
                seldom,
                {
                    "interval": "interval",
                    "seconds": f"s for {STEPS_THROWN} steps",
                    "residual": "largest energy residual over energy in play",
                    "mean_height_off": "mean height off that of interval 1, over the way fallen",
                    "disagreement": "force found over force solved for, less 1",
                },
            ),
        ]
    )
    fill(ROOT / "docs/physics/far_field.md", "wall_scene", text)


main()
