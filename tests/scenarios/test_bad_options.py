# SPDX-License-Identifier: GPL-2.0-or-later
"""A wrong option ends in one sentence that names it, before anything has been run or written."""
from __future__ import annotations

import pytest
from scenario_script import start_script

from grainfall.drop import drop_test

BAD = [
    ("preset", "m70-ful", r"--preset = 'm70-ful'.*did you mean m70-full"),
    ("grain_diameter", -0.001, r"--grain-diameter = -0.001.*\[0.0001, 0.05\] m"),
    ("grain_spread", 0.9, r"--grain-spread = 0.9.*\[0, 0.5\]"),
    ("grain_density", 0, r"--grain-density = 0.*above 0 kg/m3"),
    ("young", "soft", r"--young = 'soft'.*Pa"),
    ("young", float("nan"), r"--young = nan"),
    ("poisson", 0.7, r"--poisson = 0.7.*0.499"),
    ("restitution", 0.001, r"--restitution = 0.001.*\[0.01, 1\]"),
    ("friction", "slippery", r"--friction = 'slippery'.*must be a number, 'cole'"),
    ("friction", "exponential:mu9=1", r"--friction.*mu9=1.*mu0, muInf, loadScale"),
    ("friction", -0.5, r"--friction = '-0.5'.*>= 0"),
    ("moisture", 2, r"--moisture = 2.*\[0, 0.5\] kg/kg"),
    ("moisture_factor", "wet", r"--moisture-factor = 'wet'.*MOISTURE:FACTOR"),
    ("profile", "banana", r"--profile = 'banana'.*m70-full"),
    ("mass", 0, r"--mass = 0.*above 0 kg"),
    ("offset_x", 0.2, r"--offset-x = 0.2.*inside the box"),
    ("box_width", 0.02, r"--box-width = 0.02.*projectile"),
    ("bed_depth", 0.001, r"--bed-depth = 0.001.*four grain"),
    ("seed", 1.5, r"--seed = 1.5.*whole number"),
    ("duration", 0, r"--duration = 0.*above 0 s"),
    ("dt_safety", 2, r"--dt-safety = 2.*\[0.001, 1\]"),
    ("time_step_control", "herz", r"--time-step-control = 'herz'.*did you mean hertz"),
    ("time_step_control", "fixed", r"--time-step-control = 'fixed'.*--time-step must be given"),
    ("normal_law", "herz", r"--normal-law = 'herz'.*did you mean hertz"),
    ("solid_fraction", 0.9, r"--solid-fraction = 0.9.*\[0.4, 0.64\]"),
    ("quick", "maybe", r"--quick = 'maybe'.*true or false"),
    ("grian_diameter", 0.01, r"unknown parameter 'grian_diameter'.*did you mean grain_diameter"),
    ("resume", "nowhere", r"--resume = 'nowhere'"),
]


@pytest.mark.parametrize(("name", "value", "message"), BAD)
def test_a_bad_value_is_named_with_what_is_allowed(name, value, message, refuses):
    refuses(drop_test, message, **{name: value})


def test_height_and_speed_together_are_refused(refuses):
    refuses(drop_test, "--drop-height = 1, --impact-speed = 2", drop_height=1, impact_speed=2)


def test_the_script_says_so_in_one_line_and_with_an_exit_code(tmp_path):
    process = start_script({"output": tmp_path / "drop", "poisson": 0.7})
    text, _ = process.communicate(timeout=60)
    assert process.returncode == 2
    errors = [line for line in text.splitlines() if "--poisson" in line]
    assert errors == ["drop_test.py: error: --poisson = '0.7': must be a number in [0, 0.499] -"]
    assert "Traceback" not in text


def test_help_states_units(tmp_path):
    process = start_script({"help": True})
    text, _ = process.communicate(timeout=60)
    assert process.returncode == 0
    for unit in ("[m]", "[s]", "[Pa]", "[kg]", "[m/s]", "[kg/m3]", "[rad/s]"):
        assert unit in text


def test_a_given_time_step_and_another_control_of_it_are_refused(refuses):
    message = "--time-step = 1e-06, --time-step-control = 'hertz'"
    refuses(drop_test, message, time_step=1e-6, time_step_control="hertz")
