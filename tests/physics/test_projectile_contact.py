# SPDX-License-Identifier: GPL-2.0-or-later
"""Contacts of a solid of revolution, beside conservation laws and stock spheres."""

from __future__ import annotations

import numpy as np
import pytest
from projectile_scene import (
    YOUNG,
    engines,
    grain,
    kinetic_energy,
    material,
    run,
    spin_momentum,
    vector,
)
from yade import O, Quaternion, Vector3, wrapper
from yade.utils import box as yade_box
from yade.utils import wall as yade_wall

from grainfall.projectiles import (
    flat_cylinder,
    make_projectile,
    ogive,
    pointing,
    sphere,
)


def real_contacts(body):
    return [i for i in O.interactions if i.isReal and body.id in (i.id1, i.id2)]


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
    # Oblique, rotating, with friction. 1e-9 of each column's largest value; only roundings differ.
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
    assert np.abs(actual - expected).max(axis=0) == pytest.approx(
        np.zeros(9), abs=1e-9 * np.abs(expected).max()
    )


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


@pytest.mark.parametrize("floor", ["wall", "box"])
def test_a_flat_projectile_dropped_on_a_floor_comes_to_rest_on_its_face(floor):
    material(friction_angle=0.3)
    if floor == "wall":
        O.bodies.append(yade_wall(0, axis=2, sense=1, material=O.materials[-1]))
    else:
        O.bodies.append(
            yade_box((0, 0, -0.05), (0.2, 0.2, 0.05), fixed=True, material=O.materials[-1])
        )
    body = make_projectile(flat_cylinder(0.05, 0.1, density=1000.0), position=(0, 0, 0.055))
    O.bodies.append(body)
    engines(2e-5, gravity=9.81, en=0.3)
    run(30000)
    # Hertz: weight = 4/3 E* sqrt(R) overlap^1.5 with E* = E / (2 (1 - nu^2)), R the solid's radius.
    weight, stiffness = 9.81 * body.state.mass, YOUNG / (2 * (1 - 0.3**2))
    overlap = (weight / (4 / 3 * stiffness * np.sqrt(0.025))) ** (2 / 3)
    assert body.state.pos[2] == pytest.approx(0.05 - overlap, rel=1e-6)
    assert abs(body.state.vel[2]) < 1e-4
    axis = body.state.ori * Vector3(0, 0, 1)
    assert axis[2] == pytest.approx(1, abs=1e-6)


def test_the_collider_follows_a_projectile_that_only_turns():
    # The centroid is held, so the collider sees no motion, and no grain is in the first bounding box.
    material()
    body = make_projectile(ogive(0.04, 0.3, density=1000.0))
    O.bodies.append(body)
    body.state.blockedDOFs = "xyz"
    spin = 20.0
    body.state.angVel = (spin, 0, 0)
    body.state.angMom = body.state.inertia[0] * Vector3(spin, 0, 0)
    target = grain((0, 0.13, 0), 0.005, fixed=True)
    engines(1e-5, load_of=body.id)
    run(6000)
    assert not real_contacts(body)
    while not real_contacts(body) and spin * O.time < 1.6:
        run(10)
    assert real_contacts(body), "the nose sweeps over the grain before it has turned by 90 degrees"
    local = body.state.ori.conjugate() * (target.state.pos - body.state.pos)
    moved = 10 * O.dt * spin * 0.13
    assert 0 < 0.005 - body.shape.closestPoint(local)[0] < moved, "found when first touched"


def test_the_bounding_box_holds_the_turned_solid_and_little_more():
    material()
    random = np.random.default_rng(3)
    for _ in range(10):
        O.reset()
        material()
        q = random.normal(size=4)
        q /= np.linalg.norm(q)
        body = make_projectile("m70-full", orientation=Quaternion(*q))
        O.bodies.append(body)
        engines(1e-9)
        O.engines[1].verletDist = 0
        O.engines[1].boundDispatcher.functors[3].turnMargin = 1e-6
        run(1)
        vertices = np.array(body.shape.mesh(180)[0])
        turned = np.array([vector(body.state.ori * Vector3(*v)) for v in vertices])
        low, high = vector(body.bound.min), vector(body.bound.max)
        assert (turned.min(axis=0) >= low).all() and (turned.max(axis=0) <= high).all()
        # Facets of 2 degrees miss a curve of radius 85 mm (the ogive) by 85 mm (1 - cos 1 deg).
        assert np.abs(turned.min(axis=0) - low).max() < 1.4e-5
        assert np.abs(turned.max(axis=0) - high).max() < 1.4e-5


def test_across_a_periodic_boundary_contacts_are_the_same_as_inside_the_cell():
    def forces(shift):
        O.reset()
        O.periodic = True
        O.cell.setBox(1, 1, 1)
        material()
        body = make_projectile(ogive(0.1, 0.3, density=1000.0), position=(0.05 + shift, 0.5, 0.5))
        O.bodies.append(body)
        grain((0.05 + shift - 0.0595, 0.5, 0.55), 0.01)
        load = engines(1e-6, load_of=body.id)
        run(1)
        assert list(load.totalForce) == pytest.approx(list(O.forces.f(body.id)), rel=1e-12)
        return vector(load.shaftForce)

    inside, across = forces(0.3), forces(0.0)
    assert inside[0] > 0
    assert across == pytest.approx(inside, rel=1e-6), "5e-4 m of overlap from coordinates of 1 m"


def test_liquid_bridges_can_ask_for_contacts_at_a_distance():
    material()
    body = make_projectile("m70-half")
    O.bodies.append(body)
    other = grain((0, 0, 0), 0.002, fixed=True)
    gap = 0.0001
    other.state.pos = (body.shape.maxRadius + 0.002 + gap, 0, 0.01)
    engines(1e-9)
    O.engines[1].boundDispatcher.functors[0].aabbEnlargeFactor = 1.1
    O.engines[2].geomDispatcher.functors[2].interactionDetectionFactor = 1.1
    O.engines[2].lawDispatcher.functors[0].neverErase = True
    run(1)
    (contact,) = real_contacts(body)
    assert contact.geom.penetrationDepth == pytest.approx(-gap, rel=1e-9)
    assert isinstance(contact.geom, wrapper.ScGeom)
