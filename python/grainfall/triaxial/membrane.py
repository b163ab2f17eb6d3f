# SPDX-License-Identifier: GPL-2.0-or-later
"""The latex membrane around a triaxial sample: a pressure turned into forces on the outermost grains.

The lateral surface is divided into cells of angle and height, somewhat smaller than a grain. From each cell a ball of
one mean grain radius comes in along the radius, as a membrane sags between grains, and rests on the grain that it meets
first; that grain gets pressure times the cell's area, along the cell's own inward normal. Over each ring of cells the
forces add up to zero, whatever grains bear them.

The surface lies where the ball's front stands. With R^2 its mean square over the cells, the volume of a sample of
height H is pi R^2 H and the area that bears the pressure 2 pi R H, so that the mean lateral stress (Love-Weber, with
the forces applied at the surface) is the pressure.
"""
from __future__ import annotations

from dataclasses import dataclass

import numpy as np

#: Width and height of a cell over the mean grain diameter: several cells to a grain, so that none is left out.
CELL_IN_DIAMETERS = 0.6


@dataclass(frozen=True)
class RubberTube:
    """The membrane's own elasticity: a thin tube drawn over the sample, free to shorten.

    Parameters
    ----------
    young : float
        Young's modulus of the rubber [Pa].
    thickness : float
        Of the wall [m].
    radius : float
        Radius of the unstretched tube [m].
    """

    young: float
    thickness: float
    radius: float

    def pressure(self, radius: float) -> float:
        """Pressure [Pa] on what stretches the tube to this radius [m]: hoop tension E t (R/R0 - 1) over R.

        The correction of triaxial tests (Henkel & Gilbert 1952; ASTM D4767). A slack tube presses on nothing.
        """
        return max(0.0, self.young * self.thickness * (radius / self.radius - 1) / radius)


@dataclass(frozen=True)
class Membrane:
    """Where a membrane rests.

    Parameters
    ----------
    grains : numpy.ndarray, shape (c,)
        The grain that bears each cell.
    normals : numpy.ndarray, shape (c, 3)
        Outward normal of each cell.
    points : numpy.ndarray, shape (c, 3)
        Where the membrane stands in each cell [m].
    radius : float
        Root mean square radius of the surface [m].
    cell_area : float
        Area of a cell [m2].
    """

    grains: np.ndarray
    normals: np.ndarray
    points: np.ndarray
    radius: float
    cell_area: float

    def forces(self, pressure: float, count: int) -> np.ndarray:
        """Forces of this pressure [Pa] on grains 0 to count - 1, shape (count, 3) [N]."""
        force = -pressure * self.cell_area * self.normals
        return np.column_stack([np.bincount(self.grains, force[:, i], count) for i in range(3)])

    def virial(self, pressure: float) -> np.ndarray:
        """Sum over the cells of point times force, shape (3, 3) [N m]; compression negative."""
        return -pressure * self.cell_area * self.points.T @ self.normals


def wrap(centres: np.ndarray, radii: np.ndarray, bottom: float, top: float) -> Membrane:
    """Wrap a membrane around a sample whose axis is the z axis.

    Parameters
    ----------
    centres : numpy.ndarray, shape (n, 3)
        Grain centres [m].
    radii : numpy.ndarray, shape (n,)
        Grain radii [m].
    bottom, top : float
        Heights of the platens [m].

    Returns
    -------
    Membrane
    """
    ball = float(radii.mean())
    cell = CELL_IN_DIAMETERS * 2 * ball
    reach = np.hypot(centres[:, 0], centres[:, 1])
    outer = np.flatnonzero(reach + radii > 0.5 * float((reach + radii).max()))
    around = max(3, round(2 * np.pi * float((reach + radii).max()) / cell))
    along = max(1, round((top - bottom) / cell))
    angles = 2 * np.pi * (np.arange(around) + 0.5) / around
    heights = bottom + (top - bottom) * (np.arange(along) + 0.5) / along
    grains, distances = _first_met(centres[outer], radii[outer] + ball, angles, heights)
    surface = distances - ball
    normals = np.zeros((along, around, 3))
    normals[..., 0], normals[..., 1] = np.cos(angles), np.sin(angles)
    points = surface[..., None] * normals
    points[..., 2] = heights[:, None]
    radius = float(np.sqrt(np.mean(surface**2)))
    return Membrane(
        grains=outer[grains.ravel()],
        normals=normals.reshape(-1, 3),
        points=points.reshape(-1, 3),
        radius=radius,
        cell_area=2 * np.pi * radius / around * (top - bottom) / along,
    )


def _first_met(
    centres: np.ndarray, reaches: np.ndarray, angles: np.ndarray, heights: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Grain met by the ball of each cell, and how far from the axis its centre then stands.

    Returns
    -------
    grains, distances : numpy.ndarray, shape (heights, angles)
        Where a ball would pass between grains to the axis, the grain nearest to its path bears it.
    """
    across = centres[:, 1, None] * np.cos(angles) - centres[:, 0, None] * np.sin(angles)
    outwards = centres[:, 0, None] * np.cos(angles) + centres[:, 1, None] * np.sin(angles)
    across[outwards < 0] = np.inf
    grains = np.empty((len(heights), len(angles)), dtype=int)
    distances = np.empty(grains.shape)
    columns = np.arange(len(angles))
    for row, height in enumerate(heights):
        lift = centres[:, 2] - height
        near = np.flatnonzero(np.abs(lift) < reaches)
        clearance = (reaches[near] ** 2 - lift[near] ** 2)[:, None] - across[near] ** 2
        met = outwards[near] + np.sqrt(np.maximum(clearance, 0.0))
        met[clearance < 0] = -np.inf
        best = np.argmax(met, axis=0) if len(near) else np.zeros(len(angles), dtype=int)
        found = len(near) > 0 and np.isfinite(met[best, columns])
        grains[row], distances[row] = _or_nearest(
            centres, reaches, across, outwards, lift, near, best, met, found
        )
    return grains, distances


def _or_nearest(
    centres: np.ndarray,
    reaches: np.ndarray,
    across: np.ndarray,
    outwards: np.ndarray,
    lift: np.ndarray,
    near: np.ndarray,
    best: np.ndarray,
    met: np.ndarray,
    found: np.ndarray,
) -> tuple[np.ndarray, np.ndarray]:
    """One row of `_first_met`: the grain met, or else the one nearest to the path."""
    columns = np.arange(across.shape[1])
    if np.all(found):
        return near[best], met[best, columns]
    gap = np.hypot(across, lift[:, None]) - reaches[:, None]
    nearest = np.argmin(gap, axis=0)
    if len(near) == 0:
        return nearest, outwards[nearest, columns]
    grains = np.where(found, near[best], nearest)
    distances = np.where(found, met[best, columns], outwards[nearest, columns])
    return grains, distances
