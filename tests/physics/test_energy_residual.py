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


def test_residual_of_an_oblique_impact_falls_without_a_floor():
    """The work of YADE's shear kinematics is booked; unbooked it would be a floor of 4e-5 here."""
    steps = [50, 100, 200, 400]
    residuals = []
    for number in steps:
        O.reset()
        residuals.append(scenes.largest(scenes.oblique(number, 1.0)))
    assert 1.7 < -slope(steps, residuals) < 2.3
    ledger = O.engines[-1]
    assert abs(ledger.table()["shearKinematics"]) > 10 * ledger.largestResidual


def test_shear_kinematics_of_yade_cost_the_overlap_s_share_of_the_tangential_work():
    """Shear displacement is reckoned with the radii, by default lengthened by (r1 + r2)/(r1 + r2 - overlap).

    Of two equal spheres sliding past each other the sliders then take more than the bodies give by the overlap
    over the sum of the radii.
    """
    shares = []
    for exact in (False, True):
        O.reset()
        ledger = scenes.sliding_pair(exact)
        table = ledger.table()
        taken = table["friction"] + table["elasticShear"]
        shares.append(table["shearKinematics"] / taken)
        assert ledger.relativeResidual < 1e-6
    overlap = O.interactions[0, 1].geom.penetrationDepth
    assert shares[0] == pytest.approx(overlap / (2 * scenes.RADIUS), rel=1e-3)
    assert shares[1] == pytest.approx(0, abs=1e-12)
