# SPDX-License-Identifier: GPL-2.0-or-later
"""The recorded loops of force and displacement as files."""
from __future__ import annotations

import csv
from pathlib import Path

import h5py
import numpy as np

from grainfall.triaxial.cyclic import COLUMNS, CyclicTest


def write_loops(test: CyclicTest, folder: Path, number: int) -> None:
    """Write the record of stretch `number` to ``loops_<number>.csv`` and into ``loops.h5``.

    The CSV's columns are those that `grainfall.dynamics.read_recording` reads (the lower platen's force under
    ``force='lower_force_N'``).
    """
    table = test.table()
    with open(folder / f"loops_{number}.csv", "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(COLUMNS)
        writer.writerows([repr(float(value)) for value in row] for row in table)
    with h5py.File(folder / "loops.h5", "w" if number == 1 else "a") as file:
        if str(number) in file:
            del file[str(number)]
        group = file.create_group(str(number))
        group.attrs["frequency_Hz"] = test.frequencies
        group.attrs["cycle_ends"] = test.cycle_ends
        for name, values in zip(COLUMNS, table.T):
            group.create_dataset(name, data=values)


def read_loops(folder: Path) -> list[dict[str, np.ndarray]]:
    """Records of all stretches in ``loops.h5``: the columns, ``frequency_Hz`` and ``cycle_ends`` of each."""
    with h5py.File(folder / "loops.h5", "r") as file:
        return [
            {
                **{name: file[key][name][:] for name in COLUMNS},
                "frequency_Hz": file[key].attrs["frequency_Hz"],
                "cycle_ends": file[key].attrs["cycle_ends"],
            }
            for key in sorted(file, key=int)
        ]
