# SPDX-License-Identifier: GPL-2.0-or-later
"""Parameters of the sand, the same in every scenario; presets of the scenarios set their own defaults."""
from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from grainfall.options import Option, OptionError

SAND = (
    Option(
        "grain_diameter", 8e-3, "mean diameter of the simulated grains", "m", low=1e-4, high=0.05
    ),
    Option(
        "grain_spread",
        0.1,
        "half-width of the uniform spread of diameters, relative to the mean",
        "-",
        low=0,
        high=0.5,
    ),
    Option("grain_density", 2650.0, "density of a grain", "kg/m3", low=0, open_low=True),
    Option(
        "young",
        5e8,
        "Young's modulus of the grains (quartz: 7e10; softer grains allow longer steps, and the summary "
        "reports the largest overlap)",
        "Pa",
        low=1e4,
        high=1e13,
    ),
    Option("poisson", 0.2, "Poisson's ratio of the grains", "-", low=0, high=0.499),
    Option(
        "restitution",
        0.6,
        "coefficient of restitution, grain on grain; 1 for no dashpot",
        "-",
        low=0.01,
        high=1,
    ),
    Option(
        "friction",
        "cole",
        "friction of the grains: a number, 'cole' (0.8 at 1 N to 0.2 at 20 N), or CURVE:NAME=VALUE,... with "
        "CURVE one of constant, power-law, exponential, asperity (see grainfall.materials)",
        "-",
        kind=str,
    ),
    Option("moisture", 0.0, "water, mass over mass of dry grains", "kg/kg", low=0, high=0.5),
    Option(
        "moisture_factor",
        "",
        "factor on friction by moisture, as MOISTURE:FACTOR,... e.g. 0:1,0.023:0.9",
        "-",
        kind=str,
    ),
    Option(
        "bridges",
        "willett",
        "force of the liquid bridges between moist grains",
        kind=str,
        choices=("willett", "willett-closed", "none"),
    ),
    Option("bridges_per_grain", 6.0, "bridges that share a grain's water", "-", low=1, high=14),
    Option("surface_tension", 0.0728, "of the water", "N/m", low=0, high=1, open_low=True),
    Option(
        "contact_angle", 0.0, "of the water on grains and other bodies", "rad", low=0, high=0.8727
    ),
    Option(
        "liquid_viscosity",
        0.0,
        "of the water in bridges (1e-3 at 20 C); 0 leaves the squeeze film out",
        "Pa s",
        low=0,
        high=10,
    ),
    Option(
        "reference_diameter",
        0.72e-3,
        "diameter of the real grain that a simulated one stands for: friction is read at the load it would "
        "carry; 0 for none",
        "m",
        low=0,
        high=0.05,
    ),
)

LAWS = (
    Option(
        "normal_law",
        "hertz",
        "normal force of the contact law",
        kind=str,
        choices=("hertz", "report"),
    ),
    Option(
        "tangential_law",
        "incremental",
        "tangential force of the contact law",
        kind=str,
        choices=("incremental", "mindlin-deresiewicz", "report", "secant", "none"),
    ),
    Option(
        "path",
        "flat",
        "flat: grains and their contacts in packed arrays, several times faster; general: YADE's own loops, "
        "with the same results",
        kind=str,
        choices=("flat", "general"),
    ),
)


def friction_is_known(values: dict[str, Any], given: Mapping[str, Any]) -> None:
    """The texts for friction and its moisture factor can be read."""
    from grainfall.contacts import friction_curve

    try:
        friction_curve(values["friction"])
    except ValueError as error:
        raise OptionError(_naming("--friction", values["friction"], error)) from None
    try:
        friction_curve(values["friction"], values["moisture_factor"])
    except ValueError as error:
        raise OptionError(_naming("--moisture-factor", values["moisture_factor"], error)) from None


def _naming(flag: str, value: Any, error: Exception) -> str:
    """The message with the option's name in front, unless it is there already."""
    text = str(error)
    return text if text.startswith(flag) else f"{flag} = {value!r}: {text}"
