# SPDX-License-Identifier: GPL-2.0-or-later
"""The half-scale replica dropped on a small bed: grain size, step size, tangential law, energy booking.

The truth is the depth with the finest grains. Grains of one size in another packing (`seed`) already give other depths,
so every setting is run in several packings, the same ones for all settings.
"""
from __future__ import annotations

import tempfile
from typing import Any

from grainfall.drop import drop_test

from accuracy_cost.study import Case, Knob, Measurement, timed

BED = {"box_length": 0.08, "box_width": 0.08, "bed_depth": 0.07}
FIXED = {
    "preset": "m70-half",
    **BED,
    "duration": 0.06,
    "vtk_interval": 0,
    "checkpoint_interval": 1.0,
    "no_plots": True,
    "quiet": True,
    "path": "general",  # as all runs kept in the results: their times are compared
}
GRAIN = 8e-3
PACKINGS = (1, 2, 3, 4)


def run(**options: Any) -> Measurement:
    """One drop: its depth [m], processor seconds of the drop without the bed's preparation."""
    given = {**FIXED, "grain_diameter": GRAIN, **options}
    with tempfile.TemporaryDirectory() as folder:
        bed_options = {**given, "duration": 1e-4, "output": f"{folder}/bed"}
        drop_test(**bed_options)  # the bed is kept and found again
        summary: dict[str, Any] = {}
        cpu = timed(lambda: summary.update(drop_test(**given, output=f"{folder}/drop")))
    extra = {
        "depth_m": summary["depth_m"],
        "grains": summary["particles"],
        "steps": summary["steps"],
        "energy_residual_relative": summary["energy_residual_relative"] or float("nan"),
    }
    return Measurement(summary["depth_m"], cpu, extra)


def distance(result: Any, truth: Any) -> float:
    """Difference in depth over the depth of the truth."""
    return abs(result / truth - 1)


CASE = Case(
    name="small_drop",
    error="depth, relative to the finest grains [-]",
    cost="one drop of 60 ms",
    run=run,
    # 30 000 grains: an hour and more.
    reference={"grain_diameter": 2.5e-3},
    distance=distance,
    knobs=(
        Knob(
            "grain diameter [mm]",
            {f"{1e3 * d:g}": {"grain_diameter": d} for d in (12e-3, 10e-3, 8e-3, 6e-3, 5e-3)},
        ),
        Knob(
            "step over Rayleigh step, 8 mm",
            {f"{s:g}": {"dt_safety": s} for s in (0.4, 0.3, 0.2, 0.1)},
        ),
        Knob(
            "HertzTimeStepper, safety, 8 mm",
            {f"{s:g}": {"time_step_control": "hertz", "dt_safety": s} for s in (0.6, 0.3, 0.15)},
        ),
        Knob(
            "tangential law, 8 mm",
            {
                law: {"tangential_law": law}
                for law in ("none", "incremental", "mindlin-deresiewicz")
            },
        ),
        Knob(
            "Young's modulus of the grains [Pa], 8 mm",
            {f"{e:.0e}": {"young": e} for e in (5e7, 2e8, 5e8)},
        ),
    ),
    samples=tuple({"seed": seed} for seed in PACKINGS),
)
