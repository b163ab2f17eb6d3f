# SPDX-License-Identifier: GPL-2.0-or-later
"""Run by test_energy_ledger.py with one and with two threads: writes the energies of a shaken box as JSON.

usage: PYTHONPATH=build/python:tests/physics yade -n -x [-j2] energy_pack.py <output.json>
"""
from __future__ import annotations

import json
import sys
from pathlib import Path

import grainfall  # noqa: F401
import ledger_scenes as scenes
from yade import O

ledger = scenes.shaken_box(0.4, grains_per_side=11, duration=0.008)
Path(sys.argv[-1]).write_text(
    json.dumps({"threads": O.numThreads, "contacts": O.interactions.countReal(), **ledger.table()}),
    encoding="utf-8",
)
