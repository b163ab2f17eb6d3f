# SPDX-License-Identifier: GPL-2.0-or-later
"""k and b of MR-2629, Eq 9-17, from records made with known k and b."""
from __future__ import annotations

import numpy as np
import pytest

from grainfall.dynamics import (
    MeasurementError,
    Response,
    fit_phasors,
    haversine,
    loop_energy,
    multisine,
    read_recording,
    remove_apparatus,
    stiffness_and_damping,
)

# A sample of the report's size with a Young's modulus of 100 MPa, losing 5 % of 2 pi times its energy at 50 Hz.
STIFFNESS = 100e6 * np.pi * 0.018**2 / 0.085
DAMPING = 0.05 * STIFFNESS / (2 * np.pi * 50)
PEAK_TO_PEAK = 400e-9


def kelvin_voigt(time, frequencies, peak_to_peak=PEAK_TO_PEAK):
    """Displacement and force (Eq 9) of haversines at these frequencies; the derivative is exact."""
    share = peak_to_peak / len(frequencies)
    omegas = 2 * np.pi * np.asarray(frequencies)
    velocity = sum(0.5 * share * w * np.sin(w * time) for w in omegas)
    displacement = multisine(time, peak_to_peak, frequencies)
    return displacement, STIFFNESS * displacement + DAMPING * velocity


def test_a_haversine_starts_at_rest_and_spans_its_peak_to_peak():
    time = np.linspace(0, 0.1, 2001)
    x = haversine(time, PEAK_TO_PEAK, 20.0)
    assert x[0] == 0 and x.min() >= 0
    assert x.max() == pytest.approx(PEAK_TO_PEAK, rel=1e-6)
    assert x[1] / PEAK_TO_PEAK == pytest.approx((np.pi * 20 * time[1]) ** 2, rel=1e-4)


def test_kelvin_voigt_is_recovered_from_a_noisy_drifting_record():
    # 20 000 samples with noise of 1 % of the amplitude leave a standard error of 0.014 % on k: 0.1 % is 7 of them.
    # b has the same absolute error as k / omega, hence 1/0.05 as large a relative one.
    rng = np.random.default_rng(1)
    time = np.arange(20_000) / 20_000.0
    x, force = kelvin_voigt(time, [50.0])
    amplitude, load = PEAK_TO_PEAK / 2, STIFFNESS * PEAK_TO_PEAK / 2
    x = x + 0.01 * amplitude * rng.standard_normal(len(time)) + 0.3 * amplitude * time
    force = force + 0.01 * load * rng.standard_normal(len(time)) - 0.5 * load * time + 100.0
    (found,) = stiffness_and_damping(time, x, force, [50.0])
    assert found.stiffness == pytest.approx(STIFFNESS, rel=1e-3)
    assert found.damping == pytest.approx(DAMPING, rel=1e-3 / 0.05)
    assert found.loss_factor == pytest.approx(0.05, abs=1e-3)


def test_the_phasors_are_those_of_equation_16():
    # F = F0 cos(w t), x = x0 cos(w t + phi): k = F0 cos(phi)/x0, b = -k tan(phi)/w.
    time = np.arange(400) / 400.0 / 10
    load, amplitude, phase, omega = 3.0, 2e-7, -0.2, 2 * np.pi * 10
    force, x = load * np.cos(omega * time), amplitude * np.cos(omega * time + phase)
    (found,) = stiffness_and_damping(time, x, force, [10.0])
    assert found.stiffness == pytest.approx(load * np.cos(phase) / amplitude, rel=1e-12)
    assert found.damping == pytest.approx(-found.stiffness * np.tan(phase) / omega, rel=1e-12)
    assert found.phase == pytest.approx(phase, rel=1e-12)
    assert found.force_amplitude == pytest.approx(load, rel=1e-12)


def test_standard_errors_cover_the_truth_as_often_as_they_say():
    # Of 400 records 68.3 % should fall within one standard error; the count scatters by 2.3 %, so 4 of those.
    rng = np.random.default_rng(2)
    time = np.arange(500) / 5000.0
    x, force = kelvin_voigt(time, [40.0])
    deviations = []
    for _ in range(400):
        noisy_x = x + 0.05 * PEAK_TO_PEAK * rng.standard_normal(len(time))
        noisy_force = force + 0.02 * STIFFNESS * PEAK_TO_PEAK * rng.standard_normal(len(time))
        (found,) = stiffness_and_damping(time, noisy_x, noisy_force, [40.0], harmonics=1)
        deviations.append(
            (
                (found.stiffness - STIFFNESS) / found.stiffness_error,
                (found.damping - DAMPING) / found.damping_error,
            )
        )
    for column in np.abs(deviations).T:
        assert np.mean(column < 1) == pytest.approx(0.683, abs=0.093)
        assert np.mean(column < 2) > 0.91


def test_several_sines_at_once_give_the_same_as_one_by_one():
    frequencies = [10.0, 33.0, 70.0, 150.0]
    time = np.arange(6000) / 6000.0
    together = stiffness_and_damping(time, *kelvin_voigt(time, frequencies), frequencies)
    for frequency, found in zip(frequencies, together):
        (alone,) = stiffness_and_damping(time, *kelvin_voigt(time, [frequency]), [frequency])
        assert found.stiffness == pytest.approx(alone.stiffness, rel=1e-9)
        assert found.damping == pytest.approx(alone.damping, rel=1e-9)


def test_the_third_harmonic_of_a_hardening_spring_is_reported():
    # F = k (x + c x^3) with x = x0 cos: third over first harmonic (c x0^2/4)/(1 + 3 c x0^2/4), no second.
    time = np.arange(1000) / 1000.0
    amplitude, c = 1.0, 0.2
    x = amplitude * np.cos(2 * np.pi * 5 * time)
    (found,) = stiffness_and_damping(time, x, STIFFNESS * (x + c * x**3), [5.0])
    assert found.force_harmonics[0] == pytest.approx(0, abs=1e-12)
    assert found.force_harmonics[1] == pytest.approx((c / 4) / (1 + 3 * c / 4), rel=1e-9)
    assert found.stiffness == pytest.approx(STIFFNESS * (1 + 0.75 * c), rel=1e-9)


def test_a_harmonic_that_is_itself_a_test_frequency_is_not_fitted_twice():
    time = np.arange(3000) / 3000.0
    x, force = kelvin_voigt(time, [10.0, 30.0])
    low, high = stiffness_and_damping(time, x, force, [10.0, 30.0])
    assert low.force_harmonics[1] == 0.0
    assert high.stiffness == pytest.approx(STIFFNESS, rel=1e-9)


def test_the_area_of_the_loop_is_the_damping():
    # pi w b x0^2; the trapezoidal rule is exact to rounding over a whole period of a sine.
    time = np.arange(2000) / 2000.0 / 50
    work = loop_energy(*kelvin_voigt(time, [50.0]))
    amplitude = PEAK_TO_PEAK / 2
    assert work == pytest.approx(np.pi * 2 * np.pi * 50 * DAMPING * amplitude**2, rel=1e-5)


def test_frequencies_that_a_record_cannot_tell_apart_are_refused():
    time = np.arange(500) / 5000.0
    with pytest.raises(ValueError, match="cannot be told apart"):
        fit_phasors(time, np.cos(time), [50.0, 50.0])
    with pytest.raises(ValueError, match="samples cannot determine"):
        fit_phasors(time[:3], time[:3], [50.0])


def combined(arrangement: str, frequency: float) -> tuple[Response, Response]:
    """Sample in its apparatus, and the apparatus, from the mechanics of springs and dashpots."""
    omega = 2 * np.pi * frequency
    sample = complex(STIFFNESS, omega * DAMPING)
    frame = complex(3 * STIFFNESS, 0.2 * omega * DAMPING)
    whole = sample + frame if arrangement == "parallel" else sample * frame / (sample + frame)
    return (
        Response(frequency, whole.real, whole.imag / omega),
        Response(frequency, frame.real, frame.imag / omega),
    )


@pytest.mark.parametrize("arrangement", ["parallel", "series"])
def test_the_sample_is_left_when_the_apparatus_is_removed(arrangement):
    measured, apparatus = zip(*(combined(arrangement, f) for f in (10.0, 60.0, 150.0)))
    for found in remove_apparatus(measured, apparatus, arrangement):
        assert found.stiffness == pytest.approx(STIFFNESS, rel=1e-12)
        assert found.damping == pytest.approx(DAMPING, rel=1e-9)


@pytest.mark.parametrize("arrangement", ["parallel", "series"])
def test_errors_of_sample_and_apparatus_both_count(arrangement):
    # First-order propagation against finite differences of the removal itself.
    whole, frame = combined(arrangement, 60.0)
    step = 1e-6

    def removed(k=0.0, b=0.0, frame_k=0.0, frame_b=0.0):
        one = Response(60.0, whole.stiffness + k, whole.damping + b)
        other = Response(60.0, frame.stiffness + frame_k, frame.damping + frame_b)
        (found,) = remove_apparatus([one], [other], arrangement)
        return np.array([found.stiffness, found.damping])

    errors = {"k": 1e3, "b": 2.0, "frame_k": 5e3, "frame_b": 1.0}
    variance = sum(
        ((removed(**{name: step * e}) - removed(**{name: -step * e})) / (2 * step)) ** 2
        for name, e in errors.items()
    )
    measured = Response(60.0, whole.stiffness, whole.damping, errors["k"], errors["b"])
    apparatus = Response(60.0, frame.stiffness, frame.damping, errors["frame_k"], errors["frame_b"])
    (found,) = remove_apparatus([measured], [apparatus], arrangement)
    assert found.stiffness_error == pytest.approx(np.sqrt(variance[0]), rel=1e-4)
    assert found.damping_error == pytest.approx(np.sqrt(variance[1]), rel=1e-4)


def test_an_apparatus_that_cannot_be_removed_is_named():
    whole, frame = combined("series", 60.0)
    with pytest.raises(ValueError, match="arrangement = 'beside'.*parallel, series"):
        remove_apparatus([whole], [frame], "beside")
    with pytest.raises(ValueError, match="not measured at 60 Hz .*10, 20"):
        others = [Response(10.0, 1.0, 0.0), Response(20.0, 1.0, 0.0)]
        remove_apparatus([whole], others, "series")
    with pytest.raises(ValueError, match="stiffer than the whole"):
        remove_apparatus([frame], [whole], "series")


def write(path, *lines):
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


def test_a_measured_file_is_read_in_its_own_units(tmp_path):
    path = write(
        tmp_path / "a.csv",
        "# sample 3, dry",
        "time [ms],gauge,displacement (µm),force_kN",
        "0,7,0.1,0.02",
        "2,7,0.3,0.05",
    )
    record = read_recording(path)
    np.testing.assert_allclose(record.time, [0, 2e-3])
    np.testing.assert_allclose(record.displacement, [1e-7, 3e-7])
    np.testing.assert_allclose(record.force, [20.0, 50.0])


def test_columns_of_other_names_can_be_pointed_at(tmp_path):
    path = write(tmp_path / "a.csv", "t_s,lvdt_nm,cell_N", "0,1,2", "1,3,4")
    record = read_recording(path, time="t_s", displacement="lvdt_nm", force="cell_N")
    np.testing.assert_allclose(record.displacement, [1e-9, 3e-9])


BAD_FILES = [
    (["time_s,force_N", "0,1", "1,2"], "no column for displacement among 'time_s', 'force_N'"),
    (["time_s,displacement_in,force_N", "0,1,2"], "'displacement_in': its unit must be one of m, "),
    (["time_s,displacement_m,force_N", "0,1,2", "1,x,2"], "line 3, 'displacement_m': 'x'"),
    (["time_s,displacement_m,force_N", "0,1,2", "1,2"], "line 3, 'force_N': '' is no number"),
    (["time_s,displacement_m,force_N", "0,1,2", "0,1,2"], "line 3: time must increase"),
    (["time_s,displacement_m,force_N", "0,1,2"], "1 rows of values"),
    (["# nothing"], "the file is empty"),
    (["time_s,displacement_m,displacement_mm,force_N", "0,1,2,3"], "2 columns for displacement"),
]


@pytest.mark.parametrize(("lines", "message"), BAD_FILES)
def test_a_file_that_cannot_be_used_is_refused_with_the_place(lines, message, tmp_path):
    path = write(tmp_path / "bad.csv", *lines)
    with pytest.raises(MeasurementError, match=message) as caught:
        read_recording(path)
    assert "bad.csv" in str(caught.value)


def test_a_record_too_short_or_too_coarse_for_a_frequency_is_refused(tmp_path):
    rows = [f"{i / 100},{i % 3},{i}" for i in range(50)]
    record = read_recording(write(tmp_path / "a.csv", "time_s,displacement_m,force_N", *rows))
    record.check_frequencies([10.0])
    with pytest.raises(MeasurementError, match="3 Hz: the record of 0.49 s holds 1.5 cycles"):
        record.check_frequencies([3.0])
    with pytest.raises(MeasurementError, match="50 Hz: samples 0.01 s apart"):
        record.check_frequencies([50.0])
