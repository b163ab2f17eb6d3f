# SPDX-License-Identifier: GPL-2.0-or-later
"""Moments of a drop on disk: arrays for the report's picture, VTK files for ParaView."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import meshio
import numpy as np
import yade.wrapper
from yade import O

from grainfall.bed_scene import WALL_COUNT
from grainfall.projectile_mesh import write_vtp


class Snapshots:
    """Writes the state of the scene, numbered, into a results folder.

    Parameters
    ----------
    folder : Path
        Results folder; files go to ``snapshots/`` and ``vtk/``.
    grains : int
        Number of grains; the walls and the projectile follow them.
    outline : numpy.ndarray, shape (m, 2)
        Points (z, r) of the projectile's profile in its own axes [m].
    box : tuple of float
        Inside of the box [m].
    """

    def __init__(
        self,
        folder: Path,
        grains: int,
        outline: np.ndarray,
        box: tuple[float, float, float],
    ) -> None:
        self.folder = folder
        self.grains = grains
        self.outline = outline
        self.box = box
        self.largest_relative_overlap = 0.0
        (folder / "snapshots").mkdir(parents=True, exist_ok=True)
        (folder / "vtk").mkdir(parents=True, exist_ok=True)

    def write(
        self, touch: float | None = None, far_field: Mapping[str, np.ndarray] | None = None
    ) -> None:
        """Write the present state; its time counts from `touch`, and is negative before the first touch.

        `far_field`: arrays that show the continuum, for `grainfall.drop.far_field_files`.
        """
        name = f"{round(O.time * 1e6):09d}us"
        points, forces = self._contacts()
        state = O.bodies[self.grains + WALL_COUNT].state
        bodies = [O.bodies[i] for i in range(self.grains)]
        orientation = state.ori
        np.savez_compressed(
            self.folder / "snapshots" / f"{name}.npz",
            time=-1.0 if touch is None else O.time - touch,
            centres=np.array([b.state.pos for b in bodies], dtype=float),
            radii=np.array([b.shape.radius for b in bodies], dtype=float),
            contact_points=points,
            contact_force=forces,
            projectile_position=np.array(state.pos, dtype=float),
            projectile_orientation=np.array([orientation[i] for i in (3, 0, 1, 2)], dtype=float),
            outline=self.outline,
            box=np.array(self.box),
            **(far_field or {}),
        )
        prefix = str(self.folder / "vtk" / name) + "-"
        recorder = yade.wrapper.VTKRecorder(fileName=prefix, recorders=["spheres", "velocity"])
        recorder()
        _write_branches(self.folder / "vtk" / f"{name}-contacts.vtu", points, forces)
        write_vtp(
            self.folder / "vtk" / f"{name}-projectile.vtp", O.bodies[self.grains + WALL_COUNT]
        )

    def _contacts(self) -> tuple[np.ndarray, np.ndarray]:
        """Branches, shape (c, 3, 2) [m], and force magnitudes, shape (c,) [N], of all contacts."""
        branches, forces = [], []
        for contact in O.interactions:
            if not contact.isReal:
                continue
            geom, phys = contact.geom, contact.phys
            ends = [self._end(contact.id1, geom), self._end(contact.id2, geom)]
            branches.append(np.array(ends, dtype=float).T)
            forces.append((phys.normalForce + phys.shearForce).norm())
            if contact.id1 < self.grains and contact.id2 < self.grains:
                overlap = geom.penetrationDepth / min(geom.refR1, geom.refR2)
                self.largest_relative_overlap = max(self.largest_relative_overlap, overlap)
        return np.array(branches).reshape(-1, 3, 2), np.array(forces)

    def _end(self, body: int, geom) -> list[float]:
        """End of a branch: the grain's centre, or the contact point on a wall or the projectile."""
        return list(O.bodies[body].state.pos if body < self.grains else geom.contactPoint)


def _write_branches(path: Path, branches: np.ndarray, forces: np.ndarray) -> None:
    """Contacts as lines with their force.

    YADE's VTKRecorder has no contacts with bodies other than spheres and walls: it crashes on them.
    """
    points = np.swapaxes(branches, 1, 2).reshape(-1, 3)
    lines = np.arange(len(points)).reshape(-1, 2)
    meshio.Mesh(points, [("line", lines)], cell_data={"force_N": [forces]}).write(path)
