# SPDX-License-Identifier: GPL-2.0-or-later
"""What effects, boxes and a projectile cost on the flat path.

usage: PYTHONPATH=build/python:benchmarks yade -j1 -n -x benchmarks/flat_effects.py [build] [--rounds 5]
                                          [--grains 10000] [--output benchmarks/results/flat_effects.json]
                                          [--page docs/flat_path.md]

The beds of the speed benchmark (speed/bed.py): grains at rest in a box, and 15 ms after a sphere of 10 kg met them.
Every case makes its contacts and their histories in 300 steps and is saved. In each round every case in turn is
loaded and timed, in processor time; ratios to the plain bed are formed within a round, and the median over the rounds
is given, with the quartiles. A moist bed has bridges over gaps besides the contacts of the dry one.
"""
from __future__ import annotations

import argparse
import json
import math
import sys
import time
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import grainfall  # noqa: F401
import numpy as np
import yade.wrapper as w
from speed import bed as beds
from speed.report import fill
from yade import O, utils

PREPARATION, WARM_UP, STEPS = 300, 30, 300  # steps
DENSITY = beds.MASS / (4 / 3 * math.pi * beds.RADIUS**3)  # kg/m3
WATER = {"gravimetricMoisture": 0.01 * 2650 / DENSITY}  # as much as 1 % of quartz
CACHE = Path.home() / ".cache" / "grainfall" / "speed"


@dataclass(frozen=True)
class Case:
    """A bed: what differs from dry grains in walls."""

    name: str
    material: dict[str, Any] = field(default_factory=dict)
    law: dict[str, Any] = field(default_factory=dict)
    boxes: bool = False
    solid: bool = False
    books: bool = False


CASES = (
    Case("dry, constant friction"),
    Case("friction: power law", {"friction": "PowerLawFriction"}),
    Case("liquid bridges", WATER),
    Case("liquid bridges, closed form", {**WATER, "bridgeModel": "willett-closed"}),
    Case("liquid bridges with viscous film", {**WATER, "liquidViscosity": 1e-3}),
    Case("partial slip", law={"tangentialLaw": "mindlin-deresiewicz"}),
    Case("energy booking", books=True),
    Case("five boxes in the place of walls", boxes=True),
    Case("solid of revolution in the place of the sphere", solid=True),
)


def build(case: Case, rows: np.ndarray, side: float) -> None:
    """The case's grains, box and engines; `rows` as in a bed's file, shape (n, 11)."""
    O.reset()
    values = {
        "young": beds.YOUNG,
        "poisson": beds.POISSON,
        "density": DENSITY,
        "restitution": beds.RESTITUTION,
        "friction": beds.FRICTION,
        **case.material,
    }
    if isinstance(values["friction"], str):
        values["friction"] = getattr(w, values["friction"])()
    material = w.GrainMat(**values, label="grains")
    O.materials.append(material)
    dry = w.GrainMat(**{**values, "gravimetricMoisture": 0}, label="projectile")
    O.materials.append(dry)
    for row in rows.tolist():
        projectile = row[9] == beds.PROJECTILE_RADIUS
        body = utils.sphere(row[:3], row[9], material=dry if projectile else material)
        if projectile and case.solid:
            body.shape = w.SolidOfRevolution(profile=[(-row[9], 0, 1), (row[9], 0, 0)])
        body.state.mass = row[10]
        body.state.inertia = (0.4 * row[10] * row[9] ** 2,) * 3
        body.state.vel, body.state.angVel = row[3:6], row[6:9]
        O.bodies.append(body)
    add_walls(case.boxes, side, 4 * rows[:, 2].max(), material)
    O.engines = engines(case)
    O.dt = beds.TIME_STEP
    O.trackEnergy = case.books


def add_walls(boxes: bool, side: float, height: float, material: Any) -> None:
    """Four sides and a floor around the z axis [m]."""
    half = side / 2
    for place, axis in ((-half, 0), (half, 0), (-half, 1), (half, 1), (0.0, 2)):
        if not boxes:
            O.bodies.append(utils.wall(place, axis=axis, sense=0, material=material))
            continue
        extents, centre = np.array([side, side, height]), np.zeros(3)
        extents[axis] = 2 * beds.RADIUS
        centre[axis] = place + math.copysign(extents[axis], place if axis < 2 else -1)
        O.bodies.append(utils.box(tuple(centre), tuple(extents), fixed=True, material=material))


def engines(case: Case) -> list[Any]:
    """With the functors of every shape that a case may have."""
    shapes = ("Sphere", "Wall", "Box", "SolidOfRevolution")
    loop = w.GrainInteractionLoop(
        [
            w.Ig2_Sphere_Sphere_ScGeom(),
            w.Ig2_Wall_Sphere_ScGeom(hertzian=True),
            w.Ig2_Box_Sphere_ScGeom(),
            w.Ig2_SolidOfRevolution_Sphere_ScGeom(),
            w.Ig2_Wall_SolidOfRevolution_ScGeom(),
        ],
        [w.Ip2_GrainMat_GrainMat_GrainPhys()],
        [w.Law2_ScGeom_GrainPhys_HertzMindlin(**case.law)],
    )
    loop.skin = beds.SKIN / 2 / beds.RADIUS
    return [
        w.ForceResetter(),
        w.InsertionSortCollider([getattr(w, f"Bo1_{shape}_Aabb")() for shape in shapes]),
        loop,
        w.GrainIntegrator(gravity=(0, 0, -beds.GRAVITY), damping=0),
    ]


def time_a_case(name: str) -> dict[str, float]:
    """ms a step, real contacts."""
    O.loadTmp(name)
    O.run(WARM_UP, True)
    start = time.process_time()
    O.run(STEPS, True)
    elapsed = time.process_time() - start
    if O.engines[2].path != "flat":
        raise RuntimeError(f"{name} ran on the path '{O.engines[2].path}'")
    return {"step_ms": 1e3 * elapsed / STEPS, "contacts": O.interactions.countReal()}


def quartiles(values: Sequence[float]) -> list[float]:
    """Median, lower and upper quartile."""
    low, middle, high = np.percentile(values, (25, 50, 75))
    return [round(float(v), 3) for v in (middle, low, high)]


def summarise(samples: dict[str, list[dict[str, float]]]) -> dict[str, Any]:
    """Medians and quartiles over the rounds of each case; ratios formed within a round."""
    plain = samples[CASES[0].name]
    return {
        name: {
            "contacts": int(own[-1]["contacts"]),
            "step_ms": quartiles([s["step_ms"] for s in own]),
            "over_dry": quartiles([s["step_ms"] / p["step_ms"] for s, p in zip(own, plain)]),
        }
        for name, own in samples.items()
    }


def table(results: dict[str, dict[str, Any]], grains: int) -> str:
    """In Markdown."""
    lines = [
        f"| {grains} grains | contacts | at rest, ms | over dry | contacts | struck, ms | over dry |",
        "| --- | ---: | ---: | ---: | ---: | ---: | ---: |",
    ]
    for case in CASES:
        cells = []
        for bed in ("settled", "struck"):
            entry = results[bed].get(case.name)
            if entry is None:
                cells += ["", "", ""]
                continue
            middle, low, high = entry["over_dry"]
            cells += [
                str(entry["contacts"]),
                f"{entry['step_ms'][0]:.2f}",
                f"{middle:.2f} ({low:.2f} to {high:.2f})",
            ]
        lines.append(f"| {case.name} | " + " | ".join(cells) + " |")
    return "\n".join(lines)


def main(arguments: list[str]) -> None:
    """Prepare, measure, write."""
    home = Path(__file__ if __file__.endswith("flat_effects.py") else sys.argv[0]).resolve().parent
    parser = argparse.ArgumentParser(prog="flat_effects.py", description=__doc__.splitlines()[0])
    parser.add_argument("build", nargs="?", type=Path, default=home.parent / "build")
    parser.add_argument("--rounds", type=int, default=5, help="rounds, each with every case")
    parser.add_argument("--grains", type=int, default=10_000)
    parser.add_argument("--output", type=Path, default=home / "results" / "flat_effects.json")
    parser.add_argument("--page", type=Path, help="page whose table is rewritten")
    options = parser.parse_args(arguments)
    program = options.build / "benchmarks" / "speed" / "bare_loop"
    results = {}
    for bed, make in (("settled", beds.settled_bed), ("struck", beds.struck_bed)):
        made = make(options.grains, CACHE, program)
        cases = [case for case in CASES if bed == "struck" or not case.solid]
        for case in cases:
            build(case, made.bodies(), made.side)
            O.run(PREPARATION, True)
            O.saveTmp(case.name)
        samples: dict[str, list[dict[str, float]]] = {case.name: [] for case in cases}
        for _ in range(options.rounds):
            for case in cases:
                samples[case.name].append(time_a_case(case.name))
        results[bed] = summarise(samples)
    report = {"grains": options.grains, "rounds": options.rounds, **results}
    options.output.parent.mkdir(parents=True, exist_ok=True)
    options.output.write_text(json.dumps(report, indent=1) + "\n", encoding="utf-8")
    page_table = table(results, options.grains)
    print(page_table)
    if options.page:
        fill(options.page, "flat effects", page_table)


main(sys.argv[1:])
