# SPDX-License-Identifier: GPL-2.0-or-later
"""Contact parameters from measured stiffness k(f) and damping b(f): MR-2629, section 3.2, by least squares.

A script or the console::

    import grainfall
    from grainfall.calibrate import Parameter, calibrate, read_spectra, triaxial_model
    data = read_spectra("measured.csv")
    model = triaxial_model("results/calibration", confinement=5e3)
    found = calibrate(model, [Parameter("friction", 0.5, 0.05, 1.5)], data)

From a command line or under yade-batch: ``scenarios/calibrate_friction.py``.
"""
from __future__ import annotations

from grainfall.calibrate.fit import Calibration, Parameter, calibrate, profile
from grainfall.calibrate.run_cache import RunCache
from grainfall.calibrate.spectra import Spectra, SpectraError, read_spectra
from grainfall.calibrate.triaxial_model import triaxial_model

__all__ = [
    "Calibration",
    "Parameter",
    "RunCache",
    "Spectra",
    "SpectraError",
    "calibrate",
    "profile",
    "read_spectra",
    "triaxial_model",
]
