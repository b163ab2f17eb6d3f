# SPDX-License-Identifier: GPL-2.0-or-later
"""What the range of a single parameter cannot show: parameters that do not fit together."""
from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

from grainfall.options import OptionError
from grainfall.sand_options import friction_is_known

LOWEST, HIGHEST = 1.0, 1000.0
#: Strain above which a test is no small-strain test and the platen would travel through grains [-].
LARGEST_STRAIN = 1e-3
#: Periods of the lowest frequency that the common period of a multisine may last.
LONGEST_COMMON_PERIOD = 20


def frequencies_are_numbers(values: dict[str, Any], given: Mapping[str, Any]) -> None:
    """The list of frequencies can be read, and each is in range and there once."""
    found: list[float] = []
    for text in str(values["frequencies"]).split(","):
        try:
            frequency = float(text)
        except ValueError:
            frequency = math.nan
        if not LOWEST <= frequency <= HIGHEST or frequency in found:
            raise OptionError(
                f"--frequencies = {values['frequencies']!r}: {text.strip()!r} must be a number in [{LOWEST:g}, "
                f"{HIGHEST:g}] Hz, each once, separated by commas"
            )
        found.append(frequency)
    if values["multisine"] and common_period(found) * min(found) > LONGEST_COMMON_PERIOD:
        raise OptionError(
            f"--frequencies = {values['frequencies']!r}: together they repeat only after {common_period(found):g} s; "
            "with --multisine choose multiples of a common frequency"
        )


def common_period(frequencies: Sequence[float]) -> float:
    """Shortest time after which sines of these frequencies all repeat [s]."""
    parts = [Fraction(frequency).limit_denominator(10_000) for frequency in frequencies]
    numerator = math.gcd(*(part.numerator for part in parts))
    denominator = math.lcm(*(part.denominator for part in parts))
    return denominator / numerator


def strain_is_small(values: dict[str, Any], given: Mapping[str, Any]) -> None:
    """The displacement, enlarged for soft grains or not, is a small strain."""
    from grainfall.triaxial.parameters import peak_to_peak, softness

    strain = peak_to_peak(values) / values["height"]
    if strain > LARGEST_STRAIN:
        limit = LARGEST_STRAIN * values["height"] * softness(values) ** (2 / 3)
        raise OptionError(
            f"--peak-to-peak = {values['peak_to_peak']}: with these grains a strain of {strain:.2g}; must be at most "
            f"{limit:.3g} m, a strain of {LARGEST_STRAIN:g}"
        )


def grains_fit(values: dict[str, Any], given: Mapping[str, Any]) -> None:
    """The sample is at least three grains wide and high."""
    least = 3 * values["grain_diameter"]
    for side in ("diameter", "height"):
        if values[side] < least:
            raise OptionError(
                f"--{side} = {values[side]}: must be at least {least:.4g} m, three grain diameters"
            )


def lateral_stress_is_there(values: dict[str, Any], given: Mapping[str, Any]) -> None:
    """Something holds the sample's sides, and the axial stress is known.

    A body in balance with free sides and smooth platens has no mean lateral stress, and friction bears an axial one
    only beside a lateral one (docs/triaxial.md).
    """
    from grainfall.triaxial.parameters import rubber_tube

    diameter = values["diameter"]
    tension = rubber_tube(values, diameter).pressure(0.5 * diameter)
    if values["confinement"] + tension > 0:
        return
    if values["moisture"] == 0 or values["bridges"] == "none":
        raise OptionError(
            f"--confinement = {values['confinement']}: dry grains without cell pressure and without a membrane in "
            "tension do not stand, friction cannot hold a free side; give --membrane-thickness above 0 and "
            "--membrane-fit below 1, or --moisture with --bridges, or a confinement above 0 Pa"
        )
    if values["axial_stress"] is None:
        raise OptionError(
            f"--confinement = {values['confinement']}: no cell pressure and no membrane in tension, so there is no "
            "lateral stress that --stress-ratio could multiply; --axial-stress must be given"
        )


def cycles_in_order(values: dict[str, Any], given: Mapping[str, Any]) -> None:
    """The least number of cycles does not exceed the most."""
    if values["most_cycles"] < values["least_cycles"]:
        raise OptionError(
            f"--most-cycles = {values['most_cycles']}: must be at least --least-cycles = "
            f"{values['least_cycles']}"
        )


CHECKS = (
    frequencies_are_numbers,
    grains_fit,
    strain_is_small,
    cycles_in_order,
    lateral_stress_is_there,
    friction_is_known,
)
