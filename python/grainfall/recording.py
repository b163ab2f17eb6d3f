# SPDX-License-Identifier: GPL-2.0-or-later
"""Traces of a run: what is measured in every step, averaged into rows, and kept in HDF5 and CSV.

A contact force that is only looked at now and then says little about the impulse: grains hit and leave
within a few steps. So the force is summed in every step, and a row holds its mean since the row before;
the momentum balance of the trace is then exact.
"""
from __future__ import annotations

import csv
import os
from collections.abc import Callable
from pathlib import Path

import h5py
import numpy as np
from yade import O, Vector3

# Columns of the projectile's trace, with units in their names; z and forces point upwards.
TRACE_COLUMNS = (
    "time_s",
    "depth_m",
    "x_m",
    "y_m",
    "z_m",
    "velocity_x_m_per_s",
    "velocity_y_m_per_s",
    "velocity_z_m_per_s",
    "spin_x_rad_per_s",
    "spin_y_rad_per_s",
    "spin_z_rad_per_s",
    "tilt_degrees",
    "force_x_N",
    "force_y_N",
    "force_z_N",
    "nose_force_z_N",
    "shaft_force_z_N",
    "base_force_z_N",
    "largest_force_N",
    "contacts",
)


class Table:
    """Rows of numbers under fixed column names, growing at the end.

    Parameters
    ----------
    columns : sequence of str
        Names, each ending in its unit.
    """

    def __init__(self, columns: tuple[str, ...]) -> None:
        self.columns = tuple(columns)
        self._rows: list[tuple[float, ...]] = []

    def __len__(self) -> int:
        return len(self._rows)

    def append(self, row: tuple[float, ...]) -> None:
        """Add one row with a value for each column."""
        self._rows.append(row)

    def __getitem__(self, column: str) -> np.ndarray:
        """One column, shape (rows,)."""
        index = self.columns.index(column)
        return np.array([row[index] for row in self._rows], dtype=float)

    def array(self) -> np.ndarray:
        """All rows, shape (rows, columns)."""
        return np.array(self._rows, dtype=float).reshape(len(self._rows), len(self.columns))

    def fill(self, rows: np.ndarray) -> None:
        """Replace all rows by those of an array, shape (rows, columns)."""
        self._rows = [tuple(row) for row in np.asarray(rows).tolist()]

    def drop_after(self, time: float) -> None:
        """Forget rows later than `time` [s]; the first column is the time."""
        self._rows = [row for row in self._rows if row[0] <= time]


def save_tables(path: Path, tables: dict[str, Table]) -> None:
    """Write tables to one HDF5 file, a group each and a dataset a column, all at once."""
    partial = path.with_suffix(".partial")
    with h5py.File(partial, "w") as file:
        for name, table in tables.items():
            values = table.array()
            group = file.create_group(name)
            group.attrs["columns"] = list(table.columns)
            for index, column in enumerate(table.columns):
                group.create_dataset(column, data=values[:, index])
    os.replace(partial, path)


def load_tables(path: Path, tables: dict[str, Table]) -> None:
    """Fill tables from a file that `save_tables` wrote."""
    with h5py.File(path, "r") as file:
        for name, table in tables.items():
            columns = [file[name][column][:] for column in table.columns]
            table.fill(np.column_stack(columns) if columns[0].size else np.empty((0, len(columns))))


def save_csv(path: Path, table: Table) -> None:
    """Write a table as comma-separated text, names in the first line."""
    partial = path.with_suffix(".partial")
    with open(partial, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(table.columns)
        writer.writerows([f"{value:.9g}" for value in row] for row in table.array().tolist())
    os.replace(partial, path)


class ProjectileRecorder:
    """Sums the load on a projectile in every step and writes a row every `steps_per_row` steps.

    YADE calls `sample_active` at the end of each step through a PyRunner; a saved scene keeps that call,
    and `activate` connects it with a recorder again.

    Parameters
    ----------
    body : int
        Id of the projectile.
    surface : float
        Height of the sand's surface [m].
    steps_per_row : int
        Steps between rows.
    on_row : callable
        Called after each row.
    """

    def __init__(
        self, body: int, surface: float, steps_per_row: int, on_row: Callable[[], None]
    ) -> None:
        self.body = body
        self.surface = surface
        self.steps_per_row = steps_per_row
        self.trace = Table(TRACE_COLUMNS)
        self._on_row = on_row
        self._clear()
        self.connect()

    def connect(self) -> None:
        """Find body and engine in the present scene; to be repeated after O.load."""
        self._state = O.bodies[self.body].state
        self._nose = Vector3(0, 0, O.bodies[self.body].shape.noseZ)
        self._load = next(e for e in O.engines if e.label == "projectile_load")

    def _clear(self) -> None:
        self._force = Vector3(0, 0, 0)
        self._zones = [0.0, 0.0, 0.0]
        self._largest = 0.0

    def sample(self) -> None:
        """Add the forces of this step; at the end of an interval, write a row."""
        load = self._load
        nose, shaft, base = load.noseForce, load.shaftForce, load.baseForce
        force = nose + shaft + base
        self._force += force
        self._zones[0] += nose[2]
        self._zones[1] += shaft[2]
        self._zones[2] += base[2]
        self._largest = max(self._largest, force.norm())
        if (O.iter + 1) % self.steps_per_row == 0:
            self._write_row((O.iter + 1) * O.dt)
            self._clear()
            self._on_row()

    def _write_row(self, time: float) -> None:
        state, count = self._state, self.steps_per_row
        tip = state.pos + state.ori * self._nose
        downwards = -(state.ori * Vector3(0, 0, 1))[2]
        tilt = np.degrees(np.arccos(np.clip(-downwards, -1.0, 1.0)))
        self.trace.append(
            (
                time,
                self.surface - tip[2],
                *tip,
                *state.vel,
                *state.angVel,
                float(tilt),
                *(self._force / count),
                *(zone / count for zone in self._zones),
                self._largest,
                self._load.contacts,
            )
        )


_active: list[ProjectileRecorder] = []


def activate(recorder: ProjectileRecorder) -> None:
    """Make `recorder` the one that the scene's PyRunner feeds."""
    _active[:] = [recorder]


def sample_active() -> None:
    """Called by YADE at the end of each step."""
    _active[0].sample()
