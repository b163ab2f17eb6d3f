# SPDX-License-Identifier: GPL-2.0-or-later
"""Which tangential law drew the published curves of Chung & Ooi (2011), tests 5 and 6?

usage: /usr/bin/python3 benchmarks/chung_ooi_readings.py

Integrates the impact of a sphere on a rigid plane (overlap and slip only, no library) under several
readings of "Mindlin's stiffness with damping" and prints how far each lies from the digitised curves of
tests/data/chung_ooi_2011. Units: mass, normal speed and largest elastic overlap are 1.
"""

from __future__ import annotations

import math
from itertools import product
from pathlib import Path

import numpy as np

DATA = Path(__file__).resolve().parents[1] / "tests" / "data" / "chung_ooi_2011"
STEPS = 1500
CONTACT_TIME = 2.9433  # Hertz, over largest overlap and speed
HERTZ = 1.25  # force over overlap^1.5 for which the largest overlap is 1

SPRINGS = {
    "Eq 4, F - k ds": lambda k, before: 1.0,
    "rescaled on unloading": lambda k, before: min(1.0, k / before),
    "total displacement, k s": lambda k, before: k / before,
}


def rebound_slip(
    slip: np.ndarray,
    friction: float,
    poisson: float,
    restitution: float,
    spring: str,
    stiffness_factor: float = 1.0,
    dashpot: float = 1.0,
    cap: str = "whole",
) -> np.ndarray:
    """Slip after the impact, shape (n,), for slips before; both over the normal speed.

    stiffness_factor: k_t over Mindlin's. dashpot: tangential damping coefficient over 2 zeta sqrt(m k_t).
    cap: the normal force that limits spring and dashpot together, 'whole' or 'elastic'.
    """
    minus_log = -math.log(restitution)
    damping = 2 * math.sqrt(5 / 6) * minus_log / math.hypot(math.pi, minus_log)
    ratio = stiffness_factor * 2 * (1 - poisson) / (2 - poisson)
    step = CONTACT_TIME / STEPS
    overlap, closing, force, before = 0.0, 1.0, np.zeros_like(slip), 0.0
    slip = slip.copy()
    while True:
        overlap += closing * step
        if overlap <= 0:
            return slip
        normal_stiffness = 1.5 * HERTZ * math.sqrt(overlap)
        stiffness = ratio * normal_stiffness
        elastic = HERTZ * overlap**1.5
        normal = elastic + damping * math.sqrt(normal_stiffness) * closing
        if before > 0:
            force *= SPRINGS[spring](stiffness, before)
        before = stiffness
        limit = friction * max(0.0, normal if cap == "whole" else elastic)
        force = np.clip(force - stiffness * slip * step, -limit, limit)
        viscous = dashpot * damping * math.sqrt(stiffness) * slip
        closing -= normal * step
        slip += 3.5 * np.clip(force - viscous, -limit, limit) * step


def read(name: str) -> tuple[np.ndarray, np.ndarray]:
    """Digitised curve: abscissae and ordinates."""
    return np.loadtxt(DATA / name, delimiter=",", skiprows=2).T


def main() -> None:
    """Print the largest and the mean distance of each reading from each curve."""
    print(
        "test 5, undamped: slip after over mu v_n; largest (mean) distance from the published curve"
    )
    for spring, factor in product(SPRINGS, (1.0, 0.5)):
        row = []
        for name, poisson in (("steel", 0.30), ("polyethylene", 0.40)):
            slip, published = read(f"test5_slip_{name}.csv")
            after = rebound_slip(0.3 * slip, 0.3, poisson, 1.0, spring, factor, 0.0) / 0.3
            off = np.abs(after - published)
            row.append(f"{name} {off.max():.2f} ({off.mean():.2f})")
        print(f"  {spring:26s} k_t = {factor:3.1f} Mindlin's   {'   '.join(row)}")
    print("test 6, restitution 0.5: -v_st'/v_st")
    for spring, cap in product(SPRINGS, ("whole", "elastic")):
        row = []
        for name, poisson in (("aluminium_alloy", 0.33), ("nylon", 0.40)):
            inverse, published = read(f"test6_patch_restitution_{name}.csv")
            slip = 3.5 * 0.4 * 1.5 / inverse
            after = rebound_slip(slip, 0.4, poisson, 0.5, spring, cap=cap)
            off = np.abs(-after / slip - published)
            row.append(f"{name} {off.max():.2f} ({off.mean():.2f})")
        print(f"  {spring:26s} capped by mu x {cap:7s} normal force   {'   '.join(row)}")


if __name__ == "__main__":
    main()
