# SPDX-License-Identifier: GPL-2.0-or-later
"""HertzTimeStepper among YADE's engines: what it says, when it keeps still, saving, threads, bad input."""
from __future__ import annotations

import json
import math
import os
import subprocess
from pathlib import Path

import contact_scenes as cs
import pytest
import time_step_scenes as ts
from yade import HertzTimeStepper, O


def test_scene_without_bodies_keeps_its_step():
    engine = ts.set_engines()
    O.dt = 2e-5
    O.run(25, True)
    assert (O.dt, engine.reason, list(engine.decidingContact)) == (
        2e-5,
        "nothing limits the step",
        [],
    )


def test_grains_apart_and_at_rest_have_the_rayleigh_step_of_the_smallest():
    ts.add_materials()
    cs.add_sphere((0, 0, 0), ts.RADIUS, "grain")
    small = cs.add_sphere((1, 0, 0), ts.RADIUS / 2, "grain")
    cs.add_sphere((2, 0, 0), ts.RADIUS / 10, "grain", fixed=True)
    engine = ts.set_engines()
    O.run(1, True)
    shear_modulus = ts.SOLID.young / (2 * (1 + ts.SOLID.poisson))
    wave = math.sqrt(shear_modulus / ts.SOLID.density) * (0.1631 * ts.SOLID.poisson + 0.8766)
    assert engine.criticalStep == pytest.approx(math.pi * ts.RADIUS / 2 / wave, rel=1e-9)
    assert O.dt == pytest.approx(0.1 * engine.criticalStep, rel=1e-12)
    assert engine.reason == f"Rayleigh step of {small}"
    assert list(engine.decidingContact) == [small]


def test_reason_names_the_fast_body_and_the_grain_it_may_hit():
    ts.add_materials()
    grain = cs.add_sphere((0, 0, 0), ts.RADIUS, "grain")
    fast = cs.add_sphere((0, 0, 10 * ts.RADIUS), 3 * ts.RADIUS, "grain", (0, 0, -50))
    engine = ts.set_engines(maxApproach=1)
    O.run(1, True)
    assert engine.reason == f"approach of {fast} at 50 m/s, impact on {grain}"
    assert list(engine.decidingContact) == [fast, grain]


def test_common_motion_of_all_bodies_does_not_shorten_the_step():
    steps = []
    for drift in (0, 1e4):
        O.reset()
        ts.add_materials()
        cs.add_sphere((0, 0, 0), ts.RADIUS, "grain", (drift, 0, 50))
        cs.add_sphere((0, 0, 9 * ts.RADIUS), ts.RADIUS, "grain", (drift, 0, 0))
        ts.set_engines()
        O.run(1, True)
        steps.append(O.dt)
    assert steps[1] == pytest.approx(steps[0], rel=1e-9)


def test_switched_off_it_leaves_the_step_alone_and_on_again_it_takes_it_back_up():
    ts.add_materials()
    cs.add_sphere((0, 0, 0), ts.RADIUS, "grain")
    engine = ts.set_engines()
    O.run(11, True)
    chosen = O.dt
    O.dynDt = False
    O.dt = chosen / 7
    O.run(50, True)
    assert not engine.active
    assert O.dt == chosen / 7
    O.dynDt = True
    O.run(500, True)
    assert chosen / 1.2 < O.dt <= chosen


def test_step_shrinks_at_once_grows_slowly_and_keeps_to_its_bounds():
    ts.add_materials()
    ball = cs.add_sphere((0, 0, 0), ts.RADIUS, "grain")
    engine = ts.set_engines(timeStepUpdateInterval=1, maxGrowth=1.2)
    O.run(1, True)
    free = O.dt
    O.bodies[ball].state.vel = (0, 0, 1000)
    cs.add_sphere((1, 0, 0), ts.RADIUS, "grain")
    O.run(1, True)
    short = O.dt
    assert short < free / 3
    O.bodies[ball].state.vel = (0, 0, 0)
    O.run(1, True)
    assert O.dt == pytest.approx(1.2 * short, rel=1e-12)
    engine.maxStep = short / 2
    O.run(1, True)
    assert O.dt <= short / 2
    engine.maxStep = 0
    engine.minStep = 2 * free
    O.run(1, True)
    assert O.dt == 2 * free


@pytest.mark.parametrize("suffix", [".xml", ".yade.gz"])
def test_saved_scene_goes_on_with_the_same_steps(suffix, tmp_path):
    ts.add_colliding_grains()
    ts.set_engines(gravity=(0, 0, -9.81), safety=0.2)
    O.run(30, True)
    file = str(tmp_path / f"scene{suffix}")
    O.save(file)

    def go_on() -> list[float]:
        steps = []
        for _ in range(8):
            O.run(20, True)
            engine = O.engines[-2]
            steps += [O.dt, engine.criticalStep, float(engine.changes)]
        return steps

    assert O.interactions.countReal() > 20
    expected = go_on()
    O.reset()
    O.load(file)
    # Contacts come back in another order: rounding.
    assert go_on() == pytest.approx(expected, rel=1e-9)


def test_two_threads_choose_the_steps_of_one(tmp_path):
    results = []
    for threads in (1, 2):
        output = tmp_path / f"{threads}.json"
        script = Path(__file__).with_name("time_step_pack.py")
        command = ["yade", "-n", "-x", f"-j{threads}", str(script), str(output)]
        environment = {**os.environ, "OMP_WAIT_POLICY": "passive"}
        subprocess.run(command, check=True, capture_output=True, timeout=170, env=environment)
        results.append(json.loads(output.read_text(encoding="utf-8")))
    assert [r["threads"] for r in results] == [1, 2]
    assert results[0]["changes"] == results[1]["changes"] > 1
    assert results[1]["steps"] == pytest.approx(results[0]["steps"], rel=1e-6)


BAD = [
    ("safety", 0.0, "0", "> 0"),
    ("safety", math.nan, "nan", "> 0"),
    ("equation", "hertz", "'hertz'", "'summed' or 'report'"),
    ("maxApproach", -0.1, "-0.1", "> 0"),
    ("maxGrowth", 1.0, "1", "> 1"),
    ("deadBand", -0.5, "-0.5", ">= 0"),
    ("minStep", -1e-6, "-1e-06", ">= 0"),
    ("maxStep", math.inf, "inf", "finite"),
    ("timeStepUpdateInterval", 0, "0", "at least 1"),
]


@pytest.mark.parametrize("attribute, value, written, allowed", BAD)
def test_wrong_value_is_refused_and_the_good_one_kept(attribute, value, written, allowed):
    with pytest.raises(
        ValueError, match=f"HertzTimeStepper.{attribute} = {written}: must be .*{allowed}"
    ):
        HertzTimeStepper(**{attribute: value})
    engine = HertzTimeStepper()
    before = getattr(engine, attribute)
    with pytest.raises(ValueError, match=f"HertzTimeStepper.{attribute} = "):
        setattr(engine, attribute, value)
    assert getattr(engine, attribute) == before


def test_bounds_that_cross_are_refused():
    with pytest.raises(
        ValueError, match="HertzTimeStepper.maxStep = 1e-07: must be 0 or not below minStep"
    ):
        HertzTimeStepper(minStep=1e-6, maxStep=1e-7)
