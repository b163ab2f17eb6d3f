# SPDX-License-Identifier: GPL-2.0-or-later
"""The scenario under yade-batch."""
from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from scenario_script import SCRIPT, SMALL, run_batch

SHORT = {**SMALL, "duration": 1e-3, "no_plots": True, "quiet": True}


def summaries(rows: dict[str, dict[str, Any]], folder: Path) -> list[dict[str, Any]]:
    """Of one drop a row; rows are named and have the same columns."""
    columns = list(next(iter(rows.values())))
    table = [" ".join(["description", *columns])]
    for name, options in rows.items():
        table.append(" ".join([name, *(repr(options[column]) for column in columns)]))
    (folder / "drops.table").write_text("\n".join(table) + "\n")
    run_batch(folder / "drops.table", SCRIPT)
    return [json.loads(path.read_text()) for path in folder.rglob("summary.json")]


def test_each_row_of_a_table_runs_with_its_own_parameters_into_its_own_folder(bed_cache, tmp_path):
    options = {**SHORT, "bed_cache": str(bed_cache)}
    rows = {
        "falling": {**options, "friction": "cole"},
        "constant": {**options, "friction": "0.5"},
    }
    found = summaries(rows, tmp_path)
    assert sorted(one["parameters"]["friction"] for one in found) == ["0.5", "cole"]
    assert all(one["preset"] == "m70-half" for one in found)


def test_a_table_may_ask_for_a_continuum_outside_the_box(bed_cache, tmp_path):
    options = {
        **SHORT,
        "bed_cache": str(bed_cache),
        "far_field": "quasi-static",
        "far_field_cache": str(tmp_path / "walls"),
    }
    (deformable,) = summaries({"deformable": options}, tmp_path)
    assert deformable["far_field"]["contacts"] > 0
