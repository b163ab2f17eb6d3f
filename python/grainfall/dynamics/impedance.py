# SPDX-License-Identifier: GPL-2.0-or-later
"""Stiffness k and damping b of Eq 9 from records of force and displacement."""
from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from grainfall.dynamics.phasors import fit_phasors


@dataclass(frozen=True)
class Response:
    """What a sample (or an apparatus) answers at one frequency.

    Parameters
    ----------
    frequency : float
        [Hz].
    stiffness, damping : float
        k [N/m] and b [N s/m] of Eq 16.
    stiffness_error, damping_error : float
        Their standard errors if the noise of both records is white; 0 where unknown.
    force_amplitude, displacement_amplitude : float
        F0 [N] and x0 [m] of Eq 10-11.
    phase : float
        phi of Eq 11 [rad]: displacement ahead of force; negative where energy is lost.
    force_harmonics, displacement_harmonics : tuple of float
        Amplitudes of the second, third, ... harmonic over the first.
    """

    frequency: float
    stiffness: float
    damping: float
    stiffness_error: float = 0.0
    damping_error: float = 0.0
    force_amplitude: float = float("nan")
    displacement_amplitude: float = float("nan")
    phase: float = float("nan")
    force_harmonics: tuple[float, ...] = ()
    displacement_harmonics: tuple[float, ...] = ()

    @property
    def complex_stiffness(self) -> complex:
        """k + i w b [N/m]."""
        return complex(self.stiffness, 2 * np.pi * self.frequency * self.damping)

    @property
    def loss_factor(self) -> float:
        """w b / k, which is -tan(phi) [-]; energy lost in a cycle over 2 pi times the largest energy stored."""
        return 2 * np.pi * self.frequency * self.damping / self.stiffness


def stiffness_and_damping(
    time: np.ndarray,
    displacement: np.ndarray,
    force: np.ndarray,
    frequencies: Sequence[float],
    harmonics: int = 3,
) -> list[Response]:
    """k and b at each frequency, from a record that may hold one sine or several at once.

    Parameters
    ----------
    time, displacement, force : numpy.ndarray, shape (n,)
        Time [s], displacement [m] and force [N], both counted positive in the same sense: compression.
    frequencies : sequence of float
        Frequencies that the actuator was driven at [Hz].
    harmonics : int
        Highest multiple of each frequency that is fitted beside it and reported.

    Returns
    -------
    list of Response
        One for each frequency, in the order given.

    Raises
    ------
    ValueError
        The record cannot tell the frequencies apart, or nothing moves at one of them.
    """
    moved = fit_phasors(time, displacement, frequencies, harmonics)
    pushed = fit_phasors(time, force, frequencies, harmonics)
    responses = []
    for row, frequency in enumerate(moved.frequencies):
        x, y = complex(moved.fundamentals[row]), complex(pushed.fundamentals[row])
        if abs(x) == 0.0:
            raise ValueError(f"no displacement at {frequency:g} Hz")
        ratio = y / x
        covariance = _ratio_covariance(x, ratio, moved.covariances[row], pushed.covariances[row])
        omega = 2 * np.pi * frequency
        responses.append(
            Response(
                frequency=float(frequency),
                stiffness=ratio.real,
                damping=ratio.imag / omega,
                stiffness_error=float(np.sqrt(covariance[0, 0])),
                damping_error=float(np.sqrt(covariance[1, 1])) / omega,
                force_amplitude=abs(y),
                displacement_amplitude=abs(x),
                phase=float(-np.angle(ratio)),
                force_harmonics=tuple(pushed.harmonic_ratios[row].tolist()),
                displacement_harmonics=tuple(moved.harmonic_ratios[row].tolist()),
            )
        )
    return responses


def _ratio_covariance(x: complex, ratio: complex, of_x: np.ndarray, of_y: np.ndarray) -> np.ndarray:
    """Covariance, shape (2, 2), of real and imaginary part of y/x, to first order: d(y/x) = dy/x - (y/x) dx/x."""
    by_y, by_x = _as_matrix(1 / x), _as_matrix(-ratio / x)
    return by_y @ of_y @ by_y.T + by_x @ of_x @ by_x.T


def _as_matrix(factor: complex) -> np.ndarray:
    """Multiplication by a complex number as a matrix on (real, imaginary)."""
    return np.array([[factor.real, -factor.imag], [factor.imag, factor.real]])


def loop_energy(displacement: np.ndarray, force: np.ndarray) -> float:
    """Work done on the sample over a closed loop, the integral of F dx by the trapezoidal rule [J].

    For Eq 9 and a sine of amplitude x0 it is pi w b x0^2: a second road to b, blind to harmonics' phases.

    Parameters
    ----------
    displacement, force : numpy.ndarray, shape (n,)
        [m], [N]; the loop is closed from the last sample to the first.
    """
    x, y = np.append(displacement, displacement[0]), np.append(force, force[0])
    return float(np.sum(0.5 * (y[1:] + y[:-1]) * np.diff(x)))
