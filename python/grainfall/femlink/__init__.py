# SPDX-License-Identifier: GPL-2.0-or-later
"""Deformable wall: an elastic continuum, held at its outer boundary, that grains touch at its surface.

The continuum is built once and condensed to its surface; the result is kept in a file::

    from grainfall import femlink
    mesh = femlink.container(cavity=(0.3, 0.15, 0.3), thickness=0.3, element=0.015)
    model = femlink.cached_wall(mesh, {0: (20e6, 0.3, 1600)})
    wall = femlink.Wall(model)

Only what builds a continuum (:class:`Continuum`, :func:`read_gmsh`) loads deal.II, at first use; a wall from a
file does without.
"""
from __future__ import annotations

from typing import Any

from grainfall.femlink._wall import (
    ClosestPoint,
    ExplicitContinuum,
    Feature,
    HexMesh,
    Solid,
    Surface,
    Wall,
    WallModel,
    box,
    closest_point,
    contact_axes,
    container,
    disc_compliance,
    half_space_block,
    load_wall,
)
from grainfall.femlink.cache import cached_wall
from grainfall.femlink.output import write_vtu
from grainfall.femlink.scene import add_explicit_wall, add_wall, functors

__all__ = [
    "ClosestPoint",
    "Continuum",
    "ExplicitContinuum",
    "Feature",
    "Field",
    "HexMesh",
    "Solid",
    "Surface",
    "Wall",
    "WallModel",
    "add_explicit_wall",
    "add_wall",
    "box",
    "cached_wall",
    "closest_point",
    "contact_axes",
    "container",
    "disc_compliance",
    "functors",
    "half_space_block",
    "load_wall",
    "read_gmsh",
    "write_vtu",
]

_NEEDS_DEALII = ("Continuum", "Field", "read_gmsh")


def __getattr__(name: str) -> Any:
    """Load deal.II for the names that need it."""
    if name not in _NEEDS_DEALII:
        raise AttributeError(f"module 'grainfall.femlink' has no attribute '{name}'")
    try:
        from grainfall.femlink import _continuum
    except ImportError as error:
        raise ImportError(
            f"grainfall.femlink.{name} needs deal.II: install Debian's package 'libdeal.ii-dev' and "
            f"build Grainfall anew; walls kept in files can be used without it ({error})"
        ) from error
    return getattr(_continuum, name)
