# SPDX-License-Identifier: GPL-2.0-or-later
"""Free motion of a projectile in six degrees of freedom, beside rigid-body mechanics."""

from __future__ import annotations

import numpy as np
import pytest
from projectile_scene import (
    engines,
    grain,
    kinetic_energy,
    material,
    run,
    spin_momentum,
    vector,
)
from yade import O, Vector3

from grainfall.projectiles import flat_cylinder, make_projectile, pointing


def free_body(spec, **motion):
    material()
    body = make_projectile(spec, **motion)
    O.bodies.append(body)
    return body


def axis_of(body):
    return vector(body.state.ori * Vector3(0, 0, 1))


def precession(steps_a_turn, turns=2):
    """Axis after some turns of a free top, its analytic place, and the relative energy error."""
    O.reset()
    body = free_body(
        "m70-full", orientation=pointing((0.4, 0.2, -1)), angular_velocity=(30, -20, 60)
    )
    momentum, energy, start = spin_momentum(body), kinetic_energy(body), axis_of(body)
    size = np.linalg.norm(momentum)
    rate = size / body.state.inertia[0]
    engines(2 * np.pi / rate / steps_a_turn)
    run(int((turns + 0.3) * steps_a_turn))
    assert spin_momentum(body) == pytest.approx(momentum, rel=1e-14)
    along = momentum / size
    across = start - (start @ along) * along
    angle = rate * O.time
    expected = start - across + np.cos(angle) * across + np.sin(angle) * np.cross(along, start)
    return axis_of(body), expected, kinetic_energy(body) / energy - 1


def test_without_torque_the_axis_precesses_about_the_angular_momentum_at_the_analytic_rate():
    # Symmetric top: the axis turns about the constant L at the rate |L| / I_transverse, at constant
    # inclination, with constant energy. YADE's integrator keeps L exactly and the rest to first order
    # in the step; so the error must halve with it and vanish in the extrapolation to step zero.
    coarse, expected, coarse_energy = precession(4000)
    fine, _, fine_energy = precession(8000)
    coarse_error = np.linalg.norm(coarse - expected)
    fine_error = np.linalg.norm(fine - expected)
    assert fine_error < 5e-3
    assert fine_error == pytest.approx(coarse_error / 2, rel=0.02)
    assert np.linalg.norm(2 * fine - coarse - expected) < 0.05 * fine_error
    assert fine_energy == pytest.approx(coarse_energy / 2, rel=0.05)
    assert abs(2 * fine_energy - coarse_energy) < 0.05 * abs(fine_energy)


def test_a_dropped_projectile_falls_by_half_g_t_squared_and_keeps_its_attitude():
    # Leapfrog from rest moves the body by g dt^2 n (n + 1) / 2: half a step more than g t^2 / 2.
    start = pointing((0.1, 0, -1))
    body = free_body("m70-full", orientation=start, position=(0, 0, 1))
    engines(1e-4, gravity=9.81)
    run(3000)
    assert body.state.pos[2] == pytest.approx(1 - 9.81 * 1e-8 * 3000 * 3001 / 2, rel=1e-12)
    assert body.state.vel[2] == pytest.approx(-9.81 * 0.3, rel=1e-12)
    assert (body.state.ori * start.conjugate()).norm() == pytest.approx(1)
    assert vector(body.state.angVel) == pytest.approx(np.zeros(3))


def test_dropped_from_the_reports_height_the_replica_arrives_with_its_theoretical_speed():
    # MR-2629, section 4.2: 3.5 m/s from 0.61 m.
    body = free_body("m70-full", nose_at=(0, 0, 0.61))
    engines(1e-4, gravity=9.81)
    while body.state.pos[2] + body.shape.noseZ > 0:
        run(50)
    excess = body.state.pos[2] + body.shape.noseZ
    speed = -body.state.vel[2]
    assert speed**2 == pytest.approx(2 * 9.81 * (0.61 - excess), rel=1e-3)
    assert round(speed, 1) == 3.5


def test_a_hit_beside_the_axis_turns_the_projectile_by_impulse_times_lever():
    # The shaft is hit across the axis, above the centroid: I_transverse * omega = lever * impulse.
    body = free_body(flat_cylinder(0.05, 0.2, density=1000.0))
    lever = 0.07
    grain((0.0352, 0, lever), 0.01, (-1.0, 0, 0))
    engines(1e-6)
    run(12000)
    assert not any(i.isReal for i in O.interactions)
    impulse = body.state.mass * vector(body.state.vel)
    assert impulse[0] < 0
    expected = np.cross((0, 0, lever), impulse)[1] / body.state.inertia[1]
    # Both bodies move during the contact; the lever changes by a hundredth of a millimetre.
    assert body.state.angVel[1] == pytest.approx(expected, rel=1e-3)
    axis = axis_of(body)
    assert axis[0] < 0 and abs(axis[1]) < 1e-9, "it tilts in the plane of the hit"


def test_spin_about_the_axis_stays_when_the_nose_is_hit_without_friction():
    spin = 200.0
    body = free_body("m70-half", angular_velocity=(0, 0, spin))
    nose = body.shape.noseZ
    grain((0.004, 0, nose - 0.002), 0.003, (0, 0, 3.0))
    engines(2e-7)
    run(20000)
    assert body.state.vel[2] > 0
    # Frictionless forces meet the axis of a solid of revolution, so L along it cannot change; the
    # integrator's axis is exact to first order in the step.
    along = axis_of(body)
    assert spin_momentum(body) @ along == pytest.approx(spin * body.state.inertia[2], rel=1e-7)
