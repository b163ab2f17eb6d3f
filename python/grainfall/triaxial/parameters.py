# SPDX-License-Identifier: GPL-2.0-or-later
"""Parameters and presets of the cyclic triaxial test."""
from __future__ import annotations

from typing import Any

from grainfall.options import Option, OptionTable
from grainfall.run_notes import ENERGY_LIMIT
from grainfall.sand_options import LAWS, SAND
from grainfall.triaxial.checks import CHECKS
from grainfall.triaxial.membrane import RubberTube

#: Section 3.2.1: size of the sample [m] and bound of the peak-to-peak displacement [m].
REPORT_DIAMETER, REPORT_HEIGHT, REPORT_PEAK_TO_PEAK = 36e-3, 85e-3, 500e-9

# ASTM 20-30 sand: 0.72 mm is the mean of its sieves 0.60 and 0.85 mm; quartz (70 GPa) is softened tenfold.
_SAND = {
    "grain_spread": 0.15,
    "grain_density": 2650.0,
    "young": 7e9,
    "poisson": 0.2,
    "restitution": 0.8,
    "friction": "cole",
    "reference_diameter": 0.72e-3,
    # The incremental law lets go of shear energy in every cycle (docs/triaxial.md).
    "tangential_law": "mindlin-deresiewicz",
}

PRESETS: dict[str, dict[str, Any]] = {
    "crrel": {
        **_SAND,
        "diameter": REPORT_DIAMETER,
        "height": REPORT_HEIGHT,
        "grain_diameter": 5e-3,
    },
    "small": {**_SAND, "diameter": 9e-3, "height": 21e-3, "grain_diameter": 1.5e-3},
}

RUN = (
    Option("preset", "crrel", "which sample", kind=str, choices=tuple(PRESETS)),
    Option(
        "output",
        "",
        "folder for results (default: results/triaxial-<preset>; under yade-batch one folder a table row)",
        kind=str,
        runtime=True,
    ),
    Option("resume", "", "continue the run of this results folder", kind=str, runtime=True),
    Option("seed", 1, "seed of the packing", kind=int, low=0),
    Option(
        "sample_cache",
        "",
        "folder of prepared samples (default: ~/.cache/grainfall/samples)",
        kind=str,
    ),
    ENERGY_LIMIT,
    Option("no_energy", False, "book no energies: faster, no energy residual", kind=bool),
    Option("no_plots", False, "write no pictures and no HTML page", kind=bool, runtime=True),
    Option("quiet", False, "no progress bar and no printed summary", kind=bool, runtime=True),
)

SAMPLE = (
    Option("diameter", 36e-3, "diameter of the sample", "m", low=0, open_low=True),
    Option("height", 85e-3, "height of the sample", "m", low=0, open_low=True),
    Option(
        "void_ratio",
        0.62,
        "volume of voids over volume of grains after preparation",
        "-",
        low=0.5,
        high=0.9,
    ),
    Option("platen_young", 69e9, "Young's modulus of the platens (aluminium)", "Pa", low=1e4),
    Option("platen_poisson", 0.33, "their Poisson's ratio", "-", low=0, high=0.499),
    Option("platen_friction", 0.3, "friction of grains on the platens", "-", low=0, high=5),
    Option("gravity", False, "the grains have weight", kind=bool),
)

#: Thickness of a latex membrane for samples of the report's diameter [m]: below 1 % of the diameter, ASTM D4767.
LATEX_THICKNESS = 0.3e-3

MEMBRANE = (
    Option(
        "membrane_young",
        1.4e6,
        "Young's modulus of the membrane (latex, ASTM D4767)",
        "Pa",
        low=0,
        open_low=True,
        high=1e9,
    ),
    Option(
        "membrane_thickness",
        None,
        "thickness of the membrane, whose tension adds to the cell pressure; 0: only the cell pressure acts (default: "
        "0.3e-3 on 36 mm, in proportion to the diameter)",
        "m",
        low=0,
        high=5e-3,
    ),
    Option(
        "membrane_fit",
        0.95,
        "diameter of the unstretched membrane over that of the sample (ASTM D4767: 0.90 to 0.95)",
        "-",
        low=0.5,
        high=1,
    ),
)

LOADING = (
    Option("confinement", 20e3, "cell pressure; 0 for none", "Pa", low=0, high=200e3),
    *MEMBRANE,
    Option(
        "axial_stress",
        None,
        "axial stress at which the sample is held in the cyclic stage; preloading goes as far above it as without this "
        "option (default: stress_ratio times the lateral stress of cell and membrane)",
        "Pa",
        low=0,
        open_low=True,
        high=600e3,
    ),
    Option(
        "stress_ratio",
        1.2,
        "axial over lateral stress at which the sample is held in the cyclic stage",
        "-",
        low=0.5,
        high=3,
    ),
    Option(
        "preload_ratio",
        1.4,
        "axial over lateral stress that preloading goes up to before it returns to the stress ratio",
        "-",
        low=0.5,
        high=3,
    ),
    Option(
        "preload_friction",
        None,
        "constant friction during preloading, with restitution 0.8, so that runs of different friction, damping or "
        "moisture start from the same state (default: the sand's own)",
        "-",
        low=0,
        high=5,
    ),
    Option(
        "frequencies",
        "10,20,40,80,150",
        "frequencies, tested one after the other, each between 1 and 1000",
        "Hz",
        kind=str,
    ),
    Option("multisine", False, "test all frequencies at once, each with its share", kind=bool),
    Option(
        "peak_to_peak",
        None,
        "peak-to-peak displacement of the upper platen (default: 400e-9 on 85 mm, in proportion to the height)",
        "m",
        low=0,
        open_low=True,
    ),
    Option(
        "reference_young",
        70e9,
        "Young's modulus of the real grains: with softer ones the displacement is enlarged by "
        "(reference/young)^(2/3), so that contacts come as near to slip as the real ones; 0 for none",
        "Pa",
        low=0,
        high=1e13,
    ),
    Option(
        "least_cycles", 3, "cycles at each frequency after the first", kind=int, low=2, high=1000
    ),
    Option("most_cycles", 8, "cycles after which to stop waiting", kind=int, low=2, high=1000),
    Option(
        "steady_change",
        0.002,
        "relative change of k + i w b from one cycle to the next that counts as steady",
        "-",
        low=0,
        open_low=True,
        high=1,
    ),
)

NUMERICS = (
    Option(
        "dt_safety",
        0.4,
        "time step over the largest that the stiffness of the contacts allows",
        "-",
        low=0.001,
        high=0.9,
    ),
    *LAWS,
)

TABLE = OptionTable(
    {
        "run": RUN,
        "sand": SAND,
        "sample": SAMPLE,
        "loading": LOADING,
        "numerics": NUMERICS,
    },
    PRESETS,
    CHECKS,
    prog="triaxial_calibration.py",
)


def softness(parameters: dict[str, Any]) -> float:
    """Modulus of the simulated grains over that of the real ones; 1 where no reference is given."""
    reference = parameters["reference_young"]
    return parameters["young"] / reference if reference else 1.0


def real_peak_to_peak(parameters: dict[str, Any]) -> float:
    """Peak-to-peak displacement [m] of the real grains' sample of this size."""
    given = parameters["peak_to_peak"]
    strain = 0.8 * REPORT_PEAK_TO_PEAK / REPORT_HEIGHT
    return given if given is not None else strain * parameters["height"]


def peak_to_peak(parameters: dict[str, Any]) -> float:
    """Peak-to-peak displacement [m] that the simulated sample gets."""
    return real_peak_to_peak(parameters) * softness(parameters) ** (-2 / 3)


def rubber_tube(parameters: dict[str, Any], diameter: float) -> RubberTube:
    """The membrane that is drawn over a sample of this diameter [m]."""
    p = parameters
    thickness = p["membrane_thickness"]
    if thickness is None:
        thickness = LATEX_THICKNESS / REPORT_DIAMETER * p["diameter"]
    return RubberTube(p["membrane_young"], thickness, 0.5 * diameter * p["membrane_fit"])


def frequency_list(parameters: dict[str, Any]) -> list[float]:
    """Frequencies [Hz]; the checks have read them before."""
    return [float(text) for text in parameters["frequencies"].split(",")]
