# SPDX-License-Identifier: GPL-2.0-or-later
"""Time of a step: stock YADE, Grainfall's two paths, LAMMPS, LIGGGHTS and the bare kernel on one bed."""
