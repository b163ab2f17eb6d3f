# SPDX-License-Identifier: GPL-2.0-or-later
"""Boxes and projectiles on the flat path: their contacts with grains lie in the arrays, their motion is YADE's.

Tolerances as in test_flat_path: a step differs by rounding, which contacts amplify with every impact.
"""
from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import flat_scenes as scenes
import numpy as np
import pytest
import yade.wrapper as w
from flat_scenes import (
    LAWS,
    MANY_STEPS,
    ONE_STEP,
    RADIUS,
    box_engines,
    on_both_paths,
    one_step_on_both_paths,
    pack,
    sand,
)
from grainfall.projectiles import projectile
from yade import O, Quaternion, Vector3, utils


def assert_equal(results: tuple[dict[str, Any], dict[str, Any]], tolerance: float) -> None:
    """As for other scenes; some of these have few contacts."""
    scenes.assert_equal(results, tolerance, contacts=10)


def contacts_of(body: int, results: tuple[dict[str, Any], dict[str, Any]]) -> int:
    """Contacts of a body; a test that means to look at them must have some."""
    return int((results[1]["ids"] == body).any(axis=1).sum())


def all_are_flat() -> bool:
    """No pair went through its own functors."""
    return bool(w.Omega().engines[2].statistics()["general"] == 0)


def add_box(
    centre: tuple[float, float, float],
    half_edges: tuple[float, float, float],
    axis: tuple[float, float, float] = (0, 0, 1),
    angle: float = 0,
    fixed: bool = True,
) -> Any:
    """A box among the grains, turned by `angle` about `axis`."""
    turn = Quaternion(Vector3(axis).normalized(), angle)
    box = utils.box(
        centre, half_edges, orientation=turn, fixed=fixed, material=O.materials[0], wire=False
    )
    O.bodies.append(box)
    return box


@pytest.mark.parametrize("tangential", LAWS)
def test_one_step_on_boxes_is_the_general_path_s_to_1e_12(tangential):
    """Both start from the same moving pack in a box of boxes, made by 300 steps of the general path."""
    law = {"tangentialLaw": tangential}
    O.reset()
    pack(sand(), boxes=True)
    box_engines(False, law=law)
    O.run(300, True)
    results = one_step_on_both_paths(lambda flat: box_engines(flat, law=law))
    O.loadTmp("start")
    box_engines(True, law=law)
    O.run(1, True)
    assert all_are_flat()
    assert sum(contacts_of(4**3 + i, results) for i in range(5)) > 3
    assert_equal(results, ONE_STEP)


@pytest.mark.parametrize("tangential", LAWS)
def test_a_pack_in_boxes_falls_together_alike_on_both_paths(tangential):
    def build(flat: bool) -> None:
        pack(sand(), boxes=True)
        box_engines(flat, law={"tangentialLaw": tangential})

    assert_equal(on_both_paths(build, 300), MANY_STEPS)


def test_grains_meet_edges_and_corners_of_a_turned_box_alike_on_both_paths():
    """Seen from the box, the normals have one part, two, three."""

    def build(flat: bool) -> None:
        pack(sand())
        half, radius = np.array([0.008, 0.007, 0.006]), 0.004
        box = add_box((0.08, 0.015, 0.02), tuple(half), (1, 2, 3), 0.9)
        for parts in ((0, 0, 1), (1, -1, 0), (1, 1, -1)):
            out = np.array(parts)
            place = half * out + 0.99 * radius * out / np.linalg.norm(out) + 0.1 * half * (out == 0)
            centre = box.state.pos + box.state.ori * Vector3(place)
            O.bodies.append(utils.sphere(centre, radius, material=O.materials[0]))
        box_engines(flat)

    for steps in (1, 10, 300):
        results = on_both_paths(build, steps)
        assert_equal(results, MANY_STEPS if steps > 1 else ONE_STEP)
        if steps == 1:
            touched = (results[0]["ids"] == 4**3 + 5).any(axis=1)
            back = O.bodies[4**3 + 5].state.ori.conjugate()
            normals = [back * Vector3(normal) for normal in results[0]["normal"][touched]]
            assert [sum(abs(part) > 1e-9 for part in n) for n in normals] == [1, 2, 3]


def test_a_box_that_slides_and_turns_drags_its_grains_alike_on_both_paths():
    """The shear is that of the box's material at the contact points, far from its centre and across the normal."""

    def build(flat: bool) -> None:
        pack(sand())
        box = add_box((0.02, 0.01, -0.008), (0.05, 0.04, 0.004), (1, 0, 0), 0.02)
        box.state.vel = (0.3, 0.1, 0.2)
        box.state.angVel = (1, 2, 20)
        box_engines(flat)

    met = 0
    for steps in (3, 10, 20, 300):
        results = on_both_paths(build, steps)
        assert_equal(results, MANY_STEPS)
        met += contacts_of(len(O.bodies) - 1, results)
    assert met > 5


def test_grains_whose_centres_are_within_a_box_are_pushed_out_alike_on_both_paths():
    """Half sunk into the floor at the start: YADE then takes the nearest face, and the shear of spheres."""

    def build(flat: bool) -> None:
        pack(sand(young=1e6))
        add_box((0.01, 0.01, -0.0035), (0.03, 0.03, 0.0042))
        box_engines(flat)

    within = on_both_paths(build, 1)
    assert within[1]["overlap"].max() > RADIUS
    assert_equal(within, ONE_STEP)
    assert_equal(on_both_paths(build, 100), MANY_STEPS)


def test_a_free_box_falls_on_the_pack_alike_on_both_paths():
    """Its motion is that of an aspherical body, its contacts lie in the arrays."""

    def build(flat: bool) -> None:
        pack(sand())
        box = add_box((0.015, 0.016, 0.042), (0.008, 0.006, 0.004), (1, 1, 0), 0.4, fixed=False)
        mass = 2500 * 8 * 0.008 * 0.006 * 0.004
        box.state.mass = mass
        edges = np.array([0.016, 0.012, 0.008])
        box.state.inertia = tuple(mass / 12 * ((edges**2).sum() - edges**2))
        box.aspherical = True
        box.state.vel = (0, 0, -2)
        box_engines(flat)

    for steps in (60, 80, 300):
        assert_equal(on_both_paths(build, steps), MANY_STEPS)
    moved = O.bodies[-1].state
    assert abs(moved.vel[2] + 2 + scenes.GRAVITY * O.time) > 0.1 and moved.angVel.norm() > 1


def test_moist_grains_hang_on_boxes_alike_on_both_paths():
    """Bridges with a film, of which some hold over a gap."""

    def build(flat: bool) -> None:
        pack(sand(gravimetricMoisture=0.01, liquidViscosity=1e-3), boxes=True)
        O.bodies[4**3].state.angVel = (0, 3, 5)
        box_engines(flat)

    results = on_both_paths(build, 300)
    of_boxes = (results[1]["ids"] >= 4**3).any(axis=1)
    assert (results[1]["overlap"][of_boxes] < 0).any()
    assert_equal(results, MANY_STEPS)


@pytest.mark.parametrize("moisture", (0.0, 0.01))
def test_the_books_of_a_pack_in_boxes_are_the_same_on_both_paths(moisture):
    books = []
    for flat in (True, False):
        O.reset()
        pack(sand(gravimetricMoisture=moisture, liquidViscosity=1e-3), boxes=True)
        O.bodies[4**3].state.angVel = (0, 3, 5)
        box_engines(flat, more=[scenes.ledger()])
        O.run(520, True)
        books.append({**dict(O.energy.items()), "residual": w.Omega().engines[-1].residual})
    scale = max(abs(value) for value in books[1].values())
    assert set(books[0]) == set(books[1])
    for name, value in books[1].items():
        assert books[0][name] == pytest.approx(value, abs=1e-9 * scale), name


def test_a_bar_that_sweeps_around_meets_grains_far_from_where_it_lay():
    """It turns by half a turn about its middle at rest; its bound says nothing of the grains in its way."""

    def build(flat: bool) -> None:
        pack(sand())
        box = add_box((0.015, 0.015, 0.036), (0.03, 0.001, 0.001), (0, 0, 1), 1.5)
        box.state.angVel = (0, 0, 1000)
        for i in range(12):
            angle = math.pi * (i + 0.5) / 12 + 1.5
            place = (0.015 + 0.025 * math.cos(angle), 0.015 + 0.025 * math.sin(angle), 0.06)
            O.bodies.append(utils.sphere(place, 0.002, material=O.materials[0]))
        box.state.pos = (0.015, 0.015, 0.06)
        box_engines(flat)

    results = on_both_paths(build, 314)
    assert_equal(results, MANY_STEPS)
    swept = np.linalg.norm(results[0]["velocity"][-12:], axis=1)
    assert (swept > 1).all()


def test_a_giant_sphere_finds_the_box_that_it_falls_on():
    """Its centre is many cells away from where it touches."""

    def build(flat: bool) -> None:
        pack(sand(), count=5)
        add_box((0.16, 0.02, 0.0), (0.002, 0.02, 0.02))
        giant = utils.sphere((0.2, 0.02, 0.034), 0.05, material=O.materials[0])
        giant.state.vel = (-1, 0, 0)
        O.bodies.append(giant)
        box_engines(flat)

    results = on_both_paths(build, 300)
    assert [5**3 + 5, 5**3 + 6] in results[1]["ids"].tolist()
    assert_equal(results, MANY_STEPS)


def test_boxes_with_a_geometry_of_their_own_keep_it():
    """Contacts that begin at a distance are not the arrays'; the functor makes them, in the same step."""

    def build(flat: bool) -> None:
        pack(sand(), boxes=True)
        box_engines(flat)
        O.engines[2].geomDispatcher.functors[2].interactionDetectionFactor = 1.001

    assert_equal(on_both_paths(build, 300), MANY_STEPS)
    O.reset()
    build(True)
    O.run(1, True)
    assert not all_are_flat() and O.engines[2].path == "flat"


@pytest.mark.parametrize("moisture", (0.0, 0.01))
def test_a_projectile_feels_the_same_load_in_every_step_on_both_paths(moisture):
    """Zone by zone, as ProjectileLoad sums it while nobody else looks; and its pairs lie in the arrays."""
    loads = []
    for flat in (True, False):
        O.reset()
        pack(sand(gravimetricMoisture=moisture, liquidViscosity=1e-3))
        shell = scenes.drop_projectile(
            projectile("m70-half"), sand(label="steel", young=1e9, liquidViscosity=1e-3)
        )
        O.bodies[shell].state.angVel = (3, 0, 100)
        scenes.projectile_engines(flat, [w.ProjectileLoad(body=shell, label="load")])
        O.run(300, True)
        if flat:
            assert O.engines[2].statistics()["publications"] < 5
            assert all_are_flat()
        load = O.engines[-1]
        zones = ("nose", "shaft", "base")
        loads.append(
            [list(getattr(load, zone + what)) for zone in zones for what in ("Impulse", "Force")]
            + [[getattr(load, zone + "Contacts")] * 3 for zone in zones]
        )
    flat_load, general = np.array(loads[0]), np.array(loads[1])
    assert np.abs(general[0]).max() > 0
    assert np.abs(flat_load - general).max() <= MANY_STEPS * np.abs(general).max()


def test_one_step_of_a_projectile_is_the_general_path_s_to_1e_12():
    O.reset()
    pack(sand())
    shell = scenes.drop_projectile(projectile("m70-half"), sand(label="steel", young=1e9))
    O.bodies[shell].state.angVel = (3, 0, 100)
    scenes.projectile_engines(False)
    O.run(300, True)
    results = one_step_on_both_paths(scenes.projectile_engines)
    assert contacts_of(shell, results) > 0
    assert_equal(results, ONE_STEP)


def test_a_projectile_that_spins_about_its_axis_calls_for_no_more_searches():
    """Its surface stays where it is, however fast it spins."""
    searches = []
    for spin in (0.0, 5000.0):
        O.reset()
        pack(sand(friction=0))
        shell = scenes.drop_projectile(projectile("m70-half"), sand(label="steel", friction=0))
        O.bodies[shell].state.angVel = (0, 0, spin)
        scenes.projectile_engines(True)
        O.run(300, True)
        searches.append(O.engines[2].statistics()["searches"])
    assert searches[1] <= searches[0] + 2


def test_boxes_and_a_projectile_saved_half_way_go_on_to_the_last_bit(tmp_path: Path):
    file = str(tmp_path / "obstacles.yade.gz")
    O.reset()
    pack(sand(gravimetricMoisture=0.01))
    box = add_box((0.02, 0.01, -0.008), (0.05, 0.04, 0.004), (1, 0, 0), 0.02)
    box.state.vel = (0.3, 0.1, 0.2)
    box.state.angVel = (1, 2, 20)
    scenes.drop_projectile(projectile("m70-half"), sand(label="steel", young=1e9))
    geometries = [w.Ig2_Box_Sphere_ScGeom(), w.Ig2_SolidOfRevolution_Sphere_ScGeom()]
    bounds = [w.Bo1_Box_Aabb(), w.Bo1_SolidOfRevolution_Aabb()]
    scenes.engines(True, geometries, bounds)
    scenes.assert_saving_changes_no_bit(file)


def test_a_wall_that_the_collider_leaves_out_is_left_out_on_both_paths():
    """A body without bound (bounded = False) touches nothing."""

    def build(flat: bool) -> None:
        pack(sand())
        ghost = utils.wall(0.01, axis=0, material=O.materials[0])
        O.bodies.append(ghost)
        ghost.bounded = False
        box_engines(flat)

    assert_equal(on_both_paths(build, 300), MANY_STEPS)


def test_a_wall_that_slides_in_its_own_plane_calls_for_no_more_searches():
    """It stays where it is for the grains, however far it goes."""
    searches = []
    for speed in (0.0, 100.0):
        O.reset()
        pack(sand(friction=0))
        O.bodies[-1].state.vel = (speed, 0, 0)
        scenes.engines(True)
        O.run(300, True)
        searches.append(O.engines[2].statistics()["searches"])
    assert searches[0] == searches[1]
