# SPDX-License-Identifier: GPL-2.0-or-later
"""The cyclic triaxial test of MR-2629, sections 3.2 and 4.1: `triaxial_test` runs one."""

from __future__ import annotations

from grainfall.options import OptionError
from grainfall.triaxial.run import triaxial_test

__all__ = ["OptionError", "triaxial_test"]
