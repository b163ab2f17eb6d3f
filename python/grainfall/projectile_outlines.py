# SPDX-License-Identifier: GPL-2.0-or-later
"""Outlines of projectiles: cylinder, sphere, hemisphere, cone and tangent ogive noses.

Each function returns a `Projectile` whose nose touches z = 0 and whose axis is z; further keywords
are fields of `Projectile`, as ``mass`` or ``density``.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

Vertex = tuple[float, float, float]  # z [m], r [m], bulge [-] of the piece to the next vertex


@dataclass(frozen=True)
class Projectile:
    """Outline and mass of a projectile.

    Parameters
    ----------
    name : str
    profile : tuple of (z, r, bulge)
        Generating curve from nose to base [m, m, -], see ``SolidOfRevolution.profile``.
    mass : float or None
        Mass [kg].
    density : float or None
        Uniform density [kg/m3], where the mass is not given. One of the two is needed for a body.
    zones : tuple of str
        'nose', 'shaft' or 'base' of each piece; empty: from the largest radius.
    source : str
        Where the numbers come from, and what is assumed.
    """

    name: str
    profile: tuple[Vertex, ...]
    mass: float | None = None
    density: float | None = None
    zones: tuple[str, ...] = ()
    source: str = ""

    def shape(self, **attributes: Any) -> Any:
        """SolidOfRevolution of this outline; `attributes` are further ones of the shape."""
        from yade import wrapper

        return wrapper.SolidOfRevolution(
            profile=list(self.profile), zones=list(self.zones), **attributes
        )

    def scaled(self, factor: float) -> Projectile:
        """The same outline `factor` times larger; a given mass grows with the volume."""
        require("factor", factor, factor > 0, "> 0")
        profile = tuple((z * factor, r * factor, bulge) for z, r, bulge in self.profile)
        mass = None if self.mass is None else self.mass * factor**3
        return replace(self, profile=profile, mass=mass)


def require(name: str, value: float, fine: bool, allowed: str) -> None:
    """Raise ValueError naming attribute, value and allowed range unless `fine` and finite."""
    if not (fine and math.isfinite(value)):
        raise ValueError(f"{name} = {value}; allowed: {allowed}")


def _finish(
    name: str, nose: Sequence[Vertex], length: float, properties: dict[str, Any]
) -> Projectile:
    """Close an outline whose nose ends at the shoulder with a cylinder and a flat base."""
    nose_end, radius, _ = nose[-1]
    if abs(nose_end - length) <= 1e-9 * length:
        closing: tuple[Vertex, ...] = ((nose_end, 0.0, 0.0),)
    elif nose_end < length:
        closing = ((length, radius, 0.0), (length, 0.0, 0.0))
    else:
        raise ValueError(
            f"length = {length} m; allowed: >= {nose_end:.6g} m, the length of the {name} nose"
        )
    return Projectile(name, tuple(nose) + closing, **properties)


def flat_cylinder(diameter: float, length: float, **properties: Any) -> Projectile:
    """Circular cylinder with flat ends: diameter [m], length [m]."""
    require("diameter", diameter, diameter > 0, "> 0 m")
    require("length", length, length > 0, "> 0 m")
    return _finish("flat", [(0.0, 0.0, 0.0), (0.0, 0.5 * diameter, 0.0)], length, properties)


def sphere(diameter: float, **properties: Any) -> Projectile:
    """Sphere: diameter [m]. Its front half is the nose, its rear half the base."""
    require("diameter", diameter, diameter > 0, "> 0 m")
    radius, quarter = 0.5 * diameter, math.tan(math.pi / 8)
    profile = ((0.0, 0.0, quarter), (radius, radius, quarter), (diameter, 0.0, 0.0))
    return Projectile("sphere", profile, **{"zones": ("nose", "base"), **properties})


def hemisphere(diameter: float, length: float, **properties: Any) -> Projectile:
    """Cylinder with a hemispherical nose: diameter [m], length over all [m]."""
    require("diameter", diameter, diameter > 0, "> 0 m")
    radius = 0.5 * diameter
    nose = [(0.0, 0.0, math.tan(math.pi / 8)), (radius, radius, 0.0)]
    return _finish("hemisphere", nose, length, properties)


def cone(
    diameter: float, length: float, nose_length: float, tip_radius: float = 0.0, **properties: Any
) -> Projectile:
    """Cylinder with a conical nose.

    Parameters
    ----------
    diameter, length : float
        Of the cylinder, over all [m].
    nose_length : float
        From the sharp tip to the cylinder [m]; a rounded tip shortens it.
    tip_radius : float
        Radius of the sphere that rounds the tip [m], tangent to the flank; 0: sharp.
    """
    require("diameter", diameter, diameter > 0, "> 0 m")
    require("nose_length", nose_length, nose_length > 0, "> 0 m")
    require("tip_radius", tip_radius, tip_radius >= 0, ">= 0 m")
    radius = 0.5 * diameter
    if tip_radius == 0:
        nose = [(0.0, 0.0, 0.0), (nose_length, radius, 0.0)]
    else:
        slope = math.atan2(radius, nose_length)
        joint_r = tip_radius * math.cos(slope)
        require("tip_radius", tip_radius, joint_r < radius, f"< {radius / math.cos(slope):.6g} m")
        joint_z = tip_radius * (1 - math.sin(slope))
        nose_end = joint_z + (radius - joint_r) / math.tan(slope)
        bulge = math.tan(0.25 * (0.5 * math.pi - slope))
        nose = [(0.0, 0.0, bulge), (joint_z, joint_r, 0.0), (nose_end, radius, 0.0)]
    return _finish("cone", nose, length, properties)


def ogive(
    diameter: float,
    length: float,
    calibre_radius_head: float = 1.5,
    tip_radius: float = 0.0,
    **properties: Any,
) -> Projectile:
    """Cylinder with a tangent ogive nose.

    Parameters
    ----------
    diameter, length : float
        Of the cylinder, over all [m].
    calibre_radius_head : float
        Radius of the ogive's arc in diameters (CRH) [-], > 0.5; the sharp nose is
        ``diameter * sqrt(CRH - 1/4)`` long. 0.5 would be a hemisphere.
    tip_radius : float
        Radius of the sphere that rounds the tip [m], tangent to the ogive; 0: sharp.
    """
    require("diameter", diameter, diameter > 0, "> 0 m")
    require("calibre_radius_head", calibre_radius_head, calibre_radius_head > 0.5, "> 0.5")
    radius = 0.5 * diameter
    require("tip_radius", tip_radius, 0 <= tip_radius < radius, f"0 to < {radius:.6g} m")
    arc = diameter * calibre_radius_head
    inwards = (
        arc - radius
    )  # the arc's centre lies this far beyond the axis, abreast of the shoulder
    sharp_length = diameter * math.sqrt(calibre_radius_head - 0.25)
    if tip_radius == 0:
        angle = math.asin(sharp_length / arc)
        nose = [(0.0, 0.0, math.tan(angle / 4)), (sharp_length, radius, 0.0)]
    else:
        # The centre of the tip's sphere is arc - tip_radius away from the arc's centre.
        behind = math.sqrt((arc - tip_radius) ** 2 - inwards**2)
        turn = math.atan2(behind, inwards)
        joint = (tip_radius * (1 - math.sin(turn)), tip_radius * math.cos(turn))
        tip_bulge = math.tan(0.25 * (0.5 * math.pi - turn))
        nose = [
            (0.0, 0.0, tip_bulge),
            (joint[0], joint[1], math.tan(turn / 4)),
            (behind + tip_radius, radius, 0.0),
        ]
    return _finish("ogive", nose, length, properties)
