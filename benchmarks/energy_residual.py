# SPDX-License-Identifier: GPL-2.0-or-later
"""How the residual of the energy balance falls with the time step, and what the ledger costs.

usage: PYTHONPATH=build/python:tests/physics yade -n -x -j1 benchmarks/energy_residual.py [--no-cost]
           [--output benchmarks/results/energy_residual.json] [--plot docs/images/energy_residual.png]

Residuals: the largest over the run, over the energy in play. Cost: processor time of a step with a ledger over that
without, in turns on the same settling grains; median and quartiles of the rounds.
"""
from __future__ import annotations

import argparse
import json
import sys
import time
from pathlib import Path

import grainfall  # noqa: F401
import ledger_scenes as scenes
import matplotlib
import numpy as np
from yade import EnergyLedger, O

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

IMPACT_STEPS = (25, 50, 100, 200, 400, 800)
BED_FRACTIONS = (0.4, 0.2, 0.1, 0.05)
CASES = {
    "head-on, elastic": lambda n: scenes.head_on(n, 1.0),
    "head-on, restitution 0.5": lambda n: scenes.head_on(n, 0.5),
    "oblique, friction, restitution 0.5": lambda n: scenes.oblique(n, 0.5),
}
PERIODS = (1, 10, 100)


def impacts() -> dict[str, list[float]]:
    """Residual of each case for each of IMPACT_STEPS."""
    found: dict[str, list[float]] = {}
    for name, run in CASES.items():
        found[name] = []
        for steps in IMPACT_STEPS:
            O.reset()
            found[name].append(scenes.largest(run(steps)))
    return found


def beds() -> list[float]:
    """Residual of 512 settling grains for each of BED_FRACTIONS."""
    found = []
    for fraction in BED_FRACTIONS:
        O.reset()
        found.append(scenes.largest(scenes.settling_bed(fraction)))
    return found


def cost(rounds: int = 9, steps: int = 100) -> dict[str, list[float]]:
    """Quartiles of the ratio of step times, with over without, for O.trackEnergy and ledgers by period."""
    O.reset()
    scenes.settling_bed(0.2, grains_per_side=14, duration=0.08)
    engines = list(O.engines)[:-1]

    def seconds(extra: list, track: bool) -> float:
        O.engines = engines + extra
        O.trackEnergy = track
        O.run(10, True)
        start = time.process_time()
        O.run(steps, True)
        return time.process_time() - start

    ratios: dict[str, list[float]] = {}
    for _ in range(rounds):
        without = seconds([], False)
        ratios.setdefault("O.trackEnergy alone", []).append(seconds([], True) / without)
        for period in PERIODS:
            name = f"EnergyLedger(iterPeriod={period})"
            ledger = [EnergyLedger(iterPeriod=period)]
            ratios.setdefault(name, []).append(seconds(ledger, True) / without)
    return {name: np.percentile(values, [25, 50, 75]).tolist() for name, values in ratios.items()}


def order(steps: list[float], residuals: list[float]) -> float:
    """Slope of log residual over log step."""
    return float(np.polyfit(np.log(steps), np.log(residuals), 1)[0])


def plot(results: dict, path: Path) -> None:
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.8), sharey=True, layout="constrained")
    steps = 1 / np.array(IMPACT_STEPS)
    for (name, residuals), marker in zip(results["impacts"].items(), "os^"):
        left.loglog(steps, residuals, marker + "-", label=name)
    left.loglog(steps, 6 * steps**2, "k:", label="second order")
    left.set(xlabel="time step / duration of the contact", ylabel="residual / energy in play")
    left.set_title("impacts")
    fractions = np.array(BED_FRACTIONS)
    right.loglog(fractions, results["bed"], "o-", label="512 grains settle in a box")
    right.loglog(fractions, 0.09 * fractions**2, "k:", label="second order")
    right.set(xlabel="time step / Rayleigh step", title="bed")
    right.set_xticks(fractions, [f"{fraction:g}" for fraction in fractions])
    right.minorticks_off()
    for axes in (left, right):
        axes.axhline(1e-3, color="0.7", linewidth=0.8)
        axes.legend(fontsize=8)
        axes.grid(alpha=0.3)
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=110)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument(
        "--output", type=Path, default=Path("benchmarks/results/energy_residual.json")
    )
    parser.add_argument("--plot", type=Path, default=Path("docs/images/energy_residual.png"))
    parser.add_argument("--no-cost", action="store_true")
    options = parser.parse_args(sys.argv[1:])
    results: dict = {
        "steps_per_contact": IMPACT_STEPS,
        "impacts": impacts(),
        "rayleigh_fractions": BED_FRACTIONS,
        "bed": beds(),
    }
    steps = [1 / n for n in IMPACT_STEPS]
    results["orders"] = {name: order(steps, r) for name, r in results["impacts"].items()}
    results["orders"]["bed"] = order(list(BED_FRACTIONS), results["bed"])
    if not options.no_cost:
        results["step_time_ratio_quartiles"] = cost()
    options.output.write_text(json.dumps(results, indent=1) + "\n", encoding="utf-8")
    plot(results, options.plot)
    print(json.dumps(results, indent=1))


main()
