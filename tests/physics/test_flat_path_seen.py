# SPDX-License-Identifier: GPL-2.0-or-later
"""What scripts, viewers and files see of a scene on the flat path, and change in it.

Tolerances as in test_flat_path.
"""
from __future__ import annotations

from pathlib import Path
from typing import Any

import flat_scenes as scenes
import numpy as np
import pytest
import yade.wrapper as w
from flat_scenes import MANY_STEPS, assert_equal, build, differences, on_both_paths
from yade import O, utils


def test_stored_energy_and_utils_see_the_contacts_of_the_flat_path():
    results = []
    for flat in (True, False):
        O.reset()
        build(flat)
        O.run(300, True)
        results.append(
            (utils.unbalancedForce(), utils.kineticEnergy(), utils.avgNumInteractions())
            + tuple(w.Omega().engines[2].lawDispatcher.functors[0].elasticEnergy().values())
        )
    assert results[0] == pytest.approx(results[1], rel=1e-8)


def test_a_script_that_looks_in_the_middle_of_a_run_sees_the_present():
    """Positions noted by a PyRunner every 50 steps are those of the general path at the same steps."""
    notes: dict[bool, list[Any]] = {True: [], False: []}

    def build_watched(flat: bool) -> None:
        build(flat)
        O.engines = [
            *O.engines,
            w.PyRunner(command="note()", iterPeriod=50, initRun=True),
        ]
        import builtins

        builtins.note = lambda: notes[flat].append(scenes.state())

    on_both_paths(build_watched, 300)
    assert len(notes[True]) == len(notes[False]) >= 6
    for flat, general in zip(notes[True], notes[False]):
        if len(general["ids"]) > 20:
            assert_equal((flat, general), MANY_STEPS)


def test_a_script_that_changes_bodies_in_the_middle_of_a_run_is_obeyed():
    """Velocities set, a grain added and one erased by a PyRunner, at a time when contacts exist."""

    def build_changing(flat: bool) -> None:
        build(flat)
        O.engines = [*O.engines, w.PyRunner(command="change()", iterPeriod=100, nDo=4)]

        def change() -> None:
            O.bodies[3].state.vel = (1, 0, 0)
            if O.iter < 150:
                O.bodies.append(utils.sphere((0.015, 0.015, 0.06), 0.004, material=O.materials[0]))
                O.bodies.erase(10)

        import builtins

        builtins.change = change

    flat, general = on_both_paths(build_changing, 350)
    assert_equal((flat, general), MANY_STEPS)
    assert len(flat["position"]) == 4**3 + 5


def test_saving_in_the_middle_of_an_impact_continues_to_the_last_bit(tmp_path: Path):
    file = str(tmp_path / "middle.yade.gz")
    O.reset()
    build(True, gravimetricMoisture=0.01)
    scenes.assert_saving_changes_no_bit(file)


def test_switching_the_flat_path_off_and_on_in_a_run_changes_nothing():
    O.reset()
    build(True)
    O.run(100, True)
    O.engines[2].flat = False
    O.run(100, True)
    assert O.engines[2].path == "general: flat = False"
    assert not O.engines[1].dead
    O.engines[2].flat = True
    O.run(100, True)
    switched = scenes.state()
    O.reset()
    build(False)
    O.run(300, True)
    assert_equal((switched, scenes.state()), MANY_STEPS)


def test_leaving_the_flat_path_while_nobody_looks_loses_nothing():
    """An engine that is said to be blind turns the path off, at a time when only the arrays know what goes on."""
    O.reset()
    build(True)
    O.engines = [
        *O.engines,
        w.PyRunner(command="loop.flat = False", iterPeriod=150, nDo=2, label="switch"),
    ]
    O.engines[2].blindEngines = ["switch"]
    O.run(300, True)
    assert O.engines[2].path == "general: flat = False"
    switched = scenes.state()
    O.reset()
    build(False)
    O.run(300, True)
    assert_equal((switched, scenes.state()), MANY_STEPS)


def test_contacts_that_came_and_went_unseen_leave_those_that_touch():
    """The scene lists each overlapping pair once and no other; many more have met since the last look."""
    O.reset()
    build(True, restitution=1.0)
    O.run(3000, True)
    statistics = O.engines[2].statistics()
    grains = [b for b in O.bodies if isinstance(b.shape, w.Sphere)]
    places = np.array(
        [b.state.pos - b.state.vel * O.dt for b in grains]
    )  # where contacts were found
    radii = np.array([b.shape.radius for b in grains])
    distances = np.linalg.norm(places[:, None] - places[None], axis=2)
    overlap = radii[:, None] + radii[None] - distances
    overlapping = {(i, j) for i, j in np.argwhere(overlap >= 0).tolist() if i < j}
    listed = [(i.id1, i.id2) for i in O.interactions]
    of_grains = sorted(pair for pair in listed if max(pair) < len(grains))
    assert len(listed) == O.interactions.countReal() == statistics["contacts"]
    assert of_grains == sorted(overlapping)
    assert statistics["born"] > 10 * len(listed) > 0
    assert statistics["born"] - statistics["parted"] == len(listed)


def test_a_law_changed_under_way_takes_over_the_forces_alike_on_both_paths():
    """Contacts made by a law without memory of slip get one where they are, and keep what they were made with."""

    def made_with() -> dict[tuple[int, int], tuple[float, ...]]:
        names = ("normalCoefficient", "shearCoefficient", "normalDamping", "tangensOfFrictionAngle")
        real = (i for i in O.interactions if i.isReal)
        return {(i.id1, i.id2): tuple(getattr(i.phys, n) for n in names) for i in real}

    results = []
    for flat in (True, False):
        O.reset()
        build(flat)
        O.run(100, True)
        before = made_with()
        O.engines[2].lawDispatcher.functors[0].tangentialLaw = "mindlin-deresiewicz"
        O.run(1, True)
        after = made_with()
        both = before.keys() & after.keys()
        assert len(both) > 20
        assert all(before[pair] == after[pair] for pair in both)
        assert all(O.interactions[pair].phys.partialSlip is not None for pair in both)
        O.run(199, True)
        results.append(scenes.state())
    assert_equal((results[0], results[1]), MANY_STEPS)


@pytest.mark.parametrize("moisture", (0.0, 0.01))
def test_a_law_changed_while_nobody_looks_takes_over_the_forces_too(moisture):
    """By an engine that is said to be blind: slip is remembered from step 100 on, and no more from step 200 on."""

    def build_changing(flat: bool) -> None:
        build(flat, gravimetricMoisture=moisture)
        O.engines = [
            *O.engines,
            w.PyRunner(
                command="contact_law.tangentialLaw = 'mindlin-deresiewicz' if O.iter < 150 else 'incremental'",
                iterPeriod=100,
                nDo=3,
                initRun=False,
                label="changer",
            ),
        ]
        if flat:
            O.engines[2].blindEngines = ["changer"]

    for steps in (150, 300):
        assert_equal(on_both_paths(build_changing, steps), MANY_STEPS)


def test_pausing_a_run_in_the_background_leaves_everything_published():
    """The forces that contacts and bodies show belong together: on every grain they add up to its force."""
    O.reset()
    build(True)
    O.run()
    while O.iter < 300:
        pass
    O.pause()
    assert not O.running
    seen = scenes.state()
    total = np.zeros((len(O.bodies), 3))
    for (first, second), normal, shear in zip(
        seen["ids"], seen["normal force"], seen["shear force"]
    ):
        total[first] -= normal + shear
        total[second] += normal + shear
    assert total == pytest.approx(seen["force"], abs=1e-12 * np.abs(seen["force"]).max())


def test_what_a_viewer_is_shown_by_the_clock_changes_a_run_by_no_bit():
    """The same run at its own pace, and one that waits long enough to be shown in between."""
    states = []
    for pause in (0.0, 0.6):
        O.reset()
        build(True)
        O.engines = [
            *O.engines,
            w.PyRunner(
                command=f"import time; time.sleep({pause})", iterPeriod=120, nDo=4, label="waiter"
            ),
        ]
        O.engines[2].blindEngines = ["waiter"]
        O.run(500, True)
        states.append(scenes.state())
    assert {k: v for k, v in differences(*states).items() if v != 0} == {}
