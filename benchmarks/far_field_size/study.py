# SPDX-License-Identifier: GPL-2.0-or-later
"""Drops of the full-scale replica in near fields of several sizes: rigid walls, a continuum outside, grains throughout.

The replica falls on 12 mm grains (Young's modulus 2e8 Pa) in a square box 0.15 m deep. A continuum reaches out to 3.5
diameters, and as far below the floor as to the sides.
"""
from __future__ import annotations

import json
import resource
import subprocess
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np

DIAMETER = 0.057  # m, of the replica
#: Half-widths in diameters: of near fields with rigid walls and in a continuum, of the bed that has grains as far as
#: the continuum reaches, and of larger ones.
NEAR, WHOLE, LARGER = (1.25, 1.75, 2.5), 3.5, (5.0, 7.0)
#: Steps between common solutions that are tried in the smallest near field.
INTERVALS = (10, 30, 100)
DEPTH, GRAIN, YOUNG, END = 0.15, 12e-3, 2e8, 0.05
#: Moment at which depths are compared, after first touch [s].
COMPARED_AT = 0.04
#: After first touch, the time over which the force is averaged [s]: its peak is the hit of single grains.
FORCE_OVER = 0.02
RIGID, CONTINUUM = "rigid", "quasi-static"


@dataclass(frozen=True)
class Case:
    """One drop: half-width in diameters, what is outside, steps between common solutions, seed of the packing."""

    half_width: float
    outside: str
    interval: int
    seed: int

    @property
    def name(self) -> str:
        """Of its results folder."""
        wall = f"continuum-{self.interval}" if self.outside == CONTINUUM else self.outside
        return f"{self.half_width:g}d-{wall}-seed{self.seed}"

    def options(self) -> dict[str, Any]:
        """Of the drop test."""
        radius = self.half_width * DIAMETER
        options = {
            "preset": "m70-full",
            "grain-diameter": GRAIN,
            "young": YOUNG,
            "bed-depth": DEPTH,
            "near-field-radius": radius,
            "duration": END,
            "rest-speed": 0,
            "vtk-interval": 0,
            "seed": self.seed,
            "far-field": self.outside,
        }
        if self.outside == CONTINUUM:
            options["far-field-thickness"] = round((WHOLE - self.half_width) * DIAMETER, 9)
            options["far-field-interval"] = self.interval
        return options


def cases(seeds: int, interval: int) -> list[Case]:
    """Of the study, packing by packing; then the smallest near field with other intervals."""
    found = []
    for seed in range(1, seeds + 1):
        for half_width in NEAR:
            found.append(Case(half_width, RIGID, 0, seed))
            found.append(Case(half_width, CONTINUUM, interval, seed))
        found += [Case(half_width, RIGID, 0, seed) for half_width in (WHOLE, *LARGER)]
    found += [Case(NEAR[0], CONTINUUM, n, seed) for n in INTERVALS for seed in range(1, seeds + 1)]
    return list(dict.fromkeys(found))


def run(case: Case, folder: Path, script: Path) -> dict[str, Any]:
    """Settle the bed unless it is kept, drop, and return what is reported."""
    rigid = {name: value for name, value in case.options().items() if "far-field-" not in name}
    settling = _drop(rigid | {"far-field": RIGID, "duration": 1e-6}, folder / "bed", script)
    bed = json.loads((folder / "bed" / "summary.json").read_text())["bed"]
    dropping = _drop(case.options(), folder / case.name, script)
    summary = json.loads((folder / case.name / "summary.json").read_text())
    trace = np.genfromtxt(folder / case.name / "trace.csv", delimiter=",", names=True)
    since_touch = trace["time_s"] - summary["touch_time_s"]
    wall = summary.get("far_field", {})
    return {
        **asdict(case),
        "grains": summary["particles"],
        "steps": summary["steps"],
        "settling_s": None if bed["from_cache"] else settling,
        "drop_s": dropping,
        "setup_s": wall.get("setup_seconds", 0.0),
        "peak_force_camera_N": summary["peak_force_camera_N"],
        "mean_force_N": mean_force(since_touch, trace["force_N"]),
        "depth_m": float(np.interp(COMPARED_AT, since_touch, trace["depth_m"])),
        "energy_residual_relative": summary["energy_residual_relative"],
        "young_Pa": wall.get("young_Pa"),
        "unknowns": wall.get("unknowns"),
        "surface_unknowns": wall.get("surface_unknowns"),
        "contacts": wall.get("most_contacts"),
        "largest_displacement_m": wall.get("largest_displacement_m"),
        "largest_disagreement": wall.get("largest_disagreement"),
    }


def mean_force(since_touch: np.ndarray, force: np.ndarray) -> float:
    """Of the first `FORCE_OVER` after the touch [N]."""
    inside = (since_touch > 0) & (since_touch < FORCE_OVER)
    times = np.concatenate([[0], since_touch[inside], [FORCE_OVER]])
    return float(np.trapz(np.interp(times, since_touch, force), times) / FORCE_OVER)


def _drop(options: dict[str, Any], output: Path, script: Path) -> float:
    """Processor seconds of one run of the scenario."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    arguments = [f"--{name}={value}" for name, value in options.items()]
    command = ["yade", "-j1", "-n", "-x", str(script), *arguments, "--no-plots", "--quiet"]
    subprocess.run([*command, f"--output={output}"], check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
