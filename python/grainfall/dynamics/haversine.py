# SPDX-License-Identifier: GPL-2.0-or-later
"""The displacement that the actuator is made to follow."""
from __future__ import annotations

from collections.abc import Sequence

import numpy as np


def haversine(time: np.ndarray, peak_to_peak: float, frequency: float) -> np.ndarray:
    """A (1 - cos w t)/2: starts at rest from zero and never goes below it.

    Parameters
    ----------
    time : numpy.ndarray, shape (n,)
        Time [s].
    peak_to_peak : float
        Peak-to-peak displacement A [m].
    frequency : float
        w / 2 pi [Hz].

    Returns
    -------
    numpy.ndarray, shape (n,)
        Displacement [m].
    """
    return peak_to_peak * 0.5 * (1.0 - np.cos(2 * np.pi * frequency * np.asarray(time)))


def multisine(time: np.ndarray, peak_to_peak: float, frequencies: Sequence[float]) -> np.ndarray:
    """Haversines of several frequencies at once, each with an equal share of the peak-to-peak displacement.

    Parameters
    ----------
    time : numpy.ndarray, shape (n,)
        Time [s].
    peak_to_peak : float
        Bound of the peak-to-peak displacement of the sum [m].
    frequencies : sequence of float
        [Hz].

    Returns
    -------
    numpy.ndarray, shape (n,)
        Displacement [m].
    """
    share = peak_to_peak / len(frequencies)
    return np.sum([haversine(time, share, frequency) for frequency in frequencies], axis=0)
