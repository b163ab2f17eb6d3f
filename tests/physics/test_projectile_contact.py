# SPDX-License-Identifier: GPL-2.0-or-later
"""Contacts of a solid of revolution, beside conservation laws and stock spheres."""

from __future__ import annotations

import numpy as np
import pytest
from projectile_scene import (
    engines,
    grain,
    kinetic_energy,
    material,
    real_contacts,
    run,
    spin_momentum,
    vector,
)
from yade import O
from yade.utils import wall as yade_wall

from grainfall.projectiles import (
    flat_cylinder,
    make_projectile,
    pointing,
    sphere,
)


def total_momenta(bodies):
    linear = sum(b.state.mass * vector(b.state.vel) for b in bodies)
    angular = sum(
        np.cross(vector(b.state.pos), b.state.mass * vector(b.state.vel)) + spin_momentum(b)
        for b in bodies
    )
    return linear, angular


def test_each_grain_touches_the_projectile_once_and_only_where_the_surface_is_reached():
    material()
    body = make_projectile("m70-full", orientation=pointing((0.3, 0.1, -1)))
    O.bodies.append(body)
    random = np.random.default_rng(1)
    radius = 0.004
    for position in random.uniform(-0.12, 0.12, (800, 3)):
        grain(position, radius, fixed=True)
    body.dynamic = False
    engines(1e-9)
    # Fixed bodies get no contacts with each other, but the projectile may move.
    body.dynamic = True
    run(1)
    expected = set()
    for other in O.bodies:
        if other.id != body.id:
            local = body.state.ori.conjugate() * (other.state.pos - body.state.pos)
            if body.shape.closestPoint(local)[0] < radius:
                expected.add(other.id)
    touching = [i.id1 + i.id2 - body.id for i in real_contacts(body)]
    assert len(expected) > 20
    assert sorted(touching) == sorted(expected)


@pytest.mark.parametrize("projectile_first", [True, False])
def test_grain_hitting_the_nose_off_axis_conserves_both_momenta_and_elastic_energy(
    projectile_first,
):
    # Frictionless: the law then stores no energy but Hertz'. Momenta are kept to rounding, because
    # forces are opposite and act in one point; kinetic energy to the integrator's error of an
    # elastic impact of some hundred steps.
    material()
    body = make_projectile("m70-full")
    if projectile_first:
        O.bodies.append(body)
    hit = grain((0.015, 0.002, -0.11), 0.006, (0, 0, 2.0))
    if not projectile_first:
        O.bodies.append(body)
    engines(2e-6)
    pair = (body, hit)
    linear, angular = total_momenta(pair)
    energy = sum(kinetic_energy(b) for b in pair)
    touched = False
    for _ in range(20):
        run(500)
        touched = touched or bool(real_contacts(body))
    assert touched and not real_contacts(body)
    linear_after, angular_after = total_momenta(pair)
    assert np.linalg.norm(linear_after - linear) < 1e-12 * np.linalg.norm(linear)
    assert np.linalg.norm(angular_after - angular) < 1e-9 * np.linalg.norm(angular)
    assert sum(kinetic_energy(b) for b in pair) == pytest.approx(energy, rel=1e-3)
    assert abs(body.state.angVel[1]) > 0.01, "the hit beside the axis tilts the projectile"


def trajectory_of_pair(make_target):
    material(friction_angle=0.4)
    target = make_target()
    hit = grain((0.03, 0.001, 0.062), 0.01, (-0.5, 0.1, -1.5))
    hit.state.angVel = (3, -20, 5)
    engines(1e-6)
    path = []
    for _ in range(60):
        run(300)
        for b in (target, hit):
            path.append(list(b.state.pos) + list(b.state.vel) + list(b.state.angVel))
    return np.array(path)


def test_sphere_profile_reproduces_the_trajectory_of_a_stock_sphere():
    # Oblique, rotating, with friction; 1e-9 of the largest value of each component.
    density = 2650.0

    def stock():
        return grain((0, 0, 0), 0.05)

    def revolved():
        body = make_projectile(sphere(0.1, density=density), orientation=pointing((1, 2, 0.5)))
        body.aspherical = False  # a ball needs no other integrator than stock spheres
        O.bodies.append(body)
        return body

    expected = trajectory_of_pair(stock)
    O.reset()
    actual = trajectory_of_pair(revolved)
    assert np.abs(expected[-1, 3:6] - (-0.5, 0.1, -1.5)).max() > 0.5, "they did collide"
    difference = np.abs(actual - expected).max(axis=0)
    assert (difference <= 1e-9 * np.abs(expected).max(axis=0)).all()


def test_sphere_profile_bounces_on_a_wall_like_a_stock_sphere():
    def path(revolved):
        O.reset()
        material(friction_angle=0.3)
        O.bodies.append(yade_wall(0, axis=2, sense=1, material=O.materials[-1]))
        if revolved:
            body = make_projectile(sphere(0.02, density=2650.0))
            body.aspherical = False
            O.bodies.append(body)
            body.state.pos, body.state.vel = (0, 0, 0.011), (0.4, 0, -1)
        else:
            body = grain((0, 0, 0.011), 0.01, (0.4, 0, -1))
        engines(1e-6, gravity=9.81)
        points = []
        for _ in range(50):
            run(100)
            points.append(
                list(body.state.pos) + list(body.state.vel) + [0.01 * w for w in body.state.angVel]
            )
        return np.array(points)

    expected = path(False)
    assert expected[-1, 5] > 0.9, "it came back"
    assert np.abs(path(True) - expected).max() < 1e-9


def test_curvature_of_the_surface_decides_the_contacts_equivalent_radius():
    # Sphere of equal mean curvature: 2a on a shaft of radius a, flat on the base, the grain's own
    # radius at an edge.
    material()
    a, length, radius = 0.05, 0.3, 0.01
    body = make_projectile(flat_cylinder(2 * a, length, density=1000.0))
    O.bodies.append(body)
    reach = 0.999 * radius
    shaft = grain((a + reach, 0, 0.05), radius)
    base = grain((0.01, 0, length / 2 + reach), radius)
    edge = grain((a + 0.7 * reach, 0, -length / 2 - 0.7 * reach), radius)
    engines(1e-9)
    run(1)
    geometry = {i.id1 + i.id2 - body.id: i.geom for i in real_contacts(body)}
    assert geometry[shaft.id].refR1 == pytest.approx(2 * a, rel=1e-12)
    assert geometry[base.id].refR1 == pytest.approx(1e8 * radius, rel=1e-12)
    # At the edge: 1 / radius along the meridian, cos 45 / a around the axis.
    mean = 0.5 * (1 / radius + np.sqrt(0.5) / a)
    assert geometry[edge.id].refR1 == pytest.approx(1 / mean, rel=1e-6)
    for g in geometry.values():
        assert g.refR2 == radius


def test_a_contact_keeps_its_history_while_the_grain_slides_from_shaft_to_nose():
    # A grain is led at constant overlap along a cylinder, around the sharp edge, over the flat nose.
    material(friction_angle=0.5)
    a, length, radius, overlap, straight = 0.05, 0.2, 0.002, 1e-5, 5e-4
    body = make_projectile(flat_cylinder(2 * a, length, density=1000.0))
    O.bodies.append(body)
    body.state.blockedDOFs = "xyzXYZ"
    led = grain((0, 0, 0), radius)
    led.state.blockedDOFs = "xyzXYZ"
    load = engines(1e-6, load_of=body.id)
    distance, chunk, stretch = radius - overlap, 50, 5e-5  # m of path in each chunk of steps
    corner, quarter = np.array((a, 0, -length / 2)), 0.5 * np.pi * distance

    def centre(path):
        if path < straight:
            return corner + (distance, 0, straight - path)
        turn = min((path - straight) / distance, 0.5 * np.pi)
        beyond = max(path - straight - quarter, 0)
        return corner + (distance * np.cos(turn) - beyond, 0, -distance * np.sin(turn))

    zones, mobilised, born = [], [], set()
    for k in range(82):
        here, there = centre(k * stretch), centre((k + 1) * stretch)
        led.state.pos, led.state.vel = here, (there - here) / (chunk * O.dt)
        run(chunk)
        (contact,) = real_contacts(body)
        born.add(contact.iterMadeReal)
        mobilised.append(contact.phys.shearForce.norm() / contact.phys.normalForce.norm())
        zones.append((load.noseContacts, load.shaftContacts, load.baseContacts))
    assert born == {0}, "one contact from beginning to end"
    assert zones[0] == (0, 1, 0) and zones[-1] == (1, 0, 0)
    assert mobilised[2:] == pytest.approx(
        [np.tan(0.5)] * 80, rel=1e-9
    ), "friction never starts anew"
