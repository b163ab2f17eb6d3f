# SPDX-License-Identifier: GPL-2.0-or-later
"""Times a step of everybody on the same beds and writes benchmarks/results/speed.json and docs/performance.md.

usage: PYTHONPATH=benchmarks /usr/bin/python3 -m speed.run [build] [--quick] [--output FOLDER]
                                                         [--parts settled,moving,growth]

Needs an idle machine: how busy others kept it is recorded. Beds are kept in ~/.cache/grainfall/speed
(or --cache).
"""
from __future__ import annotations

import argparse
import os
import time
from pathlib import Path
from typing import Any

from speed import machine, report, study
from speed.bed import SEED, Bed, settled_bed, struck_bed
from speed.contenders import Contender, bare_loop, contenders
from speed.study import Case

PARTS = ("settled", "moving", "growth")
#: Contenders followed from the smallest bed to the largest.
GROWING = ("stock_yade", "general", "flat", "lammps_granular", "kernel")
#: Name of a ratio: contender over contender, threads, whether the projectile moves.
RATIOS = {
    "stock_yade_over_flat_j1": ("stock_yade", "flat", 1, False),
    "stock_yade_over_flat_j2": ("stock_yade", "flat", 2, False),
    "lammps_granular_over_flat_j1": ("lammps_granular", "flat", 1, False),
    "lammps_granular_over_flat_j2": ("lammps_granular", "flat", 2, False),
    "lammps_hertz_history_over_flat_j1": ("lammps_hertz_history", "flat", 1, False),
    "liggghts_over_flat_j1": ("liggghts", "flat", 1, False),
    "flat_over_kernel_j1": ("flat", "kernel", 1, False),
    "stock_yade_over_flat_moving_j1": ("stock_yade", "flat", 1, True),
    "stock_yade_over_flat_moving_j2": ("stock_yade", "flat", 2, True),
    "stock_yade_over_general_j1": ("stock_yade", "general", 1, False),
    "general_over_kernel_j1": ("general", "kernel", 1, False),
}


def main() -> None:
    """Measure and report."""
    options = _options()
    build, cache = options.build.resolve(), options.cache.resolve()
    field = contenders(build)
    for contender in field:
        if contender.absent:
            print(f"skipped: {contender.label}: {contender.absent}")
    started = time.time()
    sizes = options.grains
    cases: dict[str, list[dict[str, Any]]] = {"settled": [], "moving": []}
    for kind in ("settled", "moving"):
        for grains in sizes if kind in options.parts else ():
            bed = (settled_bed if kind == "settled" else struck_bed)(
                grains, cache, bare_loop(build)
            )
            for threads in (1, 2) if (os.cpu_count() or 1) > 1 else (1,):
                cases[kind].append(_measured(kind, bed, threads, options, field))
    results: dict[str, Any] = {
        "machine": machine.description(),
        "quick": options.quick,
        "seed": SEED,
        "skipped": {c.name: c.absent for c in field if c.absent},
        "ratios": {},
        "ratio_quartiles": {},
        **cases,
    }
    _add_ratios(results, max(sizes))
    largest = [c for c in cases["settled"] if c["grains"] == max(sizes) and c["threads"] == 1]
    if largest:
        results["memory"] = study.memory(largest[0])
    if "growth" in options.parts:
        results["growth"] = _growth(cache, build, options, field)
    results["seconds"] = round(time.time() - started)
    report.write(results, options.folder, options.page)
    print(report.tables(results))


def _options() -> argparse.Namespace:
    root = Path(__file__).resolve().parents[2]
    parser = argparse.ArgumentParser(prog="speed.run", description=__doc__.splitlines()[0])
    parser.add_argument("build", nargs="?", default=root / "build", type=Path)
    parser.add_argument(
        "--quick", action="store_true", help="10 000 grains, few rounds: a minute or two"
    )
    parser.add_argument("--parts", default="", help=f"some of {','.join(PARTS)}")
    parser.add_argument(
        "--grains", type=int, nargs="+", help="sizes of the beds (default: 10000 50000)"
    )
    parser.add_argument("--rounds", type=int, default=0, help="samples of each contender")
    cache = Path(os.environ.get("XDG_CACHE_HOME", Path.home() / ".cache")) / "grainfall" / "speed"
    parser.add_argument("--cache", type=Path, default=cache, help="folder of the beds")
    parser.add_argument(
        "--output",
        type=Path,
        help="folder for speed.json and speed.png; no page is written (default with --quick: results/speed)",
    )
    options = parser.parse_args()
    usual = ("settled",) if options.quick else PARTS
    options.parts = tuple(options.parts.split(",")) if options.parts else usual
    unknown = set(options.parts) - set(PARTS)
    if unknown:
        parser.error(f"--parts: {', '.join(sorted(unknown))} is none of {', '.join(PARTS)}")
    options.grains = options.grains or ([10_000] if options.quick else [10_000, 50_000])
    if options.quick and not options.output:
        options.output = root / "results/speed"
    # Without a folder of its own a run is the one that the documentation shows.
    options.page = None if options.output else root / "docs/performance.md"
    options.folder = options.output or root / "benchmarks/results"
    return options


def _measured(
    kind: str, bed: Bed, threads: int, options: argparse.Namespace, field: list[Contender]
) -> dict[str, Any]:
    rounds = options.rounds or (2 if options.quick else 5 if kind == "settled" else 3)
    moving = kind == "moving"
    case = Case(bed, threads, 20, 200 if moving else 80, rounds, moving)
    print(f"{kind}, {bed.grains} grains, {threads} threads, {rounds} rounds", flush=True)
    return study.measure(case, field)


def _add_ratios(results: dict[str, Any], grains: int) -> None:
    """Ratios of the largest bed of this run, and the quartiles of each."""
    for name, (over, under, threads, moving) in RATIOS.items():
        for case in results["moving" if moving else "settled"]:
            if case["grains"] == grains and case["threads"] == threads:
                found = study.ratio(case, over, under)
                if found:
                    results["ratios"][name] = found["median"]
                    results["ratio_quartiles"][name] = found["quartiles"]


def _growth(
    cache: Path, build: Path, options: argparse.Namespace, field: list[Contender]
) -> dict[str, Any]:
    """From 1000 to 500 000 grains on one thread."""
    sizes = (
        (1000, 3000, 10_000) if options.quick else (1000, 5000, 10_000, 50_000, 200_000, 500_000)
    )
    growing = [c for c in field if c.name in GROWING]
    cases = []
    for grains in sizes:
        bed = settled_bed(grains, cache, bare_loop(build))
        large = grains > 50_000
        rounds = 2 if large or options.quick else 3
        print(f"growth, {grains} grains, {rounds} rounds", flush=True)
        # Small beds are stepped oftener, so that the clock's grain does not show.
        steps = 20 if large else max(80, 200_000 // grains)
        cases.append(study.measure(Case(bed, 1, 10, steps, rounds), growing))
    return study.growth(cases)


if __name__ == "__main__":
    main()
