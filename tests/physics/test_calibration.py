# SPDX-License-Identifier: GPL-2.0-or-later
"""Calibration against models whose answer is known in closed form."""
from __future__ import annotations

import json

import numpy as np
import pytest

from grainfall.calibrate import (
    Parameter,
    RunCache,
    SpectraError,
    calibrate,
    profile,
    read_spectra,
)
from grainfall.calibrate.run import calibrate_friction
from grainfall.calibrate.spectra import spectra_of
from grainfall.calibrate.triaxial_model import sand
from grainfall.options import OptionError

CONDITIONS = [(w, f) for w in (0.0, 0.023, 0.05) for f in (10.0, 30.0, 60.0, 100.0, 150.0)]
TRUTH = {"friction": 0.35, "restitution": 0.7}


def contact_model(values, conditions):
    """A sample that softens and loses energy by slip, b ~ 1/f, and by dashpots, b constant.

    For partial slip of a contact (Mindlin & Deresiewicz 1953) the loss factor goes with amplitude over friction, and
    the stiffness falls by as much; a dashpot's coefficient goes with -ln e/sqrt(pi^2 + ln^2 e) (Antypov & Elliott
    2011).
    """
    slip = 0.02 / values["friction"]
    log_e = -np.log(values.get("restitution", 0.8))
    ratio = log_e / np.hypot(np.pi, log_e)
    modelled = {}
    for moisture, frequencies in conditions:
        for frequency in frequencies:
            stiffness = 1e6 * (1 - slip * (1 + 10 * moisture))
            hysteretic = stiffness * slip / (2 * np.pi * frequency)
            modelled[moisture, frequency] = stiffness, hysteretic + 200.0 * ratio
    return modelled


def data_of(values, model=contact_model, noise=0.0, seed=1, **errors):
    """Spectra that the model gives for these values, with relative noise."""
    rng = np.random.default_rng(seed)
    conditions = [(w, [f for v, f in CONDITIONS if v == w]) for w in (0.0, 0.023, 0.05)]
    modelled = model(values, conditions)
    rows = []
    for moisture, frequency in CONDITIONS:
        k, b = modelled[moisture, frequency]
        scatter = 1 + noise * rng.standard_normal(2)
        rows.append((moisture, frequency, k * scatter[0], b * scatter[1]))
    return spectra_of(rows, **errors)


PARAMETERS = [
    Parameter("friction", 0.8, 0.05, 2.0),
    Parameter("restitution", 0.9, 0.1, 0.99),
]


def test_the_parameters_that_made_the_data_are_found():
    # The derivatives are differences over 10 %, so the optimiser approaches geometrically; 1e-3 is its tolerance.
    found = calibrate(contact_model, PARAMETERS, data_of(TRUTH))
    assert found.converged and not found.unseen and not found.at_bound
    for name, value in TRUTH.items():
        assert found.values[name] == pytest.approx(value, rel=2e-3)


def test_a_model_that_scatters_does_not_mislead_the_derivatives():
    # Scatter of 0.5 % in b, different at every point, as a packing's would be: differences over 10 % of the
    # parameters see through it, where those over 1e-8 would be 1e5 times the true derivative.
    def rough(values, conditions):
        smooth = contact_model(values, conditions)
        phase = 1e4 * sum(values.values())
        return {
            key: (k, b * (1 + 0.005 * np.sin(phase * (1 + i))))
            for i, (key, (k, b)) in enumerate(smooth.items())
        }

    found = calibrate(rough, PARAMETERS, data_of(TRUTH))
    for name, value in TRUTH.items():
        assert found.values[name] == pytest.approx(value, rel=0.05)


def test_standard_errors_are_those_of_repeated_measurements():
    # 60 noisy data sets; the standard deviation of 60 values is itself known to 9 %, so 30 % is 3 of that.
    errors = {"stiffness_error": 0.02, "damping_error": 0.02}
    logs, stated = [], []
    for seed in range(60):
        found = calibrate(
            contact_model, PARAMETERS, data_of(TRUTH, noise=0.02, seed=seed, **errors)
        )
        logs.append(np.log([found.values[name] for name in TRUTH]))
        stated.append([found.relative_errors[name] for name in TRUTH])
    np.testing.assert_allclose(np.std(logs, axis=0), np.mean(stated, axis=0), rtol=0.3)


def test_a_parameter_that_changes_nothing_is_reported_as_unseen():
    parameters = [*PARAMETERS, Parameter("loadScale", 5.0, 0.1, 50.0)]
    found = calibrate(contact_model, parameters, data_of(TRUTH))
    assert [line.split(":")[0] for line in found.unseen] == ["loadScale"]
    assert found.relative_errors["loadScale"] == np.inf
    assert found.singular_values[-1] == 0
    assert json.loads(json.dumps(found.as_dict()))["relative_errors"]["loadScale"] is None
    assert found.values["friction"] == pytest.approx(TRUTH["friction"], rel=2e-3)


def test_a_pair_of_which_only_the_product_counts_is_reported_as_such():
    def product(values, conditions):
        return contact_model({"friction": values["a"] * values["b"]}, conditions)

    data = data_of({"a": 0.5, "b": 0.7}, product)
    found = calibrate(product, [Parameter("a", 1, 0.1, 5), Parameter("b", 1, 0.1, 5)], data)
    assert found.values["a"] * found.values["b"] == pytest.approx(0.35, rel=2e-3)
    assert any("a^" in line and "b^" in line and "fix one" in line for line in found.unseen)


def test_a_profile_rises_by_one_at_one_standard_error():
    data = data_of(TRUTH, stiffness_error=0.002, damping_error=0.02)
    found = calibrate(contact_model, PARAMETERS, data)
    sigma = found.relative_errors["friction"]
    values = TRUTH["friction"] * np.exp([-sigma, 0.0, sigma])
    rows = profile(contact_model, PARAMETERS, data, "friction", values.tolist())
    below, least, above = (chi for _, chi in rows)
    # parabolic to the order of sigma, here 1 %
    assert below - least == pytest.approx(1, abs=0.1)
    assert above - least == pytest.approx(1, abs=0.1)


def test_an_estimate_beyond_a_bound_stops_there_and_says_so():
    found = calibrate(contact_model, [Parameter("friction", 0.8, 0.5, 2.0)], data_of(TRUTH))
    assert found.at_bound == ["friction"]
    assert found.values["friction"] == pytest.approx(0.5, rel=1e-3)


def test_runs_are_kept_and_found_again(tmp_path):
    calls = []

    def expensive(parameters, folder):
        calls.append(parameters)
        return contact_model(parameters, [(0.0, [10.0])])[0.0, 10.0]

    def model(values, conditions):
        cache = RunCache(expensive, tmp_path)
        return {(0.0, 10.0): cache(values)}

    data = spectra_of([(0.0, 10.0, *contact_model({"friction": 0.4}, [(0.0, [10.0])])[0.0, 10.0])])
    parameters = [Parameter("friction", 0.8, 0.1, 2.0)]
    first = calibrate(model, parameters, data)
    once = len(calls)
    assert 0 < once <= first.evaluations
    again = calibrate(model, parameters, data)
    assert len(calls) == once
    assert again.values == first.values


@pytest.mark.parametrize("bounds", [(0.5, 0.0, 1.0), (2.0, 0.1, 1.0), (0.5, 0.5, 0.5)])
def test_bounds_that_make_no_sense_are_refused(bounds):
    with pytest.raises(ValueError, match="parameter 'friction': start = .*low < high"):
        Parameter("friction", *bounds)


def test_parameters_become_options_of_the_scenario():
    values = {
        "mu0": 0.8,
        "muInf": 0.2,
        "loadScale": 3.0,
        "moisture_factor@0.023": 0.9,
        "young": 5e9,
    }
    options = sand(values, 0.023)
    assert options == {
        "friction": "exponential:mu0=0.8,muInf=0.2,loadScale=3",
        "moisture_factor": "0:1,0.023:0.9",
        "moisture": 0.023,
        "young": 5e9,
    }
    with pytest.raises(ValueError, match="mu0 without muInf, loadScale"):
        sand({"mu0": 0.8}, 0.0)


def test_the_scenario_writes_what_it_found(tmp_path, monkeypatch):
    asked = []

    def stand_in(folder, **options):
        asked.append(options)
        return contact_model

    monkeypatch.setattr("grainfall.calibrate.run.triaxial_model", stand_in)
    data = data_of(TRUTH)
    rows = zip(data.moisture, data.frequency, data.stiffness, data.damping)
    table = tmp_path / "measured.csv"
    table.write_text("\n".join([HEADER, *(",".join(map(repr, map(float, r))) for r in rows)]))
    found = calibrate_friction(
        measured=str(table),
        fit="friction=0.8:0.05:2,restitution=0.9:0.1:0.99",
        output=str(tmp_path / "out"),
        confinement=5e3,
        quiet=True,
    )
    assert found.values["friction"] == pytest.approx(TRUTH["friction"], rel=2e-3)
    assert asked == [{"confinement": 5e3}]
    written = json.loads((tmp_path / "out" / "calibration.json").read_text())
    assert written["values"] == found.values and written["unseen"] == []


BAD_OPTIONS = [
    ({}, "--measured: a table"),
    ({"fit": "friction=0.5"}, "'friction=0.5' must be NAME=START:LOW:HIGH"),
    ({"fit": "friction=0.5:1:2"}, "start = 0.5 must lie in"),
    ({"fit": "frction=0.5:0.1:1"}, "'frction=0.5:0.1:1': must be NAME=..., NAME one of friction"),
    ({"fit": "preset=1:0.5:2"}, "NAME one of friction"),
    ({"fit": "friction=a:b:c"}, "'a' must be a number"),
    ({"fix": "muInf=x"}, "'x' must be a number"),
    ({"confinement": -1}, "--confinement = -1"),
    ({"frequencies": "10"}, "unknown parameter 'frequencies'"),
]


@pytest.mark.parametrize(("options", "message"), BAD_OPTIONS)
def test_a_calibration_that_makes_no_sense_is_refused_before_it_runs(options, message, tmp_path):
    table = tmp_path / "measured.csv"
    table.write_text(f"{HEADER}\n0,10,1e6,5\n")
    given = {"measured": str(table)} if options else {}
    with pytest.raises(OptionError, match=message):
        calibrate_friction(**given, **options, output=str(tmp_path / "out"))
    assert not (tmp_path / "out").exists()


HEADER = "moisture,frequency_Hz,stiffness_N_per_m,damping_N_s_per_m"
BAD_TABLES = [
    (["moisture,frequency_Hz,stiffness_N_per_m", "0,1,2"], "no column 'damping_N_s_per_m'"),
    ([HEADER], "no rows of values"),
    ([HEADER, "0,10,1e6,x"], "line 2, 'damping_N_s_per_m': 'x' must be a number"),
    ([HEADER, "0,10,-1,5"], "line 2, 'stiffness_N_per_m': '-1' must be a number above 0"),
    ([HEADER, "-1,10,1,5"], "line 2, 'moisture': '-1' must be a number of at least 0"),
    ([HEADER, "# dry", "0,10,1,5", "0,10,2,5"], "line 4: moisture 0 at 10 Hz stands there twice"),
]


@pytest.mark.parametrize(("lines", "message"), BAD_TABLES)
def test_a_table_that_cannot_be_used_is_refused_with_the_place(lines, message, tmp_path):
    path = tmp_path / "table.csv"
    path.write_text("\n".join(lines) + "\n")
    with pytest.raises(SpectraError, match=message):
        read_spectra(path)


def test_a_table_states_its_own_errors_or_gets_the_usual_ones(tmp_path):
    path = tmp_path / "table.csv"
    path.write_text(f"{HEADER},damping_error_N_s_per_m\n0.023,10,1e6,50,3\n")
    data = read_spectra(path)
    assert data.conditions == [(0.023, [10.0])]
    assert data.damping_error == pytest.approx([3.0])
    assert data.stiffness_error == pytest.approx([2e4])
