# SPDX-License-Identifier: GPL-2.0-or-later
"""Error against time, as a table and a figure.

usage: make accuracy
       PYTHONPATH=build/python:benchmarks yade -j1 -n -x benchmarks/accuracy_cost/run.py [CASE ...] [--repeats N]
       [--fresh]

Writes benchmarks/results/accuracy_cost.json, docs/images/accuracy_<case>.png and the tables of docs/accuracy.md;
cases that are not named keep what they had.
"""
from __future__ import annotations

import argparse
import json
from pathlib import Path

import grainfall  # noqa: F401

from accuracy_cost import report, small_drop, study, two_sphere_impact

CASES = {case.name: case for case in (two_sphere_impact.CASE, small_drop.CASE)}
RESULTS = Path("benchmarks/results/accuracy_cost.json")
# Drops last long enough to be timed once.
REPEATS = {"two_sphere_impact": 5, "small_drop": 1}


def main() -> None:
    """Run the cases named on the command line, or all."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("cases", nargs="*", metavar="CASE", help=f"of {', '.join(CASES)}")
    parser.add_argument("--repeats", type=int, help="runs of each setting (default: by case)")
    parser.add_argument("--fresh", action="store_true", help="run kept references again")
    options = parser.parse_args()
    for name in options.cases:
        if name not in CASES:
            parser.error(f"CASE = {name!r}: must be one of {', '.join(CASES)}")
    results = json.loads(RESULTS.read_text(encoding="utf-8")) if RESULTS.exists() else {}
    for name in options.cases or CASES:
        case = CASES[name]
        repeats = options.repeats or REPEATS[name]
        kept = results.get(name, {})
        truth = kept.get("reference_result")
        if truth is None or kept["reference"] != study.reference_options(case) or options.fresh:
            print(f"{name}: reference", flush=True)
            truth = case.run(**case.reference).result
        points = study.measure(case, repeats, truth, lambda text: print(text, flush=True))
        results[name] = study.as_json(case, truth, points)
        RESULTS.parent.mkdir(parents=True, exist_ok=True)
        RESULTS.write_text(json.dumps(results, indent=2) + "\n", encoding="utf-8")
        report.write(name, results[name])


if __name__ == "__main__":
    main()
