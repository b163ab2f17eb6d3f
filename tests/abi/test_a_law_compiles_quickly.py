# SPDX-License-Identifier: GPL-2.0-or-later
"""Price of a translation unit against yade-headers/."""
from __future__ import annotations

import resource
import subprocess
from pathlib import Path

import abi_build
import pytest
from declarations import FLAGS, HEADERS


@pytest.mark.parametrize(
    "source", ["laws/yade/GrainMat.cpp", "laws/yade/Law2_ScGeom_GrainPhys_HertzMindlin.cpp"]
)
def test_a_law_s_source_file_compiles_in_less_than_thirty_seconds(source, tmp_path):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(
        [abi_build.COMPILER, *FLAGS, "-O3", "-w", f"-I{HEADERS}", f"-I{abi_build.SOURCE_DIR}"]
        + ["-c", str(Path(abi_build.SOURCE_DIR) / source), "-o", str(tmp_path / "unit.o")],
        check=True,
    )
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    # Processor time, so that other work on the machine does not count.
    assert after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime < 30
