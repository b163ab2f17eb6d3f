# SPDX-License-Identifier: GPL-2.0-or-later
"""The residual of the energy balance is small at the usual step and falls with the step's square."""
from __future__ import annotations

import ledger_scenes as scenes
import numpy as np
import pytest
from yade import O

LIMIT = 1e-3
STANDARD_STEP = 0.1  # of the Rayleigh step


def slope(steps: list[float], residuals: list[float]) -> float:
    """Order of convergence: slope of log residual over log step."""
    return float(np.polyfit(np.log(steps), np.log(residuals), 1)[0])


def test_oblique_impact_with_friction_and_dashpots_closes():
    assert scenes.largest(scenes.oblique(50)) < LIMIT
    table = O.engines[-1].table()
    assert min(table[name] for name in ("friction", "viscous", "rescaling")) > 0


def test_settling_bed_closes():
    ledger = scenes.settling_bed(STANDARD_STEP)
    assert scenes.largest(ledger) < LIMIT
    table = ledger.table()
    assert len([b for b in O.bodies if b.dynamic]) == 512
    # Most of what fell is dissipated.
    assert table["friction"] + table["viscous"] > 0.7 * ledger.energyInPlay


def test_shaken_box_closes():
    ledger = scenes.shaken_box(STANDARD_STEP)
    assert scenes.largest(ledger) < LIMIT
    # The floor has put in more than it got back, and it has been dissipated.
    assert ledger.table()["imposedMotion"] > 0.1 * ledger.energyInPlay


@pytest.mark.parametrize("restitution", [0.5, 1.0])
def test_residual_of_a_head_on_impact_falls_with_the_square_of_the_step(restitution):
    steps = [40, 80, 160, 320, 640]
    residuals = []
    for number in steps:
        O.reset()
        residuals.append(scenes.largest(scenes.head_on(number, restitution)))
    # Leapfrog is of second order while the contact lasts.
    assert 1.85 < -slope(steps, residuals) < 2.15


def test_residual_of_a_settling_bed_falls_with_the_square_of_the_step():
    fractions = [0.4, 0.2, 0.1, 0.05]
    residuals = []
    for fraction in fractions:
        O.reset()
        ledger = scenes.settling_bed(fraction, grains_per_side=5, duration=0.07)
        residuals.append(scenes.largest(ledger))
    # The beds differ grain by grain after a few collisions; what is left over is still a sum over many.
    assert 1.7 < slope(fractions, residuals) < 2.4


def test_floor_of_the_residual_is_yade_s_shear_displacement():
    """With the shear displacement taken where the shear force acts nothing is left at small steps.

    By default YADE reckons it with the undeformed radii and lengthens it by (r1 + r2)/(r1 + r2 - overlap), so
    that tangential work is off by the share of the overlap in the radii, here up to 1e-3.
    """
    floors = []
    for exact in (False, True):
        O.reset()
        floors.append(abs(scenes.oblique(1600, 1.0, exact).relativeResidual))
    impact = scenes.cs.HertzImpact.of_equal_spheres(scenes.HARD, scenes.RADIUS, scenes.SPEED)
    overlap = impact.overlap / (2 * scenes.RADIUS)
    assert 1e-6 < floors[1] * 100 < floors[0] < overlap
