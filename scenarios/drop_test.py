# SPDX-License-Identifier: GPL-2.0-or-later
"""Drop a projectile on sand: yade -j2 -n -x scenarios/drop_test.py --preset m70-full

Under yade-batch the columns of the parameter table are the options, with underscores for dashes:

    yade-batch table.txt scenarios/drop_test.py
"""

import grainfall  # noqa: F401  registers the classes
from grainfall.command_line import run_script
from grainfall.drop import drop_test
from grainfall.drop.parameters import TABLE

EPILOG = (
    "Lengths in m, masses in kg, times in s, stresses in Pa, angles in degrees.\n"
    "Results: summary.json, trace.csv, trace.h5, plots/, bed_forces.png, vtk/, summary.html."
)

run_script(
    TABLE,
    __doc__.splitlines()[0],
    EPILOG,
    drop_test,
    "stopped while the bed was prepared: nothing to resume",
)
