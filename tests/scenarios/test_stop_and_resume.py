# SPDX-License-Identifier: GPL-2.0-or-later
"""A run can be stopped at any time and taken up again."""
from __future__ import annotations

import json
import signal
import time

import numpy as np
import pytest
from scenario_script import SMALL, start_script

from grainfall.drop import OptionError, drop_test


def rows(folder) -> np.ndarray:
    """All of trace.csv, shape (rows, columns)."""
    return np.genfromtxt(folder / "trace.csv", delimiter=",", skip_header=1)


def test_a_resumed_run_follows_the_one_that_was_never_stopped(small_drop):
    # A loaded scene adds forces in another order, so the runs differ by rounding, 1e-16 of the forces in
    # each step; collisions of grains amplify that, over the 110 steps here to far less than 1e-9.
    whole, whole_folder = small_drop("whole", duration=0.009)
    _, folder = small_drop("parts", duration=0.004)
    resumed = drop_test(resume=str(folder), duration=0.009, no_plots=True, quiet=True)
    assert resumed["steps"] == whole["steps"]
    difference = np.abs(rows(folder) - rows(whole_folder)).max(axis=0)
    scale = np.abs(rows(whole_folder)).max(axis=0) + 1e-12
    assert np.all(difference <= 1e-9 * scale)


def test_resuming_keeps_the_rows_already_written(small_drop):
    _, folder = small_drop(duration=0.003)
    before = (folder / "trace.csv").read_text()
    drop_test(resume=str(folder), duration=0.005, no_plots=True, quiet=True)
    assert (folder / "trace.csv").read_text().startswith(before)


def test_what_made_the_past_cannot_be_changed_by_resuming(small_drop):
    _, folder = small_drop()
    with pytest.raises(OptionError, match="--seed cannot be changed"):
        drop_test(resume=str(folder), seed=2)


def test_ctrl_c_leaves_a_summary_and_a_state_to_resume_from(bed_cache, tmp_path):
    folder = tmp_path / "drop"
    options = {
        **SMALL,
        "duration": 5.0,
        "rest_speed": 0,
        "checkpoint_interval": 1e-3,
        "no_plots": True,
        "bed_cache": bed_cache,
        "output": folder,
    }
    process = start_script(options)
    deadline = time.monotonic() + 60
    while not (folder / "trace.csv").exists() and time.monotonic() < deadline:
        assert process.poll() is None
        time.sleep(0.05)
    process.send_signal(signal.SIGINT)
    text, _ = process.communicate(timeout=60)
    assert "Traceback" not in text
    assert text.count("effects:\n") == 1  # what runs is said once, at the start
    summary = json.loads((folder / "summary.json").read_text())
    assert summary["interrupted"]
    before = (folder / "trace.csv").read_text()
    end = summary["simulated_seconds"] + 2e-3
    resumed = drop_test(resume=str(folder), duration=end, no_plots=True, quiet=True)
    assert not resumed["interrupted"]
    assert resumed["steps"] > summary["steps"]
    assert (folder / "trace.csv").read_text().startswith(before)
