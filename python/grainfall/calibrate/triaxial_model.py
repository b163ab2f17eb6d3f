# SPDX-License-Identifier: GPL-2.0-or-later
"""The simulated triaxial test as a model to calibrate: contact parameters in, k and b out."""
from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from grainfall.calibrate.run_cache import RunCache

#: Parameters that are parts of a friction curve; the others are options of the scenario by their own names.
CURVE = ("mu0", "muInf", "loadScale")
#: A parameter ``moisture_factor@0.023`` is the factor on friction at that gravimetric moisture.
FACTOR = "moisture_factor@"


def triaxial_model(
    folder: Path | str, **options: Any
) -> Callable[
    [Mapping[str, float], list[tuple[float, list[float]]]],
    dict[tuple[float, float], tuple[float, float]],
]:
    """A model for `calibrate`: runs the triaxial test for each moisture and keeps the runs.

    Parameters
    ----------
    folder : Path or str
        Where runs are kept. Calling again with the same folder finds what was run before.
    **options
        Options of ``scenarios/triaxial_calibration.py`` that are the same in all runs.

    Returns
    -------
    callable
        Of parameter values and conditions; its attribute ``runs`` is the `RunCache`. Names of parameters:
        ``friction`` (constant); ``mu0``, ``muInf``, ``loadScale`` together (exponential curve);
        ``moisture_factor@W`` (factor on friction at moisture W); any numeric option such as ``restitution`` or
        ``young``. k and b are those of the report's sample with the real grains' modulus (``equivalent_...`` in the
        summary).
    """
    runs = RunCache(_run, Path(folder))

    def model(
        values: Mapping[str, float], conditions: list[tuple[float, list[float]]]
    ) -> dict[tuple[float, float], tuple[float, float]]:
        modelled = {}
        for moisture, frequencies in conditions:
            row = {**options, **sand(values, moisture)}
            row["frequencies"] = ",".join(f"{frequency:g}" for frequency in frequencies)
            for frequency, stiffness, damping in runs(row):
                modelled[moisture, _nearest(frequency, frequencies)] = (stiffness, damping)
        return modelled

    model.runs = runs  # type: ignore[attr-defined]
    return model


def sand(values: Mapping[str, float], moisture: float) -> dict[str, Any]:
    """Options of the scenario for these parameter values at this moisture."""
    own = {
        name: float(value)
        for name, value in values.items()
        if name not in CURVE and not name.startswith(FACTOR)
    }
    curve = [name for name in CURVE if name in values]
    if curve and len(curve) < len(CURVE):
        missing = [name for name in CURVE if name not in values]
        raise ValueError(
            f"{', '.join(curve)} without {', '.join(missing)}: estimate or fix all three of an exponential curve"
        )
    if curve:
        pairs = ",".join(f"{name}={values[name]:.10g}" for name in CURVE)
        own["friction"] = f"exponential:{pairs}"
    elif "friction" in own:
        own["friction"] = f"{own['friction']:.10g}"
    factors = {
        float(name[len(FACTOR) :]): v for name, v in values.items() if name.startswith(FACTOR)
    }
    if factors:
        points = sorted({0.0: 1.0, **factors}.items())
        own["moisture_factor"] = ",".join(f"{w:g}:{factor:.10g}" for w, factor in points)
    own["moisture"] = moisture
    return own


def _run(options: dict[str, Any], folder: Path) -> list[tuple[float, float, float]]:
    """One triaxial test: (frequency, k, b) of each frequency."""
    from grainfall.triaxial import triaxial_test

    summary = triaxial_test(**{"no_plots": True, "quiet": True, **options, "output": str(folder)})
    if summary["interrupted"]:
        raise KeyboardInterrupt
    names = ("frequency_Hz", "equivalent_stiffness_N_per_m", "equivalent_damping_N_s_per_m")
    return list(zip(*(summary[name] for name in names)))


def _nearest(frequency: float, frequencies: list[float]) -> float:
    return min(frequencies, key=lambda one: abs(one - frequency))
