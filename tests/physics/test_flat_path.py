# SPDX-License-Identifier: GPL-2.0-or-later
"""The flat path gives what the general path gives.

Both call the same kernels on the same numbers; geometry and kinematics are computed in another order of operations,
so that one step differs by rounding. Contacts amplify a difference with every impact: over 300 steps (3 ms, some ten
impacts a grain) rounding of 1e-16 stays below 1e-9.
"""
from __future__ import annotations

import math

import flat_scenes as scenes
import numpy as np
import pytest
import yade.wrapper as w
from flat_scenes import (
    LAWS,
    MANY_STEPS,
    ONE_STEP,
    add_clump,
    assert_equal,
    build,
    engines,
    on_both_paths,
    one_step_on_both_paths,
    pack,
    sand,
)
from grainfall.projectiles import projectile
from yade import O, utils

CURVES = {
    "constant": lambda: 0.5,
    "power law": w.PowerLawFriction,
    "exponential": w.ExponentialFriction,
    "asperity": w.AsperityFriction,
    "table": lambda: w.TableFriction(loads=[0.001, 1.0], moistures=[0.0], mu=[0.8, 0.2]),
}


@pytest.mark.parametrize("tangential", LAWS)
def test_one_step_of_every_tangential_law_is_the_general_path_s_to_1e_12(tangential):
    """Both start from the same moving pack, made by 300 steps of the general path and loaded from a file."""
    law = {"tangentialLaw": tangential}
    O.reset()
    build(False, law)
    O.run(300, True)
    assert_equal(one_step_on_both_paths(lambda flat: engines(flat, law=law)), ONE_STEP)


@pytest.mark.parametrize("tangential", LAWS)
@pytest.mark.parametrize("normal", ("hertz", "report"))
def test_every_law_runs_alike_on_both_paths(normal, tangential):
    law = {"normalLaw": normal, "tangentialLaw": tangential}
    assert_equal(on_both_paths(lambda flat: build(flat, law), 300), MANY_STEPS)


@pytest.mark.parametrize("curve", CURVES)
def test_every_friction_curve_runs_alike_on_both_paths(curve):
    results = on_both_paths(lambda flat: build(flat, friction=CURVES[curve]()), 300)
    assert_equal(results, MANY_STEPS)


@pytest.mark.parametrize("model", ("willett", "willett-closed"))
@pytest.mark.parametrize("viscosity", (0.0, 1e-3))
def test_moist_packs_run_alike_on_both_paths(model, viscosity):
    """Bridges that hold grains together over a gap, rupture and form are among them."""
    wet = {"gravimetricMoisture": 0.01, "bridgeModel": model, "liquidViscosity": viscosity}
    results = on_both_paths(lambda flat: build(flat, **wet), 300)
    assert_equal(results, MANY_STEPS)
    assert np.any(results[0]["overlap"] < 0)


@pytest.mark.parametrize("restitution", (1.0, 0.3))
def test_dashpots_run_alike_on_both_paths(restitution):
    assert_equal(on_both_paths(lambda flat: build(flat, restitution=restitution), 300), MANY_STEPS)


def test_numerical_damping_and_blocked_motion_run_alike_on_both_paths():
    def build_damped(flat: bool) -> None:
        pack(sand())
        O.bodies[5].state.blockedDOFs = "xyZ"
        O.bodies[6].state.blockedDOFs = "xyzXYZ"
        O.bodies[6].state.vel = (0, 0, 0.1)
        O.bodies[7].state.isDamped = False
        engines(flat, damping=0.3)

    assert_equal(on_both_paths(build_damped, 300), MANY_STEPS)


def test_walls_whose_radius_is_the_sphere_s_act_alike_on_both_paths():
    """YADE's default for walls; all other tests have walls of a very large radius (hertzian=True)."""

    def build_plain(flat: bool) -> None:
        pack(sand())
        engines(flat, hertzian=False)

    assert_equal(on_both_paths(build_plain, 300), MANY_STEPS)


def test_a_moving_wall_and_permanent_forces_act_alike_on_both_paths():
    def build_pushed(flat: bool) -> None:
        pack(sand())
        O.bodies[-1].state.vel = (0, 0, 0.2)
        engines(flat)
        for grain in range(10):
            O.forces.setPermF(grain, (0.01, 0, -0.02))

    assert_equal(on_both_paths(build_pushed, 300), MANY_STEPS)


def test_a_projectile_meets_the_grains_alike_on_both_paths():
    """Its pairs run through their own functors in the same step, its motion is that of an aspherical body."""

    def build_drop(flat: bool) -> None:
        pack(sand())
        scenes.drop_projectile(projectile("m70-half"), sand(label="steel", young=1e9))
        scenes.projectile_engines(flat)

    flat, general = on_both_paths(build_drop, 300)
    assert_equal((flat, general), MANY_STEPS)
    assert np.abs(general["force"][-1]).max() > 0


@pytest.mark.parametrize("exact", [True, False])
def test_clumps_move_and_are_hit_alike_on_both_paths(exact):
    """Clumps among the grains and on each other: members push, the clump tumbles by its own moments of inertia."""

    def build_clumps(flat: bool) -> None:
        pack(sand())
        for i in range(6):
            place = (
                0.0078 * (i % 2) + 0.01,
                0.0115 * (i // 2 % 2) + 0.01,
                0.0375 + 0.008 * (i // 4),
            )
            add_clump(place)
        engines(flat, more=[scenes.ledger()])
        O.engines[3].exactAsphericalRot = exact
        for body in O.bodies:
            if body.isClump:
                body.state.vel = (0, 0, -1 - 20 * (body.state.pos[2] - 0.039))

    met = set()  # members of clumps in a contact
    for steps in (65, 75, 130, 300):
        flat, general = on_both_paths(build_clumps, steps)
        assert_equal((flat, general), MANY_STEPS)
        members = [b.id for b in O.bodies if b.isClumpMember]
        met |= set(np.isin(general["ids"], members).sum(axis=1).tolist())
    assert met == {0, 1, 2}


def test_one_step_of_a_clump_is_the_general_path_s_to_1e_12():
    """From the same moving scene, the clump on the grains."""
    O.reset()
    pack(sand())
    clump = add_clump((0.01, 0.01, 0.0388))
    O.bodies[clump].state.vel = (0.1, 0, -1)
    engines(False)
    O.run(45, True)
    results = one_step_on_both_paths(engines)
    assert np.abs(results[0]["force"][clump]).max() > 0
    assert_equal(results, ONE_STEP)


def test_a_giant_sphere_among_small_ones_finds_all_its_neighbours():
    def build_giant(flat: bool) -> None:
        pack(sand(), count=5)
        giant = utils.sphere((0.02, 0.02, 0.075), 5 * scenes.RADIUS, material=O.materials[0])
        giant.state.vel = (0, 0, -2)
        O.bodies.append(giant)
        engines(flat)

    assert_equal(on_both_paths(build_giant, 300), MANY_STEPS)


def test_the_books_of_a_moist_pack_are_the_same_on_both_paths():
    """Every entry of O.energy, kinetic energy and gravity included, and the residual of the ledger."""
    books = []
    for flat in (True, False):
        O.reset()
        pack(sand(gravimetricMoisture=0.01))
        engines(flat, more=[scenes.ledger()])
        O.run(520, True)
        residual = w.Omega().engines[-1].residual
        books.append({**dict(O.energy.items()), "residual now": residual})
    scale = max(abs(value) for value in books[1].values())
    assert set(books[0]) == set(books[1])
    for name, value in books[1].items():
        assert books[0][name] == pytest.approx(value, abs=1e-9 * scale), name


def test_a_contact_that_cannot_be_made_ends_the_run_with_one_sentence():
    O.reset()
    build(True)
    O.engines[2].physDispatcher.functors = [w.Ip2_FrictMat_FrictMat_MindlinPhys()]
    with pytest.raises(RuntimeError, match="does not make GrainPhys"):
        O.step()


def test_what_cannot_run_flat_runs_on_the_general_path_and_says_why():
    def many_clumps() -> None:
        build(True)
        for i in range(260):
            add_clump((0.1 + 0.02 * i, 0, 0))

    def stock_integrator() -> None:
        build(True)
        O.engines = [*O.engines[:3], w.NewtonIntegrator(gravity=(0, 0, -9.81))]

    def periodic() -> None:
        build(True)
        O.bodies.clear()
        O.bodies.append(utils.sphere((0.01, 0.01, 0.01), 0.004, material=O.materials[0]))
        O.periodic = True

    for scene, reason in (
        (many_clumps, "520 bodies are members of clumps"),
        (stock_integrator, "GrainIntegrator"),
        (periodic, "periodic"),
    ):
        O.reset()
        scene()
        O.run(10, True)
        path = O.engines[2].path
        assert path.startswith("general: ") and reason in path
    O.reset()


def test_far_flung_grains_do_not_hide_neighbours():
    """Two grains meet 10 km away from the pack, beyond the cells that cover it."""
    O.reset()
    build(True)
    far = [utils.sphere((1e4 + x, 0, 0), 0.005, material=O.materials[0]) for x in (0.0, 0.0102)]
    far[0].state.vel = (1, 0, 0)
    O.bodies.append(far)
    O.run(40, True)
    assert O.interactions.has(len(O.bodies) - 2, len(O.bodies) - 1)
    assert math.isfinite(O.bodies[-1].state.vel[0]) and O.bodies[-1].state.vel[0] > 0
