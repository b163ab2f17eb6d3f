# SPDX-License-Identifier: GPL-2.0-or-later
"""The flat path gives with two threads what it gives with one.

Threads add the forces on a grain in another order, so that one step differs by rounding, which contacts amplify with
every impact (see test_flat_path).
"""
from __future__ import annotations

import os
import pickle
import subprocess
from pathlib import Path
from typing import Any

import flat_scenes as scenes
import numpy as np
import pytest
from flat_scenes import MANY_STEPS, ONE_STEP
from yade import O


@pytest.fixture(scope="module")
def runs(tmp_path_factory: pytest.TempPathFactory) -> dict[int, dict[str, Any]]:
    """{threads: {scene: state at its end}}."""
    folder = tmp_path_factory.mktemp("threads")
    start = folder / "start.yade.gz"
    O.reset()
    scenes.pack(scenes.sand(), count=6)
    scenes.engines(False)
    O.run(300, True)
    O.save(str(start))
    O.reset()
    script = Path(__file__).with_name("flat_threads.py")
    # Threads that wait without spinning: else two of them crawl where a core is shared.
    environment = {**os.environ, "OMP_WAIT_POLICY": "passive"}
    results = {}
    for threads in (1, 2):
        output = folder / f"{threads}.pickle"
        command = ["yade", "-n", "-x", f"-j{threads}", str(script), str(start), str(output)]
        done = subprocess.run(command, capture_output=True, text=True, timeout=120, env=environment)
        assert output.exists(), done.stdout[-2000:] + done.stderr[-2000:]
        results[threads] = pickle.loads(output.read_bytes())
        assert results[threads]["threads"] == threads
    return results


def assert_equal(one: dict[str, Any], two: dict[str, Any], tolerance: float) -> None:
    arrays = [{k: v for k, v in s.items() if isinstance(v, np.ndarray)} for s in (one, two)]
    assert len(one["ids"]) > 100
    assert np.array_equal(one["ids"], two["ids"])
    found = scenes.differences(*arrays)
    assert {k: v for k, v in found.items() if not v <= tolerance} == {}


def test_one_step_with_two_threads_is_that_with_one_to_1e_12(runs):
    """From the same moving pack, made by 300 steps of the general path."""
    assert_equal(runs[1]["one step"], runs[2]["one step"], ONE_STEP)


@pytest.mark.parametrize("bed", ("dry bed", "moist bed"))
def test_a_bed_falls_together_with_two_threads_as_with_one(runs, bed):
    assert_equal(runs[1][bed], runs[2][bed], MANY_STEPS)


@pytest.mark.parametrize("bed", ("dry bed", "moist bed"))
def test_two_threads_book_the_energies_that_one_books(runs, bed):
    """Every entry of O.energy; what threads would lose by booking at once is missing here, and in the residual."""
    one, two = (runs[threads][bed] for threads in (1, 2))
    scale = max(abs(value) for value in one["energies"].values())
    assert set(one["energies"]) == set(two["energies"])
    for name, value in one["energies"].items():
        assert two["energies"][name] == pytest.approx(value, abs=1e-9 * scale), name
    # The step of 1e-5 s resolves impacts of 4e-4 s: leapfrog's error, with either number of threads.
    assert two["residual"] == pytest.approx(one["residual"], abs=1e-9)
    assert abs(two["residual"]) < 1e-3


def test_yade_s_integrator_loses_no_work_that_its_threads_book_first(runs):
    """It names the entry from all threads at once unless the ledger did before: about half of such runs lost some."""
    one, two = (runs[threads]["works of gravity"] for threads in (1, 2))
    assert two == pytest.approx(one, rel=1e-9)


def test_bodies_that_come_and_go_are_obeyed_with_two_threads(runs):
    one, two = (runs[threads]["changing bodies"] for threads in (1, 2))
    assert len(two["position"]) == 6**3 + 5
    assert_equal(one, two, MANY_STEPS)


def test_boxes_and_a_projectile_meet_grains_with_two_threads_as_with_one(runs):
    one, two = (runs[threads]["obstacles"] for threads in (1, 2))
    assert_equal(one, two, MANY_STEPS)
    assert two["impulse"] == pytest.approx(one["impulse"], rel=MANY_STEPS) and one["impulse"] > 0


def test_impacts_saved_half_way_go_on_with_two_threads_as_if_never_saved(runs):
    """Slip histories, bridges and clumps among what is saved."""
    assert (runs[1]["kept on"]["ids"] >= 6**3 + 5).any()  # of clumps
    assert_equal(runs[2]["kept on"], runs[2]["saved"], MANY_STEPS)
    assert_equal(runs[1]["kept on"], runs[2]["saved"], MANY_STEPS)
