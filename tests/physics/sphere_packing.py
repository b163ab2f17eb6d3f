# SPDX-License-Identifier: GPL-2.0-or-later
"""Packings of equal spheres in a periodic cube, in units of their radius: a lattice, and a random one
kept in tests/data (made by benchmarks/jammed_packing.py).
"""
from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree

RANDOM = Path(__file__).resolve().parents[1] / "data" / "packings" / "jammed_500.csv"


@dataclass(frozen=True)
class Packing:
    """centres, shape (n, 3), in a cube of side `side`, both in radii."""

    centres: np.ndarray
    side: float

    @property
    def solid_fraction(self) -> float:
        return 4 / 3 * math.pi * len(self.centres) / self.side**3

    def contacts(self) -> tuple[np.ndarray, np.ndarray]:
        """Pairs of touching spheres, shape (c, 2), and branch vectors, shape (c, 3)."""
        pairs = cKDTree(self.centres % self.side, boxsize=self.side).query_pairs(
            2.0, output_type="ndarray"
        )
        return pairs, branches(self.centres, pairs, self.side)

    def pressure(self) -> float:
        """Mean stress over 4/3 E* sqrt(R*/R)."""
        _, branch = self.contacts()
        length = np.linalg.norm(branch, axis=1)
        return float(((2 - length) ** 1.5 * length).sum()) / (3 * self.side**3)


def face_centred_cubic(cells: int, overlap: float) -> Packing:
    """`cells`^3 cubes of the close packing, neighbours overlapping by `overlap`."""
    edge = math.sqrt(2) * (2 - overlap)
    corner = np.array([(0, 0, 0), (0, 0.5, 0.5), (0.5, 0, 0.5), (0.5, 0.5, 0)])
    origin = np.stack(np.meshgrid(*[np.arange(cells)] * 3), axis=-1).reshape(-1, 1, 3)
    return Packing(((origin + corner + 0.25) * edge).reshape(-1, 3), cells * edge)


def read_random() -> Packing:
    """500 frictionless spheres, jammed: no residual force above 2e-5 of the mean contact force."""
    with open(RANDOM, encoding="utf-8") as file:
        side = float(file.readline().split("side =")[1])
        file.readline()
        return Packing(np.loadtxt(file, delimiter=","), side)


def branches(centres: np.ndarray, pairs: np.ndarray, side: float) -> np.ndarray:
    """Vectors from the first to the nearest image of the second sphere of each pair, shape (c, 3)."""
    branch = centres[pairs[:, 1]] - centres[pairs[:, 0]]
    return branch - side * np.round(branch / side)
