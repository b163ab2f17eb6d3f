# SPDX-License-Identifier: GPL-2.0-or-later
"""What a drop leaves behind, and that it obeys mechanics."""
from __future__ import annotations

import csv
import json
import math
import re

import h5py
import numpy as np
import pytest

GRAVITY = 9.81


def read_trace(folder) -> dict[str, np.ndarray]:
    """Columns of trace.csv by name."""
    with open(folder / "trace.csv", newline="") as file:
        rows = list(csv.reader(file))
    values = np.array(rows[1:], dtype=float)
    return {name: values[:, index] for index, name in enumerate(rows[0])}


def test_the_summary_has_the_agreed_keys_and_equals_its_file(small_drop):
    summary, folder = small_drop()
    agreed = {
        "preset",
        "seed",
        "particles",
        "steps",
        "simulated_seconds",
        "wall_seconds",
        "energy_residual_relative",
        "effects",
        "price",
        "depth_m",
        "peak_force_N",
        "impact_speed_m_per_s",
        "stop_time_s",
        "stages",
    }
    assert agreed <= set(summary)
    assert json.loads((folder / "summary.json").read_text()) == json.loads(json.dumps(summary))
    assert summary["preset"] == "m70-half"
    assert summary["bed"]["solid_fraction_core"] > 0.5
    assert any(seconds > 0 for seconds in summary["price"].values())


def test_the_trace_is_the_same_in_csv_and_hdf5(small_drop):
    _, folder = small_drop()
    trace = read_trace(folder)
    with h5py.File(folder / "trace.h5") as file:
        for name, values in trace.items():
            np.testing.assert_array_equal(file["trace"][name][:], values)


def test_the_projectile_arrives_with_the_speed_of_its_fall(small_drop):
    # Free fall from 0.61 m ends at sqrt(2 g h) = 3.459 m/s; the first grain may lie up to one grain
    # diameter above or below the mean surface, which is 0.7 % of the height and half of that in speed.
    summary, _ = small_drop()
    assert summary["impact_speed_m_per_s"] == pytest.approx(
        math.sqrt(2 * GRAVITY * 0.61), rel=0.007
    )


def test_the_recorded_force_is_the_change_of_momentum(small_drop):
    # With a row in every step the leapfrog scheme makes this exact: m dv = (F - m g) dt for each step.
    # What is left is rounding of a few hundred additions.
    summary, folder = small_drop(record_interval=1e-9)
    trace = read_trace(folder)
    mass = summary["parameters"]["mass"]
    # velocity counts downwards, force upwards; the velocity of a row is that before its force acts
    impulse = np.cumsum((mass * GRAVITY - trace["force_N"][:-1]) * np.diff(trace["time_s"]))
    change = mass * (trace["velocity_m_per_s"][1:] - trace["velocity_m_per_s"][0])
    assert np.max(trace["force_N"]) > 1.0
    np.testing.assert_allclose(impulse, change, atol=1e-11 * mass * 3.46)


def test_the_impulse_of_the_trace_does_not_depend_on_how_often_it_is_recorded(small_drop):
    # Rows hold the mean force since the row before, so that hits between two rows are counted. The last
    # row of the coarse trace lies somewhere in the fine one; up to there both sum the same forces.
    _, fine_folder = small_drop("fine", record_interval=1e-9)
    _, coarse_folder = small_drop("coarse", record_interval=5e-4)
    fine, coarse = read_trace(fine_folder), read_trace(coarse_folder)
    assert len(coarse["time_s"]) < len(fine["time_s"]) / 5
    within = fine["time_s"] <= coarse["time_s"][-1] * (1 + 1e-12)
    step = fine["time_s"][1] - fine["time_s"][0]
    spans = np.diff(coarse["time_s"], prepend=coarse["time_s"][0] - step)
    impulse = np.sum(coarse["force_N"] * spans)
    assert impulse > 0
    assert np.sum(fine["force_N"][within]) * step == pytest.approx(impulse, rel=1e-9)


def test_nose_shaft_and_base_make_up_the_whole_force(small_drop):
    _, folder = small_drop()
    trace = read_trace(folder)
    zones = trace["nose_force_N"] + trace["shaft_force_N"] + trace["base_force_N"]
    np.testing.assert_allclose(zones, trace["force_N"], rtol=1e-12, atol=1e-12)


def test_energy_is_accounted_for_within_a_thousandth(small_drop):
    summary, folder = small_drop(duration=0.01, dt_safety=0.1, record_interval=2e-5)
    assert 0 < summary["energy_residual_relative"] < 1e-3
    assert not any("energy balance" in note for note in summary["notes"])
    with h5py.File(folder / "trace.h5") as file:
        energy = {name: values[:] for name, values in file["energy"].items()}
    # The rows are those of the ledger: their total strays by no more than its residual.
    total = energy["total_J"]
    assert np.ptp(total) <= 2 * summary["energy_residual_J"] * (1 + 1e-9)
    taken = summary["dissipated_by_friction_J"] + summary["dissipated_by_dashpots_J"]
    assert 0 < taken < summary["energy_in_play_J"]


def test_a_larger_residual_than_allowed_is_told(small_drop):
    summary, _ = small_drop(energy_limit=1e-9)
    assert any("the energy balance is off by" in note for note in summary["notes"])


def test_without_energies_there_is_no_ledger_and_no_residual(small_drop):
    summary, folder = small_drop(no_energy=True)
    assert summary["energy_residual_relative"] is None
    assert "energy_ledger" not in summary["price"]
    assert len((folder / "energy.csv").read_text().splitlines()) <= 1


def test_the_same_seed_gives_the_same_drop_and_another_seed_another(small_drop):
    _, first = small_drop("first")
    _, again = small_drop("again")
    _, other = small_drop("other", seed=2)
    trace = (first / "trace.csv").read_text()
    assert (again / "trace.csv").read_text() == trace
    assert (other / "trace.csv").read_text() != trace


@pytest.mark.parametrize("seed", [1, 2])
@pytest.mark.parametrize("moisture", [0.0, 0.02])
def test_a_whole_drop_is_the_same_on_both_paths(small_drop, seed, moisture):
    options = {"seed": seed, "duration": 0.03, "moisture": moisture}
    flat, general = (small_drop(path, path=path, **options)[0] for path in ("flat", "general"))
    assert flat["steps"] == general["steps"] > 600
    # Sums in another order differ by 1e-16; collisions multiply that, in eight dry packings to 1e-12 to 5e-12.
    for name in ("depth_m", "peak_force_camera_N", "energy_in_play_J"):
        assert flat[name] == pytest.approx(general[name], rel=1e-7), name


def test_coarsening_is_stated(small_drop):
    summary, _ = small_drop()
    # 8 mm for the 0.72 mm of ASTM 20-30 sand
    assert summary["grain_enlargement"] == pytest.approx(8 / 0.72)
    # number by volume: a spread of +-10 % makes the mean volume 1 % larger than that of the mean grain
    expected = summary["particles"] * (8 / 0.72) ** 3
    assert summary["real_grains"] == pytest.approx(expected, rel=0.05)


def test_constant_friction_is_one_word_away(small_drop):
    with_load, _ = small_drop("load")
    constant, _ = small_drop("constant", friction="0.5")
    assert any("power law" in effect for effect in with_load["effects"])
    assert not any("power law" in effect for effect in constant["effects"])
    assert {"projectile", "energy ledger"} <= set(constant["effects"])


def test_pictures_page_and_paraview_files_are_written_and_the_page_needs_no_other_file(small_drop):
    _, folder = small_drop(no_plots=False, vtk_interval=2e-3)
    for picture in (*folder.glob("plots/*.png"), folder / "bed_forces.png"):
        assert picture.read_bytes().startswith(b"\x89PNG")
    assert list(folder.glob("plots/*.png"))
    page = (folder / "summary.html").read_text()
    sources = re.findall(r'(?:src|href)="([^"]*)"', page)
    assert sources and all(source.startswith(("data:", "#")) for source in sources)
    suffixes = {path.suffix for path in (folder / "vtk").iterdir()}
    assert {".vtu", ".vtp"} <= suffixes
