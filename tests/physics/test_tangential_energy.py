# SPDX-License-Identifier: GPL-2.0-or-later
"""A contact taken round a closed path gives back no more work than was put in.

Mindlin's tangential stiffness k grows with the normal force. A spring that keeps its force while k
falls (stock YADE, the report's Eq 4), sheared by s at k1 and back at k2 < k1, gives (k1 - k2) s^2/2
(Elata & Berryman 1996); one that keeps its displacement while k grows (the secant spring of Chung &
Ooi's codes) gives the same when loaded under shear. The default spring does neither: it loses that
energy instead.
"""
from __future__ import annotations

import math
from collections.abc import Sequence

import contact_scenes as cs
import numpy as np
import pytest
from yade import O

SOLID = cs.Solid(1.0e9, 0.25, 2500)
RADIUS = 0.01
TIME_STEP = 1e-6
STEPS = 200  # for each leg of a path

Leg = tuple[float, float]  # displacement along x and along z [m]

LIGHT, HEAVY = 1e-5, 4e-5  # overlaps [m]
SHEAR = 1e-6  # tangential displacement [m]; with friction 10 nothing slides


def stiffness(overlap: float) -> float:
    """Mindlin's tangential stiffness 8 G* sqrt(R overlap) [N/m] against a rigid plane."""
    return 8 / SOLID.shear_compliance * math.sqrt(RADIUS * overlap)


def shear_work(law, paths: Sequence[Sequence[Leg]], friction: float) -> np.ndarray:
    """Work [J] of the tangential force on spheres led along these paths over a rigid plane, one for
    each path.

    Each sphere starts in touch with the plane, does not turn, and takes STEPS steps for a leg. The
    work of a step is the mean of the forces before and after times the displacement, exact for a
    linear spring.
    """
    O.reset()
    angle = math.atan(friction)
    O.materials.append(
        [
            SOLID.rigid_material(frictionAngle=angle, label="plane"),
            SOLID.material(frictionAngle=angle, label="sphere"),
        ]
    )
    cs.add_plane("plane")
    ids = [
        cs.add_sphere((0, 4 * RADIUS * i, RADIUS), RADIUS, "sphere", fixed=True)
        for i in range(len(paths))
    ]
    legs = len(paths[0])
    work = np.zeros(len(paths))
    force = np.zeros(len(paths))
    displacement = np.zeros(len(paths))

    def record() -> None:
        nonlocal force
        before, force = force, np.array([cs.force_on(i)[0] for i in ids])
        work[:] += 0.5 * (before + force) * displacement
        leg, step = divmod(O.iter, STEPS)
        if step == 0 and leg < legs:
            for path, i in zip(paths, ids):
                dx, dz = path[leg]
                O.bodies[i].state.vel = (dx / STEPS / TIME_STEP, 0, dz / STEPS / TIME_STEP)
            displacement[:] = [path[leg][0] / STEPS for path in paths]

    cs.set_engines(law, record)
    O.dt = TIME_STEP
    O.run(legs * STEPS + 1, True)
    return work


SHEAR_BACK_AT_LESS_LOAD = [(0, -HEAVY), (SHEAR, 0), (0, HEAVY - LIGHT), (-SHEAR, 0), (0, LIGHT)]
SHEAR_BACK_AT_MORE_LOAD = [(0, -LIGHT), (SHEAR, 0), (0, LIGHT - HEAVY), (-SHEAR, 0), (0, HEAVY)]
DIFFERENCE = 0.5 * (stiffness(HEAVY) - stiffness(LIGHT)) * SHEAR**2


def secant_law():
    return cs.grain_law(tangentialLaw="secant")


def report_law():
    return cs.grain_law(tangentialLaw="report")


REPORT_STIFFNESS = 2 ** (-1 / 3)  # Eq 5 over Mindlin's stiffness at the same normal force


@pytest.mark.parametrize(
    "law, path, gain",
    [
        pytest.param(cs.stock_law, SHEAR_BACK_AT_LESS_LOAD, 1, id="stock, less load: makes it"),
        pytest.param(cs.grain_law, SHEAR_BACK_AT_LESS_LOAD, -1, id="ours, less load: loses it"),
        pytest.param(cs.stock_law, SHEAR_BACK_AT_MORE_LOAD, -1, id="stock, more load: loses it"),
        pytest.param(cs.grain_law, SHEAR_BACK_AT_MORE_LOAD, -1, id="ours, more load: loses it"),
        pytest.param(secant_law, SHEAR_BACK_AT_MORE_LOAD, 1, id="secant, more load: makes it"),
        pytest.param(secant_law, SHEAR_BACK_AT_LESS_LOAD, -1, id="secant, less load: loses it"),
        pytest.param(
            report_law, SHEAR_BACK_AT_LESS_LOAD, REPORT_STIFFNESS, id="Eq 4, less load: makes it"
        ),
    ],
)
def test_changing_the_load_under_shear_moves_half_the_stiffness_change_times_the_square(
    law, path, gain
):
    (work,) = shear_work(law(), [path], friction=10.0)
    assert work == pytest.approx(gain * DIFFERENCE, rel=1e-5)  # the plane is rigid to 1e-6


def random_closed_paths(count: int, legs: int, seed: int) -> list[list[Leg]]:
    """Paths that press, shear and release at random and end where they began, out of contact."""
    random = np.random.default_rng(seed)
    paths = []
    for _ in range(count):
        x = np.concatenate([[0], random.uniform(-3 * SHEAR, 3 * SHEAR, legs - 1), [0]])
        z = -np.concatenate([[0], random.uniform(0.1 * LIGHT, HEAVY, legs - 1), [0]])
        paths.append(list(zip(np.diff(x), np.diff(z))))
    return paths


@pytest.mark.parametrize("tangential_law", ["incremental", "mindlin-deresiewicz"])
@pytest.mark.parametrize("friction", [0.02, 0.1, 10.0], ids=["slides", "slides at times", "sticks"])
def test_no_closed_path_gives_work(friction, tangential_law):
    paths = random_closed_paths(count=24, legs=8, seed=1)
    work = shear_work(cs.grain_law(tangentialLaw=tangential_law), paths, friction)
    scale = 0.5 * stiffness(HEAVY) * SHEAR**2
    # A leg that presses and shears at once is cut into 200 steps; each books its spring to second
    # order.
    assert np.all(work < 1e-4 * scale)


def test_stock_law_gives_work_on_some_closed_paths():
    """The control: the same paths show the defect where it exists."""
    paths = random_closed_paths(count=24, legs=8, seed=1)
    work = shear_work(cs.stock_law(), paths, friction=10.0)
    assert np.max(work) > 0.1 * 0.5 * stiffness(HEAVY) * SHEAR**2


def energy_after_impact(law, degrees: Sequence[float], friction: float) -> np.ndarray:
    """Kinetic energy after over before an undamped impact on a rigid plane, for each angle."""
    O.reset()
    angle = math.atan(friction)
    O.materials.append(
        [
            SOLID.rigid_material(frictionAngle=angle, label="plane"),
            SOLID.material(frictionAngle=angle, label="sphere"),
        ]
    )
    cs.add_plane("plane")
    speed = 1.0
    ids = []
    for i, a in enumerate(np.radians(degrees)):
        velocity = (speed * math.sin(a), 0, -speed * math.cos(a))
        position = (0, 4 * RADIUS * i, RADIUS)
        ids.append(cs.add_sphere(position, RADIUS, "sphere", velocity))
    cs.set_engines(law)
    grazing = speed * math.cos(math.radians(max(degrees)))
    steepest = speed * math.cos(math.radians(min(degrees)))
    O.dt = cs.HertzImpact.on_rigid_plane(SOLID, RADIUS, steepest).duration / 500
    cs.run_for(1.2 * cs.HertzImpact.on_rigid_plane(SOLID, RADIUS, grazing).duration)
    assert O.interactions.countReal() == 0
    states = [O.bodies[i].state for i in ids]
    spin_energy = 0.4 * RADIUS**2
    return np.array(
        [(s.vel.squaredNorm() + spin_energy * s.angVel.squaredNorm()) / speed**2 for s in states]
    )


@pytest.mark.parametrize("tangential_law", ["incremental", "mindlin-deresiewicz"])
@pytest.mark.parametrize("friction", [0.05, 0.3, 1.0, 3.0])
def test_oblique_and_grazing_impact_gain_no_energy(friction, tangential_law):
    degrees = (2, 5, 10, 20, 30, 40, 50, 60, 70, 80, 85, 88)
    # 500 steps a collision: leapfrog errs by less than 1e-6.
    law = cs.grain_law(tangentialLaw=tangential_law)
    assert np.all(energy_after_impact(law, degrees, friction) < 1 + 1e-6)
