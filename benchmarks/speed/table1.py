# SPDX-License-Identifier: GPL-2.0-or-later
"""Times the whole of Table 1's 0.1 s: stock YADE's contact law, integrator and loop, and Grainfall's paths.

usage: PYTHONPATH=benchmarks /usr/bin/python3 -m speed.table1 [build] [--paths flat,stock] [--threads 2] [--seconds 0.1]

50 000 grains, the M70 outline of 57 mm and 10 kg at 2 m/s, 10 000 steps of 1e-5 s, no recorders. The outline is
Grainfall's in all paths, since YADE has none. Writes benchmarks/results/speed_table1.json and the table in
docs/performance.md for each path that was run; the others keep what they had.
"""
from __future__ import annotations

import argparse
import json
import os
import subprocess
import tempfile
from pathlib import Path
from typing import Any

from speed import machine
from speed.bed import Bed, settled_bed
from speed.contenders import ROOT, bare_loop, yade_environment
from speed.report import fill, whole_run


def main() -> None:
    """Run the paths one after the other."""
    parser = argparse.ArgumentParser(prog="speed.table1", description=__doc__.splitlines()[0])
    parser.add_argument("build", nargs="?", default=ROOT / "build", type=Path)
    parser.add_argument("--paths", default="flat,general,stock")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--grains", type=int, default=50_000)
    parser.add_argument("--seconds", type=float, default=0.1, help="simulated time")
    cache = Path(os.environ.get("XDG_CACHE_HOME", Path.home() / ".cache")) / "grainfall" / "speed"
    parser.add_argument("--cache", type=Path, default=cache, help="folder of the beds")
    parser.add_argument(
        "--output", type=Path, help="file for the numbers, instead of the documentation's"
    )
    options = parser.parse_args()
    build = options.build.resolve()
    bed = settled_bed(options.grains, options.cache.resolve(), bare_loop(build))
    output = options.output or ROOT / "benchmarks/results/speed_table1.json"
    runs: dict[str, Any] = {}
    if output.exists():
        runs = json.loads(output.read_text(encoding="utf-8"))["runs"]
    for path in options.paths.split(","):
        runs[path] = timed(path, bed, build, options.threads, options.seconds)
    report = {"machine": machine.description(), "grains": bed.grains, "runs": runs}
    if "flat" in runs and "stock" in runs:
        report["stock_over_flat"] = round(
            runs["stock"]["wall_seconds"] / runs["flat"]["wall_seconds"], 3
        )
    output.parent.mkdir(parents=True, exist_ok=True)
    output.write_text(json.dumps(report, indent=1) + "\n", encoding="utf-8")
    if not options.output:
        fill(ROOT / "docs/performance.md", "table1", whole_run(report))
    print(json.dumps(report, indent=1))


def timed(path: str, bed: Bed, build: Path, threads: int, seconds: float) -> dict[str, Any]:
    """One run; its numbers, and how many processors others kept busy meanwhile."""
    watch = machine.OthersWatch()
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "report.json"
        script = ROOT / "benchmarks/speed/table1_run.py"
        command = ["yade", f"-j{threads}", "-n", "-x", str(script), path, str(bed.path)]
        command += [repr(bed.side), repr(seconds), str(file)]
        subprocess.run(command, env=yade_environment(build), check=True)
        if not file.exists():
            raise SystemExit(f"the run on the {path} path did not end")
        numbers = json.loads(file.read_text(encoding="utf-8"))
    return {**numbers, "others_busy_processors": round(watch.busy(), 2)}


if __name__ == "__main__":
    main()
