# SPDX-License-Identifier: GPL-2.0-or-later
"""The copper bar that hits a wall end on (Taylor 1948), in the form on which codes are compared.

Length 32.4 mm, radius 3.2 mm, 227 m/s, E = 117 GPa, nu = 0.35, 8930 kg/m^3, yield 0.4 GPa, hardening 0.1 GPa; the
wall is rigid and smooth; the state after 80 us is compared. A quarter of the bar, by symmetry.
"""
from __future__ import annotations

import numpy as np

from grainfall import femlink

LENGTH, RADIUS, SPEED, DURATION = 32.4e-3, 3.2e-3, 227.0, 80e-6
COPPER = femlink.Solid(117e9, 0.35, 8930, law="j2", yield_stress=0.4e9, hardening=0.1e9)


def quarter_disc(cells: int) -> tuple[np.ndarray, np.ndarray]:
    """Quadrilaterals of a quarter of the unit disc: a square of cells x cells in the middle, as many rings outside.

    Returns
    -------
    points : (n, 2) float
    quads : (m, 4) int
        Corners (0,0), (1,0), (0,1), (1,1).
    """
    side = 0.55
    inner = np.linspace(0, side, cells + 1)
    points: dict[tuple[int, int], int] = {}
    coordinates: list[np.ndarray] = []
    quads = []

    def number(point: np.ndarray) -> int:
        key = (round(point[0] * 1e9), round(point[1] * 1e9))
        if key not in points:
            points[key] = len(coordinates)
            coordinates.append(point)
        return points[key]

    def add(grid: np.ndarray) -> None:
        for j in range(grid.shape[1] - 1):
            for i in range(grid.shape[0] - 1):
                corners = (grid[i, j], grid[i + 1, j], grid[i, j + 1], grid[i + 1, j + 1])
                quads.append([number(corner) for corner in corners])

    square = np.array([[(x, y) for y in inner] for x in inner])
    square *= 1 - 0.12 * (square[..., ::-1] / side) ** 2  # bulges, so that no cell becomes flat
    add(square)
    angle = np.linspace(0, np.pi / 4, cells + 1)
    arc = np.column_stack([np.cos(angle), np.sin(angle)])
    share = np.linspace(0, 1, cells + 1)
    right = np.array([(1 - s) * square[-1] + s * arc for s in share])
    add(right)
    add(right[:, :, ::-1].transpose(1, 0, 2))
    return np.array(coordinates), np.array(quads)


def bar(cells: int, layers: int, element: str) -> tuple[femlink.HexMesh, femlink.ExplicitContinuum]:
    """Quarter of the bar on its way down, its foot at z = 0 on the wall."""
    flat, quads = quarter_disc(cells)
    heights = np.linspace(0, LENGTH, layers + 1)
    vertices = np.array([[*(RADIUS * p), z] for z in heights for p in flat])
    n = len(flat)
    hexahedra = np.array(
        [
            [*(quads[q] + k * n), *(quads[q] + (k + 1) * n)]
            for k in range(layers)
            for q in range(len(quads))
        ]
    )
    mesh = femlink.HexMesh(vertices, hexahedra)
    held = np.abs(vertices) < 1e-9  # the symmetry planes, and the foot on the smooth wall
    continuum = femlink.ExplicitContinuum(
        mesh, {0: COPPER}, element=element, hourglass=0.1, held=held
    )
    velocities = np.zeros_like(vertices)
    velocities[:, 2] = -SPEED
    velocities[held] = 0
    continuum.velocities = velocities
    return mesh, continuum


def shape(mesh: femlink.HexMesh, continuum: femlink.ExplicitContinuum) -> tuple[float, float]:
    """Length of the bar and radius of its foot now, m."""
    now = mesh.vertices + continuum.displacement
    foot = now[mesh.vertices[:, 2] == 0]
    return now[:, 2].max(), np.hypot(foot[:, 0], foot[:, 1]).max()
