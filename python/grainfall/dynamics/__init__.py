# SPDX-License-Identifier: GPL-2.0-or-later
"""Stiffness and damping from cyclic tests: MR-2629, section 3.2.2, Eq 9-17. Needs numpy alone.

The sample is read as a spring and a dashpot side by side, F = k x + b dx/dt (Eq 9). Written with phasors,
x = Re X exp(i w t) and F = Re Y exp(i w t), this is Y = (k + i w b) X: the real part of Y / X is k and the
imaginary part over w is b. With F = F0 cos(w t) and x = x0 cos(w t + phi) (Eq 10-11) the same numbers are
Eq 16, k = F0 cos(phi)/x0 and b = -k tan(phi)/w; phi < 0 where the sample dissipates.
"""
from __future__ import annotations

from grainfall.dynamics.apparatus import remove_apparatus
from grainfall.dynamics.haversine import haversine, multisine
from grainfall.dynamics.impedance import Response, loop_energy, stiffness_and_damping
from grainfall.dynamics.measured import MeasurementError, Recording, read_recording
from grainfall.dynamics.phasors import PhasorFit, fit_phasors

__all__ = [
    "MeasurementError",
    "PhasorFit",
    "Recording",
    "Response",
    "fit_phasors",
    "haversine",
    "loop_energy",
    "multisine",
    "read_recording",
    "remove_apparatus",
    "stiffness_and_damping",
]
