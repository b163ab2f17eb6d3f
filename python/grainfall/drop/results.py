# SPDX-License-Identifier: GPL-2.0-or-later
"""From the trace of a drop to its results."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from grainfall.report.plots import CAMERA_RATE_PER_S, camera_average, camera_force

# What contacts lose: term of the ledger -> column of the energies.
DISSIPATED = {
    "friction": "friction_J",
    "viscous": "viscous_J",
    "rescaling": "rescaling_J",
    "bridgeRupture": "ruptured_J",
}


def touch_time(trace: Mapping[str, np.ndarray]) -> float:
    """Time of the first row with a contact on the projectile [s]; of the last row if there is none."""
    touching = np.flatnonzero(trace["contacts"] > 0)
    return float(trace["time_s"][touching[0] if len(touching) else -1])


def drop_results(trace: Mapping[str, np.ndarray], mass: float, rest_speed: float) -> dict[str, Any]:
    """Depth, speeds, forces and stages of a drop.

    Parameters
    ----------
    trace : mapping of str to numpy.ndarray, shape (rows,)
        Columns of `grainfall.drop.trace.COLUMNS`.
    mass : float
        Of the projectile [kg].
    rest_speed : float
        The nose has stopped when, over one frame, it sinks slower than this [m/s].

    Returns
    -------
    dict
        Times count from the first touch. ``depth_m`` is the deepest the nose got; a projectile that then topples
        ends a little higher, at ``final_depth_m``. ``peak_force_N`` is the largest mean over one row of
        the trace; ``peak_force_camera_N`` that of the mean over one frame of the report's camera (389 1/s).
    """
    start = touch_time(trace)
    after = trace["time_s"] >= start
    t = trace["time_s"][after] - start
    force = trace["force_N"][after]
    speed = trace["velocity_m_per_s"][after]
    depth = trace["depth_m"][after]
    smooth = camera_force(trace["time_s"], trace["force_N"])[after]
    peak, smooth_peak = int(np.argmax(force)), int(np.argmax(smooth))
    sinking = camera_average(t, np.gradient(depth, t)) if len(t) > 1 else np.array([np.inf])
    slow = np.flatnonzero(sinking < rest_speed)
    stop = float(t[slow[0]]) if len(slow) else None
    return {
        "touch_time_s": start,
        "depth_m": float(depth.max()),
        "final_depth_m": float(depth[-1]),
        "impact_speed_m_per_s": float(speed[0]),
        "final_speed_m_per_s": float(speed[-1]),
        "peak_force_N": float(force[peak]),
        "peak_force_time_s": float(t[peak]),
        "peak_force_camera_N": float(smooth[smooth_peak]),
        "peak_force_camera_time_s": float(t[smooth_peak]),
        "peak_deceleration_camera_m_per_s2": float(smooth[smooth_peak]) / mass,
        "stop_time_s": stop,
        "final_tilt_deg": float(trace["tilt_deg"][-1]),
        "impulse_N_s": float(np.sum(force[1:] * np.diff(t))),
        "stages": stages(t, smooth, stop),
    }


def stages(t: np.ndarray, smooth: np.ndarray, stop: float | None) -> dict[str, Any]:
    """The three stages of MR-2629, section 4.2, from the frame-averaged force.

    Stage 1, velocity rolls off: until the force first passes half its peak. Stage 2, deceleration
    rises to its maximum: until the peak. Stage 3: from the peak until rest. They count as visible
    if each lasts at least one frame of the report's camera.

    Parameters
    ----------
    t, smooth : numpy.ndarray, shape (n,)
        Time since first touch [s], frame-averaged force [N].
    stop : float or None
        Time of rest [s].
    """
    peak = int(np.argmax(smooth))
    half = int(np.flatnonzero(smooth[: peak + 1] >= 0.5 * smooth[peak])[0])
    end = stop if stop is not None else float(t[-1])
    frame = 1 / CAMERA_RATE_PER_S
    return {
        "stage_2_start_s": float(t[half]),
        "stage_3_start_s": float(t[peak]),
        "stage_3_end_s": end,
        "three_stages_visible": bool(np.min(np.diff([0.0, t[half], t[peak], end])) >= frame),
    }


def energy_results(ledger: Any, energy: Mapping[str, np.ndarray]) -> dict[str, Any]:
    """Residual of the energy balance and what took the energy.

    Parameters
    ----------
    ledger : EnergyLedger or None
        That of the scene; None if no energies were booked.
    energy : mapping of str to numpy.ndarray, shape (rows,)
        Columns of `grainfall.drop.trace.ENERGY_COLUMNS`.

    Returns
    -------
    dict
        ``energy_residual_J``: largest residual at the balances of the run; ``energy_residual_relative``: the
        same over the energy in play; None without a ledger.
    """
    if ledger is None or not ledger.energyInPlay:
        return {"energy_residual_relative": None}
    last = ledger.table()
    started = len(energy["time_s"]) > 0
    first = {name: energy[column][0] if started else 0.0 for name, column in DISSIPATED.items()}
    return {
        "energy_residual_J": ledger.largestResidual,
        "energy_residual_relative": ledger.largestResidual / ledger.energyInPlay,
        "energy_in_play_J": ledger.energyInPlay,
        "dissipated_by_friction_J": last["friction"] - first["friction"],
        "dissipated_by_dashpots_J": last["viscous"] - first["viscous"],
        "dissipated_by_rescaling_J": last["rescaling"] - first["rescaling"],
        "lost_in_ruptured_bridges_J": last["bridgeRupture"] - first["bridgeRupture"],
    }
