# SPDX-License-Identifier: GPL-2.0-or-later
"""Exact capillary force of a liquid bridge between equal spheres, by the Young-Laplace equation.

usage: /usr/bin/python3 benchmarks/young_laplace.py [tests/data/young_laplace/force.csv]

Writes the table that the bridge tests compare with. No gravity, sphere radius 1, surface tension 1.

Along the meniscus with arc length l, angle phi to the axis, distance y from it and suction P:

    dx/dl = cos phi,  dy/dl = sin phi,  dphi/dl = cos(phi)/y + P

It meets the sphere at half filling angle beta, y = sin beta, phi = pi/2 - beta - theta, and is followed from
there to the neck, phi = 0. That gives volume and separation, and the force F/(2 pi) = sin(beta)
sin(beta + theta) + P sin(beta)^2/2. Newton's method finds beta and P for a volume and a separation; from
contact the bridge is stretched by 5 % of the rupture distance at a time, in the end by 1 %, each solution
starting the next, until there is none: the last is the longest bridge.
"""
from __future__ import annotations

import math
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq, fsolve

VOLUMES = (1e-4, 1e-3, 1e-2, 5e-2, 8.5e-2)
ANGLES_DEGREES = (0.0, 20.0, 40.0)
PERCENTS = (0, 10, 25, 50, 75, 90)  # of the rupture distance by Willett et al., Eq 15


@dataclass(frozen=True)
class Bridge:
    """One solution: half filling angle [rad], separation, volume, force over 2 pi R gamma."""

    filling_angle: float
    separation: float
    volume: float
    force: float


def bridge(filling_angle: float, suction: float, contact_angle: float) -> Bridge:
    """The bridge of this half filling angle [rad], suction (times R/gamma), contact angle [rad]."""
    radius = math.sin(filling_angle)
    slope = math.pi / 2 - filling_angle - contact_angle

    def backwards(_: float, state: np.ndarray) -> tuple[float, float, float, float]:
        _, y, phi, _ = state
        return (
            math.cos(phi),
            -math.sin(phi),
            -math.cos(phi) / y - suction,
            math.pi * y * y * math.cos(phi),
        )

    def neck(_: float, state: np.ndarray) -> float:
        return state[2]

    def axis(_: float, state: np.ndarray) -> float:
        return state[1] - 1e-3 * radius

    neck.terminal = axis.terminal = True
    solution = solve_ivp(
        backwards,
        (0, 20),
        (0, radius, slope, 0),
        "DOP853",
        events=(neck, axis),
        rtol=1e-10,
        atol=1e-13,
    )
    if len(solution.t_events[0]) == 0:  # no neck: more liquid than any bridge of this angle holds
        return Bridge(filling_angle, math.inf, math.inf, math.nan)
    half_length, _, _, half_volume = solution.y[:, -1]
    rise = math.cos(filling_angle)
    cap = math.pi / 3 * (2 - 3 * rise + rise**3)
    force = radius * math.sin(filling_angle + contact_angle) + suction * radius**2 / 2
    return Bridge(filling_angle, 2 * (half_length - 1 + rise), 2 * (half_volume - cap), force)


def touching(filling_angle: float, contact_angle: float) -> tuple[Bridge, float]:
    """The bridge of this half filling angle [rad] between touching spheres, and its suction."""
    suction = brentq(
        lambda p: min(bridge(filling_angle, p, contact_angle).separation, 10.0),
        -1.5,
        4 / filling_angle**2,
        xtol=1e-10,
        rtol=1e-12,
    )
    return bridge(filling_angle, suction, contact_angle), suction


def contact(volume: float, contact_angle: float) -> np.ndarray:
    """Half filling angle [rad] and suction of the bridge of this volume between touching spheres."""
    # The liquid is a ring in a gap of width y^2: V is a little below pi/2 beta^4.
    least = (2 * volume / math.pi) ** 0.25
    beta = brentq(
        lambda b: touching(b, contact_angle)[0].volume / volume - 1,
        0.8 * least,
        1.3 * least,
        xtol=1e-10,
    )
    return np.array([beta, touching(beta, contact_angle)[1]])


def stretched(volume: float, contact_angle: float) -> dict[int, Bridge]:
    """Bridges of this volume by separation in % of the rupture distance, until there are no more."""
    scale = willett_rupture_distance(volume, contact_angle)
    previous = found = contact(volume, contact_angle)
    bridges: dict[int, Bridge] = {}
    for percent in (*range(0, 90, 5), *range(90, 150)):

        def excess(unknowns: np.ndarray) -> tuple[float, float]:
            # In these variables both unknowns are of order one, and the suction may change sign.
            candidate = bridge(
                found[0] * unknowns[0], found[1] + abs(found[1]) * unknowns[1], contact_angle
            )
            missing = candidate.separation / scale - percent / 100
            return candidate.volume / volume - 1, missing

        guess = (found - previous) / np.abs(found) if percent <= 90 else np.zeros(2)
        step, *_ = fsolve(excess, guess + (1, 0), xtol=1e-8, full_output=True)
        if max(map(abs, excess(step))) > 1e-6:
            break
        previous, found = found, np.array([found[0] * step[0], found[1] + abs(found[1]) * step[1]])
        bridges[percent] = bridge(found[0], found[1], contact_angle)
    return bridges


def merging_volume(contact_angle: float) -> float:
    """Volume at which bridges of three touching spheres meet: half filling angle 30 degrees."""
    return touching(math.pi / 6, contact_angle)[0].volume


def willett_rupture_distance(volume: float, contact_angle: float) -> float:
    """Eq 15 of Willett et al. 2000, over the radius."""
    root = volume ** (1 / 3)
    return (1 + contact_angle / 2) * (root + 0.1 * root**2)


def table() -> list[tuple[float, ...]]:
    """Rows: volume, contact angle [degrees], fraction of Eq 15, separation, force, longest bridge."""
    rows = []
    for degrees in ANGLES_DEGREES:
        for volume in VOLUMES:
            bridges = stretched(volume, math.radians(degrees))
            scale = willett_rupture_distance(volume, math.radians(degrees))
            longest = max(one.separation for one in bridges.values())
            for percent in PERCENTS:
                if percent in bridges:
                    one = bridges[percent]
                    rows.append(
                        (volume, degrees, percent / 100, percent / 100 * scale, one.force, longest)
                    )
    return rows


def main() -> None:
    """Print the volume of merging bridges and write the table."""
    default = Path(__file__).resolve().parents[1] / "tests/data/young_laplace/force.csv"
    path = Path(sys.argv[1]) if len(sys.argv) > 1 else default
    path.parent.mkdir(parents=True, exist_ok=True)
    for degrees in ANGLES_DEGREES:
        volume = merging_volume(math.radians(degrees))
        print(f"bridges of touching spheres meet at V* = {volume:.4f}, theta = {degrees:g} degrees")
    with open(path, "w", encoding="utf-8") as file:
        file.write(
            "# Young-Laplace equation solved numerically by benchmarks/young_laplace.py: equal spheres of "
            "radius R, no gravity; F/(2 pi R gamma), lengths over R\n"
        )
        file.write("volume,contact_angle_deg,fraction,separation,force,rupture_distance\n")
        for row in table():
            volume, degrees, fraction, separation, force, longest = row
            file.write(
                f"{volume:g},{degrees:g},{fraction:g},{separation:.8g},{force:.6f},{longest:.6g}\n"
            )
    print(f"written: {path}")


if __name__ == "__main__":
    main()
