# SPDX-License-Identifier: GPL-2.0-or-later
"""Where the tests of the binary interface find what the build made for them."""
from __future__ import annotations

import os
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BUILD = Path(os.environ.get("GRAINFALL_BUILD_DIR", ROOT / "build"))
for folder in (BUILD / "tests" / "abi", Path(__file__).parent):
    if str(folder) not in sys.path:
        sys.path.insert(0, str(folder))

import abi_probe  # noqa: E402

abi_probe.register_classes()
