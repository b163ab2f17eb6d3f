# SPDX-License-Identifier: GPL-2.0-or-later
"""The yardstick of the speed benchmark computes what our law computes in YADE.

benchmarks/speed/bare_bed.cpp has its own geometry, neighbour search and leapfrog around the same kernel. A
disordered bed with a sphere falling into it goes the same way in both. The lever arm at a wall differs by the
overlap, 1e-3 of the radius at most here, on the few grains that touch one: hence 1e-3 of the way moved.
"""
from __future__ import annotations

import os
import sys
from pathlib import Path

import numpy as np
import pytest
import yade.wrapper as w
from yade import O

sys.path.append(str(Path(__file__).resolve().parents[2] / "benchmarks"))
from speed import bed as beds  # noqa: E402
from speed import yade_scene  # noqa: E402

PROGRAM = Path(os.environ.get("GRAINFALL_BUILD_DIR", "build")) / "benchmarks/speed/bare_loop"
SIDE, STEPS = 0.07, 60  # m
TOLERANCE = 1e-3


@pytest.fixture(scope="module")
def struck_bed(tmp_path_factory) -> Path:
    """700 grains at rest and a sphere of 10 kg that has just touched them."""
    if not PROGRAM.exists():
        pytest.skip(f"{PROGRAM} is not built")
    file = tmp_path_factory.mktemp("bed") / "bed.f64"
    rows = beds._random_bed(700, SIDE)
    rows.tofile(file)
    for drag, steps in ((2000.0, 400), (100.0, 1500)):
        beds.run_bare_loop(PROGRAM, file, file, SIDE, steps, drag=drag)
    rows = np.fromfile(file).reshape(-1, 11)
    rows[:, 3:9] = 0
    beds.with_sphere(rows).tofile(file)
    return file


def test_the_bare_loop_moves_grains_as_yade_does_with_our_law(struck_bed, tmp_path):
    start = np.fromfile(struck_bed).reshape(-1, 11)
    out = tmp_path / "bare.f64"
    counted = beds.run_bare_loop(PROGRAM, struck_bed, out, SIDE, STEPS)
    bare = np.fromfile(out).reshape(-1, 11)

    O.reset()
    yade_scene.add_bodies("general", start, SIDE)
    verlet = beds.SKIN / 2
    O.engines = [
        w.ForceResetter(),
        w.InsertionSortCollider([w.Bo1_Sphere_Aabb(), w.Bo1_Wall_Aabb()], verletDist=verlet),
        yade_scene.contact_loop("general", verlet),
        yade_scene.integrator("general"),
    ]
    O.dt = beds.TIME_STEP
    O.run(STEPS, True)
    in_yade = yade_scene.final_bodies(start)

    assert counted["rebuilds"] > 0, "the test is to cover contacts carried over to a new list"
    for columns, quantity in ((slice(0, 3), "positions"), (slice(6, 9), "spins")):
        moved = np.linalg.norm(in_yade[:, columns] - start[:, columns])
        apart = np.linalg.norm(bare[:, columns] - in_yade[:, columns])
        assert apart < TOLERANCE * moved, f"{quantity} differ by {apart / moved:.2g} of the way"


def test_a_list_of_contacts_alone_leaves_none_out(struck_bed, tmp_path):
    counted = beds.run_bare_loop(
        PROGRAM, struck_bed, tmp_path / "bare.f64", SIDE, 5, contacts_only=2e-4
    )
    assert counted["contacts"] > 700
    assert counted["missed"] == 0
