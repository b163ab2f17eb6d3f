# SPDX-License-Identifier: GPL-2.0-or-later
"""The critical step that HertzTimeStepper finds is the true one: below it nothing grows, above it all does.

Preloaded grains are set to vibrate at 1e-7 m/s. At 0.9 of the critical step their energy stays what it was for
hundreds of steps; at 1.5 it grows a millionfold within a few tens. So the engine's number is neither unsafe
nor more than 1.5 times too careful.
"""
from __future__ import annotations

import contact_scenes as cs
import pytest
import time_step_scenes as ts
from yade import O

#: Kinetic energy may rise by what potential energy there was at the start, in all modes at once, and beat.
BOUNDED = 10
EXPLODES = 1e4


def vibrate(ids: list[int], safety: float, law: dict | None = None, **stepper) -> tuple[float, str]:
    """Growth of the energy within 300 steps, and what decided the first of them."""
    engine = ts.set_engines(law, **ts.exact(safety=safety, **stepper))
    ts.shake(ids)
    O.run(1, True)
    reason = engine.reason
    return ts.growth(ids, 300), reason


@pytest.mark.parametrize("law, motion", [("incremental", "rotation"), ("none", "translation")])
def test_grain_with_twelve_neighbours_is_stable_below_its_critical_step_and_not_above(law, motion):
    results = {}
    for safety in (0.9, 1.5):
        O.reset()
        ts.add_materials()
        centre = ts.add_cluster(overlap=0.1)
        results[safety], reason = vibrate([centre], safety, {"tangentialLaw": law})
        assert reason.startswith("contact of 0 and") and reason.endswith(motion)
    assert results[0.9] < BOUNDED
    assert results[1.5] > EXPLODES


def test_critical_step_of_that_grain_is_the_closed_form():
    # Twelve springs k_t at R - overlap/2 add up to 8 k_t r^2 about each axis against 2/5 m R^2.
    ts.add_materials()
    centre = ts.add_cluster(overlap=0.1)
    engine = ts.set_engines(**ts.exact())
    O.run(1, True)
    contact = next(i for i in O.interactions if i.isReal)
    lever = 0.95 * ts.RADIUS
    frequency = (8 * contact.phys.ks * lever**2 / O.bodies[centre].state.inertia[0]) ** 0.5
    assert engine.criticalStep == pytest.approx(2 / frequency, rel=1e-9)
    assert O.dt == pytest.approx(0.1 * engine.criticalStep, rel=1e-12)


def test_block_of_grains_is_stable_below_the_critical_step_and_not_above():
    results = {}
    for safety in (0.9, 1.5):
        O.reset()
        ts.add_materials()
        free = ts.add_block(overlap=0.1, cells=2)
        results[safety], reason = vibrate(free, safety)
        assert reason.startswith("contact of")
    assert results[0.9] < BOUNDED
    assert results[1.5] > EXPLODES


def test_eq_7_and_8_as_printed_blow_up_that_block():
    """Twelve contacts a grain: the printed step is above the limit, as the sum over contacts says."""
    steps = {}
    for equation in ("summed", "report"):
        O.reset()
        ts.add_materials()
        free = ts.add_block(overlap=0.1, cells=2)
        engine = ts.set_engines(**ts.exact(safety=1, equation=equation))
        ts.shake(free)
        O.run(1, True)
        steps[equation] = engine.criticalStep
        assert engine.reason.endswith("Eq 7-8") == (equation == "report")
    assert steps["report"] > 1.05 * steps["summed"]
    assert ts.growth(free, 300) > EXPLODES


SCENES = ["light between heavy", "mass ratio 1e6", "stiffness ratio 1e4", "walls", "boxes", "clump"]


@pytest.mark.parametrize("kind", SCENES)
def test_hard_case_is_stable_below_the_critical_step_and_not_above(kind):
    results = {}
    for safety in (0.9, 1.5):
        O.reset()
        ts.add_materials()
        ids = ts.add_squeezed(kind)
        results[safety], reason = vibrate(ids, safety)
        assert reason.startswith("contact of")
    assert results[0.9] < BOUNDED
    assert results[1.5] > EXPLODES


def test_pair_that_nothing_moves_limits_nothing():
    ts.add_materials()
    for x in (0, 1.9):
        cs.add_sphere((x * ts.RADIUS, 0, 0), ts.RADIUS, "grain", fixed=True)
    engine = ts.set_engines()
    O.dt = 3e-4
    O.run(20, True)
    assert O.interactions.countReal() == 1
    assert (O.dt, engine.reason, engine.criticalStep) == (3e-4, "nothing limits the step", 0)
    assert list(engine.decidingContact) == []
