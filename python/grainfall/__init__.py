# SPDX-License-Identifier: GPL-2.0-or-later
"""Grains with load- and moisture-dependent friction, and projectiles, for YADE.

Importing this package inside YADE registers its classes there, as if they were YADE's own::

    from yade import *
    import grainfall
    O.materials.append(GrainMat(young=70e9, poisson=0.2, label="sand"))
"""
from __future__ import annotations

from grainfall import _yade_guard

_yade_guard.require_verified_yade()

from grainfall import _build_info, _registration  # noqa: E402  the guard comes first

__version__: str = _build_info.PACKAGE_VERSION
CLASS_NAMES: tuple[str, ...] = _registration.register()

from grainfall.materials import check_scene, quartz_sand  # noqa: E402, F401
from grainfall.pricing import price  # noqa: E402, F401
