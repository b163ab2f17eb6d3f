# SPDX-License-Identifier: GPL-2.0-or-later
"""What is written down while a drop runs: motion of the projectile, force by zone, energies.

The recorder's engine is saved with the scene and finds its trace here, so a resumed run goes on writing.
"""

from __future__ import annotations

import builtins
import csv
import math
from pathlib import Path
from typing import Any

import h5py
import numpy as np
from yade import O, Vector3

COLUMNS = (
    "time_s",
    "depth_m",
    "velocity_m_per_s",
    "force_N",
    "nose_force_N",
    "shaft_force_N",
    "base_force_N",
    "tilt_deg",
    "contacts",
)
ENERGY_COLUMNS = (
    "time_s",
    "kinetic_J",
    "potential_J",
    "elastic_normal_J",
    "elastic_shear_J",
    "bridges_J",
    "far_field_J",
    "friction_J",
    "viscous_J",
    "rescaling_J",
    "ruptured_J",
    "shear_kinematics_J",
    "total_J",
)
#: Rows of the trace between two rows of energies, which cost a walk over all bodies and contacts.
ENERGY_EVERY = 50


class Trace:
    """Rows of a running drop, kept in memory and appended to ``trace.csv`` and ``energy.csv``.

    Parameters
    ----------
    folder : Path
        Results folder.
    body : int
        The projectile.
    surface : float
        Height of the undisturbed surface [m], from which depth counts.
    """

    def __init__(self, folder: Path, body: int, surface: float) -> None:
        self.folder = folder
        self.body = body
        self.surface = surface
        self.rows: list[tuple[float, ...]] = []
        self._since = O.time
        self.energies: list[tuple[float, ...]] = []
        self._written = {"trace.csv": 0, "energy.csv": 0}

    def record(self) -> None:
        """Add a row; called by the recorder between force computation and integration."""
        self.rows.append(self._row())

    def record_energies(self) -> None:
        """Add a row of energies; called after the ledger of the same step."""
        self.energies.append(energy_row())

    def _row(self) -> tuple[float, ...]:
        body = O.bodies[self.body]
        axis = body.state.ori * Vector3(0, 0, -1)
        nose = body.state.pos + axis * abs(body.shape.noseZ)
        load = _engine("projectile_load")
        tilt = math.degrees(math.acos(min(1.0, max(-1.0, -axis[2]))))
        return (
            O.time,
            self.surface - nose[2],
            -body.state.vel[2],
            *self._mean_forces(load),
            tilt,
            load.contacts,
        )

    def _mean_forces(self, load: Any) -> tuple[float, ...]:
        """Vertical force since the last row [N]: total, nose, shaft, base.

        Grains hit and leave between two rows, so samples would not add up to the momentum lost.
        """
        span = O.time + O.dt - self._since
        zones = (load.totalImpulse, load.noseImpulse, load.shaftImpulse, load.baseImpulse)
        forces = tuple(impulse[2] / span for impulse in zones)
        load.noseImpulse = load.shaftImpulse = load.baseImpulse = Vector3.Zero
        self._since = O.time + O.dt
        return forces

    def flush(self) -> None:
        """Append what is new to the files."""
        self._append("trace.csv", COLUMNS, self.rows)
        self._append("energy.csv", ENERGY_COLUMNS, self.energies)

    def _append(self, name: str, columns: tuple[str, ...], rows: list[tuple[float, ...]]) -> None:
        path = self.folder / name
        start = self._written[name]
        with open(path, "a" if start else "w", newline="") as file:
            writer = csv.writer(file)
            if not start:
                writer.writerow(columns)
            writer.writerows([repr(float(value)) for value in row] for row in rows[start:])
        self._written[name] = len(rows)

    def load(self, until: float) -> None:
        """Take up the rows of an earlier part of the run, those up to `until` [s]; the rest is redone."""
        self.rows = _read(self.folder / "trace.csv", until)
        if self.rows:
            self._since = self.rows[-1][0] + O.dt
        self.energies = _read(self.folder / "energy.csv", until)
        for name in self._written:
            self._written[name] = 0

    def arrays(self) -> dict[str, np.ndarray]:
        """Columns of the trace, each of shape (rows,)."""
        table = np.array(self.rows, dtype=float).reshape(-1, len(COLUMNS))
        return {name: table[:, i] for i, name in enumerate(COLUMNS)}

    def energy_arrays(self) -> dict[str, np.ndarray]:
        """Columns of the energies, each of shape (rows,)."""
        table = np.array(self.energies, dtype=float).reshape(-1, len(ENERGY_COLUMNS))
        return {name: table[:, i] for i, name in enumerate(ENERGY_COLUMNS)}

    def write_hdf5(self) -> Path:
        """Write trace and energies to ``trace.h5``, one dataset a column, and return its path."""
        path = self.folder / "trace.h5"
        with h5py.File(path, "w") as file:
            for group, columns in (("trace", self.arrays()), ("energy", self.energy_arrays())):
                for name, values in columns.items():
                    file.create_dataset(f"{group}/{name}", data=values)
        return path


def energy_row() -> tuple[float, ...]:
    """Energies of the scene in this step [J] from its ledger, in the order of `ENERGY_COLUMNS`."""
    ledger = _engine("energy_ledger")
    ledger.update()
    terms = ledger.table()
    parts = (
        terms["kineticTranslation"] + terms["kineticRotation"],
        terms["potential"],
        terms["elasticNormal"],
        terms["elasticShear"],
        terms["bridge"],
        terms["farField"],
        terms["friction"],
        terms["viscous"],
        terms["rescaling"],
        terms["bridgeRupture"],
        -terms["shearKinematics"],
    )
    return (O.time, *parts, sum(parts))


def _engine(label: str) -> Any:
    """The engine or functor of this label in the scene in hand; YADE makes labels built-in names."""
    return getattr(builtins, label)


def _read(path: Path, until: float) -> list[tuple[float, ...]]:
    if not path.exists():
        return []
    with open(path, newline="") as file:
        rows = [tuple(float(value) for value in row) for row in list(csv.reader(file))[1:]]
    return [row for row in rows if row[0] <= until * (1 + 1e-12)]


_current: Trace | None = None


def set_current(trace: Trace | None) -> None:
    """Name the trace that the recorder of the scene in hand writes to."""
    global _current
    _current = trace


def record() -> None:
    """Called by the recorder's engine; without a trace (scene loaded by hand) nothing is recorded."""
    if _current is not None:
        _current.record()


def record_energies() -> None:
    """Called by the engine behind the ledger."""
    if _current is not None:
        _current.record_energies()
