# SPDX-License-Identifier: GPL-2.0-or-later
"""Does the boundary of the bed still influence a drop, and what does it cost to push it out?"""
