# SPDX-License-Identifier: GPL-2.0-or-later
"""Twin experiment: can a calibration find the friction and restitution that simulated data were made with?

    yade -j1 -n -x benchmarks/calibration_twin.py FOLDER

Data come from a triaxial test with known friction, the model is the same test with friction to be found; packing
and preloading are the same, so what is tested is the optimiser and what the data contain. The amplitude is six times
the report's: there contacts slide, and the loss tells of friction. Runs are kept in FOLDER.
"""
from __future__ import annotations

import json
import sys
import time
from pathlib import Path

import grainfall  # noqa: F401  registers the classes
from grainfall.calibrate import Parameter, calibrate, triaxial_model
from grainfall.calibrate.spectra import spectra_of

TRUTH = {"friction": 0.4, "restitution": 0.7}
OPTIONS = {
    "grain_diameter": 8e-3,
    "diameter": 30e-3,
    "height": 60e-3,
    "confinement": 5e3,
    "membrane_thickness": 0,
    "tangential_law": "incremental",
    "peak_to_peak": 6 * 400e-9 * 60 / 85,
    "preload_friction": 0.2,
    "least_cycles": 2,
    "most_cycles": 3,
}
FREQUENCIES = (75.0, 150.0)


def main() -> None:
    """Make the data, fit, print what came out."""
    folder = Path(sys.argv[1])
    model = triaxial_model(folder, **OPTIONS)
    made = model(TRUTH, [(0.0, list(FREQUENCIES))])
    data = spectra_of([(w, f, k, b) for (w, f), (k, b) in made.items()], 0.005, 0.03)
    parameters = [Parameter("friction", 0.8, 0.2, 2.0), Parameter("restitution", 0.9, 0.3, 0.98)]
    began = time.monotonic()
    found = calibrate(model, parameters, data)
    print(
        f"{found.evaluations} evaluations, {model.runs.computed} runs, {time.monotonic() - began:.0f} s"
    )
    for name, true in TRUTH.items():
        value, error = found.values[name], found.relative_errors[name]
        print(
            f"{name:12s} true {true:.4g}  found {value:.4g}  ({value / true - 1:+.1%}, standard error {error:.1%})"
        )
    print("unseen:", found.unseen or "nothing", " singular values:", found.singular_values)
    (folder / "twin.json").write_text(json.dumps({"truth": TRUTH, **found.as_dict()}, indent=1))


main()
