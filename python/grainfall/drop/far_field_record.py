# SPDX-License-Identifier: GPL-2.0-or-later
"""What is written down of the continuum around a bed while a drop runs, and what a summary says of it."""
from __future__ import annotations

import builtins
import csv
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np
from yade import O

from grainfall.drop.far_field import Continuum, clearance
from grainfall.projectile_mesh import surface_mesh

COLUMNS = (
    "time_s",
    "contacts",
    "force_x_N",
    "force_y_N",
    "force_z_N",
    "stored_J",
    "largest_displacement_m",
    "disagreement",
)
CONTINUUM, START, RECORD = "far_field.json", "far_field_start.npz", "far_field.csv"


class FarFieldRecord:
    """Rows of ``far_field.csv``: contacts, force on the continuum, its energy, how far its nodes have moved.

    Parameters
    ----------
    folder : Path
        Results folder, with the files that `begin` wrote.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.continuum = Continuum.load(folder / CONTINUUM)
        self._start = np.load(folder / START)["forces"]
        self.rows: list[tuple[float, ...]] = []
        #: Distance of the projectile from the continuum when the run ended for it [m]; None if it did not.
        self.reached: float | None = None

    @classmethod
    def begin(cls, folder: Path, continuum: Continuum) -> FarFieldRecord:
        """Of a new run, before its first step."""
        continuum.save(folder / CONTINUUM)
        np.savez(folder / START, forces=np.array(builtins.far_field.nodeForces()))
        return cls(folder)

    def load(self, until: float) -> None:
        """Take up the rows of an earlier part of the run, those up to `until` [s]."""
        path = self.folder / RECORD
        if path.exists():
            with open(path, newline="") as file:
                rows = [tuple(map(float, row)) for row in list(csv.reader(file))[1:]]
            self.rows = [row for row in rows if row[0] <= until * (1 + 1e-12)]

    def sample(self) -> None:
        """Add a row."""
        wall = builtins.far_field
        moved = np.array(wall.nodeDisplacements())
        if wall.datum:
            moved = moved - np.array(wall.datum)
        largest = float(np.linalg.norm(moved, axis=1).max())
        self.rows.append(
            (O.time, wall.contacts, *wall.force, wall.storedEnergy, largest, wall.disagreement)
        )

    def flush(self) -> None:
        """Write the rows."""
        with open(self.folder / RECORD, "w", newline="") as file:
            writer = csv.writer(file)
            writer.writerow(COLUMNS)
            writer.writerows([repr(float(value)) for value in row] for row in self.rows)

    def snapshot(self) -> dict[str, np.ndarray]:
        """What shows the continuum at this moment: forces on its nodes beyond those at the start, shape (n, 3) [N], or
        the state of one with inertia."""
        wall = builtins.far_field
        if wall.continuum:
            return {"far_field_state": np.array(wall.continuum.state())}
        return {"far_field_forces": np.array(wall.nodeForces()) - self._start}

    def is_reached(self, p: dict[str, Any], projectile: int, ahead: float) -> bool:
        """May the projectile touch the continuum within `ahead` [s]? It has no contact with it."""
        body = O.bodies[projectile]
        points, _, _ = surface_mesh(body, meridians=16)
        gap = clearance(p, points)
        turning = body.state.angVel.norm() * float(
            np.linalg.norm(points - np.array(list(body.state.pos)), axis=1).max()
        )
        if gap > (body.state.vel.norm() + turning) * ahead:
            return False
        self.reached = gap
        return True

    def summary(self, interval: int) -> dict[str, Any]:
        """What the summary says of the continuum."""
        table = np.array(self.rows, dtype=float).reshape(-1, len(COLUMNS))
        column = {name: table[:, i] for i, name in enumerate(COLUMNS)}
        result = {
            **asdict(self.continuum),
            "interval": interval,
        }
        if len(table):
            result |= {
                "contacts": int(column["contacts"][-1]),
                "most_contacts": int(column["contacts"].max()),
                "force_N": [float(column[f"force_{axis}_N"][-1]) for axis in "xyz"],
                "strain_energy_J": float(column["stored_J"][-1]),
                "largest_displacement_m": float(column["largest_displacement_m"].max()),
                "largest_disagreement": float(column["disagreement"].max()),
            }
        return {_with_unit(name): value for name, value in result.items()}

    def notes(self) -> list[str]:
        """What a reader must know."""
        if self.reached is None:
            return []
        return [
            f"The run ended because the projectile came within {1e3 * self.reached:.1f} mm of the continuum, with "
            "which it has no contact: take a larger box (--near-field-radius, --bed-depth)."
        ]


_UNITS = {
    "cavity": "m",
    "thickness": "m",
    "element": "m",
    "young": "Pa",
    "density": "kg_per_m3",
    "setup_seconds": "",
}


def _with_unit(name: str) -> str:
    unit = _UNITS.get(name, "")
    return f"{name}_{unit}" if unit else name
