# SPDX-License-Identifier: GPL-2.0-or-later
"""What each way of making a triaxial run affordable saves in time and costs in accuracy.

    yade -j1 -n -x benchmarks/triaxial_price.py [RESULT.json]

One change at a time from a base run: the report's sample with 8 mm grains of 7 GPa, constant friction, 50 Hz. Compared
are the stiffness of the report's sample with quartz grains (scaled as the summary scales it, inertia removed), the loss
factor, and the processor time of preloading and cycles; samples are prepared beforehand. Packings of other seeds
show which differences mean anything.
"""
from __future__ import annotations

import json
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

import grainfall  # noqa: F401  registers the classes
from grainfall.triaxial import triaxial_test
from grainfall.triaxial.parameters import TABLE
from grainfall.triaxial.run import sample_spec
from grainfall.triaxial.samples import obtain_sample

BASE = {
    "grain_diameter": 8e-3,
    "young": 7e9,
    "friction": "0.5",
    "frequencies": "50",
    "confinement": 5e3,
    "membrane_thickness": 0,
    "tangential_law": "incremental",
    "no_plots": True,
    "quiet": True,
}
VARIANTS: dict[str, dict[str, Any]] = {
    "base: 8 mm, 7 GPa, 50 Hz": {},
    "another packing (seed 2)": {"seed": 2},
    "another packing (seed 3)": {"seed": 3},
    "grains of 11 mm": {"grain_diameter": 11e-3},
    "grains of 6 mm": {"grain_diameter": 6e-3},
    "small sample, 9 x 21 mm, 2 mm grains": {"preset": "small", "grain_diameter": 2e-3},
    "quartz's own 70 GPa": {"young": 70e9},
    "0.7 GPa": {"young": 0.7e9},
    "time step x 0.5": {"dt_safety": 0.2},
    "time step x 2": {"dt_safety": 0.8},
    "no energies booked": {"no_energy": True},
    "20, 50, 110 Hz one by one": {"frequencies": "50,20,110"},
    "20, 50, 110 Hz at once": {"frequencies": "50,20,110", "multisine": True},
}


def measure(changes: dict[str, Any], folder: Path) -> dict[str, Any]:
    """Run one variant: stiffness [N/m] and loss at 50 Hz, grains, steps, processor time [s]."""
    options = {**BASE, **changes}
    obtain_sample(sample_spec(TABLE.resolve(options)), "", lambda stage, fraction: None)
    began = time.process_time()
    summary = triaxial_test(output=str(folder), **options)
    spent = time.process_time() - began
    scale = summary["equivalent_stiffness_N_per_m"][0] / summary["stiffness_N_per_m"][0]
    return {
        "equivalent_stiffness_N_per_m": scale * summary["inertia_free_stiffness_N_per_m"][0],
        "load_cell_over_inertia_free": summary["stiffness_N_per_m"][0]
        / summary["inertia_free_stiffness_N_per_m"][0],
        "loss_factor": summary["loss_factor"][0],
        "grains": summary["particles"],
        "steps_of_cycles": sum(summary["steps_by_stretch"]),
        "time_step_s": summary["time_step_s"][0],
        "processor_seconds": spent,
        "energy_residual_relative": summary["energy_residual_relative"],
    }


def main() -> None:
    """Run all variants and print the table."""
    rows = {}
    with tempfile.TemporaryDirectory() as folder:
        for number, (name, changes) in enumerate(VARIANTS.items()):
            rows[name] = measure(changes, Path(folder) / str(number))
            row, base = rows[name], next(iter(rows.values()))
            print(
                f"{name:40s} grains {row['grains']:5d}  k {row['equivalent_stiffness_N_per_m'] / 1e6:6.3f} MN/m "
                f"({row['equivalent_stiffness_N_per_m'] / base['equivalent_stiffness_N_per_m'] - 1:+6.1%})  "
                f"loss {row['loss_factor']:.2e}  load cell {row['load_cell_over_inertia_free'] - 1:+.1%}  "
                f"steps {row['steps_of_cycles']:7d}  {row['processor_seconds']:6.1f} s",
                flush=True,
            )
    if len(sys.argv) > 1:
        Path(sys.argv[1]).write_text(json.dumps(rows, indent=1) + "\n")


main()
