# SPDX-License-Identifier: GPL-2.0-or-later
"""YADE script: grains collide in a box under HertzTimeStepper; writes the steps it chose as JSON.

usage: yade -n -x [-j2] time_step_pack.py <output.json>
"""
import json
import sys
from pathlib import Path

sys.path.insert(0, str(Path(sys.argv[0]).resolve().parent))

import grainfall  # noqa: E402, F401
import time_step_scenes as ts  # noqa: E402
from yade import O  # noqa: E402

ts.add_colliding_grains()
engine = ts.set_engines(gravity=(0, 0, -9.81))
steps = []
for _ in range(12):
    O.run(20, True)
    steps.append(O.dt)
with open(sys.argv[1], "w", encoding="utf-8") as file:
    json.dump({"threads": O.numThreads, "steps": steps, "changes": engine.changes}, file)
