# SPDX-License-Identifier: GPL-2.0-or-later
"""Cycle a triaxial sample of sand: yade -j2 -n -x scenarios/triaxial_calibration.py --preset crrel

Under yade-batch the columns of the parameter table are the options, with underscores for dashes:

    yade-batch table.txt scenarios/triaxial_calibration.py
"""

import grainfall  # noqa: F401  registers the classes
from grainfall.command_line import run_script
from grainfall.triaxial import triaxial_test
from grainfall.triaxial.parameters import TABLE

EPILOG = (
    "Lengths in m, stresses in Pa, frequencies in Hz, times in s.\n"
    "Results: summary.json, loops_*.csv, loops.h5, plots/, summary.html."
)

run_script(
    TABLE,
    __doc__.splitlines()[0],
    EPILOG,
    triaxial_test,
    "stopped before the first cycle: nothing to resume",
)
