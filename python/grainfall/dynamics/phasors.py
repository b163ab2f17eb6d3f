# SPDX-License-Identifier: GPL-2.0-or-later
"""Amplitude and phase of a signal at frequencies that are known, with their uncertainty."""
from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class PhasorFit:
    """Least-squares fit of offset, linear drift, sines and their harmonics.

    Parameters
    ----------
    frequencies : numpy.ndarray, shape (f,)
        Fundamental frequencies [Hz].
    phasors : numpy.ndarray, shape (f, h), complex
        Phasor of harmonic 1, 2, ... h of each frequency, in the unit of the signal, for time zero of the signal.
    covariances : numpy.ndarray, shape (f, 2, 2)
        Covariance of real and imaginary part of each fundamental, if the residuals are white noise.
    offset, drift : float
        Value at the middle of the record, and slope per second.
    residual_rms : float
        Root mean square of what the fit leaves, degrees of freedom accounted for.
    """

    frequencies: np.ndarray
    phasors: np.ndarray
    covariances: np.ndarray
    offset: float
    drift: float
    residual_rms: float

    @property
    def fundamentals(self) -> np.ndarray:
        """Phasors of the fundamentals, shape (f,)."""
        return self.phasors[:, 0]

    @property
    def harmonic_ratios(self) -> np.ndarray:
        """Amplitudes of harmonics 2 to h over that of the fundamental, shape (f, h - 1)."""
        return np.abs(self.phasors[:, 1:]) / np.abs(self.phasors[:, :1])


def fit_phasors(
    time: np.ndarray, values: np.ndarray, frequencies: Sequence[float], harmonics: int = 1
) -> PhasorFit:
    """Fit values = offset + drift (t - middle) + sum of Re(P exp(2 pi i n f t)), n = 1 ... harmonics.

    Parameters
    ----------
    time, values : numpy.ndarray, shape (n,)
        Time [s], not necessarily evenly spaced, and the signal.
    frequencies : sequence of float
        Fundamental frequencies [Hz].
    harmonics : int
        Highest multiple of each frequency to fit. A harmonic that is itself one of the frequencies (or a harmonic of
        an earlier one) belongs to that one and is reported here as zero.

    Returns
    -------
    PhasorFit

    Raises
    ------
    ValueError
        The record is too short, or too coarse, to tell the terms apart.
    """
    time, values = np.asarray(time, dtype=float), np.asarray(values, dtype=float)
    fundamentals = np.asarray(frequencies, dtype=float)
    middle = 0.5 * (time[0] + time[-1])
    terms, places = _terms(fundamentals, harmonics)
    design = _design(time, middle, terms)
    if len(time) <= design.shape[1]:
        raise ValueError(f"{len(time)} samples cannot determine {design.shape[1]} unknowns")
    scale = np.linalg.norm(design, axis=0)
    left, singular, right = np.linalg.svd(design / scale, full_matrices=False)
    if singular[-1] < 1e-6 * singular[0]:
        raise ValueError(
            f"frequencies {terms.tolist()} Hz cannot be told apart in a record of "
            f"{time[-1] - time[0]:g} s with {len(time)} samples"
        )
    solution = right.T @ ((left.T @ values) / singular) / scale
    residual = values - design @ solution
    variance = float(residual @ residual) / (len(time) - design.shape[1])
    covariance = variance * (right.T / singular**2) @ right / np.outer(scale, scale)
    return _collect(fundamentals, places, solution, covariance, variance)


def _terms(fundamentals: np.ndarray, harmonics: int) -> tuple[np.ndarray, np.ndarray]:
    """Frequencies to fit, shape (m,), and the place of each harmonic among them, -1 where another owns it."""
    terms = fundamentals.tolist()
    places = np.full((len(terms), harmonics), -1)
    places[:, 0] = np.arange(len(terms))
    for row, fundamental in enumerate(fundamentals):
        for harmonic in range(2, harmonics + 1):
            frequency = harmonic * fundamental
            if not np.any(np.isclose(terms, frequency, rtol=1e-9)):
                places[row, harmonic - 1] = len(terms)
                terms.append(frequency)
    return np.array(terms), places


def _design(time: np.ndarray, middle: float, terms: np.ndarray) -> np.ndarray:
    """Columns 1, t - middle, then cos and -sin of each term (the parts of Re P exp(i w t))."""
    angle = 2 * np.pi * np.outer(time, terms)
    columns = np.empty((len(time), 2 + 2 * len(terms)))
    columns[:, 0] = 1.0
    columns[:, 1] = time - middle
    columns[:, 2::2] = np.cos(angle)
    columns[:, 3::2] = -np.sin(angle)
    return columns


def _collect(
    fundamentals: np.ndarray,
    places: np.ndarray,
    solution: np.ndarray,
    covariance: np.ndarray,
    variance: float,
) -> PhasorFit:
    """Sort the solution's columns into phasors."""
    all_phasors = np.append(solution[2::2] + 1j * solution[3::2], 0.0)
    blocks = [covariance[2 + 2 * i : 4 + 2 * i, 2 + 2 * i : 4 + 2 * i] for i in places[:, 0]]
    return PhasorFit(
        frequencies=fundamentals,
        phasors=all_phasors[places],
        covariances=np.array(blocks),
        offset=float(solution[0]),
        drift=float(solution[1]),
        residual_rms=float(np.sqrt(variance)),
    )
