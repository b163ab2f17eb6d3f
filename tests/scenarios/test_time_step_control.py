# SPDX-License-Identifier: GPL-2.0-or-later
"""The same drop under HertzTimeStepper: the energy balance holds and the summary says what the steps were."""
from __future__ import annotations

import pytest


def test_drop_under_the_hertz_time_stepper_conserves_energy_and_tells_its_steps(small_drop):
    summary, _ = small_drop(time_step_control="hertz", duration=0.01)
    assert 0 < summary["time_step_smallest_s"] <= summary["time_step_mean_s"]
    assert summary["time_step_mean_s"] * summary["steps"] == pytest.approx(
        summary["simulated_seconds"], rel=1e-9
    )
    assert summary["time_step_decided_by"].startswith(("contact of", "Rayleigh", "approach"))
    assert summary["price"]["time_stepper"] > 0
    # As for the fixed step: velocities are known half a step from positions.
    assert summary["energy_residual_relative"] < 0.01
