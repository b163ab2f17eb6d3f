# SPDX-License-Identifier: GPL-2.0-or-later
"""The scenario under yade-batch."""
from __future__ import annotations

import json

from scenario_script import SCRIPT, SMALL, run_batch


def test_each_row_of_a_table_runs_with_its_own_parameters_into_its_own_folder(bed_cache, tmp_path):
    options = {**SMALL, "duration": 1e-3, "no_plots": True, "quiet": True}
    columns = ["description", *options, "bed_cache", "friction"]
    table = [" ".join(columns)]
    for name, friction in (("falling", "cole"), ("constant", "0.5")):
        values = [name, *map(repr, options.values()), repr(str(bed_cache)), repr(friction)]
        table.append(" ".join(values))
    (tmp_path / "frictions.table").write_text("\n".join(table) + "\n")
    run_batch(tmp_path / "frictions.table", SCRIPT)
    summaries = [json.loads(path.read_text()) for path in tmp_path.rglob("summary.json")]
    frictions = sorted(summary["parameters"]["friction"] for summary in summaries)
    assert frictions == ["0.5", "cole"]
    assert all(summary["preset"] == "m70-half" for summary in summaries)
