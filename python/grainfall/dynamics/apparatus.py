# SPDX-License-Identifier: GPL-2.0-or-later
"""Taking the apparatus out of what was measured: MR-2629, Eq 17.

The equation, F_sys = (k_s + K_m(f)) x + (b_s + b_m(f)) dx/dt, adds stiffnesses, as for an apparatus that works *beside*
the sample at the same displacement (a membrane, a guide). The report gets the apparatus' share, however, by putting
in a steel sample "much stiffer" than the apparatus. Beside steel an apparatus would not be seen at all; what a steel
sample shows is an apparatus *in line* with the sample (frame, load cell, joints), where the compliances add:
1/(k + i w b) = 1/(k_s + i w b_s) + 1/(K_m + i w b_m). Both readings are offered, and none is the default: which one is
true is a property of the machine.
"""
from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from grainfall.dynamics.impedance import Response

ARRANGEMENTS = ("parallel", "series")


def remove_apparatus(
    measured: Sequence[Response], apparatus: Sequence[Response], arrangement: str
) -> list[Response]:
    """Responses of the sample alone.

    Parameters
    ----------
    measured : sequence of Response
        Sample and apparatus together.
    apparatus : sequence of Response
        The apparatus alone: at the same frequencies, or a single one whose k and b hold at all of them (Eq 17 writes
        k_s and b_s without an f).
    arrangement : {'parallel', 'series'}
        'parallel': Eq 17 as printed, k and b are subtracted. 'series': the apparatus yields under the same force as the
        sample, so its compliance is subtracted.

    Returns
    -------
    list of Response
        With standard errors of both sources; harmonics are not carried over.

    Raises
    ------
    ValueError
        Unknown arrangement, a frequency without apparatus, or an apparatus softer than the whole (series).
    """
    if arrangement not in ARRANGEMENTS:
        raise ValueError(f"arrangement = {arrangement!r}: must be one of {', '.join(ARRANGEMENTS)}")
    return [_remove(one, _at(one.frequency, apparatus), arrangement) for one in measured]


def _at(frequency: float, apparatus: Sequence[Response]) -> Response:
    if len(apparatus) == 1:
        return apparatus[0]
    for one in apparatus:
        if np.isclose(one.frequency, frequency, rtol=1e-6):
            return one
    known = ", ".join(f"{one.frequency:g}" for one in apparatus) or "none"
    raise ValueError(f"apparatus was not measured at {frequency:g} Hz (measured: {known})")


def _remove(whole: Response, apparatus: Response, arrangement: str) -> Response:
    omega = 2 * np.pi * whole.frequency
    total = whole.complex_stiffness
    frame = complex(apparatus.stiffness, omega * apparatus.damping)
    if arrangement == "parallel":
        sample, by_total, by_frame = total - frame, 1.0 + 0j, -1.0 + 0j
    else:
        if abs(frame) <= abs(total):
            raise ValueError(
                f"apparatus of {abs(frame):g} N/m at {whole.frequency:g} Hz: in series it must be stiffer than "
                f"the whole, {abs(total):g} N/m"
            )
        sample = 1 / (1 / total - 1 / frame)
        by_total, by_frame = (sample / total) ** 2, -((sample / frame) ** 2)
    errors = _propagate(whole, by_total, omega) + _propagate(apparatus, by_frame, omega)
    return Response(
        frequency=whole.frequency,
        stiffness=sample.real,
        damping=sample.imag / omega,
        stiffness_error=float(np.sqrt(errors[0])),
        damping_error=float(np.sqrt(errors[1])) / omega,
        phase=float(-np.angle(sample)),
    )


def _propagate(source: Response, factor: complex, omega: float) -> np.ndarray:
    """Variances of real and imaginary part that `source` brings, shape (2,) [N2/m2]; its k and b independent."""
    variances = np.array([source.stiffness_error, omega * source.damping_error]) ** 2
    parts = np.array([[factor.real, -factor.imag], [factor.imag, factor.real]])
    return parts**2 @ variances
