# SPDX-License-Identifier: GPL-2.0-or-later
"""Sizes of the declared classes, compared with what the library asks operator new for."""
from __future__ import annotations

import json
import os
import subprocess

import pytest
from comparison import declared
from conftest import BUILD

# Sizes that follow from something else that is compared.
FOLLOWS = {
    "Factorable": "Serializable's size",
    "Indexable": "offset of the first member of Shape, Bound, Material, State",
    "ForceContainer": "offset of Scene.SpeedElements, which follows it",
    "TimingInfo": "offset of Engine.timingDeltas, which follows it",
    "DynlibDescriptor": "its two members; YADE keeps it by value in a map",
}
# Classes that are only called, never laid out: what is declared of them is the beginning at most.
NEVER_LAID_OUT = {"Omega", "Logging", "ClassFactory", "Mathr"}
SIZED = sorted(
    name
    for name in declared().classes
    if "<" not in name and name not in {*FOLLOWS, *NEVER_LAID_OUT}
)

SCRIPT = """
import ctypes, json, sys
sys.path[:0] = {path!r}
import abi_probe, yade.wrapper
requested = ctypes.CDLL(None).requested_bytes
requested.restype, requested.argtypes = ctypes.c_size_t, [ctypes.c_void_p]
O.reset()
parts = abi_probe.scene_parts()
sizes = dict()
for name in {names!r}:
    instance = None if name in parts else getattr(yade.wrapper, name)()
    sizes[name] = requested(parts[name] if name in parts else abi_probe.address(instance))
print("SIZES", json.dumps(sizes))
"""


@pytest.fixture(scope="module")
def allocated(tmp_path_factory) -> dict[str, int]:
    """Bytes that YADE requested for one object of each class, recorded in a process of its own."""
    script = tmp_path_factory.mktemp("sizes") / "sizes.py"
    script.write_text(
        SCRIPT.format(path=[str(BUILD / "tests" / "abi")], names=SIZED), encoding="utf-8"
    )
    recorder = BUILD / "tests" / "abi" / "liballocation_recorder.so"
    run = subprocess.run(
        ["yade", "-n", "-x", str(script)],
        env={**os.environ, "LD_PRELOAD": str(recorder)},
        capture_output=True,
        text=True,
        timeout=120,
    )
    line = next((ln for ln in run.stdout.splitlines() if ln.startswith("SIZES ")), None)
    assert line, run.stdout + run.stderr
    return json.loads(line.removeprefix("SIZES "))


@pytest.mark.parametrize("name", SIZED)
def test_our_class_is_as_large_as_the_object_that_yade_makes(name, allocated):
    assert declared().classes[name].size == allocated[name]
