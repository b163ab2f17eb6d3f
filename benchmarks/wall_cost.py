# SPDX-License-Identifier: GPL-2.0-or-later
"""What a deformable wall costs: set-up and memory by mesh, a step by number of contacts.

usage: PYTHONPATH=build/python yade -j1 -n -x benchmarks/wall_cost.py

Writes benchmarks/results/wall_cost.json. Times are processor seconds of this thread.
"""
from __future__ import annotations

import json
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np

import grainfall  # noqa: F401  the package lives inside YADE
from grainfall import femlink

SAND = {0: (20e6, 0.3, 1600.0)}
SIZE = (0.3, 0.15, 0.1)  # m, its top couples
RESULT = Path(sys.argv[0]).parent / "results" / "wall_cost.json"
GRAIN = 4 / 3 * 70e9 / (1 - 0.2**2) * 1e-3**0.5  # N/m^1.5: quartz, 1 mm radius


def set_up(degree: int, divisions: tuple[int, int, int]) -> tuple[dict[str, Any], femlink.Wall]:
    """Build and condense one wall."""
    start = time.thread_time()
    continuum = femlink.Continuum(
        femlink.box(SIZE, divisions), SAND, degree=degree, solver="direct"
    )
    assembled = time.thread_time()
    model = continuum.condense()
    condensed = time.thread_time()
    row = {
        "degree": degree,
        "divisions": divisions,
        "unknowns": continuum.unknowns,
        "surface_unknowns": model.compliance.shape[0],
        "assembly_s": assembled - start,
        "condensation_s": condensed - assembled,
        **continuum.memory,
    }
    return row, femlink.Wall(model)


def step_cost(wall: femlink.Wall, contacts: int, rounds: int = 5) -> dict[str, Any]:
    """Processor time of a solve from the forces before: every contact moved; overlaps alone changed."""
    rng = np.random.default_rng(3)
    surface = wall.model.surface
    faces = list(rng.integers(0, len(surface.faces), contacts))
    references = rng.uniform(-0.9, 0.9, (contacts, 2))
    overlap = rng.uniform(0.5e-6, 1.5e-6, contacts)
    options: dict[str, Any] = dict(
        free_shear=rng.normal(0, 3e-7, (contacts, 2)),
        coefficient=[GRAIN] * contacts,
        shear_stiffness=1e6,
        friction=0.5,
        tolerance=1e-8,
    )
    cold = wall.solve(faces, references, free_overlap=list(overlap), **options)
    moved, stayed, sweeps = [], [], []
    force = cold["force"]
    for _ in range(rounds):
        references = np.clip(references + rng.normal(0, 1e-3, references.shape), -1, 1)
        overlap = overlap * (1 + rng.normal(0, 1e-3, contacts))
        start = time.thread_time()
        wall.solve(faces, references, free_overlap=list(overlap), start=force, **options)
        middle = time.thread_time()
        overlap = overlap * (1 + rng.normal(0, 1e-3, contacts))
        found = wall.solve(faces, references, free_overlap=list(overlap), start=force, **options)
        stayed.append(time.thread_time() - middle)
        moved.append(middle - start)
        sweeps.append(found["sweeps"])
        force = found["force"]
    return {
        "contacts": contacts,
        "all_moved_ms": 1e3 * float(np.median(moved)),
        "patches_stayed_ms": 1e3 * float(np.median(stayed)),
        "sweeps_cold": cold["sweeps"],
        "sweeps": float(np.median(sweeps)),
        "converged": bool(found["converged"]),
    }


def main() -> None:
    """Measure, print, write."""
    results: dict[str, Any] = {"set_up": [], "steps": []}
    for degree, divisions in [
        (1, (24, 12, 8)),
        (1, (36, 18, 12)),
        (1, (48, 24, 16)),
        (2, (12, 6, 4)),
        (2, (24, 12, 8)),
    ]:
        row, wall = set_up(degree, divisions)
        results["set_up"].append(row)
        print(row, flush=True)
        if (degree, divisions[0]) in [(1, 24), (1, 48)]:
            for contacts in (1, 10, 100, 1000):
                step = {"unknowns": row["unknowns"], **step_cost(wall, contacts)}
                results["steps"].append(step)
                print(step, flush=True)
    RESULT.write_text(json.dumps(results, indent=1) + "\n")


main()
