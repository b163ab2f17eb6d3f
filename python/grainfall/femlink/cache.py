# SPDX-License-Identifier: GPL-2.0-or-later
"""Walls kept on disk, so that the same mesh and materials are condensed once."""
from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from grainfall.femlink import _wall
from grainfall.store import cache_folder

# Raised when the discretisation changes, so that walls kept before are built anew.
_METHOD = 1


def wall_path(key: str, cache: Path | str = "") -> Path:
    """File of the wall with this key."""
    return cache_folder("walls", cache) / f"wall-{_METHOD}-{key}.gfw"


def cached_wall(
    mesh: _wall.HexMesh,
    materials: Mapping[int, tuple[float, float, float]],
    degree: int = 1,
    gravity: Sequence[float] = (0.0, 0.0, 0.0),
    surface_load: Sequence[float] = (0.0, 0.0, 0.0),
    cache: Path | str = "",
    solver: str = "auto",
    memory_limit: float = 0.0,
    progress: Callable[[float], None] | None = None,
) -> _wall.WallModel:
    """Condensed wall, from its file if there is one, else built (which loads deal.II) and written.

    Parameters
    ----------
    mesh
        Hexahedra with boundary ids.
    materials
        Young's modulus (Pa), Poisson's ratio and density (kg/m^3) by region.
    degree
        Of the shape functions, 1 or 2.
    gravity, surface_load : (3,) float
        m/s^2; Pa on the coupling surface. They preload the wall.
    cache
        Folder of kept walls; default: ~/.cache/grainfall/walls.
    solver, memory_limit
        As of :class:`grainfall.femlink.Continuum`.
    progress
        Told the share done (0 to 1) on the iterative path.
    """
    key = _wall.wall_key(mesh, dict(materials), degree, gravity, surface_load)
    path = wall_path(key, cache)
    if path.exists():
        return _wall.load_wall(str(path))
    from grainfall.femlink import Continuum

    continuum = Continuum(mesh, dict(materials), degree, solver, memory_limit)
    model = continuum.condense(gravity, surface_load, progress)
    path.parent.mkdir(parents=True, exist_ok=True)
    model.save(str(path))
    return model
