# SPDX-License-Identifier: GPL-2.0-or-later
"""Fit contact parameters to measured k(f) and b(f):

    yade -j2 -n -x scenarios/calibrate_friction.py --measured FILE --fit friction=0.5:0.05:1.5

All options of triaxial_calibration.py apply to the runs of the model. Under yade-batch the columns of the parameter
table are the options, with underscores for dashes. Stopped with Ctrl-C and started again with the same --output it
goes on.
"""

import grainfall  # noqa: F401  registers the classes
from grainfall.calibrate.run import TABLE, calibrate_friction
from grainfall.command_line import run_script

EPILOG = (
    "The measured file is a CSV table with the columns moisture, frequency_Hz, stiffness_N_per_m, damping_N_s_per_m\n"
    "and, where known, stiffness_error_N_per_m and damping_error_N_s_per_m. Results: calibration.json, runs/."
)

run_script(
    TABLE,
    "Fit contact parameters to measured stiffness and damping.",
    EPILOG,
    calibrate_friction,
    "stopped; start again to go on",
)
