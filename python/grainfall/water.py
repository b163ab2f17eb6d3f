# SPDX-License-Identifier: GPL-2.0-or-later
"""Where the water of a scene is, for summaries."""
from __future__ import annotations

import builtins


def water_budget() -> dict[str, float]:
    """Where the water is now, volumes at the size of the simulated grains; asks the law labelled ``contact_law``."""
    budget = builtins.contact_law.water()
    return {
        "total_m3": budget["total"],
        "in_bridges_m3": budget["inBridges"],
        "on_grains_m3": budget["onGrains"],
        "bridges": budget["bridges"],
        "mean_bridge_volume_over_radius_cubed": budget["meanRelativeVolume"],
        "share_beyond_pendular": budget["beyondPendular"],
        "share_beyond_range_of_force": budget["beyondFit"],
        "overdrawn_grains": budget["overdrawnGrains"],
    }
