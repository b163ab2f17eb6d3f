# SPDX-License-Identifier: GPL-2.0-or-later
"""What a run reports: results, effects, price, how coarse the sand was."""

from __future__ import annotations

import builtins
import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from yade import O

from grainfall import run_notes
from grainfall.beds import Bed
from grainfall.drop.results import drop_results, energy_results
from grainfall.effects import running_effects
from grainfall.report.html_page import number, split_unit
from grainfall.wall_clock import engine_seconds
from grainfall.water import water_budget

if TYPE_CHECKING:
    from grainfall.drop.run import DropRun

#: Results printed at the end of a run.
PRINTED = (
    "particles",
    "impact_speed_m_per_s",
    "depth_m",
    "peak_force_camera_N",
    "peak_force_N",
    "stop_time_s",
    "grain_enlargement",
    "energy_residual_relative",
    "simulated_seconds",
)


def make_summary(run: DropRun, bed: Bed) -> dict[str, Any]:
    """Contents of ``summary.json``: see README for the keys; each states its unit."""
    p = run.parameters
    trace = run.trace.arrays()
    summary: dict[str, Any] = {
        "preset": p["preset"],
        "seed": p["seed"],
        "particles": len(bed.radii),
        "steps": O.iter,
        "time_step_s": O.dt,
        **time_steps(p),
        "simulated_seconds": O.time,
        "wall_seconds": run.earlier["wall_seconds"] + run.clock.total,
        "interrupted": run.interrupted,
        "threads": O.numThreads,
    }
    if len(trace["time_s"]) > 1:
        summary.update(drop_results(trace, p["mass"], p["rest_speed"]))
        ledger = None if p["no_energy"] else builtins.energy_ledger
        summary.update(energy_results(ledger, run.trace.energy_arrays()))
    summary.update(coarsening(p, bed))
    summary["largest_overlap_over_radius"] = run.snapshots.largest_relative_overlap
    summary["effects"] = running_effects()
    summary["path"] = getattr(builtins.contacts, "path", "general")
    if p["moisture"] > 0 and p["bridges"] != "none":
        summary["water"] = water_budget()
    summary["price"] = engine_seconds(run.clock, "drop", run.earlier["price"])
    summary["bed"] = {**bed.report, "from_cache": run.bed_was_cached}
    if run.far_field:
        summary["far_field"] = run.far_field.summary(p["far_field_interval"])
    summary["parameters"] = dict(p)
    summary["notes"] = notes(summary) + (run.far_field.notes() if run.far_field else [])
    return summary


def time_steps(p: dict[str, Any]) -> dict[str, Any]:
    """Smallest and mean step [s], and what decided the smallest one."""
    mean = O.time / O.iter if O.iter else O.dt
    if p["time_step_control"] == "hertz":
        stepper = builtins.time_stepper
        smallest, reason = stepper.smallestStep, stepper.smallestReason
    else:
        smallest = O.dt
        reason = "given" if p["time_step"] is not None else "Rayleigh step of the smallest grain"
    return {
        "time_step_smallest_s": smallest,
        "time_step_mean_s": mean,
        "time_step_decided_by": reason,
    }


def coarsening(p: dict[str, Any], bed: Bed) -> dict[str, Any]:
    """By how much the grains were enlarged, and how many the real ones would be."""
    real = p["reference_diameter"]
    if not real:
        return {"grain_enlargement": 1.0, "real_grains": len(bed.radii)}
    volume = float(np.sum(4 / 3 * math.pi * bed.radii**3))
    return {
        "grain_enlargement": p["grain_diameter"] / real,
        "real_grains": round(volume / (math.pi / 6 * real**3)),
    }


def notes(summary: dict[str, Any]) -> list[str]:
    """What a reader must know to use the numbers."""
    lines = run_notes.coarse_grains(summary)
    overlap = summary["largest_overlap_over_radius"]
    if overlap > 0.01:
        lines.append(
            f"The largest overlap seen is {100 * overlap:.1f} % of a grain's radius: the grains are soft "
            "(--young); below 1 % stiffness hardly matters."
        )
    lines += run_notes.energy_balance(summary, "the energy in play")
    lines += run_notes.water(summary)
    lines += run_notes.interruption(summary)
    if not summary["interrupted"] and summary.get("stop_time_s") is None:
        lines.append("The projectile was still moving at the end: depth and times are not final.")
    return lines


def print_summary(summary: dict[str, Any], folder: Path) -> None:
    """Print the main results as a table."""
    print(f"\n{summary['preset']}: results in {folder}")
    for key in PRINTED:
        if key in summary:
            name, unit = split_unit(key)
            print(f"  {name:28s} {number(summary[key])} {unit}".rstrip())
    run_notes.print_end(summary)
