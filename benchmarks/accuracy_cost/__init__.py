# SPDX-License-Identifier: GPL-2.0-or-later
"""What accuracy costs in time: error against processor time, for each knob that buys accuracy."""
