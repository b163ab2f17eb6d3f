# SPDX-License-Identifier: GPL-2.0-or-later
"""Walls and closed forms that the tests of the deformable wall share."""
from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("grainfall.femlink._continuum", reason="built without deal.II")

from grainfall import femlink  # noqa: E402

YOUNG, POISSON, DENSITY = 20e6, 0.3, 1600.0  # loose sand at small strain: Pa, 1, kg/m^3
SAND = {0: (YOUNG, POISSON, DENSITY)}


def run_script(script: Path, *arguments: str, threads: int = 1) -> None:
    """Runs a script in a YADE of its own, with this package; it must leave with 0."""
    package = str(Path(sys.modules["grainfall"].__file__).parents[1])
    run = subprocess.run(
        ["yade", f"-j{threads}", "-n", "-x", str(script), *arguments],
        env={**os.environ, "PYTHONPATH": package},
        capture_output=True,
        timeout=300,
    )
    assert run.returncode == 0, run.stderr.decode()[-2000:]


def node_contacts(surface: femlink.Surface, nodes: np.ndarray) -> tuple[list[int], np.ndarray]:
    """Face and reference point of each of the surface's nodes given, (k,) and (k, 2)."""
    faces = surface.faces
    across = round(faces.shape[1] ** 0.5)
    place: dict[int, tuple[int, int]] = {}
    for face, row in enumerate(faces):
        for corner, node in enumerate(row):
            place.setdefault(int(node), (face, corner))
    found = [place[int(node)] for node in nodes]
    references = [
        (2 * (corner % across) / (across - 1) - 1, 2 * (corner // across) / (across - 1) - 1)
        for _, corner in found
    ]
    return [face for face, _ in found], np.array(references)


def half_space_displacement(x: np.ndarray, force: tuple[float, float, float]) -> np.ndarray:
    """Displacement of the half-space z < 0 under a force at its origin (m); x: (n, 3), force (Fx, 0, Fz), N.

    Boussinesq and Cerruti, as in Johnson 1985, eq 3.18 and 3.75 (his z points into the body).
    """
    shear = YOUNG / (2 * (1 + POISSON))
    depth = -x[:, 2]
    r = np.linalg.norm(x, axis=1)
    normal, tangential = -force[2] / (4 * np.pi * shear), force[0] / (4 * np.pi * shear)
    k = 1 - 2 * POISSON
    u = np.zeros_like(x)
    for axis in (0, 1):
        u[:, axis] = normal * (x[:, axis] * depth / r**3 - k * x[:, axis] / (r * (r + depth)))
        u[:, axis] += tangential * (
            x[:, 0] * x[:, axis] / r**3 - k * x[:, 0] * x[:, axis] / (r * (r + depth) ** 2)
        )
    u[:, 0] += tangential * (1 / r + k / (r + depth))
    u[:, 2] = -normal * (depth**2 / r**3 + 2 * (1 - POISSON) / r)
    u[:, 2] -= tangential * (x[:, 0] * depth / r**3 + k * x[:, 0] / (r * (r + depth)))
    return u
