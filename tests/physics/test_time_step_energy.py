# SPDX-License-Identifier: GPL-2.0-or-later
"""Energy balance under HertzTimeStepper, in a scene that needs short steps at first and long ones later.

Grains rush together at up to 10 m/s, fly apart and come to rest; meanwhile the step grows almost threefold.
"""
from __future__ import annotations

import contact_scenes as cs
import ledger_scenes as scenes
import numpy as np
import pytest
import time_step_scenes as ts
from yade import O

DURATION = 0.02  # s
GRAVITY = (0, 0, -9.81)
SAFETIES = (0.4, 0.2, 0.1, 0.05)


def residual(step: float | None = None, **stepper) -> tuple[float, int]:
    """Largest residual over the energy in play, and steps, with a fixed `step` [s] or a HertzTimeStepper."""
    O.reset()
    ts.add_colliding_grains()
    if step is None:
        ts.set_engines(gravity=GRAVITY, **stepper)
    else:
        cs.set_engines(cs.grain_law(), gravity=GRAVITY)
        O.dt = step
    ledger = scenes.add_ledger(iterPeriod=10)
    O.run(1, True)
    while O.time < DURATION:
        O.run(max(1, min(200, int((DURATION - O.time) / O.dt))), True)
    return scenes.largest(ledger), O.iter


def test_residual_with_a_variable_step_falls_with_the_square_of_safety():
    residuals = []
    for safety in SAFETIES:
        residuals.append(residual(safety=safety, maxApproach=1)[0])
        stepper = O.engines[-3]
        assert stepper.changes > 10
        assert O.dt > 2.5 * stepper.smallestStep
    # A sum over collisions that are not the same ones in every run: near 2, not exactly.
    slope = np.polyfit(np.log(SAFETIES), np.log(residuals), 1)[0]
    assert 1.8 < slope < 2.6


@pytest.mark.parametrize("safety", [0.4, 0.1])
def test_variable_step_leaves_less_than_half_the_residual_of_as_many_equal_steps(safety):
    variable, steps = residual(safety=safety, maxApproach=1)
    fixed, as_many = residual(step=DURATION / steps)
    assert as_many == pytest.approx(steps, rel=0.01)
    assert variable < 0.5 * fixed
