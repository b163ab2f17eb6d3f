# SPDX-License-Identifier: GPL-2.0-or-later
"""The projectile drop test of MR-2629, sections 3.3 and 4.2-4.3: `drop_test` runs one."""

from __future__ import annotations

from grainfall.drop.run import drop_test
from grainfall.options import OptionError

__all__ = ["OptionError", "drop_test"]
