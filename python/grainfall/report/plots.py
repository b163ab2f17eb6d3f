# SPDX-License-Identifier: GPL-2.0-or-later
"""Velocity, force and depth of the projectile over time."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure

#: Frames per second of the camera in MR-2629, section 3.3: the resolution of its published traces.
CAMERA_RATE_PER_S = 389.0

BLUE, ORANGE, GREEN, GREY = "#2166ac", "#d6604d", "#1b7837", "#777777"


def read_trace(path: str | Path) -> dict[str, np.ndarray]:
    """Read a trace: one array of shape (n,) for each column, by the column's name (SI units)."""
    table = np.genfromtxt(path, delimiter=",", names=True, ndmin=1)
    return {name: np.atleast_1d(table[name]) for name in table.dtype.names}


def camera_average(
    time: np.ndarray, values: np.ndarray, rate: float = CAMERA_RATE_PER_S
) -> np.ndarray:
    """Running mean over one frame of a camera.

    Parameters
    ----------
    time, values : numpy.ndarray, shape (n,)
        Time [s], increasing, and the quantity.
    rate : float
        Frames per second [1/s].

    Returns
    -------
    numpy.ndarray, shape (n,)
    """
    if len(time) < 3:
        return values.copy()
    half = 0.5 / rate
    steps = 0.5 * (values[1:] + values[:-1]) * np.diff(time)
    integral = np.concatenate(([0.0], np.cumsum(steps)))
    low = np.maximum(time - half, time[0])
    high = np.minimum(time + half, time[-1])
    return (np.interp(high, time, integral) - np.interp(low, time, integral)) / (high - low)


def camera_force(time: np.ndarray, force: np.ndarray) -> np.ndarray:
    """Frame mean of a force [N] that was zero before its first row: the projectile was in flight.

    Parameters
    ----------
    time, force : numpy.ndarray, shape (n,)
        Time [s], increasing, and force [N].

    Returns
    -------
    numpy.ndarray, shape (n,)
    """
    if len(time) < 2:
        return force.copy()
    flight = time[0] - np.array([1 / CAMERA_RATE_PER_S, 0.5 * (time[1] - time[0])])
    padded = camera_average(np.concatenate((flight, time)), np.concatenate(([0.0, 0.0], force)))
    return padded[2:]


def draw_trace(
    trace: Mapping[str, np.ndarray], summary: Mapping[str, Any], path: str | Path
) -> Path:
    """Draw velocity, force and depth over time, one above the other, and return the file's path."""
    figure = Figure(figsize=(8, 8.5), layout="constrained")
    velocity, force, depth = figure.subplots(3, 1, sharex=True)
    milliseconds = (trace["time_s"] - summary.get("touch_time_s", 0.0)) * 1e3

    velocity.plot(milliseconds, trace["velocity_m_per_s"], color=BLUE)
    velocity.set_ylabel("velocity, downwards [m/s]")
    velocity.axhline(0, color=GREY, linewidth=0.6)

    force.plot(
        milliseconds,
        trace["force_N"],
        color=GREY,
        linewidth=0.5,
        label="mean over a row of the trace",
    )
    smooth = camera_force(trace["time_s"], trace["force_N"])
    force.plot(
        milliseconds, smooth, color=ORANGE, linewidth=1.8, label="mean over a frame at 389 1/s"
    )
    for name, colour in (("nose_force_N", GREEN), ("shaft_force_N", BLUE)):
        if name in trace and np.any(trace[name]):
            label = name.split("_")[0] + " (mean)"
            part = camera_force(trace["time_s"], trace[name])
            force.plot(milliseconds, part, color=colour, linewidth=1.0, linestyle="--", label=label)
    force.set_ylabel("force on the projectile,\nupwards [N]")
    # A single grain's kick would squeeze everything else against the axis.
    force.set_ylim(top=1.15 * max(np.percentile(trace["force_N"], 99.5), smooth.max(), 1e-9))
    force.legend(frameon=False, fontsize=9)

    depth.plot(milliseconds, trace["depth_m"] * 1e3, color=BLUE)
    depth.invert_yaxis()
    depth.set_ylabel("depth of the nose [mm]")
    depth.set_xlabel("time since first touch [ms]")

    _mark_stages((velocity, force, depth), summary.get("stages"))
    figure.suptitle(str(summary.get("title", f"drop {summary.get('preset', '')}")))
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=130)
    return path


def _mark_stages(axes: tuple[Any, ...], stages: Any) -> None:
    """Draw the borders between the three stages of MR-2629, section 4.2, where they were found."""
    if not isinstance(stages, Mapping):
        return
    for name in ("stage_2_start_s", "stage_3_start_s"):
        if isinstance(stages.get(name), (int, float)):
            for axis in axes:
                axis.axvline(stages[name] * 1e3, color=GREY, linestyle=":", linewidth=1)
