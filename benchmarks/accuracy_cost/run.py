# SPDX-License-Identifier: GPL-2.0-or-later
"""Error against time, as a table and a figure.

usage: make accuracy
       PYTHONPATH=build/python:benchmarks yade -j1 -n -x benchmarks/accuracy_cost/run.py [CASE ...] [--repeats N]
       [--samples N] [--fresh]

Writes benchmarks/results/accuracy_cost.json, docs/images/accuracy_<case>.png and the tables of docs/accuracy.md;
cases that are not named keep what they had. Long runs
are kept, so that a study that was stopped goes on, and one with a new knob runs only that.
"""
from __future__ import annotations

import argparse
import json
from pathlib import Path
from typing import Any

import grainfall  # noqa: F401

from accuracy_cost import impact_speeds, report, small_drop, study, two_sphere_impact

CASES = {case.name: case for case in (two_sphere_impact.CASE, impact_speeds.CASE, small_drop.CASE)}
RESULTS = Path("benchmarks/results/accuracy_cost.json")
# Drops last long enough to be timed once.
REPEATS = {"two_sphere_impact": 5, "impact_speeds": 3, "small_drop": 1}


def main() -> None:
    """Run the cases named on the command line, or all."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("cases", nargs="*", metavar="CASE", help=f"of {', '.join(CASES)}")
    parser.add_argument("--repeats", type=int, help="runs of each setting (default: by case)")
    parser.add_argument(
        "--samples", type=int, default=1, help="samples to run of each setting (default: 1)"
    )
    parser.add_argument("--fresh", action="store_true", help="run again what was kept")
    options = parser.parse_args()
    for name in options.cases:
        if name not in CASES:
            parser.error(f"CASE = {name!r}: must be one of {', '.join(CASES)}")
    results = load()
    for name in options.cases or CASES:
        before = {} if options.fresh else results.get(name, {})
        run_case(CASES[name], before, options.repeats or REPEATS[name], options.samples)


def run_case(case: study.Case, before: dict[str, Any], repeats: int, samples: int) -> None:
    """Run one case, as far as `before`, its part of the results file, does not have it, and report it."""
    kept = study.KeptRuns(before.get("runs", []), lambda runs: save(case.name, runs=runs))
    truth = before.get("reference_result")
    if truth is None or before["reference"] != study.reference_options(case):
        print(f"{case.name}: reference", flush=True)
        truth = case.run(**case.reference).result
        save(case.name, **study.reference_as_json(case, truth))
    points = study.measure(
        case, truth, kept, repeats, samples, lambda text: print(text, flush=True)
    )
    report.write(case.name, save(case.name, **study.as_json(case, points)))


def load() -> dict[str, Any]:
    """The results file, by case."""
    return json.loads(RESULTS.read_text(encoding="utf-8")) if RESULTS.exists() else {}


def save(name: str, **entries: Any) -> dict[str, Any]:
    """Put entries into a case's part of the results file; returns that part."""
    results = load()
    results.setdefault(name, {}).update(entries)
    RESULTS.parent.mkdir(parents=True, exist_ok=True)
    RESULTS.write_text(json.dumps(results, indent=2) + "\n", encoding="utf-8")
    return results[name]


if __name__ == "__main__":
    main()
