# SPDX-License-Identifier: GPL-2.0-or-later
"""Chung & Ooi (2011) test 5: 10 um spheres strike a rigid plane at 5 m/s and 0.1 to 30 m/s along it.

Plotted is the slip of the patch after over that before, both over mu v_n. Sliding throughout
(v_st/(mu v_n) above 5.8, Maw, Barber & Fawcett 1976) it follows from momentum. Below, the paper's DEM
curve is not the one of its test 4, although in these units both are the same problem: it is met to 5 %
by Eq 4's spring with one half of Mindlin's stiffness, and by nothing of full stiffness. The paper also
plots finite elements, to which the default law is nearly twice as near as that curve.
"""
from __future__ import annotations

import chung_ooi_oblique as co
import contact_scenes as cs
import numpy as np
import pytest

IMPACT = co.Oblique(radius=1e-5, normal_speed=5.0, friction=0.3, restitution=1.0, spinning=False)
UNIT = IMPACT.friction * IMPACT.normal_speed  # m/s, mu v_n
SOLIDS = {
    "steel": cs.Solid(2.08e11, 0.30, 7850),
    "polyethylene": cs.Solid(1.0e9, 0.40, 1400),
}
REPORT_FACTOR = 2 ** (-1 / 3)  # k_t of tangentialLaw 'report' over Mindlin's


def published(quantity: str, curve: str) -> tuple[np.ndarray, np.ndarray]:
    return cs.read_csv(f"chung_ooi_2011/test5_{quantity}_{curve}.csv").T


def slip_after(name: str, before: np.ndarray, *law) -> np.ndarray:
    """Slip after over mu v_n', for slips before over mu v_n."""
    result = co.on_rigid_plane(IMPACT, SOLIDS[name], UNIT * before, *law)
    return result.slip / (IMPACT.friction * result.normal)


@pytest.mark.parametrize("law", ["incremental", "secant", "report"])
@pytest.mark.parametrize("name", SOLIDS)
def test_gross_sliding_follows_from_momentum_alone(name, law):
    before = np.array([6.5, 8.0, 10.0, 14.0, 20.0])
    result = co.on_rigid_plane(IMPACT, SOLIDS[name], UNIT * before, law)
    hertz = cs.HertzImpact.on_rigid_plane(SOLIDS[name], IMPACT.radius, IMPACT.normal_speed)
    # The arm of friction is the radius less the overlap, which takes up to this off the spin: 0.6 % for
    # steel, 2.6 % for polyethylene. A thousandth is left for the step.
    shorter = hertz.overlap / IMPACT.radius
    spin = result.spin * IMPACT.radius / (-5 * UNIT)
    assert np.all(-spin < 1 + 1e-3)
    assert np.all(-spin > 1 - shorter - 1e-3)
    velocity = result.slip + result.spin * IMPACT.radius
    assert velocity == pytest.approx((before - 2) * UNIT, rel=1e-3)


@pytest.mark.parametrize("name", SOLIDS)
def test_published_curves_agree_where_the_contact_slides_throughout(name):
    before, expected = published("slip", name)
    sliding = before > 5.9
    # The plot was read to 0.05; polyethylene's shorter arm gives another 7 (1 - 0.974) / 2 = 0.09.
    assert slip_after(name, before[sliding]) == pytest.approx(expected[sliding], abs=0.15)
    before, expected = published("spin", name)
    sliding = before > 5.9
    result = co.on_rigid_plane(IMPACT, SOLIDS[name], UNIT * before[sliding])
    assert -result.spin * IMPACT.radius / UNIT == pytest.approx(expected[sliding], abs=0.1)


@pytest.mark.parametrize("name", SOLIDS)
def test_eq_4_with_half_of_mindlin_s_stiffness_is_the_published_curve(name):
    before, expected = published("slip", name)
    half = slip_after(name, before, "report", 0.5 / REPORT_FACTOR)
    whole = slip_after(name, before, "report", 1.0 / REPORT_FACTOR)
    # 5 % of the curve's depth, 2.9; with the whole stiffness it is missed by half of that depth.
    assert half == pytest.approx(expected, abs=0.15)
    assert np.max(np.abs(whole - expected)) > 1.0


@pytest.mark.parametrize("law", ["incremental", "secant", "report"])
def test_steel_is_nearer_to_the_finite_elements_than_the_published_curve(law):
    before, finite_elements = published("slip", "finite_elements")
    ours = slip_after("steel", before, law) - finite_elements
    theirs = np.interp(before, *published("slip", "steel")) - finite_elements
    # Root mean squares: 0.34, 0.39, 0.12 and 0.63 theirs. What is left is micro-slip; the softer spring of
    # "report" stands in for part of it.
    assert np.sqrt(np.mean(ours**2)) < 0.7 * np.sqrt(np.mean(theirs**2))
