# SPDX-License-Identifier: GPL-2.0-or-later
"""What a triaxial run reports: k and b by frequency, the state of the sample, effects, price, what was scaled."""

from __future__ import annotations

import builtins
import math
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from yade import O

from grainfall import run_notes
from grainfall.effects import running_effects
from grainfall.report.html_page import number
from grainfall.triaxial.cyclic import CyclicTest, inertia_free
from grainfall.triaxial.parameters import (
    REPORT_DIAMETER,
    REPORT_HEIGHT,
    REPORT_PEAK_TO_PEAK,
    peak_to_peak,
    real_peak_to_peak,
    softness,
)
from grainfall.wall_clock import engine_seconds
from grainfall.water import water_budget

if TYPE_CHECKING:
    from grainfall.triaxial.run import TriaxialRun

#: Cycles at the end of a stretch that k and b are taken from.
FITTED_CYCLES = 2


def test_results(
    test: CyclicTest,
    parameters: dict[str, Any],
    before: Mapping[str, float],
    ledger: Any,
) -> dict[str, Any]:
    """Results of one stretch of cycles.

    Parameters
    ----------
    before : mapping
        What the contacts had dissipated when it began [J].
    ledger : EnergyLedger or None
        Begun with the stretch; None where no energies are booked.
    """
    change = test.change()
    lower, upper = test.responses(FITTED_CYCLES), test.responses(FITTED_CYCLES, "upper")
    free = [inertia_free(*both) for both in zip(lower, upper)]
    results: dict[str, Any] = {
        "frequency_Hz": [one.frequency for one in lower],
        "stiffness_N_per_m": [one.stiffness for one in lower],
        "damping_N_s_per_m": [one.damping for one in lower],
        "upper_stiffness_N_per_m": [one.stiffness for one in upper],
        "upper_damping_N_s_per_m": [one.damping for one in upper],
        "inertia_free_stiffness_N_per_m": [value.real for value in free],
        "inertia_free_damping_N_s_per_m": [
            value.imag / (2 * math.pi * one.frequency) for value, one in zip(free, lower)
        ],
        "loss_factor": [one.loss_factor for one in lower],
        "force_amplitude_N": [one.force_amplitude for one in lower],
        "second_harmonic": [one.force_harmonics[0] for one in lower],
        "third_harmonic": [one.force_harmonics[1] for one in lower],
        "cycles": len(test.cycle_ends) - 1,
        "change_of_last_cycle": change,
        "least_platen_force_N": float(test.table(FITTED_CYCLES)[:, 2:].min()),
        "steady": change < parameters["steady_change"],
        "time_step_s": test.step,
        "steps": test.steps_per_cycle * len(test.cycle_ends),
    }
    if ledger is not None:
        results.update(_energy_balance(test, before, ledger, results))
    return results


def _energy_balance(
    test: CyclicTest, before: Mapping[str, float], ledger: Any, results: Mapping[str, Any]
) -> dict[str, float]:
    """The ledger's balance of this stretch; its residual over the energy that a cycle stores and returns."""
    terms = ledger.table()
    stored = 0.5 * float(np.max(results["stiffness_N_per_m"])) * test.peak_to_peak**2
    lost = {name: terms[name] - before[name] for name in before}
    return {
        "energy_residual_J": terms["residual"],
        "energy_residual_relative": abs(terms["residual"]) / stored,
        "energy_stored_in_a_cycle_J": stored,
        "platen_work_J": terms["imposedMotion"],
        "membrane_work_J": terms["permanentLoad"],
        "dissipated_by_friction_J": lost["friction"],
        "dissipated_by_dashpots_J": lost["viscous"],
        "dissipated_by_rescaling_J": lost["rescaling"],
        "lost_in_ruptured_bridges_J": lost["bridgeRupture"],
    }


def make_summary(run: TriaxialRun) -> dict[str, Any]:
    """Contents of ``summary.json``; lists run over the frequencies, in the order tested."""
    p, tests = run.parameters, run.finished["tests"]
    summary: dict[str, Any] = {
        "title": f"Cyclic triaxial test {p['preset']}",
        "preset": p["preset"],
        "seed": p["seed"],
        "particles": len(run.sample.radii),
        "steps": O.iter,
        "simulated_seconds": O.time,
        "wall_seconds": run.finished["wall_seconds"] + run.clock.total,
        "interrupted": run.interrupted,
        "threads": O.numThreads,
    }
    if tests:
        summary.update(_joined(tests))
        summary.update(_equivalent(summary, run))
    summary["displacement_peak_to_peak_m"] = peak_to_peak(p)
    summary.update(_scaling(run))
    summary["effects"] = running_effects()
    summary["path"] = getattr(builtins.contacts, "path", "general")
    if p["moisture"] > 0 and p["bridges"] != "none":
        summary["water"] = water_budget()
    summary["price"] = engine_seconds(run.clock, "cycles", run.finished["price"])
    summary["preload"] = run.finished["preload"]
    summary["sample"] = {**run.sample.report, "from_cache": run.sample_was_cached}
    summary["parameters"] = dict(p)
    summary["notes"] = notes(summary, p)
    return summary


def _joined(tests: list[dict[str, Any]]) -> dict[str, Any]:
    """Lists of all stretches end to end; of single numbers a list over stretches."""
    joined: dict[str, Any] = {}
    for name, value in tests[0].items():
        parts = [test[name] for test in tests]
        joined[name] = sum(parts, []) if isinstance(value, list) else parts
    joined["steps_by_stretch"] = joined.pop("steps")
    residuals = joined.pop("energy_residual_relative", None)
    joined["energy_residual_relative"] = max(residuals) if residuals else None
    return joined


def _equivalent(summary: dict[str, Any], run: TriaxialRun) -> dict[str, Any]:
    """The sample's Young's modulus, and k and b of the report's sample with the reference grains.

    Under the same stresses contact stiffness goes with (Young's modulus)^(2/3); k with area over height. The loss
    factor w b/k is kept, as it is where friction makes the loss.
    """
    state = run.finished["preload"]
    slimness = state["height_m"] / (math.pi / 4 * state["diameter_m"] ** 2)
    report = math.pi / 4 * REPORT_DIAMETER**2 / REPORT_HEIGHT
    factor = slimness * report * softness(run.parameters) ** (-2 / 3)
    return {
        "modulus_Pa": [k * slimness for k in summary["stiffness_N_per_m"]],
        "equivalent_stiffness_N_per_m": [k * factor for k in summary["stiffness_N_per_m"]],
        "equivalent_damping_N_s_per_m": [b * factor for b in summary["damping_N_s_per_m"]],
    }


def _scaling(run: TriaxialRun) -> dict[str, Any]:
    """By how much grains were enlarged and softened."""
    p = run.parameters
    real = p["reference_diameter"]
    volume = float(np.sum(4 / 3 * math.pi * run.sample.radii**3))
    return {
        "grain_enlargement": p["grain_diameter"] / real if real else 1.0,
        "real_grains": round(volume / (math.pi / 6 * real**3)) if real else len(run.sample.radii),
        "modulus_over_real": softness(p),
        "real_peak_to_peak_m": real_peak_to_peak(p),
    }


def notes(summary: dict[str, Any], p: dict[str, Any]) -> list[str]:
    """What a reader must know to use the numbers."""
    lines = run_notes.coarse_grains(summary)
    if summary["modulus_over_real"] < 1:
        lines.append(
            f"Grains are {1 / summary['modulus_over_real']:.3g} times softer than the real ones and the platen moves "
            f"{peak_to_peak(p) / real_peak_to_peak(p):.3g} times as far; stiffness_N_per_m is that of the simulated "
            "sample, equivalent_stiffness_N_per_m that of the report's sample with the real modulus."
        )
    if real_peak_to_peak(p) / p["height"] > REPORT_PEAK_TO_PEAK / REPORT_HEIGHT:
        lines.append(
            "The strain is larger than in the report's tests (500 nm peak to peak on 85 mm)."
        )
    reached = summary["sample"]["void_ratio"]
    if abs(reached - p["void_ratio"]) > 0.02:
        lines.append(
            f"The sample came out at a void ratio of {reached:.3f}, not {p['void_ratio']:.3f}."
        )
    lines += run_notes.energy_balance(summary, "the energy that a cycle stores")
    lines += run_notes.water(summary)
    if not all(summary.get("steady", [True])):
        lines.append("Not all frequencies became steady: see change_of_last_cycle.")
    if min(summary.get("least_platen_force_N", [math.inf])) <= 0:
        lines.append(
            "A platen was pulled or left by the sand during the cycles, so k and b are no small-strain values: raise "
            "the axial stress or reduce --peak-to-peak."
        )
    return lines + run_notes.interruption(summary)


def print_summary(summary: dict[str, Any], folder: Path) -> None:
    """Print the main results as a table."""
    print(f"\n{summary['title']}: results in {folder}")
    state = summary["preload"]
    print(
        f"  {summary['particles']} grains, void ratio {state['void_ratio']:.3f}, "
        f"axial {state['axial_stress_Pa'] / 1e3:.3g} kPa, lateral {state['lateral_stress_Pa'] / 1e3:.3g} kPa, of which "
        f"membrane {state['membrane_pressure_Pa'] / 1e3:.3g} kPa"
    )
    if "frequency_Hz" in summary:
        print(f"  {'f [Hz]':>8} {'k [N/m]':>10} {'b [N s/m]':>10} {'w b/k':>9}")
        columns = ("frequency_Hz", "stiffness_N_per_m", "damping_N_s_per_m", "loss_factor")
        for row in zip(*(summary[name] for name in columns)):
            print("  {:8.4g} {:10.4g} {:10.4g} {:9.2g}".format(*row))
        print(f"  {'energy residual relative':28s} {number(summary['energy_residual_relative'])}")
    run_notes.print_end(summary)
