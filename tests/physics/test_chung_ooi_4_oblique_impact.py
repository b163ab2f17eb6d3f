# SPDX-License-Identifier: GPL-2.0-or-later
"""Chung & Ooi (2011) test 4: oblique impact on a rigid plane, 5 to 85 degrees from the normal.

Above the angle of gross sliding (28.3 degrees for the oxide, 27.9 for the alloy) the rebound
follows from momentum alone. Below it the answer depends on how the tangential spring treats a
changing normal force, and the paper's DEM codes use a spring on the total tangential displacement
('secant': F_t = k_t(overlap) s). Such a spring makes energy when the normal force grows under shear
(see test_tangential_energy.py), so it is not the default; the default, incremental spring meets the
curve from 15 degrees on and departs from it where the paper's own codes depart furthest from the
experiment.
"""
from __future__ import annotations

import math
from dataclasses import dataclass

import contact_scenes as cs
import numpy as np
import pytest
from yade import O

RADIUS = 0.0025
SPEED = 3.9
FRICTION = 0.092
RESTITUTION = 0.98
STEPS_PER_CONTACT = 1000
SOLIDS = {
    "aluminium oxide": cs.Solid(3.8e11, 0.23, 4000),
    "aluminium alloy": cs.Solid(7.0e10, 0.33, 2700),
}


@dataclass(frozen=True)
class Rebound:
    """Over the angles: vt'/vt [-], spin about y [rad/s], rebound angle of the patch [rad]."""

    tangential: np.ndarray
    spin: np.ndarray
    patch_angle: np.ndarray


def rebound(solid: cs.Solid, degrees: np.ndarray, tangential_law: str = "incremental") -> Rebound:
    """Spheres side by side over one rigid plane, one for each angle from the normal [degrees]."""
    O.reset()
    angles = np.radians(degrees)
    friction = dict(frictionAngle=math.atan(FRICTION), restitution=RESTITUTION)
    O.materials.append(
        [
            solid.rigid_material(label="plane", **friction),
            solid.material(label="sphere", **friction),
        ]
    )
    cs.add_plane("plane")
    ids = [
        cs.add_sphere(
            (0, 4 * RADIUS * i, RADIUS),
            RADIUS,
            "sphere",
            velocity=(SPEED * math.sin(a), 0, -SPEED * math.cos(a)),
        )
        for i, a in enumerate(angles)
    ]
    cs.set_engines(cs.grain_law(tangentialLaw=tangential_law))
    fastest = cs.HertzImpact.on_rigid_plane(solid, RADIUS, SPEED * math.cos(min(angles)))
    slowest = cs.HertzImpact.on_rigid_plane(solid, RADIUS, SPEED * math.cos(max(angles)))
    O.dt = fastest.duration / STEPS_PER_CONTACT
    cs.run_for(1.1 * slowest.duration)
    assert O.interactions.countReal() == 0
    velocity = np.array([O.bodies[i].state.vel for i in ids])
    spin = np.array([O.bodies[i].state.angVel[1] for i in ids])
    patch = velocity[:, 0] - spin * RADIUS
    return Rebound(
        velocity[:, 0] / (SPEED * np.sin(angles)), spin, np.arctan2(patch, velocity[:, 2])
    )


def published(quantity: str, curve: str) -> tuple[np.ndarray, np.ndarray]:
    """Angles [degrees] and values of a digitised curve; the angles were multiples of 5 degrees."""
    data = cs.read_csv(f"chung_ooi_2011/test4_{quantity}_{curve.replace(' ', '_')}.csv")
    return 5 * np.round(data[:, 0] / 5), data[:, 1]


@pytest.mark.parametrize("name", SOLIDS)
def test_gross_sliding_follows_from_momentum_alone(name):
    degrees = np.array([30.0, 35, 40, 45, 50, 55, 60, 65, 70, 75, 80, 85])
    result = rebound(SOLIDS[name], degrees)
    tangent = np.tan(np.radians(degrees))
    loss = FRICTION * (1 + RESTITUTION)
    spin = 2.5 * loss * SPEED * np.cos(np.radians(degrees)) / RADIUS
    patch = np.arctan((tangent - 3.5 * loss) / RESTITUTION)
    # What is left is the error of the restitution, a few 1e-5, and that of the step. The arm of the
    # torque is the radius less the overlap, which is 0.3 % (oxide) or 0.5 % (alloy) of it at the
    # peak.
    assert result.tangential == pytest.approx(1 - loss / tangent, rel=1e-3)
    assert result.spin == pytest.approx(spin, rel=6e-3)
    assert result.patch_angle == pytest.approx(patch, abs=math.radians(0.2))


@pytest.mark.parametrize("name", SOLIDS)
def test_total_displacement_spring_meets_the_published_curve_from_5_to_85_degrees(name):
    degrees, expected = published("tangential_restitution", name)
    result = rebound(SOLIDS[name], degrees, "secant")
    assert result.tangential == pytest.approx(expected, rel=0.03)


@pytest.mark.parametrize("name", SOLIDS)
def test_default_spring_meets_the_published_curve_from_15_to_85_degrees(name):
    degrees, expected = published("tangential_restitution", name)
    steep = degrees >= 15
    result = rebound(SOLIDS[name], degrees[steep])
    assert result.tangential == pytest.approx(expected[steep], rel=0.03)


@pytest.mark.parametrize("name", SOLIDS)
def test_default_spring_meets_the_published_spin_from_15_to_85_degrees(name):
    degrees, expected = published("spin", name)
    steep = degrees >= 15
    result = rebound(SOLIDS[name], degrees[steep])
    # Of the largest spin: the plot was read to about 1 % of it, whatever the angle.
    assert -result.spin == pytest.approx(expected[steep], abs=0.03 * np.max(np.abs(expected)))


def test_default_spring_meets_the_published_rebound_angle_of_the_patch_from_15_to_85_degrees():
    degrees, expected = published("patch_rebound_angle", "aluminium oxide")
    steep = degrees >= 15
    result = rebound(SOLIDS["aluminium oxide"], degrees[steep])
    assert np.degrees(result.patch_angle) == pytest.approx(expected[steep], abs=1.5)


def test_default_spring_is_nearer_to_the_experiment_at_5_degrees_than_the_published_codes():
    """Kharaz et al. (2001), aluminium oxide: 0.75 at 4 degrees; micro-slip, which no spring has."""
    angles, measured = cs.read_csv("chung_ooi_2011/test4_tangential_restitution_experiment.csv").T
    degrees = np.array([5.0])
    experiment = np.interp(degrees, angles, measured)
    solid = SOLIDS["aluminium oxide"]
    ours = rebound(solid, degrees).tangential
    theirs = rebound(solid, degrees, "secant").tangential
    assert experiment < ours < theirs
