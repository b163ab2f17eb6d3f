# SPDX-License-Identifier: GPL-2.0-or-later
"""The continuum around a bed, in the place of its rigid floor and walls (MR-2629, section 3.4).

The bed has come to rest in a rigid box. The box's planes become faces of the continuum, which take the contacts
over with their forces: the wall was there when the bed was poured, so it lies where it is under these forces, and
the bed stays at rest. The faces have the rigid walls' material: what lies behind them is sand of the same grains,
so that a grain's own indentation is that of a grain on a grain, and the continuum adds what is larger than a cell.
"""
from __future__ import annotations

import json
import math
import time
from collections.abc import Mapping
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import yade.wrapper
from yade import O, Vector3, utils

from grainfall.bed_scene import add_grains, restore_contacts, wall_planes
from grainfall.bed_stiffness import Moduli, bed_moduli
from grainfall.beds import Bed
from grainfall.constants import GRAVITY

#: Growth of the cells from one to the next, outwards: docs/physics/far_field.md.
RATIO = 1.3
#: Forces on the continuum are solved for to this share of the largest; the energy residual is the same from 1e-4 to
#: 1e-8.
TOLERANCE = 1e-5
#: Rigid screens above the continuum hold grains that fly [m].
SCREEN_HEIGHT, SCREEN_THICKNESS = 3.0, 0.1


@dataclass(frozen=True)
class Inertial:
    """An explicit continuum before it is in a scene."""

    mesh: Any
    solids: dict[int, Any]
    outer: str
    gravity: tuple[float, float, float]

    def body(self) -> Any:
        """ExplicitContinuum at rest."""
        from grainfall import femlink

        return femlink.ExplicitContinuum(
            self.mesh, self.solids, outer=self.outer, gravity=self.gravity
        )

    @property
    def surface(self) -> Any:
        """What the grains touch."""
        return self.body().surface


@dataclass(frozen=True)
class Continuum:
    """What the continuum of a run is, for its summary and for showing it later.

    Parameters
    ----------
    model : str
        'quasi-static' or 'explicit'.
    cavity : (float, float, float)
        Length, width and depth of the hole that the bed lies in [m]; its floor is at z = 0.
    thickness, element : float
        Reach beyond the cavity, size of cells at it [m].
    degree : int
        Of the shape functions.
    young, poisson, density : float
        [Pa], [-], [kg/m3].
    cells, unknowns, surface_unknowns, compliance_bytes : int
        Size; the compliance is what the run holds in memory.
    setup_seconds : float
        Building it and putting it into the scene.
    from_cache : bool
        Was it read from its file?
    outer : str
        Outer boundary.
    friction_angle, dilatancy : float
        [rad] of a continuum that yields; 0: it does not.
    """

    model: str
    cavity: tuple[float, float, float]
    thickness: float
    element: float
    degree: int
    young: float
    poisson: float
    density: float
    cells: int
    unknowns: int
    surface_unknowns: int
    compliance_bytes: int
    setup_seconds: float
    from_cache: bool
    outer: str = "fixed"
    friction_angle: float = 0.0
    dilatancy: float = 0.0

    def mesh(self) -> Any:
        """Its cells."""
        return _mesh(self.cavity, self.thickness, self.element)

    def materials(self) -> dict[int, tuple[float, float, float]]:
        """As `grainfall.femlink` takes them."""
        return {0: (self.young, self.poisson, self.density)}

    def with_inertia(self) -> Inertial:
        """Of an explicit model: what its engine is made from."""
        moduli = Moduli(self.young, self.poisson, self.density)
        return _inertial(self.mesh(), moduli, self.outer, self.friction_angle, self.dilatancy)

    def save(self, path: Path) -> None:
        """Write to a JSON file."""
        path.write_text(json.dumps(asdict(self), indent=1))

    @classmethod
    def load(cls, path: Path) -> Continuum:
        """Read what `save` wrote."""
        values = json.loads(path.read_text())
        return cls(**{**values, "cavity": tuple(values["cavity"])})


def add_bed_in_continuum(
    p: Mapping[str, Any], bed: Bed, sand: Any, wall: Any
) -> tuple[Continuum, Any]:
    """Add grains and screens to an empty scene; what is around them is condensed, or read.

    Returns
    -------
    tuple of Continuum and grainfall.femlink.WallModel or Inertial
        For `add_faces`, once the projectile has the body number that it has in a rigid box.
    """
    from grainfall import femlink
    from grainfall.femlink.cache import wall_path

    started = time.monotonic()
    explicit = p["far_field"] == "explicit"
    cavity = (p["box_length"], p["box_width"], cavity_depth(bed))
    thickness, element, degree = (
        p[f"far_field_{name}"] for name in ("thickness", "element", "degree")
    )
    moduli = _moduli(p, bed)
    mesh = _mesh(cavity, thickness, element)
    add_grains(bed, sand, wall)
    O.bodies.append(_screens(cavity, thickness, wall))
    if explicit:
        strength = {
            "friction_angle": p["far_field_friction_angle"] or 0.0,
            "dilatancy": p["far_field_dilatancy"],
        }
        model: Any = _inertial(mesh, moduli, p["far_field_outer"], **strength)
        held = sum(node < 0 for node in model.surface.loose)
        size = {
            "unknowns": 3 * (len(mesh.vertices) - held),
            "surface_unknowns": 3 * (len(model.surface.loose) - held),
            "compliance_bytes": 0,
            "from_cache": False,
            "outer": p["far_field_outer"],
            **strength,
        }
    else:
        materials = {0: (moduli.young, moduli.poisson, moduli.density)}
        key = femlink._wall.wall_key(mesh, materials, degree, (0, 0, 0), (0, 0, 0))
        cached = wall_path(key, p["far_field_cache"]).exists()
        model = femlink.cached_wall(mesh, materials, degree, cache=p["far_field_cache"])
        size = {
            "unknowns": int(model.description.split()[0]),
            "surface_unknowns": len(model.compliance),
            "compliance_bytes": model.compliance.nbytes,
            "from_cache": cached,
        }
    continuum = Continuum(
        p["far_field"],
        cavity,
        thickness,
        element,
        degree,
        *asdict(moduli).values(),
        cells=len(mesh.cells),
        setup_seconds=time.monotonic() - started,
        **size,
    )
    return continuum, model


def _inertial(
    mesh: Any, moduli: Moduli, outer: str, friction_angle: float, dilatancy: float
) -> Inertial:
    """Elastic, or with an angle of friction dry sand, which yields from its stress at rest."""
    from grainfall import femlink

    law, weight = {}, 0.0
    if friction_angle:
        law = {"law": "drucker-prager", "friction_angle": friction_angle, "dilatancy": dilatancy}
        weight = GRAVITY
    solid = femlink.Solid(*asdict(moduli).values(), **law)
    return Inertial(mesh, {0: solid}, outer, (0.0, 0.0, -weight))


def cavity_depth(bed: Bed) -> float:
    """Height of the continuum beside the bed [m]: that of its highest grain, up to whole grain diameters, so that
    beds of other seeds may have the same continuum."""
    top, diameter = float((bed.centres[:, 2] + bed.radii).max()), bed.spec.diameter
    return diameter * math.ceil(top / diameter)


def _moduli(p: Mapping[str, Any], bed: Bed) -> Moduli:
    """As given, else the bed's, rounded so that beds alike share a continuum."""
    own = bed_moduli(bed)
    rounded = {
        "young": float(f"{own.young:.1e}"),
        "poisson": round(own.poisson, 2),
        "density": float(f"{own.density:.1e}"),
    }
    given = {name: p[f"far_field_{name}"] for name in rounded}
    return Moduli(**{n: rounded[n] if given[n] is None else given[n] for n in rounded})


def _mesh(cavity: tuple[float, float, float], thickness: float, element: float) -> Any:
    """Cells around the cavity, its floor at z = 0."""
    from grainfall import femlink

    mesh = femlink.container(cavity, thickness, element, ratio=RATIO)
    mesh.vertices = mesh.vertices + np.array([0.0, 0.0, cavity[2]])
    return mesh


def _screens(cavity: tuple[float, float, float], thickness: float, material: Any) -> list[Any]:
    """In place of a box's five planes: screens on the continuum's rim, for grains that fly, and its rigid base."""
    x, y, z = cavity[0] / 2, cavity[1] / 2, cavity[2]
    half, tall = SCREEN_THICKNESS / 2, SCREEN_HEIGHT / 2
    shapes = [
        ((-x - half, 0, z + tall), (half, y + 2 * half, tall)),
        ((x + half, 0, z + tall), (half, y + 2 * half, tall)),
        ((0, -y - half, z + tall), (x, half, tall)),
        ((0, y + half, z + tall), (x, half, tall)),
    ]
    screens = [
        utils.box(place, extents, fixed=True, wire=True, material=material)
        for place, extents in shapes
    ]
    return [*screens, utils.wall(-thickness, 2, 1, material=material)]


def functors() -> tuple[list[Any], list[Any], list[Any]]:
    """Bounds, geometries and laws that faces and screens need."""
    from grainfall import femlink

    w = yade.wrapper
    bounds, geometries, laws = femlink.functors()
    return [*bounds, w.Bo1_Box_Aabb()], [*geometries, w.Ig2_Box_Sphere_ScGeom()], laws


def add_faces(p: Mapping[str, Any], model: Any) -> Any:
    """The continuum's faces in the scene, and the engine that moves them, labelled ``far_field``."""
    from grainfall import femlink

    attributes = {
        "interval": p["far_field_interval"],
        "tolerance": TOLERANCE,
        "label": "far_field",
    }
    if isinstance(model, Inertial):
        return femlink.add_explicit_wall(
            model.mesh,
            model.solids,
            "wall",
            outer=model.outer,
            gravity=model.gravity,
            **attributes,
        )
    return femlink.add_wall(model, "wall", cache=p["far_field_cache"], **attributes)


def restore_contacts_on_faces(bed: Bed, wall: Any, model: Any) -> None:
    """Give the scene the contacts that the bed was saved with, those with the rigid box on the faces in its place.

    To be called once engines and time step are set.
    """
    count = len(bed.radii)
    on_plane = np.any(bed.contacts >= count, axis=1)
    restore_contacts(replace(bed, contacts=bed.contacts[~on_plane], shear=bed.shear[~on_plane]))
    pairs, shear = bed.contacts[on_plane], bed.shear[on_plane]
    # Of forces on the grain, which may be either body.
    shear = np.where(pairs[:, :1] >= count, shear, -shear)
    grains, planes = pairs.min(axis=1), pairs.max(axis=1) - count
    faces = _faces_under(bed, model.surface, grains, planes)
    wall.takeOver(
        [wall.faces[face] for face in faces],
        grains.tolist(),
        [Vector3(*row) for row in shear.tolist()],
    )


def _faces_under(bed: Bed, surface: Any, grains: np.ndarray, planes: np.ndarray) -> np.ndarray:
    """Face of the wall under each contact of a grain with a plane of the box, shape (c,)."""
    corners = np.array(surface.nodes)[np.array(surface.faces)]
    low, high = corners.min(axis=1), corners.max(axis=1)
    found = np.empty(len(grains), dtype=int)
    for number, (position, axis, _) in enumerate(wall_planes(bed.spec)):
        slack = 1e-9 * bed.spec.length
        on_plane = np.flatnonzero(
            (np.abs(low[:, axis] - position) < slack) & (np.abs(high[:, axis] - position) < slack)
        )
        others = [other for other in range(3) if other != axis]
        for contact in np.flatnonzero(planes == number):
            centre = bed.centres[grains[contact]][others]
            beyond = np.maximum(
                low[on_plane][:, others] - centre, centre - high[on_plane][:, others]
            )
            found[contact] = on_plane[np.argmin(beyond.max(axis=1))]
    return found


def clearance(p: Mapping[str, Any], points: np.ndarray) -> float:
    """Least distance of points, shape (n, 3) [m], from the continuum around the box [m]."""
    half = np.array([p["box_length"], p["box_width"]]) / 2
    return float(min((half - np.abs(points[:, :2])).min(), points[:, 2].min()))
