# SPDX-License-Identifier: GPL-2.0-or-later
"""Projectiles on floors, across periodic boundaries, and in the eyes of the collider."""

from __future__ import annotations

import numpy as np
import pytest
from projectile_scene import YOUNG, engines, grain, material, real_contacts, run, vector
from yade import O, Quaternion, Vector3, wrapper
from yade.utils import box as yade_box
from yade.utils import wall as yade_wall

from grainfall.projectiles import flat_cylinder, make_projectile, ogive


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
    # The centroid is held, so the collider sees no motion; no grain is in the first bounding box.
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
