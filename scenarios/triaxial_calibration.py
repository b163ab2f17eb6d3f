# SPDX-License-Identifier: GPL-2.0-or-later
"""Cycle a triaxial sample of sand: yade -j2 -n -x scenarios/triaxial_calibration.py --preset crrel

Under yade-batch the columns of the parameter table are the options, with underscores for dashes:

    yade-batch table.txt scenarios/triaxial_calibration.py
"""

import os
import sys

from yade import utils

import grainfall  # noqa: F401  registers the classes
from grainfall.batch import batch_row
from grainfall.triaxial import OptionError, triaxial_test
from grainfall.triaxial.parameters import TABLE

EPILOG = (
    "Lengths in m, stresses in Pa, frequencies in Hz, times in s.\n"
    "Results: summary.json, loops_*.csv, loops.h5, plots/, summary.html."
)


def main() -> int:
    """Read options, run, report; the exit code says how it went."""
    parser = TABLE.parser(__doc__.splitlines()[0], EPILOG)
    try:
        if utils.runningInBatch():
            given = batch_row(TABLE.by_name)
        else:
            given = vars(parser.parse_args(sys.argv[1:]))
        summary = triaxial_test(**given)
    except (OptionError, ValueError) as error:
        print(f"triaxial_calibration.py: error: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print(
            "triaxial_calibration.py: stopped before the first cycle: nothing to resume",
            file=sys.stderr,
        )
        return 130
    return 130 if summary["interrupted"] else 0


exit_code = main()
if exit_code:
    sys.stdout.flush()
    os._exit(exit_code)
