# SPDX-License-Identifier: GPL-2.0-or-later
"""Exact capillary force of a liquid bridge between equal spheres, by the Young-Laplace equation.

usage: /usr/bin/python3 benchmarks/young_laplace.py [tests/data/young_laplace/force.csv]

Writes the table that the bridge tests compare with. No gravity, sphere radius 1, surface tension 1.

Along the meniscus with arc length l, angle phi to the axis, distance y from it and suction P:

    dx/dl = cos phi,  dy/dl = sin phi,  dphi/dl = cos(phi)/y + P

It meets the sphere at half filling angle beta, y = sin beta, phi = pi/2 - beta - theta, and is followed from
there to the neck, phi = 0. For a volume V and an angle beta, P is found from V; the separation s and the
force F/(2 pi) = sin(beta) sin(beta + theta) + P sin(beta)^2/2 follow. With beta falling in steps of 1 %, s
passes a maximum: the rupture distance. Angles above that of the maximum are the stable bridges; the force
between them is interpolated by a cubic spline.
"""
from __future__ import annotations

import math
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline
from scipy.optimize import brentq, newton

VOLUMES = (1e-4, 1e-3, 1e-2, 5e-2, 8.5e-2)
ANGLES_DEGREES = (0.0, 20.0, 40.0)
FRACTIONS = (0.0, 0.1, 0.25, 0.5, 0.75, 0.9)  # of the rupture distance by Willett et al., Eq 15


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
        backwards, (0, 20), (0, radius, slope, 0), "DOP853", events=(neck, axis), rtol=1e-9, atol=1e-12
    )
    if len(solution.t_events[0]) == 0:  # no neck: more liquid than any bridge of this angle holds
        return Bridge(filling_angle, math.inf, math.inf, math.nan)
    half_length, _, _, half_volume = solution.y[:, -1]
    rise = math.cos(filling_angle)
    cap = math.pi / 3 * (2 - 3 * rise + rise**3)
    force = radius * math.sin(filling_angle + contact_angle) + suction * radius**2 / 2
    return Bridge(
        filling_angle, 2 * (half_length - 1 + rise), 2 * (half_volume - cap), force
    )


def of_volume(filling_angle: float, volume: float, contact_angle: float, guess: float) -> tuple[Bridge, float]:
    """The bridge of this half filling angle [rad] that holds this volume, and its suction."""
    suction = newton(
        lambda p: bridge(filling_angle, p, contact_angle).volume / volume - 1,
        guess,
        x1=guess * (1 + 1e-4) + 1e-4,
        tol=1e-9,
    )
    return bridge(filling_angle, suction, contact_angle), suction


def family(volume: float, contact_angle: float) -> list[Bridge]:
    """Bridges of this volume from a slight overlap of the spheres to past the longest one."""
    # Near contact the liquid is a ring in a gap of width beta^2, which it fills to about (V/2)^(1/4).
    beta = 1.1 * (volume / 2) ** 0.25 * (1 + 0.3 * contact_angle)
    guess = 2 * math.cos(contact_angle) / beta**2 - 1 / beta
    bridges: list[Bridge] = []
    while len(bridges) < 3 or bridges[-1].separation > bridges[-2].separation:
        found, guess = of_volume(beta, volume, contact_angle, guess)
        bridges.append(found)
        beta *= 0.99
    return bridges


def merging_volume(contact_angle: float) -> float:
    """Volume at which bridges of three touching spheres meet: half filling angle 30 degrees."""
    beta = math.pi / 6
    suction = brentq(
        lambda p: min(bridge(beta, p, contact_angle).separation, 10.0), -0.5, 50, xtol=1e-12
    )
    return bridge(beta, suction, contact_angle).volume


def willett_rupture_distance(volume: float, contact_angle: float) -> float:
    """Eq 15 of Willett et al. 2000, over the radius."""
    root = volume ** (1 / 3)
    return (1 + contact_angle / 2) * (root + 0.1 * root**2)


def table() -> list[tuple[float, ...]]:
    """Rows: volume, contact angle [degrees], fraction of Eq 15, separation, force, longest bridge."""
    rows = []
    for degrees in ANGLES_DEGREES:
        theta = math.radians(degrees)
        for volume in VOLUMES:
            bridges = family(volume, theta)
            assert bridges[0].separation < 0, "the family must begin with an overlap"
            stable = bridges[: int(np.argmax([b.separation for b in bridges]))]
            force = CubicSpline([b.separation for b in stable], [b.force for b in stable])
            longest = max(b.separation for b in bridges)
            for fraction in FRACTIONS:
                separation = fraction * willett_rupture_distance(volume, theta)
                if separation < stable[-1].separation:
                    rows.append(
                        (volume, degrees, fraction, separation, float(force(separation)), longest)
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
