# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenarios small enough for a test, and started as a user does."""
from __future__ import annotations

import os
import subprocess
from pathlib import Path
from typing import Any

SCENARIOS = Path(__file__).resolve().parents[2] / "scenarios"
SCRIPT = SCENARIOS / "drop_test.py"
TRIAXIAL = SCENARIOS / "triaxial_calibration.py"

# The half-scale replica on 8 mm grains that are soft enough for a step of 44 microseconds.
SMALL = {
    "preset": "m70-half",
    "grain_diameter": 8e-3,
    "box_length": 0.08,
    "box_width": 0.08,
    "bed_depth": 0.05,
    "young": 2e7,
    "duration": 4e-3,
    "vtk_interval": 0,
}

# Some 70 grains, 3 across: enough to hold a pressure. Other stresses than these, such as a membrane's beside the cell
# pressure, make other fabrics, of which some take more cycles to become steady.
TINY = {
    "membrane_thickness": 0,
    "grain_diameter": 8e-3,
    "diameter": 26e-3,
    "height": 55e-3,
    "friction": "0.5",
    "frequencies": "150",
    "least_cycles": 2,
    "most_cycles": 3,
    "no_plots": True,
}


def script_arguments(options: dict[str, Any]) -> list[str]:
    """Options as they are typed: ``--grain-diameter 0.008``; True stands for a bare flag."""
    arguments = []
    for name, value in options.items():
        arguments.append("--" + name.replace("_", "-"))
        if value is not True:
            arguments.append(str(value))
    return arguments


def start_script(options: dict[str, Any], script: Path = SCRIPT) -> subprocess.Popen[str]:
    """Start the scenario as a user does, with one thread."""
    return subprocess.Popen(
        ["yade", "-j1", "-n", "-x", str(script), *script_arguments(options)],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        env=dict(os.environ),
    )


def run_batch(table: Path, script: Path) -> None:
    """Run a scenario over the rows of a parameter table, in the table's folder."""
    # yade-batch writes its logs beside the script
    (table.parent / script.name).write_text(script.read_text())
    finished = subprocess.run(
        ["yade-batch", "-j1", "--job-threads=1", table.name, script.name],
        cwd=table.parent,
        env=dict(os.environ),
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        timeout=120,
    )
    assert finished.returncode == 0, finished.stdout
