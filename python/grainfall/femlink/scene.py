# SPDX-License-Identifier: GPL-2.0-or-later
"""A deformable wall in a YADE scene."""
from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from grainfall.femlink import _wall
from grainfall.femlink.cache import wall_path


def add_wall(
    wall: _wall.WallModel | Path | str,
    material: Any,
    cache: Path | str = "",
    origin: Sequence[float] = (0.0, 0.0, 0.0),
    color: tuple[float, float, float] = (0.6, 0.5, 0.4),
    **attributes: Any,
) -> Any:
    """Put a wall's faces into the scene and make the engine that moves them.

    Parameters
    ----------
    wall : WallModel, or path of a wall file
        A model that is in no file yet is written into the folder of kept walls, because the scene refers to the file.
    material : Material, or its label or id
        Of the faces, as contacts with grains see it: stiff (1000 times a grain's modulus) where the wall's own
        compliance is to supply the indentation, the wall's own moduli where faces are much larger than contacts.
    cache : path
        Folder of kept walls; default: ~/.cache/grainfall/walls.
    origin : (3,) float, m
        Where the mesh's origin lies in the scene.
    color
        Of the faces.
    attributes
        Of :yref:`FemWall`.

    Returns
    -------
    FemWall
        To be placed in ``O.engines`` between the collider and the interaction loop.

    Raises
    ------
    RuntimeError
        If the file cannot be read.
    ValueError
        If the model has no key.
    """
    import yade.wrapper as w

    model, file = _model_and_file(wall, cache)
    faces = _add_faces(model.surface, model.preload, material, origin, color)
    return w.FemWall(file=str(file), faces=faces, shift=tuple(origin), **attributes)


def add_explicit_wall(
    mesh: _wall.HexMesh,
    solids: Mapping[int, _wall.Solid],
    material: Any,
    element: str = "gauss",
    outer: str = "fixed",
    safety: float = 0.9,
    hourglass: float = 1.0,
    gravity: Sequence[float] = (0.0, 0.0, 0.0),
    origin: Sequence[float] = (0.0, 0.0, 0.0),
    color: tuple[float, float, float] = (0.6, 0.5, 0.4),
    **attributes: Any,
) -> Any:
    """Put the faces of a continuum with inertia into the scene and make the engine that moves it.

    Parameters
    ----------
    mesh, solids, element, outer, safety, hourglass, gravity
        As of :class:`grainfall.femlink.ExplicitContinuum`.
    material, origin, color, attributes
        As of :func:`add_wall`. ``interval``: the continuum is moved on in every n-th step.

    Returns
    -------
    FemWall
        Its `continuum` tells step and energies.

    Raises
    ------
    ValueError
        If mesh, solids or options are wrong.
    """
    import yade.wrapper as w

    surface = _wall.ExplicitContinuum(
        mesh, dict(solids), element, outer, safety, hourglass, gravity=gravity
    ).surface
    field = w.ExplicitFarField(
        vertices=[tuple(v) for v in mesh.vertices],
        cells=[int(n) for cell in mesh.cells for n in cell],
        regions=[int(n) for n in mesh.regions],
        boundary=[
            int(n)
            for corners, name in zip(mesh.boundary_corners, mesh.boundary_ids)
            for n in (*corners, name)
        ],
        solids=[n for region, solid in solids.items() for n in (float(region), *solid.numbers)],
        element=element,
        outer=outer,
        safety=safety,
        hourglass=hourglass,
        gravity=tuple(gravity),
    )
    faces = _add_faces(surface, np.zeros_like(surface.nodes), material, origin, color)
    return w.FemWall(continuum=field, faces=faces, shift=tuple(origin), **attributes)


def functors() -> tuple[list[Any], list[Any], list[Any]]:
    """What a wall needs of the collider (bounding) and of the interaction loop (geometry, law)."""
    import yade.wrapper as w

    return (
        [w.Bo1_FemFace_Aabb()],
        [w.Ig2_FemFace_Sphere_ScGeom()],
        [w.Law2_FemGeom_GrainPhys_HertzMindlin()],
    )


def _model_and_file(
    wall: _wall.WallModel | Path | str, cache: Path | str
) -> tuple[_wall.WallModel, Path]:
    if not isinstance(wall, _wall.WallModel):
        return _wall.load_wall(str(wall)), Path(wall).resolve()
    if not wall.key:
        raise ValueError(
            "wall.key = '': must be that of a model made by Continuum.condense or cached_wall; write another one "
            "with WallModel.save and pass the path"
        )
    path = wall_path(wall.key, cache)
    if not path.exists():
        path.parent.mkdir(parents=True, exist_ok=True)
        wall.save(str(path))
    return wall, path


def _in_scene(material: Any) -> Any:
    """The material itself, known to the scene."""
    import yade.wrapper as w

    materials = w.Omega().materials
    if isinstance(material, (str, int)):
        return materials[material]
    if material.id < 0:
        materials.append(material)
    return material


def _add_faces(
    surface: _wall.Surface,
    displacement: np.ndarray,
    material: Any,
    origin: Sequence[float],
    color: tuple[float, float, float],
) -> list[int]:
    """Bodies of shape FemFace for all faces of a surface; their ids."""
    import yade.wrapper as w

    material = _in_scene(material)
    nodes = surface.nodes + displacement + np.asarray(origin, dtype=float)
    faces = []
    for corners in surface.faces:
        body = w.Body(material=material)
        body.shape = w.FemFace(nodes=[tuple(nodes[n]) for n in corners], color=color, wire=True)
        body.state.pos = tuple(nodes[corners].mean(axis=0))
        body.dynamic = False
        body.aspherical = False
        faces.append(w.Omega().bodies.append(body))
    return faces
