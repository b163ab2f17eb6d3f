# SPDX-License-Identifier: GPL-2.0-or-later
"""Impacts under HertzTimeStepper: nothing jumps into anything, and the energy error falls with `safety`."""
from __future__ import annotations

import math
from dataclasses import replace

import contact_scenes as cs
import pytest
import time_step_scenes as ts
from grainfall.projectiles import make_projectile, projectile
from yade import (
    Bo1_SolidOfRevolution_Aabb,
    HertzTimeStepper,
    Ig2_SolidOfRevolution_Sphere_ScGeom,
    Law2_ScGeom_GrainPhys_HertzMindlin,
    O,
)


def restitution_error(speed: float, law: dict | None = None, **stepper) -> tuple[float, int]:
    """|e - 1| of two equal elastic spheres meeting head on at `speed` [m/s], and steps in contact."""
    O.materials.append(ts.SOLID.material(label="grain"))
    gap = 2.05 * ts.RADIUS
    ids = [
        cs.add_sphere((x * gap, 0, 0), ts.RADIUS, "grain", (-2 * x * speed / 2, 0, 0))
        for x in (-0.5, 0.5)
    ]
    steps = [0]

    def count() -> None:
        steps[0] += O.interactions.countReal()

    ts.set_engines(law, count, **stepper)
    while O.bodies[ids[0]].state.vel[0] > -0.4 * speed or O.interactions.countReal():
        O.run(100, True)
        assert O.iter < 20000
    away = O.bodies[ids[1]].state.vel[0] - O.bodies[ids[0]].state.vel[0]
    return abs(away / speed - 1), steps[0]


# Largest |e - 1| over the phase of the first touch, leapfrog with a constant step, by steps in a contact.
PUBLISHED = {0.2: (10, 2.6e-3), 0.1: (20, 4.3e-4), 0.04: (50, 4.1e-5), 0.02: (100, 7.2e-6)}


FREE = {"tangentialLaw": "none"}


@pytest.mark.parametrize("safety", PUBLISHED)
# The step of the fast one is chosen in flight for the worst partner and again when it is known: two or three
# changes an impact, which cost a factor of two. The slow one keeps its Rayleigh step.
@pytest.mark.parametrize("speed, factor", [(0.1, 1.0), (20.0, 2.5)])
def test_elastic_impact_has_the_restitution_of_as_many_constant_steps(speed, factor, safety):
    steps_at_least, error = PUBLISHED[safety]
    measured, steps = restitution_error(speed, FREE, safety=safety, maxApproach=1)
    assert steps >= steps_at_least
    assert measured <= factor * error


def test_energy_error_of_an_impact_falls_with_the_second_power_of_safety_or_faster():
    errors = []
    for safety in (0.4, 0.02):
        O.reset()
        errors.append(restitution_error(0.1, FREE, safety=safety)[0])
    assert errors[1] < errors[0] / (0.4 / 0.02) ** 2


def test_step_that_changes_within_a_contact_needs_the_corrected_velocity():
    """Eq 7-8 follow the overlap: NewtonIntegrator alone then gains energy, to first order in the step."""
    every = dict(equation="report", timeStepUpdateInterval=1, deadBand=0, maxGrowth=1e9)
    errors = {}
    for corrected in (True, False):
        for safety in (0.4, 0.05):
            O.reset()
            errors[corrected, safety], _ = restitution_error(
                1.0, safety=safety, correctVelocity=corrected, maxStep=safety * 2e-4, **every
            )
    order = math.log(errors[False, 0.4] / errors[False, 0.05]) / math.log(8)
    assert order == pytest.approx(1.25, abs=0.25)
    assert errors[True, 0.05] < 0.1 * errors[False, 0.05]
    assert errors[True, 0.05] < errors[True, 0.4] / 8**2


def energy_of_motion() -> float:
    """Kinetic energy [J] at the moment of the forces: velocities are half a step behind them."""
    total = 0.0
    for body in O.bodies:
        state, half = body.state, O.dt / 2
        velocity = state.vel + half * O.forces.f(body.id, sync=True) / state.mass
        total += 0.5 * state.mass * velocity.squaredNorm()
        local = state.ori.conjugate() * state.angVel
        spin = local if body.aspherical else state.angVel
        torque = O.forces.t(body.id)
        if not body.aspherical:
            spin += half * torque / state.inertia[0]
        total += 0.5 * sum(i * w * w for i, w in zip(state.inertia, spin))
    return total


class Shot:
    """A shot of 6 mm calibre at a block of 245 resting grains of quartz, 2 mm each.

    speed : float
        [m/s].
    shape : str
        'sphere' or 'ogive', of steel.
    **stepper
        Attributes of the HertzTimeStepper.
    """

    radius = 1e-3

    def __init__(self, speed: float, shape: str, **stepper) -> None:
        quartz = cs.Solid(7e10, 0.2, 2650)
        steel = cs.Solid(2.1e11, 0.3, 7800)
        for label, solid in (("quartz", quartz), ("steel", steel)):
            O.materials.append(solid.material(label=label, friction=0.4, restitution=0.8))
        for i in range(7 * 7 * 5):
            place = (i % 7 - 3, i // 7 % 7 - 3, -(i // 49) - 1)
            cs.add_sphere([2.001 * self.radius * x for x in place], self.radius, "quartz")
        velocity = (0, 0, -speed)
        # Slow ones start near enough to touch the grain below them soon; fast ones are off its centre.
        start, offset = (0.4e-3, 1e-4) if speed > 1 else (1e-7, 0)
        top = -1.001 * self.radius + start
        if shape == "sphere":
            place = (offset, 2 * offset, top + 3 * self.radius)
            self.id = cs.add_sphere(place, 3 * self.radius, "steel", velocity)
        else:
            outline = "ogive:diameter=0.006,length=0.02,calibre_radius_head=1.5,tip_radius=3e-4"
            solid = make_projectile(
                replace(projectile(outline), density=steel.density),
                nose_at=(offset, 2 * offset, top),
                velocity=velocity,
                material="steel",
            )
            self.id = O.bodies.append(solid)
        self.law = Law2_ScGeom_GrainPhys_HertzMindlin()
        self._set_engines(stepper)
        self.energy = 0.5 * O.bodies[self.id].state.mass * speed**2
        self.seen: set[tuple[int, int]] = set()
        self.first = self.largest = self.residual = 0.0

    def _set_engines(self, stepper: dict) -> None:
        ip2, _ = cs.grain_law()
        cs.set_engines((ip2, [self.law]), self.look)
        engines = O.engines
        engines[1].boundDispatcher.functors += [Bo1_SolidOfRevolution_Aabb()]
        engines[2].geomDispatcher.functors += [Ig2_SolidOfRevolution_Sphere_ScGeom()]
        self.stepper = HertzTimeStepper(**stepper)
        O.engines = engines[:-1] + [self.stepper, engines[-1]]
        O.trackEnergy = True

    def look(self) -> None:
        """Overlaps [of a grain's radius] at first touch and of all; now and then the energy."""
        for contact in O.interactions:
            if not contact.isReal:
                continue
            overlap = contact.geom.penetrationDepth / self.radius
            self.largest = max(self.largest, overlap)
            pair = (contact.id1, contact.id2)
            if self.id in pair and pair not in self.seen:
                self.seen.add(pair)
                self.first = max(self.first, overlap)
        if O.iter % 25 == 0:
            dissipated = sum(v for k, v in O.energy.items() if k.startswith("grain"))
            stored = sum(self.law.elasticEnergy().values())
            total = energy_of_motion() + stored + dissipated
            self.residual = max(self.residual, abs(total / self.energy - 1))


@pytest.mark.parametrize("shape", ["sphere", "ogive"])
@pytest.mark.parametrize("speed", [0.01, 300.0])
def test_projectile_never_jumps_into_a_grain_and_energy_is_conserved(speed, shape):
    shot = Shot(speed, shape)
    O.run(1, True)
    assert "approach" in shot.stepper.reason or speed < 1
    O.run(800, True)
    assert len(shot.seen) >= 1
    assert shot.first <= 0.02
    assert shot.residual < 0.005


def test_first_touch_is_bounded_by_the_way_that_is_allowed_in_a_step():
    """With `safety` out of the way the fast sphere still needs 1/maxApproach steps to cross a radius."""
    shot = Shot(300.0, "sphere", safety=10, maxApproach=0.02)
    O.run(1, True)
    assert shot.stepper.reason.endswith("displacement")
    assert 300 * O.dt == pytest.approx(0.02 * shot.radius, rel=1e-9)
    while not shot.seen:
        O.run(1, True)
    assert 0 < shot.first <= 0.02
