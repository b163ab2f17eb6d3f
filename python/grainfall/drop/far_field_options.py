# SPDX-License-Identifier: GPL-2.0-or-later
"""What lies beyond the box of grains: its options, and what does not fit together among them."""
from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from grainfall.options import Option, OptionError

#: Models that `--far-field` may name.
MODELS = ("rigid", "quasi-static", "explicit")

FAR_FIELD = (
    Option(
        "far_field",
        "rigid",
        "what lies beyond the box: rigid walls, or an elastic continuum without inertia (quasi-static) or with it "
        "(explicit)",
        kind=str,
        choices=MODELS,
    ),
    Option(
        "near_field_radius",
        None,
        "half-width of a square box of grains, in place of --box-length and --box-width",
        "m",
        low=0,
        open_low=True,
    ),
    Option(
        "far_field_thickness",
        None,
        "continuum beyond the box's walls and floor (default: half the box's longer side)",
        "m",
        low=0,
        open_low=True,
    ),
    Option(
        "far_field_element",
        None,
        "size of the continuum's cells at the box, growing outwards (default: 3 grain diameters)",
        "m",
        low=0,
        open_low=True,
    ),
    Option(
        "far_field_degree", 1, "degree of the continuum's shape functions", kind=int, low=1, high=2
    ),
    Option(
        "far_field_young",
        None,
        "Young's modulus of the continuum (default: the small-strain one of the bed of grains itself, from its "
        "contacts at the pressure in the middle of its depth)",
        "Pa",
        low=1e3,
        high=1e13,
    ),
    Option(
        "far_field_poisson",
        None,
        "its Poisson's ratio (default: the bed's, as for Young's modulus)",
        "-",
        low=0,
        high=0.4999,
    ),
    Option(
        "far_field_density",
        None,
        "its density (default: the bed's)",
        "kg/m3",
        low=0,
        open_low=True,
    ),
    Option(
        "far_field_friction_angle",
        None,
        "of an explicit continuum that yields as dry sand does (Drucker and Prager's cone, from the stress of soil at "
        "rest; default: it does not yield)",
        "rad",
        low=0,
        high=1.2,
        open_low=True,
    ),
    Option(
        "far_field_dilatancy",
        0.0,
        "dilatancy of a continuum that yields",
        "rad",
        low=0,
        high=1.2,
    ),
    Option(
        "far_field_interval",
        None,
        "steps between two solutions for all contacts on the continuum together, each solved alone in between; with "
        "explicit, between two motions of the continuum (default: 1; explicit: 10)",
        kind=int,
        low=1,
    ),
    Option(
        "far_field_outer",
        "absorbing",
        "outer boundary of an explicit continuum: absorbing waves, or fixed",
        kind=str,
        choices=("absorbing", "fixed"),
    ),
    Option(
        "far_field_cache",
        "",
        "folder of condensed continua (default: ~/.cache/grainfall/walls)",
        kind=str,
        runtime=True,
    ),
)
_OF_THE_CONTINUUM = tuple(o for o in FAR_FIELD if o.name.startswith("far_field_"))


def continuum_belongs_to_its_options(values: dict[str, Any], given: Mapping[str, Any]) -> None:
    """What belongs to a continuum is given only with one."""
    model = values["far_field"]
    if model == "rigid":
        for option in _OF_THE_CONTINUUM:
            if values[option.name] != option.default and not option.runtime:
                raise OptionError(
                    f"{option.flag} = {values[option.name]}: needs a continuum: --far-field must be "
                    "quasi-static or explicit with it"
                )
        return
    angle, dilatancy = values["far_field_friction_angle"], values["far_field_dilatancy"]
    if model == "explicit" and values["far_field_degree"] != 1:
        raise OptionError(
            f"--far-field-degree = {values['far_field_degree']}: must be 1 with --far-field explicit"
        )
    if model == "quasi-static" and angle is not None:
        raise OptionError(
            f"--far-field-friction-angle = {angle}: needs a continuum that yields: --far-field must be explicit with it"
        )
    if dilatancy > (angle or 0):
        raise OptionError(
            f"--far-field-dilatancy = {dilatancy}: must be a number in [0, {angle or 0}] rad, up to "
            "--far-field-friction-angle"
        )


def near_field_is_one_box(values: dict[str, Any], given: Mapping[str, Any]) -> None:
    """A radius makes the box square."""
    radius = values["near_field_radius"]
    if radius is None:
        return
    for side in ("box_length", "box_width"):
        if given.get(side) not in (None, 2 * radius):
            raise OptionError(
                f"--near-field-radius = {radius}, --{side.replace('_', '-')} = {given[side]}: "
                "must be one of the two"
            )
        values[side] = 2 * radius


def continuum_is_meshed(values: dict[str, Any], given: Mapping[str, Any]) -> None:
    """Thickness, cells and interval where they are not given; those that are fit the box."""
    if values["far_field"] == "rigid":
        return
    sides = (values["box_length"], values["box_width"])
    if values["far_field_interval"] is None:
        values["far_field_interval"] = 10 if values["far_field"] == "explicit" else 1
    if values["far_field_thickness"] is None:
        values["far_field_thickness"] = max(sides) / 2
    room = min(*sides, values["far_field_thickness"])
    if values["far_field_element"] is None:
        values["far_field_element"] = min(3 * values["grain_diameter"], room)
    if values["far_field_element"] > room:
        raise OptionError(
            f"--far-field-element = {values['far_field_element']}: must be a number in (0, {room:.4g}] m, a cell "
            "across the box's shorter side and the thickness"
        )


CHECKS = (continuum_belongs_to_its_options, near_field_is_one_box, continuum_is_meshed)
