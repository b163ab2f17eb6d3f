# SPDX-License-Identifier: GPL-2.0-or-later
"""Fit contact parameters to measured k(f) and b(f):

    yade -j2 -n -x scenarios/calibrate_friction.py --measured FILE --fit friction=0.5:0.05:1.5

All options of triaxial_calibration.py apply to the runs of the model. Under yade-batch the columns of the parameter
table are the options, with underscores for dashes. Stopped with Ctrl-C and started again with the same --output it
goes on.
"""

import os
import sys

from yade import utils

import grainfall  # noqa: F401  registers the classes
from grainfall.batch import batch_row
from grainfall.calibrate.run import TABLE, calibrate_friction
from grainfall.options import OptionError

EPILOG = (
    "The measured file is a CSV table with the columns moisture, frequency_Hz, stiffness_N_per_m, damping_N_s_per_m\n"
    "and, where known, stiffness_error_N_per_m and damping_error_N_s_per_m. Results: calibration.json, runs/."
)


def main() -> int:
    """Read options, calibrate, report; the exit code says how it went."""
    parser = TABLE.parser("Fit contact parameters to measured stiffness and damping.", EPILOG)
    try:
        if utils.runningInBatch():
            given = batch_row(TABLE.by_name)
        else:
            given = vars(parser.parse_args(sys.argv[1:]))
        calibrate_friction(**given)
    except (OptionError, ValueError) as error:
        print(f"calibrate_friction.py: error: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("calibrate_friction.py: stopped; start again to go on", file=sys.stderr)
        return 130
    return 0


exit_code = main()
if exit_code:
    sys.stdout.flush()
    os._exit(exit_code)
