# SPDX-License-Identifier: GPL-2.0-or-later
"""The triaxial scenario as a user starts it: wrong options, batch, stop and resume."""
from __future__ import annotations

import json
import signal
import time

import pytest
from scenario_script import TINY, TRIAXIAL, run_batch, start_script

from grainfall.triaxial import OptionError, triaxial_test

BAD = [
    ("preset", "crel", r"--preset = 'crel'.*did you mean crrel"),
    ("frequencies", "10,x", r"--frequencies = '10,x': 'x' must be a number in \[1, 1000\] Hz"),
    ("frequencies", "10,10", r"--frequencies = '10,10': '10'.*each once"),
    ("frequencies", "5000", r"--frequencies = '5000'.*\[1, 1000\] Hz"),
    ("confinement", -1, r"--confinement = -1.*\[0, 200000\] Pa"),
    ("confinement", 3e5, r"--confinement = 300000.0.*\[0, 200000\] Pa"),
    ("membrane_young", 0, r"--membrane-young = 0.*\(0, 1e\+09\] Pa"),
    ("membrane_thickness", 0.1, r"--membrane-thickness = 0.1.*\[0, 0.005\] m"),
    ("membrane_fit", 1.1, r"--membrane-fit = 1.1.*\[0.5, 1\]"),
    ("axial_stress", 0, r"--axial-stress = 0.*\(0, 600000\] Pa"),
    ("energy_limit", -1, r"--energy-limit = -1.*of at least 0"),
    ("stress_ratio", 9, r"--stress-ratio = 9.*\[0.5, 3\]"),
    ("void_ratio", 0.2, r"--void-ratio = 0.2.*\[0.5, 0.9\]"),
    ("diameter", 0.01, r"--diameter = 0.01.*at least 0.015 m, three grain diameters"),
    ("peak_to_peak", 1e-3, r"--peak-to-peak = 0.001.*must be at most 1.83e-05 m"),
    ("peak_to_peak", -1, r"--peak-to-peak = -1.*above 0 m"),
    ("most_cycles", 2, r"--most-cycles = 2.*--least-cycles = 3"),
    ("least_cycles", 1.5, r"--least-cycles = 1.5.*whole number"),
    ("dt_safety", 1, r"--dt-safety = 1.*\[0.001, 0.9\]"),
    ("friction", "slippery", r"--friction = 'slippery'"),
    ("poisson", 0.7, r"--poisson = 0.7.*0.499"),
    ("freqencies", "10", r"unknown parameter 'freqencies'.*did you mean frequencies"),
    ("resume", "nowhere", r"--resume = 'nowhere'"),
]


@pytest.mark.parametrize(("name", "value", "message"), BAD)
def test_a_bad_value_is_named_with_what_is_allowed(name, value, message, refuses):
    refuses(triaxial_test, message, **{name: value})


def test_frequencies_without_a_common_period_are_refused_together(refuses):
    refuses(triaxial_test, "repeat only after 100 s", frequencies="10,33.33", multisine=True)


# Nothing holds the sides: no cell pressure and no membrane, or one that is not stretched.
FREE_SIDES = {"confinement": 0, "membrane_thickness": 0}
SLACK = {"confinement": 0, "membrane_fit": 1}
UNHELD = [
    (FREE_SIDES, "--confinement = 0.* dry grains .*give --membrane-thickness .*, or --moisture"),
    (SLACK, "--confinement = 0.* dry grains"),
    ({**FREE_SIDES, "moisture": 0.02, "bridges": "none"}, "--confinement = 0.* dry grains"),
    ({**FREE_SIDES, "moisture": 0.02}, "--confinement = 0.*--axial-stress must be given"),
]


@pytest.mark.parametrize(("options", "message"), UNHELD)
def test_a_sample_that_nothing_holds_is_refused_with_the_cure(options, message, refuses):
    refuses(triaxial_test, message, **options)


def test_a_row_of_a_batch_runs_with_its_own_parameters_into_its_own_folder(sample_cache, tmp_path):
    options = {**TINY, "sample_cache": str(sample_cache), "quiet": True, "friction": "0.4"}
    columns, values = " ".join(options), " ".join(map(repr, options.values()))
    (tmp_path / "one.table").write_text(f"description {columns}\nfriction04 {values}\n")
    run_batch(tmp_path / "one.table", TRIAXIAL)
    (path,) = tmp_path.rglob("summary.json")
    summary = json.loads(path.read_text())
    assert "friction04" in str(path)
    assert summary["parameters"]["friction"] == "0.4"
    assert summary["stiffness_N_per_m"][0] > 0


def test_ctrl_c_keeps_what_is_finished_and_a_resumed_run_ends_as_one_never_stopped(
    finished_test, sample_cache, tmp_path
):
    # Contacts may come back from the file in another order: rounding, which two cycles amplify to far less than 1e-6.
    whole, _ = finished_test
    options = {**TINY, "frequencies": "150,100", "sample_cache": sample_cache, "output": tmp_path}
    process = start_script(options, TRIAXIAL)
    deadline = time.monotonic() + 100
    while time.monotonic() < deadline and not (tmp_path / "loops_1.csv").exists():
        assert process.poll() is None
        time.sleep(0.02)
    process.send_signal(signal.SIGINT)
    text, _ = process.communicate(timeout=60)
    assert "Traceback" not in text and process.returncode == 130
    summary = json.loads((tmp_path / "summary.json").read_text())
    assert summary["interrupted"] and summary["frequency_Hz"] in ([], [150.0])
    with pytest.raises(OptionError, match="--seed cannot be changed"):
        triaxial_test(resume=str(tmp_path), seed=2)
    resumed = triaxial_test(resume=str(tmp_path), no_plots=True, quiet=True)
    assert not resumed["interrupted"]
    assert resumed["frequency_Hz"] == [150.0, 100.0]
    for key in ("stiffness_N_per_m", "energy_residual_J"):
        assert resumed[key] == pytest.approx(whole[key], rel=1e-6)
