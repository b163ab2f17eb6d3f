# SPDX-License-Identifier: GPL-2.0-or-later
"""Projectiles as exact solids of revolution: presets, bodies for YADE, forces by zone.

    body = make_projectile("m70-full", nose_at=(0, 0, 0.31), velocity=(0, 0, -3.46))
    O.bodies.append(body)

Local z is the axis, the nose looks towards -z, the centroid is the body's position. Lengths in m,
masses in kg. Other outlines: see `projectile_outlines`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from .projectile_outlines import (
    Projectile,
    cone,
    flat_cylinder,
    hemisphere,
    ogive,
    require,
    sphere,
)

__all__ = [
    "PRESETS",
    "Projectile",
    "cone",
    "flat_cylinder",
    "hemisphere",
    "make_projectile",
    "ogive",
    "pointing",
    "projectile",
    "projectile_forces",
    "sphere",
]

_M70_SOURCE = (
    "Length, diameter and mass: MR-2629, section 3.3. Nose: assumed, no drawing of the 57 mm M70 "
    "shot was found: a tangent ogive of 1.5 calibres radius with a tip rounded to 0.05 calibres, a "
    "cylinder, a flat base; rotating band and tracer cavity left out."
)


def _m70(length: float, diameter: float, mass: float, name: str, source: str) -> Projectile:
    outline = ogive(diameter, length, calibre_radius_head=1.5, tip_radius=0.05 * diameter)
    return replace(outline, name=name, mass=mass, source=source)


def _table1() -> Projectile:
    source = (
        "Mass and diameter: MR-2629, Table 1, which gives neither length nor nose: the M70 outline "
        "enlarged to 57 mm is assumed. 10 kg in it is 27 times as dense as water: no real material."
    )
    return _m70(0.170 * 57 / 56.78, 0.057, 10.0, "table1", source)


#: Ready-made projectiles, by the names that scenarios use.
PRESETS: dict[str, Projectile] = {
    "m70-full": _m70(0.170, 0.05678, 0.40964, "m70-full", _M70_SOURCE),
    "m70-half": _m70(0.08505, 0.02835, 0.05119, "m70-half", _M70_SOURCE),
    "table1": _table1(),
}


#: Outlines that a text can name, with the parameters they take.
OUTLINES = {
    "ogive": (ogive, ("diameter", "length", "calibre_radius_head", "tip_radius")),
    "cone": (cone, ("diameter", "length", "nose_length", "tip_radius")),
    "hemisphere": (hemisphere, ("diameter", "length")),
    "flat-cylinder": (flat_cylinder, ("diameter", "length")),
    "sphere": (sphere, ("diameter",)),
}


def projectile(spec: str | Projectile) -> Projectile:
    """A projectile from its description.

    Parameters
    ----------
    spec : str or Projectile
        Name of a preset ('_' and '-' alike); an outline with its lengths in m, such as
        ``'cone:diameter=0.057,length=0.17,nose_length=0.06'``; a CSV file with a vertex
        ``z, r[, bulge]`` of the generating curve in each line (see ``SolidOfRevolution.profile``);
        or a Projectile, which is returned.

    Raises
    ------
    ValueError
        The text is none of these, naming what is allowed.
    """
    if isinstance(spec, Projectile):
        return spec
    text = str(spec).strip()
    if text.lower().endswith(".csv"):
        return _from_file(Path(text))
    word, _, parameters = text.partition(":")
    name = word.lower().replace("_", "-")
    if name in PRESETS and not parameters:
        return PRESETS[name]
    if name in OUTLINES:
        return _from_outline(name, parameters)
    raise ValueError(
        f"projectile = {spec!r}; allowed: {', '.join(PRESETS)}, one of {', '.join(OUTLINES)} with "
        ":NAME=METRES,... , a CSV file of vertices, or a Projectile"
    )


def _from_outline(name: str, parameters: str) -> Projectile:
    """An outline function called with the parameters of a text."""
    function, allowed = OUTLINES[name]
    values = {}
    for item in filter(None, parameters.split(",")):
        key, _, value = item.partition("=")
        try:
            values[key.strip()] = float(value)
        except ValueError:
            raise ValueError(f"projectile = {name}: {item!r}; allowed: NAME=NUMBER") from None
    unknown = [key for key in values if key not in allowed]
    if unknown:
        raise ValueError(f"projectile = {name}: {unknown[0]!r}; allowed: {', '.join(allowed)}")
    try:
        return function(**values)
    except TypeError:
        raise ValueError(f"projectile = {name}: needs {', '.join(allowed)}") from None


def _from_file(path: Path) -> Projectile:
    """A generating curve read from a file."""
    try:
        rows = [line.split("#")[0].split(",") for line in path.read_text().splitlines()]
        vertices = [[float(number) for number in row] for row in rows if row != [""]]
    except (OSError, ValueError) as error:
        raise ValueError(f"projectile = {str(path)!r}: {error}") from None
    if len(vertices) < 2 or any(len(vertex) not in (2, 3) for vertex in vertices):
        raise ValueError(
            f"projectile = {str(path)!r}; allowed: lines of z, r[, bulge], two at least"
        )
    profile = tuple((v[0], v[1], v[2] if len(v) == 3 else 0.0) for v in vertices)
    return Projectile(name=path.stem, profile=profile, source=str(path))


def pointing(direction: Sequence[float]) -> Any:
    """Orientation (Quaternion) that turns the nose from -z into `direction` by the shortest way."""
    from yade import Quaternion, Vector3

    target = Vector3(*direction)
    require("direction: its norm", target.norm(), target.norm() > 0, "> 0")
    rotation = Quaternion()
    rotation.setFromTwoVectors(Vector3(0, 0, -1), target.normalized())
    return rotation


def make_projectile(
    spec: str | Projectile,
    position: Sequence[float] = (0, 0, 0),
    velocity: Sequence[float] = (0, 0, 0),
    orientation: Any = None,
    material: Any = None,
    *,
    nose_at: Sequence[float] | None = None,
    angular_velocity: Sequence[float] = (0, 0, 0),
    **shape_attributes: Any,
) -> Any:
    """Body for ``O.bodies.append``: shape, mass, principal inertia, motion.

    Parameters
    ----------
    spec : str or Projectile
        Preset name or outline.
    position : (3,) floats
        Of the centroid [m].
    velocity, angular_velocity : (3,) floats
        Of the centroid [m/s]; [rad/s]; in global axes.
    orientation : Quaternion, optional
        Default: nose down (-z). See `pointing`.
    material : Material or str, optional
        Material, or the label of one in ``O.materials``; default: the last one made.
    nose_at : (3,) floats, optional
        Position of the nose's tip [m] instead of `position`.
    **shape_attributes
        Further attributes of ``SolidOfRevolution`` (edgeRadius, color, ...).

    Returns
    -------
    Body
    """
    from yade import O, Matrix3, Quaternion, Vector3, wrapper

    chosen = projectile(spec)
    if (chosen.mass is None) == (chosen.density is None):
        raise ValueError(
            f"projectile {chosen.name!r}: mass = {chosen.mass}, density = {chosen.density}; "
            "allowed: exactly one of the two"
        )
    shape = chosen.shape(**shape_attributes)
    mass = chosen.mass if chosen.mass is not None else chosen.density * shape.volume
    inertia = shape.inertiaOfMass(mass)
    turn = Quaternion.Identity if orientation is None else orientation
    centre = Vector3(*position)
    if nose_at is not None:
        centre = Vector3(*nose_at) - turn * Vector3(0, 0, shape.noseZ)
    if isinstance(material, str):
        material = O.materials[material]
    elif material is None and len(O.materials) == 0:
        raise ValueError("material: not given and O.materials is empty; allowed: a Material")

    body = wrapper.Body()
    body.shape = shape
    body.material = O.materials[-1] if material is None else material
    body.aspherical = True
    state = body.state
    state.mass = mass
    state.inertia = inertia
    state.pos = state.refPos = centre
    state.ori = state.refOri = turn
    state.vel = Vector3(*velocity)
    state.angVel = Vector3(*angular_velocity)
    # The integrator for bodies that are not spheres starts from the angular momentum.
    axes = turn.toRotationMatrix()
    diagonal = Matrix3(inertia[0], 0, 0, 0, inertia[1], 0, 0, 0, inertia[2])
    state.angMom = axes * diagonal * axes.transpose() * state.angVel
    return body


def projectile_forces(body: Any) -> dict[str, Any]:
    """Contact forces on a projectile now, by zone.

    Parameters
    ----------
    body : Body or int
        The projectile or its id.

    Returns
    -------
    dict
        'nose', 'shaft', 'base', 'total': force [N] (3,); the same with '_torque': moment about the
        centroid [N m] (3,); 'contacts': their number.
    """
    from yade import wrapper

    load = wrapper.ProjectileLoad(body=body if isinstance(body, int) else body.id)
    load()
    result = {"contacts": load.contacts}
    for zone in ("nose", "shaft", "base", "total"):
        result[zone] = getattr(load, zone + "Force")
        result[zone + "_torque"] = getattr(load, zone + "Torque")
    return result
