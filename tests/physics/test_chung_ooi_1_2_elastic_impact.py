# SPDX-License-Identifier: GPL-2.0-or-later
"""Chung & Ooi (2011) tests 1 and 2: elastic impact of two spheres, and of one on a rigid plane.

The closed form is Hertz's. Each collision takes 500 steps: leapfrog then errs by 1e-6 in energy,
sampling by 1e-5 in the peak. The issue asks for 0.5 %; these tests ask for 0.05 %, which still lets
no formula pass that is wrong in a factor, and none that takes the radius of a plane from the stock
functors (peak 0.87 of Hertz's).
"""
from __future__ import annotations

from dataclasses import dataclass, field

import contact_scenes as cs
import numpy as np
import pytest
from yade import O

TOLERANCE = 5e-4
STEPS_PER_CONTACT = 500

SPHERE_PAIRS = {
    "glass": cs.Solid(4.8e10, 0.20, 2800),
    "limestone": cs.Solid(2.0e10, 0.25, 2500),
}
PLANE_IMPACTS = {
    "aluminium alloy": cs.Solid(7.0e10, 0.30, 2699),
    "magnesium alloy": cs.Solid(4.0e10, 0.35, 1800),
}


@dataclass
class Impact:
    """Recorded time [s], overlap [m] and normal force [N] of one collision, one entry a step."""

    time: list[float] = field(default_factory=list)
    overlap: list[float] = field(default_factory=list)
    force: list[float] = field(default_factory=list)

    def record(self, overlap: float, force: float) -> None:
        self.time.append(O.time)
        self.overlap.append(overlap)
        self.force.append(force)

    @property
    def duration(self) -> float:
        """Time [s] from overlap zero to overlap zero, interpolated between steps."""
        t, d = np.array(self.time), np.array(self.overlap)
        inside = np.flatnonzero(d > 0)
        first, last = inside[0], inside[-1]
        end = t[last] + d[last] / (d[last] - d[last + 1]) * (t[last + 1] - t[last])
        if first == 0:
            return end - t[0]
        start = t[first] - d[first] / (d[first] - d[first - 1]) * (t[first] - t[first - 1])
        return end - start


def two_spheres(solid: cs.Solid) -> tuple[Impact, cs.HertzImpact]:
    """Test 1: radius 10 mm, +-10 m/s."""
    radius, speed = 0.010, 10.0
    hertz = cs.HertzImpact.of_equal_spheres(solid, radius, 2 * speed)
    O.materials.append(solid.material())
    gap = 2 * speed * hertz.duration / STEPS_PER_CONTACT
    left = cs.add_sphere((-radius - gap / 2, 0, 0), radius, 0, velocity=(speed, 0, 0))
    right = cs.add_sphere((radius + gap / 2, 0, 0), radius, 0, velocity=(-speed, 0, 0))
    impact = Impact()

    def record() -> None:
        distance = O.bodies[right].state.pos[0] - O.bodies[left].state.pos[0]
        impact.record(2 * radius - distance, cs.force_on(right)[0])

    run(hertz, record)
    return impact, hertz


def sphere_on_plane(solid: cs.Solid) -> tuple[Impact, cs.HertzImpact]:
    """Test 2: radius 100 mm, 0.2 m/s, rigid plane."""
    radius, speed = 0.100, 0.2
    hertz = cs.HertzImpact.on_rigid_plane(solid, radius, speed)
    O.materials.append([solid.material(label="sphere"), solid.rigid_material(label="plane")])
    cs.add_plane("plane")
    gap = speed * hertz.duration / STEPS_PER_CONTACT
    sphere = cs.add_sphere((0, 0, radius + gap), radius, "sphere", velocity=(0, 0, -speed))
    impact = Impact()

    def record() -> None:
        impact.record(radius - O.bodies[sphere].state.pos[2], cs.force_on(sphere)[2])

    run(hertz, record)
    return impact, hertz


def run(hertz: cs.HertzImpact, record) -> None:
    cs.set_engines(cs.grain_law(), record)
    O.dt = hertz.duration / STEPS_PER_CONTACT
    cs.run_for(1.1 * hertz.duration)


CASES = [
    pytest.param(scene, solid, id=name)
    for scene, solids in ((two_spheres, SPHERE_PAIRS), (sphere_on_plane, PLANE_IMPACTS))
    for name, solid in solids.items()
]


@pytest.mark.parametrize("scene, solid", CASES)
def test_elastic_impact_has_the_peak_overlap_and_duration_of_hertz(scene, solid):
    impact, hertz = scene(solid)
    assert max(impact.force) == pytest.approx(hertz.force, rel=TOLERANCE)
    assert max(impact.overlap) == pytest.approx(hertz.overlap, rel=TOLERANCE)
    assert impact.duration == pytest.approx(hertz.duration, rel=TOLERANCE)


PUBLISHED = [
    pytest.param(1, two_spheres, SPHERE_PAIRS["glass"], id="test 1 glass"),
    pytest.param(2, sphere_on_plane, PLANE_IMPACTS["aluminium alloy"], id="test 2 aluminium alloy"),
]

# Reading error of the plotted curves, as a share of the peak: Hertz's own curve misses the
# digitised points of force against overlap by up to 1.3 %, those of force against time by up to 1.5
# %.
READING = 0.02


@pytest.mark.parametrize("test, scene, solid", PUBLISHED)
def test_force_lies_on_the_published_curve_of_force_against_overlap(test, scene, solid):
    impact, hertz = scene(solid)
    published = cs.read_csv(f"chung_ooi_2011/test{test}_force_overlap.csv") * (1e-6, 1e3)
    loading = np.argmax(impact.overlap) + 1
    force = np.interp(published[:, 0], impact.overlap[:loading], impact.force[:loading])
    assert np.max(np.abs(force - published[:, 1])) < READING * hertz.force


@pytest.mark.parametrize("test, scene, solid", PUBLISHED)
def test_force_lies_on_the_published_curve_of_force_against_time(test, scene, solid):
    impact, hertz = scene(solid)
    published = cs.read_csv(f"chung_ooi_2011/test{test}_force_time.csv") * (1e-6, 1e3)
    start = impact.time[np.flatnonzero(np.array(impact.overlap) > 0)[0]]
    force = np.interp(published[:, 0], np.array(impact.time) - start, impact.force)
    assert np.max(np.abs(force - published[:, 1])) < READING * hertz.force


@pytest.mark.parametrize("scene, solid", CASES)
def test_elastic_impact_returns_the_impact_speed(scene, solid):
    _, hertz = scene(solid)
    spheres = [b.state for b in O.bodies if b.state.mass > 0]
    # 500 steps a contact: leapfrog errs by 1.3e-7 in restitution.
    for state in spheres:
        assert state.vel.norm() == pytest.approx(hertz.speed / len(spheres), rel=1e-6)
