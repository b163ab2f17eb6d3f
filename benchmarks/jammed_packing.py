# SPDX-License-Identifier: GPL-2.0-or-later
"""Makes tests/data/packings/jammed_500.csv: a random jammed packing of equal spheres, periodic.

usage: /usr/bin/python3 benchmarks/jammed_packing.py        (a minute; the same numbers each time)

The packing is a minimum of Hertz's energy at given box size (O'Hern, Silbert, Liu & Nagel 2003, Phys. Rev.
E 68:011306), so frictionless and isotropic but for its number; the box is chosen for a mean stress of
1 MPa between quartz grains (G = 29 GPa, nu = 0.31). Lengths in radii, forces in overlaps^1.5.
"""

from __future__ import annotations

import math
import sys
from pathlib import Path

import numpy as np
from scipy.optimize import minimize
from scipy.spatial import cKDTree

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests" / "physics"))
from sphere_packing import RANDOM, Packing, branches  # noqa: E402

COUNT, SEED = 500, 1
STRESS, SHEAR_MODULUS, POISSON = 1e6, 29e9, 0.31  # Pa, Pa, -


def random_packing(count: int, pressure: float, seed: int) -> Packing:
    """Jammed packing of `count` spheres at `pressure`, in the units of `Packing.pressure`."""
    rng = np.random.default_rng(seed)
    packing = _relaxed(Packing(rng.uniform(0, 1, (count, 3)), 1.0), 0.67)
    fractions, roots = [], []
    for fraction in (0.665, 0.66):
        packing = _relaxed(packing, fraction)
        fractions.append(fraction)
        roots.append(packing.pressure() ** (2 / 3))
    for _ in range(3):  # pressure^(2/3) is nearly linear in the solid fraction above jamming
        slope = (roots[-1] - roots[-2]) / (fractions[-1] - fractions[-2])
        fractions.append(fractions[-1] + (pressure ** (2 / 3) - roots[-1]) / slope)
        packing = _relaxed(packing, fractions[-1])
        roots.append(packing.pressure() ** (2 / 3))
    return packing


def _relaxed(packing: Packing, solid_fraction: float) -> Packing:
    """The nearest energy minimum after an affine change to `solid_fraction`."""
    count = len(packing.centres)
    side = (4 / 3 * math.pi * count / solid_fraction) ** (1 / 3)
    start = packing.centres * (side / packing.side)

    def energy_and_gradient(flat: np.ndarray) -> tuple[float, np.ndarray]:
        centres = flat.reshape(-1, 3)
        pairs = cKDTree(centres % side, boxsize=side).query_pairs(2.0, output_type="ndarray")
        branch = branches(centres, pairs, side)
        length = np.maximum(np.linalg.norm(branch, axis=1), 1e-12)
        overlap = 2 - length
        pull = branch * (overlap**1.5 / length)[:, None]
        gradient = np.empty_like(centres)
        for axis in range(3):
            gradient[:, axis] = np.bincount(pairs[:, 0], pull[:, axis], count)
            gradient[:, axis] -= np.bincount(pairs[:, 1], pull[:, axis], count)
        return 0.4 * float((overlap**2.5).sum()), gradient.ravel()

    options = {"maxiter": 4000, "maxfun": 5000, "gtol": 1e-9, "ftol": 0.0, "maxcor": 20}
    result = minimize(
        energy_and_gradient, start.ravel(), jac=True, method="L-BFGS-B", options=options
    )
    return Packing(result.x.reshape(-1, 3), side)


def main() -> None:
    """Make the packing and write it."""
    unit = 4 / 3 * SHEAR_MODULUS / (1 - POISSON) * math.sqrt(0.5)  # Pa, 4/3 E* sqrt(R*/R)
    packing = random_packing(COUNT, STRESS / unit, SEED)
    RANDOM.parent.mkdir(parents=True, exist_ok=True)
    with open(RANDOM, "w", encoding="utf-8") as file:
        file.write(
            "# made by benchmarks/jammed_packing.py: centres of jammed frictionless spheres in a "
            f"periodic cube, in radii; side = {packing.side!r}\n"
        )
        file.write("x_radii,y_radii,z_radii\n")
        np.savetxt(file, packing.centres % packing.side, delimiter=",", fmt="%.15g")
    print(f"solid fraction {packing.solid_fraction:.4f}, stress {packing.pressure() * unit:.4g} Pa")


if __name__ == "__main__":
    main()
