# SPDX-License-Identifier: GPL-2.0-or-later
"""How large can the force of the report's Table 1 be? Bounds that need no simulation.

The report gives a peak of 350 kN (Figure 10) for a projectile of 10 kg at 2.0 m/s in 50 000 grains of 5 mm
and 1.0 g with a shear modulus of 1e9 Pa and Poisson's ratio 0.4. Run with any Python 3::

    /usr/bin/python3 benchmarks/table1_bounds.py [results/table1]

With a results folder of the drop test the measured peaks are printed beside the bounds.
"""

from __future__ import annotations

import json
import math
import sys
from pathlib import Path

MASS, SPEED, DIAMETER = 10.0, 2.0, 0.057  # kg, m/s, m: projectile
GRAIN_MASS, GRAIN_DIAMETER = 1.0e-3, 5e-3  # kg, m
SHEAR_MODULUS, POISSON = 1e9, 0.4  # Pa, -
REPORTED = 350e3  # N


def hertz_peak(modulus: float, radius: float, mass: float, speed: float) -> float:
    """Peak force [N] of an elastic impact: effective modulus [Pa], radius [m], mass [kg], speed [m/s]."""
    overlap = (15 * mass * speed**2 / (16 * modulus * math.sqrt(radius))) ** 0.4
    return 4 / 3 * modulus * math.sqrt(radius) * overlap**1.5


def bounds() -> dict[str, float]:
    """Each bound by its name; forces in N, times in s."""
    area = math.pi / 4 * DIAMETER**2
    grain_density = GRAIN_MASS / (math.pi / 6 * GRAIN_DIAMETER**3)
    constrained = 2 * SHEAR_MODULUS * (1 - POISSON) / (1 - 2 * POISSON)
    wave_speed = math.sqrt(constrained / grain_density)
    rigid_on_grain = (
        2 * SHEAR_MODULUS / (1 - POISSON)
    )  # effective modulus against a rigid projectile
    one_grain = hertz_peak(rigid_on_grain, GRAIN_DIAMETER / 2, GRAIN_MASS, SPEED)
    under_nose = 0.6 * area / (math.pi / 4 * GRAIN_DIAMETER**2)
    return {
        "momentum of the projectile [N s]": MASS * SPEED,
        "time in which the reported force stops it [s]": MASS * SPEED / REPORTED,
        "distance covered in that time [m]": 0.5 * SPEED * MASS * SPEED / REPORTED,
        "flat face on a solid block of grain material, rho c A v [N]": grain_density
        * wave_speed
        * area
        * SPEED,
        "one free grain struck at full speed, elastic [N]": one_grain,
        "all grains under the full section struck at once [N]": one_grain * under_nose,
        "force that stops it in 0.1 s [N]": MASS * SPEED / 0.1 + MASS * 9.81,
    }


def main(arguments: list[str]) -> None:
    """Print the bounds, and the measured peaks of a results folder if one is given."""
    for name, value in bounds().items():
        print(f"{name:64s} {value:10.3g}")
    print(f"{'reported peak [N]':64s} {REPORTED:10.3g}")
    for folder in arguments:
        summary = json.loads((Path(folder) / "summary.json").read_text())
        for key in ("peak_force_N", "peak_force_camera_N"):
            print(f"{folder + ': ' + key:64s} {summary[key]:10.3g}")


if __name__ == "__main__":
    main(sys.argv[1:])
