# SPDX-License-Identifier: GPL-2.0-or-later
"""tangentialLaw='mindlin-deresiewicz': a contact that slips from its rim inwards.

Oblique impact against Maw, Barber & Fawcett (1976) and Kharaz, Gorham & Salman (2001); cycles of
shear against Mindlin & Deresiewicz (1953) as in Johnson (1985), chapter 7.
"""
from __future__ import annotations

import math
from collections.abc import Sequence

import contact_scenes as cs
import maw_barber_fawcett_impact as maw
import numpy as np
import pytest
import test_chung_ooi_4_oblique_impact as chung_ooi_4
import test_objectivity as objectivity
from yade import O

PARTIAL_SLIP = "mindlin-deresiewicz"
SOLID = cs.Solid(7.0e10, 0.2, 2650)
RADIUS = 0.00036  # m, a grain of quartz sand
OVERLAP = 1e-7  # m
FRICTION = 0.3

NORMAL_FORCE = 4 / 3 * SOLID.plane_modulus * math.sqrt(RADIUS) * OVERLAP**1.5
LIMIT = FRICTION * NORMAL_FORCE
STIFFNESS = 8 / SOLID.shear_compliance * math.sqrt(RADIUS * OVERLAP)  # 8 G* a


def test_reference_slides_throughout_where_momentum_says_so():
    incidence = np.array([4 * maw.CHI, 6.0, 10.0])
    assert maw.reference_rebound(incidence) == pytest.approx(incidence - 4 * maw.CHI, abs=1e-5)


def test_oblique_impact_rebounds_as_maw_barber_and_fawcett_found():
    incidence = np.array([0.05, 0.2, 0.5, 0.8, 1, 1.2, 1.5, 2, 2.5, 3, 3.5, 4, 4.5, 4.75, 5, 6])
    expected = maw.reference_rebound(incidence)
    error = np.abs(maw.rebound(incidence, PARTIAL_SLIP) - expected)
    without = np.abs(maw.rebound(incidence, "incremental") - expected)
    # Of a range of 1.7. What is left in gross sliding, 5e-4, is the arm shortened by the overlap.
    assert np.max(error) < 2e-3
    # A spring that sticks as a whole errs by a quarter of the range.
    assert np.max(without) > 0.4


def test_oblique_impact_rebounds_as_kharaz_gorham_and_salman_measured():
    """5 mm aluminium oxide on glass, 2 to 85 degrees, vt'/vt; restitution and friction measured."""
    degrees, measured = cs.read_csv("chung_ooi_2011/test4_tangential_restitution_experiment.csv").T
    solid = chung_ooi_4.SOLIDS["aluminium oxide"]

    def error(law: str) -> np.ndarray:
        return np.abs(chung_ooi_4.rebound(solid, degrees, law).tangential - measured)

    # The plot was read to about 0.01, and the glass is not rigid.
    assert np.max(error(PARTIAL_SLIP)) < 0.04
    assert np.max(error("incremental")) > 0.1


def led_sphere(**law) -> int:
    """Sphere held at OVERLAP in a rigid plane, in contact; returns its id."""
    O.materials.append(
        [
            SOLID.rigid_material(frictionAngle=math.atan(FRICTION), label="plane"),
            SOLID.material(frictionAngle=math.atan(FRICTION), label="sphere"),
        ]
    )
    cs.add_plane("plane")
    sphere = cs.add_sphere((0, 0, RADIUS - OVERLAP), RADIUS, "sphere", fixed=True)
    cs.set_engines(cs.grain_law(**law))
    O.dt = 1e-8
    O.run(1, True)
    return sphere


def shear(sphere: int, distance: float, steps: int, along: tuple[float, float] = (1, 0)) -> float:
    """Lead the sphere along the plane [m]; returns the force [N] on it along that direction."""
    speed = distance / steps / O.dt
    O.bodies[sphere].state.vel = (speed * along[0], speed * along[1], 0)
    O.run(steps, True)
    O.bodies[sphere].state.vel = (0, 0, 0)
    O.run(1, True)  # the law sees the last displacement
    return float(np.dot(cs.force_on(sphere)[:2], along))


def displacement_at(force: float) -> float:
    """Shear displacement [m] at a first loading to `force` [N] (Mindlin 1949)."""
    return 1.5 * LIMIT / STIFFNESS * (1 - (1 - force / LIMIT) ** (2 / 3))


def cycle_loss(share: float) -> float:
    """Energy [J] lost in a cycle between -share and share of the limit (Johnson 1985, ch. 7)."""
    rest = 1 - share
    factor = 1 - rest ** (5 / 3) - 5 * share / 6 * (1 + rest ** (2 / 3))
    return 0.9 * LIMIT**2 * 8 / STIFFNESS * factor


@pytest.mark.parametrize("share", [0.1, 0.2, 0.3, 0.5, 0.7, 0.9])
def test_cycle_of_shear_loses_what_mindlin_and_deresiewicz_give(share):
    O.trackEnergy = True
    sphere = led_sphere(tangentialLaw=PARTIAL_SLIP)
    amplitude = displacement_at(share * LIMIT)
    assert shear(sphere, amplitude, 200) == pytest.approx(-share * LIMIT, rel=1e-5)
    before = O.energy["grainFriction"]
    for distance in (-2 * amplitude, 2 * amplitude):
        shear(sphere, distance, 400)
    # 400 steps a leg; the plane is rigid to 1e-6, and YADE lengthens the shear by part of the overlap.
    assert O.energy["grainFriction"] - before == pytest.approx(cycle_loss(share), rel=1e-4)


def test_spring_that_sticks_as_a_whole_loses_nothing_in_such_a_cycle():
    """The control: why the default law has no damping at small strain."""
    O.trackEnergy = True
    sphere = led_sphere(tangentialLaw="incremental")
    amplitude = 0.3 * LIMIT / STIFFNESS
    for distance in (amplitude, -2 * amplitude, 2 * amplitude):
        shear(sphere, distance, 100)
    assert O.energy["grainFriction"] == pytest.approx(0, abs=1e-12 * LIMIT * amplitude)


def test_time_stepping_sees_mindlins_stiffness_of_a_contact_that_sticks():
    sphere = led_sphere(tangentialLaw=PARTIAL_SLIP)
    contact = O.interactions[0, sphere]
    shear(sphere, 0.5 * LIMIT / STIFFNESS, 10)
    # The plane is rigid to 1e-6.
    assert contact.phys.ks == pytest.approx(STIFFNESS, rel=1e-5)


def test_energy_in_the_springs_comes_back_but_for_what_slipped():
    O.trackEnergy = True
    sphere = led_sphere(tangentialLaw=PARTIAL_SLIP)
    amplitude = displacement_at(0.6 * LIMIT)
    shear(sphere, amplitude, 400)
    # First loading: work = integral of T over the displacement, from Mindlin's curve.
    force = np.linspace(0, 0.6 * LIMIT, 4001)
    work = np.trapz(force, 1.5 * LIMIT / STIFFNESS * (1 - (1 - force / LIMIT) ** (2 / 3)))
    law = next(e for e in O.engines if hasattr(e, "lawDispatcher")).lawDispatcher.functors[0]
    stored = law.elasticEnergy()["shear"]
    assert stored + O.energy["grainFriction"] == pytest.approx(work, rel=1e-4)
    assert 0 < O.energy["grainFriction"] < 0.2 * work


def test_force_is_carried_on_when_the_law_changes_under_load():
    sphere = led_sphere(tangentialLaw="incremental")
    law = next(e for e in O.engines if hasattr(e, "lawDispatcher")).lawDispatcher.functors[0]
    before = shear(sphere, 0.5 * LIMIT / STIFFNESS, 20)
    for name in (PARTIAL_SLIP, "incremental", PARTIAL_SLIP):
        law.tangentialLaw = name
        after = shear(sphere, 0, 1)
        assert after == pytest.approx(before, rel=1e-9)
        # Something else happens under the other law, which the slip history cannot know.
        before = shear(sphere, -0.1 * LIMIT / STIFFNESS, 20)
        assert abs(before) < abs(after)


def partly_slipped_pair() -> tuple[int, int]:
    """Two spheres sheared to and fro in two directions, at rest: their history has several pieces."""
    O.reset()
    O.materials.append(objectivity.SOLID.material(frictionAngle=math.atan(FRICTION)))
    lower = cs.add_sphere((0, 0, 0), objectivity.RADIUS, 0, fixed=True)
    height = 2 * objectivity.RADIUS - objectivity.OVERLAP
    upper = cs.add_sphere((0, 0, height), objectivity.RADIUS, 0, fixed=True)
    O.dt = 1e-6
    cs.set_engines(cs.grain_law(tangentialLaw=PARTIAL_SLIP))
    O.run(1, True)
    for leg in ((4e-6, 1e-6, 0), (-3e-6, 1e-6, 0), (1e-6, -1e-6, 0)):
        push(upper, leg)
    return lower, upper


FURTHER_LEGS = ((-2e-6, 0, 0), (1e-6, 2e-6, 0), (3e-6, -1e-6, 0))


def push(body: int, leg: Sequence[float]) -> None:
    """Lead a sphere by `leg`, three numbers [m], in 50 steps."""
    O.bodies[body].state.vel = tuple(x / 50 / O.dt for x in leg)
    O.run(50, True)
    O.bodies[body].state.vel = (0, 0, 0)
    O.run(1, True)


@pytest.mark.parametrize("direction", ["along x", "oblique"])
def test_slip_history_turns_with_its_contact(direction):
    lower, upper = partly_slipped_pair()
    expected = []
    for leg in FURTHER_LEGS:
        push(upper, leg)
        expected.append(np.array(O.interactions[lower, upper].phys.shearForce))

    lower, upper = partly_slipped_pair()
    assert len(O.interactions[lower, upper].phys.partialSlip.pieces) > 2 * 7
    branch = np.array(O.bodies[upper].state.pos) - np.array(O.bodies[lower].state.pos)
    branch /= np.linalg.norm(branch)
    axis = (1, 0, 0) if direction == "along x" else (1, 1, 0)
    axis = np.array(axis) - np.dot(axis, branch) * branch  # square to the pair
    axis /= np.linalg.norm(axis)
    objectivity.turn(lower, upper, axis, 2 * math.pi, tangentialLaw=PARTIAL_SLIP)
    for i in (lower, upper):
        O.bodies[i].state.vel = O.bodies[i].state.angVel = (0, 0, 0)
    cs.set_engines(cs.grain_law(tangentialLaw=PARTIAL_SLIP))
    # The last step of the lead moves the pair once more, beyond the full turn.
    beyond = 2 * math.pi / objectivity.STEPS

    def turned(vector: Sequence[float]) -> np.ndarray:
        along = np.dot(axis, vector) * axis
        across = np.cross(axis, vector)
        return along + math.cos(beyond) * (vector - along) + math.sin(beyond) * across

    for leg, force in zip(FURTHER_LEGS, expected):
        push(upper, turned(leg))
        after = np.array(O.interactions[lower, upper].phys.shearForce)
        assert after == pytest.approx(turned(force), abs=1e-6 * np.linalg.norm(force))


@pytest.mark.parametrize("suffix", [".xml", ".yade.gz"])
def test_slip_history_saved_half_way_continues_to_the_last_bit(suffix, tmp_path):
    lower, upper = partly_slipped_pair()
    file = str(tmp_path / f"pair{suffix}")
    O.save(file)

    def go_on() -> list[tuple[float, ...]]:
        forces = []
        for leg in FURTHER_LEGS:
            push(upper, leg)
            forces.append(tuple(O.interactions[lower, upper].phys.shearForce))
        return forces

    pieces = list(O.interactions[lower, upper].phys.partialSlip.pieces)
    expected = go_on()
    O.reset()
    O.load(file)
    assert list(O.interactions[lower, upper].phys.partialSlip.pieces) == pieces
    assert go_on() == expected


def test_other_laws_keep_no_slip_history():
    sphere = led_sphere(tangentialLaw="incremental")
    shear(sphere, LIMIT / STIFFNESS, 10)
    assert O.interactions[0, sphere].phys.partialSlip is None
