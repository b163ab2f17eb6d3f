# SPDX-License-Identifier: GPL-2.0-or-later
"""Constants of nature that several scenarios share."""
from __future__ import annotations

GRAVITY = 9.81  # m/s2
