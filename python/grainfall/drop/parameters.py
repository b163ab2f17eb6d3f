# SPDX-License-Identifier: GPL-2.0-or-later
"""Parameters and presets of the drop test."""
from __future__ import annotations

import math
from typing import Any

from grainfall.drop import far_field_options
from grainfall.drop.checks import CHECKS
from grainfall.options import Option, OptionTable
from grainfall.run_notes import ENERGY_LIMIT
from grainfall.sand_options import LAWS, SAND

# Section 3.3: box 30 cm long, 15 cm wide, 30 cm high; replicas dropped 24 in (0.61 m) on ASTM 20-30 sand,
# whose grains of 0.72 mm (mean of its sieves 0.60 and 0.85 mm) are coarsened here to a number that can be run.
_CRREL_DROP = {
    "drop_height": 0.61,
    "box_length": 0.30,
    "box_width": 0.15,
    "bed_depth": 0.30,
    "grain_density": 2650.0,
    "poisson": 0.2,
    "friction": "cole",
    "reference_diameter": 0.72e-3,
    "duration": 0.4,
}

PRESETS: dict[str, dict[str, Any]] = {
    "m70-full": {
        **_CRREL_DROP,
        "profile": "m70_full",
        "mass": 0.40964,
        "grain_diameter": 8e-3,
        "young": 5e8,
    },
    "m70-half": {
        **_CRREL_DROP,
        "profile": "m70_half",
        "mass": 0.05119,
        "grain_diameter": 6e-3,
        "young": 5e8,
    },
    # Table 1. Not in the report and chosen here: the box (three diameters wide; 50 000 grains then stand
    # 0.19 m deep), solid fraction, friction and restitution.
    "table1": {
        "profile": "table1",
        "mass": 10.0,
        "impact_speed": 2.0,
        "grain_diameter": 5e-3,
        "grain_spread": 0.0,
        "grains": 50_000,
        "grain_density": 1.0e-3 / (math.pi / 6 * 5e-3**3),
        "young": 2 * 1e9 * (1 + 0.4),
        "poisson": 0.4,
        "friction": "0.5",
        "reference_diameter": 0.0,
        "time_step": 1e-5,
        "box_length": 0.17,
        "box_width": 0.17,
        "bed_depth": 0.19,
        "duration": 0.1,
    },
}

# For `make demo`: grains that 2 slow cores can push through a whole drop in two minutes.
QUICK = {"grain_diameter": 12e-3, "young": 2e8, "bed_depth": 0.2}

RUN = (
    Option("preset", "m70-full", "which drop", kind=str, choices=tuple(PRESETS)),
    Option("quick", False, "coarse and soft grains: the whole run in a few minutes", kind=bool),
    Option(
        "output",
        "",
        "folder for results (default: results/<preset>; under yade-batch one folder a table row)",
        kind=str,
        runtime=True,
    ),
    Option("resume", "", "continue the run of this results folder", kind=str, runtime=True),
    Option("seed", 1, "seed of the packing", kind=int, low=0),
    Option(
        "duration",
        0.4,
        "end of the simulation, if the projectile is not at rest before",
        "s",
        low=0,
        open_low=True,
        runtime=True,
    ),
    Option(
        "rest_speed",
        0.01,
        "the run ends when the nose sinks slower than this over 10 ms",
        "m/s",
        low=0,
        runtime=True,
    ),
    Option(
        "record_interval", 1e-4, "time between two rows of the trace", "s", low=0, open_low=True
    ),
    Option(
        "checkpoint_interval",
        0.02,
        "simulated time between two states to resume from",
        "s",
        low=0,
        open_low=True,
    ),
    Option(
        "vtk_interval",
        0.005,
        "simulated time between two sets of files for ParaView, 0 for none",
        "s",
        low=0,
        runtime=True,
    ),
    ENERGY_LIMIT,
    Option("no_energy", False, "book no energies: faster, no energy residual", kind=bool),
    Option("no_plots", False, "write no pictures and no HTML page", kind=bool, runtime=True),
    Option("quiet", False, "no progress bar and no printed summary", kind=bool, runtime=True),
)

PROJECTILE = (
    Option(
        "profile",
        "m70_full",
        "shape: m70_full, m70_half, table1; ogive, cone, hemisphere, flat-cylinder or sphere with "
        ":NAME=METRES,... ; or a CSV file of vertices z,r,bulge",
        kind=str,
    ),
    Option("mass", 0.40964, "mass of the projectile", "kg", low=0, open_low=True),
    Option("drop_height", None, "height of free fall above the surface", "m", low=0, high=100),
    Option(
        "impact_speed",
        None,
        "speed at the surface, instead of a drop height",
        "m/s",
        low=0,
        high=100,
    ),
    Option("tilt_degrees", 0.0, "angle of the axis to the vertical", "degrees", low=-90, high=90),
    Option("spin", 0.0, "rotation about its own axis", "rad/s"),
    Option("offset_x", 0.0, "point of impact along the box, from the middle", "m"),
    Option("offset_y", 0.0, "point of impact across the box, from the middle", "m"),
    Option(
        "projectile_young",
        2.5e9,
        "Young's modulus of the projectile (printed plastic)",
        "Pa",
        low=1e4,
        high=1e13,
    ),
    Option("projectile_poisson", 0.35, "its Poisson's ratio", "-", low=0, high=0.499),
    Option("projectile_friction", 0.3, "friction of grains on the projectile", "-", low=0, high=5),
    Option(
        "projectile_restitution",
        0.6,
        "coefficient of restitution, grain on projectile",
        "-",
        low=0.01,
        high=1,
    ),
)

BED = (
    Option("box_length", 0.30, "inside of the box along x", "m", low=0, open_low=True),
    Option("box_width", 0.15, "inside of the box along y", "m", low=0, open_low=True),
    Option("bed_depth", 0.30, "depth of the sand", "m", low=0, open_low=True),
    Option("wall_friction", 0.3, "friction of grains on the box", "-", low=0, high=5),
    Option(
        "grains",
        0,
        "number of grains; 0: as many as fill the bed's depth",
        kind=int,
        low=0,
        high=10_000_000,
    ),
    Option(
        "solid_fraction", 0.6, "packed volume over volume, before settling", "-", low=0.4, high=0.64
    ),
    Option(
        "bed",
        "",
        "name under which the bed is kept, instead of one made of its parameters",
        kind=str,
    ),
    Option("bed_cache", "", "folder of prepared beds (default: ~/.cache/grainfall/beds)", kind=str),
)

NUMERICS = (
    Option(
        "time_step_control",
        None,
        "rayleigh: --dt-safety times the smallest grain's Rayleigh step; hertz: HertzTimeStepper with "
        "--dt-safety times the critical step of the moment; fixed: --time-step (without this option: fixed "
        "where a time step is given, else rayleigh)",
        kind=str,
        choices=("rayleigh", "hertz", "fixed"),
    ),
    Option(
        "dt_safety",
        0.15,
        "time step over the Rayleigh step of the smallest grain, or over the critical step with "
        "--time-step-control hertz",
        "-",
        low=0.001,
        high=1,
    ),
    Option("time_step", None, "fixed time step, instead of --dt-safety", "s", low=0, open_low=True),
    *LAWS,
)

TABLE = OptionTable(
    {
        "run": RUN,
        "sand": SAND,
        "projectile": PROJECTILE,
        "box and bed": BED,
        "far field": far_field_options.FAR_FIELD,
        "numerics": NUMERICS,
    },
    PRESETS,
    (*far_field_options.CHECKS, *CHECKS),
    prog="drop_test.py",
)
