# SPDX-License-Identifier: GPL-2.0-or-later
"""What every test inside YADE needs: Grainfall registered before it imports, and a fresh scene."""
from __future__ import annotations

from collections.abc import Iterator

import pytest

try:
    import yade
except (
    ImportError
) as error:  # the distribution's yade package sets the path only for its own start script
    raise pytest.UsageError(
        "these tests run inside YADE: yade -n -x tests/run_in_yade.py -- <pytest arguments>"
    ) from error

import grainfall  # noqa: F401  registers GrainMat and its fellows in the running YADE


@pytest.fixture(autouse=True)
def fresh_scene() -> Iterator[None]:
    """Start and leave each test with an empty scene: no bodies, engines, materials, energies."""
    yade.O.reset()
    yield
    yade.O.reset()
