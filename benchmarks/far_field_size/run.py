# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs the drops of the size study that are not there yet, and reports.

usage: PYTHONPATH=build/python:benchmarks /usr/bin/python3 -m far_field_size.run [--seeds N] [--interval N]
                                                           [--at-most N] [--again] [--report-only]

Writes benchmarks/results/far_field_size.json and docs/images/far_field_size.png, prints the tables of
docs/physics/far_field.md. Beds and continua are kept in ~/.cache/grainfall. A study that was stopped goes on; with
--again drops that are there are run anew, and keep the time that settling took if their bed is still kept.
"""
from __future__ import annotations

import argparse
import json
from dataclasses import asdict
from pathlib import Path
from typing import Any

from far_field_size import report, study

RESULTS = Path("benchmarks/results/far_field_size.json")
FOLDER = Path("results/far_field_size")
SCRIPT = Path("scenarios/drop_test.py")


def main() -> None:
    """Run and report."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", type=int, default=2, help="packings of each size")
    parser.add_argument("--interval", type=int, default=1, help="--far-field-interval")
    parser.add_argument("--at-most", type=int, default=10_000, help="drops before stopping")
    parser.add_argument("--again", action="store_true", help="also the drops that are there")
    parser.add_argument("--report-only", action="store_true", help="run nothing")
    options = parser.parse_args()
    rows = load()
    cases = study.cases(options.seeds, options.interval)
    wanted = [case for case in cases if options.again or not _find(rows, case)]
    for case in [] if options.report_only else wanted[: options.at_most]:
        print(case.name, flush=True)
        row, former = study.run(case, FOLDER, SCRIPT), _find(rows, case)
        if former:
            rows.remove(former)
            row["settling_s"] = row["settling_s"] or former["settling_s"]
        rows.append(row)
        save(rows)
    report.write(rows, options.interval)


def _find(rows: list[dict[str, Any]], case: study.Case) -> dict[str, Any] | None:
    wanted = asdict(case)
    return next((row for row in rows if wanted.items() <= row.items()), None)


def load() -> list[dict[str, Any]]:
    """Rows of the results file, one a drop."""
    return json.loads(RESULTS.read_text(encoding="utf-8")) if RESULTS.exists() else []


def save(rows: list[dict[str, Any]]) -> None:
    """Write the results file."""
    RESULTS.parent.mkdir(parents=True, exist_ok=True)
    RESULTS.write_text(json.dumps(rows, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
