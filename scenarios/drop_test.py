# SPDX-License-Identifier: GPL-2.0-or-later
"""Drop a projectile on sand: yade -j2 -n -x scenarios/drop_test.py --preset m70-full

Under yade-batch the columns of the parameter table are the options, with underscores for dashes:

    yade-batch table.txt scenarios/drop_test.py
"""

import os
import sys

from yade import utils

import grainfall  # noqa: F401  registers the classes
from grainfall.batch import batch_row
from grainfall.drop import OptionError, drop_test
from grainfall.drop.parameters import TABLE

EPILOG = (
    "Lengths in m, masses in kg, times in s, stresses in Pa, angles in degrees.\n"
    "Results: summary.json, trace.csv, trace.h5, plots/, bed_forces.png, vtk/, summary.html."
)


def main() -> int:
    """Read options, run, report; the exit code says how it went."""
    parser = TABLE.parser(__doc__.splitlines()[0], EPILOG)
    try:
        given = (
            batch_row(TABLE.by_name)
            if utils.runningInBatch()
            else vars(parser.parse_args(sys.argv[1:]))
        )
        summary = drop_test(**given)
    except (OptionError, ValueError) as error:
        print(f"drop_test.py: error: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print(
            "drop_test.py: stopped while the bed was prepared: nothing to resume", file=sys.stderr
        )
        return 130
    return 130 if summary["interrupted"] else 0


exit_code = main()
if exit_code:
    sys.stdout.flush()
    os._exit(exit_code)
