# SPDX-License-Identifier: GPL-2.0-or-later
"""grainfall.price: the scene stays as it is, what has no influence on motion changes none, and prices have a sign."""
from __future__ import annotations

import builtins
import json
import math
import os
import subprocess
from pathlib import Path

import __main__
import contact_scenes as cs
import grainfall
import numpy as np
import pytest
from grainfall.effects import running_effects
from grainfall.pricing.comparison import entry
from grainfall.pricing.price_list import PriceList
from grainfall.pricing.variants import Variant, variants
from priced_heap import heap
from yade import GrainMat, InteractionLoop, NewtonIntegrator, O, PyRunner

STEPS = 800


def numbers() -> list[float]:
    """Every bit of the motion, the contacts, the energies and the clock of the scene in hand."""
    result = [O.time, O.dt, float(O.iter), *dict(O.energy.items()).values()]
    for body in O.bodies:
        s = body.state
        result += [*s.pos, *s.ori, *s.vel, *s.angVel, *O.forces.f(body.id), *O.forces.t(body.id)]
    for i in O.interactions:
        if i.isReal:
            result += [i.id1, i.id2, *i.phys.normalForce, *i.phys.shearForce, *i.phys.shearElastic]
            result += [i.geom.penetrationDepth, i.phys.bridge.work]
            result += i.phys.partialSlip.pieces if i.phys.partialSlip else []
    return result


@pytest.fixture(scope="module")
def priced() -> dict:
    """The heap before and after it was priced, the prices, and how it goes on; then the same without a price."""
    found: dict = {}
    calls: list[int] = []
    for given in (True, False):
        O.reset()
        heap()
        __main__.grainfall_record = lambda: calls.append(O.iter)
        runner = PyRunner(command="grainfall_record()", iterPeriod=100, label="user_runner")
        O.engines = [*O.engines, runner]
        O.forces.setPermF(0, (0, 0, 1e-5))
        O.run(STEPS, True)
        if given:
            labels = (builtins.law, builtins.ledger, builtins.user_runner)
            objects = [O.bodies[0], O.bodies[-1], O.engines[-1], O.materials[0]]
            # First the ledger, which settles its books when it is asked.
            found["ledger"] = (builtins.ledger.residual, builtins.ledger.largestResidual)
            found["before"], found["filename"] = numbers(), O.filename
            called = len(calls)
            found["prices"] = grainfall.price(seconds=0.4, show=False)
            found["after"], found["filename after"] = numbers(), O.filename
            found["ledger after"] = (builtins.ledger.residual, builtins.ledger.largestResidual)
            found["same labels"] = labels == (builtins.law, builtins.ledger, builtins.user_runner)
            now = [O.bodies[0], O.bodies[-1], O.engines[-1], O.materials[0]]
            found["same objects"] = objects == now
            found["calls"] = len(calls) - called
        O.run(200, True)
        found["end" if given else "end without price"] = numbers()
    O.reset()
    return found


def test_pricing_leaves_the_scene_as_it_is_to_the_last_bit(priced):
    assert priced["after"] == priced["before"]
    assert priced["ledger after"] == priced["ledger"]
    assert priced["filename after"] == priced["filename"]


def test_pricing_leaves_the_user_s_labels_bodies_and_engines(priced):
    assert priced["same labels"] and priced["same objects"]
    assert priced["calls"] == 0  # the user's Python does not run for the sake of a price


def test_a_scene_that_was_priced_goes_on_as_one_that_was_not(priced):
    assert priced["end"] == priced["end without price"]


def test_every_effect_of_the_scene_is_priced(priced):
    names = {entry.effect for entry in priced["prices"].effects if entry.on}
    assert names == {
        "tangential force",
        "partial slip",
        "load-dependent friction",
        "moisture in friction",
        "load scaling",
        "liquid bridges",
        "viscous film",
        "viscous damping",
        "energy ledger",
        "energy booking",
        "adaptive time step",
    }


@pytest.mark.parametrize("effect", ["energy booking", "energy ledger"])
def test_keeping_books_moves_nothing(priced, effect):
    entry = priced["prices"][effect]
    assert entry.change_position_m == 0
    assert entry.change_contact_force == entry.change_kinetic_J == entry.change_stored_J == 0


@pytest.mark.parametrize(
    "effect",
    ["tangential force", "partial slip", "load-dependent friction", "moisture in friction"]
    + ["load scaling", "liquid bridges", "viscous film", "viscous damping"],
)
def test_an_effect_of_the_contacts_changes_the_motion(priced, effect):
    entry = priced["prices"][effect]
    assert (
        0 < entry.change_position_m < 0.5 * 2.5e-3
    )  # m: less than a grain's radius in a few steps


def test_dashpots_take_kinetic_energy(priced):
    assert priced["prices"]["viscous damping"].change_kinetic_J < 0


def test_every_price_is_of_the_same_rounds_with_and_without(priced):
    """Which of the two is dearer is for benchmarks to say: this machine may be busy with other things."""
    for effect in priced["prices"].effects:
        low, high = effect.price_quartiles
        assert effect.step_with_us > 0 and effect.step_without_us > 0, effect.effect
        assert low <= effect.price <= high, effect.effect


@pytest.mark.parametrize("on", [True, False])
def test_a_price_is_the_median_over_the_rounds_of_time_with_over_time_without(on):
    """Rounds that others disturbed, with and without alike or only one of them, leave it as it is."""
    alone, with_effect = np.array([4.0, 4, 4, 8, 40]) * 1e-4, np.array([6.0, 6, 6, 12, 6]) * 1e-4
    times, base = (alone, with_effect) if on else (with_effect, alone)
    here = {
        "positions": {0: np.zeros(3)},
        "force": 2.0,
        "kinetic": 1.0,
        "stored": 0.5,
        "contacts": 100,
    }
    there = {**here, "positions": {0: np.array([3e-6, 4e-6, 0])}, "force": 1.0, "kinetic": 0.75}
    line = entry(Variant("an effect", on, "none", lambda: None), times, base, (here, there))
    assert line["price"] == pytest.approx(0.5) and line["price_quartiles"][1] == pytest.approx(0.5)
    assert line["step_with_us"] == pytest.approx(600) and line["step_without_us"] == pytest.approx(
        400
    )
    assert line["nanoseconds_per_contact"] == pytest.approx(2e-4 / 100 * 1e9)
    assert line["change_position_m"] == pytest.approx(5e-6)
    assert line["change_contact_force"] == pytest.approx(1.0 if on else -0.5)
    assert line["change_kinetic_J"] == pytest.approx(0.25 if on else -0.25)


def test_prices_are_printed_and_are_plain_values_for_json(priced):
    prices = priced["prices"]
    table = prices.table()
    assert all(entry.effect in table for entry in prices.effects)
    assert "left out: PyRunner" in table
    assert PriceList.from_dict(json.loads(json.dumps(prices.as_dict()))) == prices


def test_each_variant_takes_its_effect_out_of_the_scene():
    heap()
    O.run(STEPS, True)
    words = {
        "tangential force": "tangential force",
        "load-dependent friction": "friction: power law",
        "moisture in friction": "moisture in friction",
        "load scaling": "load scaling",
        "liquid bridges": "liquid bridges",
        "viscous film": "viscous film",
        "viscous damping": "viscous damping",
        "energy ledger": "energy ledger",
        "energy booking": "energy booking",
    }
    for name, word in words.items():
        O.reset()
        heap()
        O.run(400, True)
        assert any(word in effect for effect in running_effects()), name
        (variant,) = (v for v in variants(ledger_period=20) if v.effect == name)
        variant.apply()
        O.run(1, True)
        assert not any(word in effect for effect in running_effects()), name


def test_effects_that_are_off_are_priced_by_turning_them_on():
    material = dict(young=1e7, poisson=0.25, density=2650, restitution=0.7)
    heap(material=material, tangential_law="incremental", engines=False)
    O.run(STEPS, True)
    prices = grainfall.price(seconds=0.2, show=False)
    off = {entry.effect for entry in prices.effects if not entry.on}
    assert off == {"partial slip", "energy booking", "adaptive time step"}
    assert prices["energy booking"].change_position_m == 0
    assert prices["partial slip"].change_position_m > 0
    assert math.isnan(O.materials["sand"].bridgeVolume) and not O.trackEnergy


def test_prices_on_two_threads(tmp_path):
    output = tmp_path / "prices.json"
    script = Path(__file__).with_name("priced_heap.py")
    environment = {**os.environ, "OMP_WAIT_POLICY": "passive"}
    command = ["yade", "-n", "-x", "-j2", str(script), str(output)]
    subprocess.run(command, check=True, capture_output=True, timeout=170, env=environment)
    prices = PriceList.from_dict(json.loads(output.read_text()))
    assert prices.threads == 2
    assert prices["liquid bridges"].on and prices["liquid bridges"].step_with_us > 0
    # Threads add forces in another order: rounding, over the few steps of a trial.
    assert prices["energy booking"].change_position_m < 1e-12


@pytest.mark.parametrize("seconds", [0, -1, math.nan, math.inf, "5", None, True])
def test_seconds_that_are_no_positive_number_are_refused(seconds):
    with pytest.raises(ValueError, match="seconds = .*: must be a number above 0"):
        grainfall.price(seconds=seconds)


def test_an_empty_scene_has_no_price():
    with pytest.raises(ValueError, match="O.bodies: empty"):
        grainfall.price(seconds=1)


def test_a_scene_without_our_law_has_no_price():
    O.materials.append(GrainMat())
    cs.add_sphere((0, 0, 0), 0.01, 0)
    O.engines = [InteractionLoop([], [], []), NewtonIntegrator()]
    with pytest.raises(ValueError, match="O.engines: must hold .*Law2_ScGeom_GrainPhys"):
        grainfall.price(seconds=1)
