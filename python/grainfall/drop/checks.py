# SPDX-License-Identifier: GPL-2.0-or-later
"""What the range of a single parameter cannot show: parameters that do not fit together."""
from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from grainfall.options import OptionError
from grainfall.sand_options import friction_is_known


def only_one_speed(values: dict[str, Any], given: Mapping[str, Any]) -> None:
    """The user gives a drop height or an impact speed; either replaces the preset's."""
    asked = [name for name in ("drop_height", "impact_speed") if given.get(name) is not None]
    if len(asked) == 2:
        raise OptionError(
            f"--drop-height = {given['drop_height']}, --impact-speed = {given['impact_speed']}: "
            "must be one of the two"
        )
    if asked:
        values["impact_speed" if asked == ["drop_height"] else "drop_height"] = None
    if values["drop_height"] is None and values["impact_speed"] is None:
        raise OptionError("--drop-height or --impact-speed: one of the two must be given")


def projectile_fits(values: dict[str, Any], given: Mapping[str, Any]) -> None:
    """The projectile is known and falls inside the box."""
    from grainfall.projectiles import projectile

    try:
        outline = projectile(values["profile"])
    except ValueError as error:
        raise OptionError(f"--profile = {values['profile']!r}: {error}") from None
    diameter = 2 * max(radius for _, radius, _ in outline.profile)
    for option, side in (("--offset-x", "box_length"), ("--offset-y", "box_width")):
        if values[side] <= diameter:
            flag = "--" + side.replace("_", "-")
            raise OptionError(
                f"{flag} = {values[side]}: must be above {diameter:.4g} m, the projectile's diameter"
            )
        reach = (values[side] - diameter) / 2
        offset = values[option[2:].replace("-", "_")]
        if abs(offset) > reach:
            raise OptionError(
                f"{option} = {offset}: must be a number in [{-reach:.4g}, {reach:.4g}] m, with the "
                "projectile inside the box"
            )


def grains_fit(values: dict[str, Any], given: Mapping[str, Any]) -> None:
    """The box takes at least four grains in each direction."""
    least = 4 * values["grain_diameter"]
    sides = ["box_length", "box_width"] + ([] if values["grains"] else ["bed_depth"])
    for side in sides:
        if values[side] < least:
            flag = "--" + side.replace("_", "-")
            raise OptionError(
                f"{flag} = {values[side]}: must be at least {least:.4g} m, four grain diameters"
            )


def time_step_has_one_master(values: dict[str, Any], given: Mapping[str, Any]) -> None:
    """A step is given where it is to be fixed, and only there; a control overrules a preset's step."""
    control = values["time_step_control"]
    if control == "fixed" and values["time_step"] is None:
        raise OptionError("--time-step-control = 'fixed': --time-step must be given with it")
    if control in ("rayleigh", "hertz"):
        if given.get("time_step") is not None:
            raise OptionError(
                f"--time-step = {given['time_step']}, --time-step-control = {control!r}: must be one of the two"
            )
        values["time_step"] = None


CHECKS = (
    only_one_speed,
    projectile_fits,
    grains_fit,
    friction_is_known,
    time_step_has_one_master,
)
