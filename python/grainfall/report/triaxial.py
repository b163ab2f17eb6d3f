# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures and the summary page of a triaxial test, made from the files in its results folder alone.

Files read: ``summary.json``, ``loops.h5``. Files written: ``plots/*.png``, ``summary.html``.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from grainfall.report.html_page import write_page
from grainfall.report.plots import BLUE, GREEN, GREY, ORANGE

#: Columns of the table of results.
SHOWN = (
    "frequency_Hz",
    "stiffness_N_per_m",
    "damping_N_s_per_m",
    "inertia_free_stiffness_N_per_m",
    "loss_factor",
    "equivalent_stiffness_N_per_m",
    "equivalent_damping_N_s_per_m",
    "third_harmonic",
)


def write_report(folder: str | Path) -> list[Path]:
    """Write the plots and the HTML page of a results folder; the files written, the page last."""
    folder = Path(folder)
    summary = json.loads((folder / "summary.json").read_text())
    pictures = [
        draw_spectra([(summary, "")], folder / "plots" / "stiffness_and_damping.png"),
        draw_loops(read_last_cycles(folder), folder / "plots" / "loops.png"),
    ]
    return [*pictures, write_page(summary, pictures, folder / "summary.html", SHOWN)]


def draw_spectra(runs: Sequence[tuple[Mapping[str, Any], str]], path: str | Path) -> Path:
    """Draw k(f) and b(f) of one or more summaries, each with its label, one above the other."""
    figure = Figure(figsize=(7.5, 7.5), layout="constrained")
    stiffness, damping = figure.subplots(2, 1, sharex=True)
    colours = (BLUE, ORANGE, GREEN, GREY, "#762a83", "#b8860b")
    for (summary, label), colour in zip(runs, colours * len(runs)):
        order = np.argsort(summary["frequency_Hz"])
        frequency = np.array(summary["frequency_Hz"])[order]
        style = {"color": colour, "marker": "o", "markersize": 4}
        load_cell = label or "lower platen (load cell)"
        free = f"{label}, inertia removed" if label else "inertia of the sand removed"
        for axis, name, scale in (
            (stiffness, "stiffness_N_per_m", 1e-6),
            (damping, "damping_N_s_per_m", 1.0),
        ):
            axis.plot(frequency, scale * np.array(summary[name])[order], label=load_cell, **style)
            axis.plot(
                frequency,
                scale * np.array(summary[f"inertia_free_{name}"])[order],
                label=free,
                linestyle="--",
                linewidth=1,
                color=colour,
            )
    stiffness.set_ylabel("stiffness k [MN/m]")
    damping.set_ylabel("damping b [N s/m]")
    damping.set_xlabel("frequency [Hz]")
    damping.set_ylim(bottom=min(0.0, damping.get_ylim()[0]))
    stiffness.legend(frameon=False, fontsize=8)
    return _save(figure, path)


def read_last_cycles(folder: Path) -> list[dict[str, Any]]:
    """Last cycle of each stretch in ``loops.h5``: frequencies, displacement [m] and force at the lower platen [N]."""
    from grainfall.triaxial.loops import read_loops

    loops = []
    for record in read_loops(folder):
        ends = record["cycle_ends"]
        last = slice(int(ends[-2]) if len(ends) > 1 else 0, int(ends[-1]))
        loops.append(
            {
                "frequency_Hz": record["frequency_Hz"],
                "displacement_m": record["displacement_m"][last],
                "force_N": record["lower_force_N"][last],
            }
        )
    return loops


def draw_loops(loops: Sequence[Mapping[str, Any]], path: str | Path) -> Path:
    """Draw force over displacement: as measured, and with the secant taken off so that the loop's area shows."""
    figure = Figure(figsize=(9, 4.2), layout="constrained")
    whole, opened = figure.subplots(1, 2)
    for loop, colour in zip(loops, (BLUE, ORANGE, GREEN, GREY, "#762a83", "#b8860b") * len(loops)):
        x = (loop["displacement_m"] - loop["displacement_m"].mean()) * 1e9
        force = loop["force_N"] - loop["force_N"].mean()
        slope = float(x @ force) / float(x @ x)
        label = " + ".join(f"{f:g}" for f in loop["frequency_Hz"]) + " Hz"
        for axis, y in ((whole, force), (opened, (force - slope * x) * 1e3)):
            axis.plot(
                np.append(x, x[0]), np.append(y, y[0]), color=colour, linewidth=1, label=label
            )
    whole.set_ylabel("force at the lower platen, less its mean [N]")
    opened.set_ylabel("the same less k x [mN]")
    for axis in (whole, opened):
        axis.set_xlabel("displacement, less its mean [nm]")
    whole.legend(frameon=False, fontsize=8)
    return _save(figure, path)


def _save(figure: Figure, path: str | Path) -> Path:
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=130)
    return path
