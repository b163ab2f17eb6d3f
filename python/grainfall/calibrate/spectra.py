# SPDX-License-Identifier: GPL-2.0-or-later
"""Stiffness and damping by frequency and moisture: what a calibration is fitted to."""
from __future__ import annotations

import csv
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

#: Columns of a file; the errors may be missing.
COLUMNS = ("moisture", "frequency_Hz", "stiffness_N_per_m", "damping_N_s_per_m")
ERROR_COLUMNS = ("stiffness_error_N_per_m", "damping_error_N_s_per_m")
#: Relative standard errors where a file states none: scatter between samples rather than noise of the instruments.
STIFFNESS_ERROR, DAMPING_ERROR = 0.02, 0.1


class SpectraError(ValueError):
    """A table that cannot be used; the message names it, the line and what is expected."""


@dataclass(frozen=True)
class Spectra:
    """k and b of one or more samples.

    Parameters
    ----------
    moisture, frequency : numpy.ndarray, shape (n,)
        [kg/kg], [Hz].
    stiffness, damping : numpy.ndarray, shape (n,)
        [N/m], [N s/m].
    stiffness_error, damping_error : numpy.ndarray, shape (n,)
        Standard errors [N/m], [N s/m].
    """

    moisture: np.ndarray
    frequency: np.ndarray
    stiffness: np.ndarray
    damping: np.ndarray
    stiffness_error: np.ndarray
    damping_error: np.ndarray

    @property
    def conditions(self) -> list[tuple[float, list[float]]]:
        """Each moisture with its frequencies [Hz], in the order of the rows."""
        found: dict[float, list[float]] = {}
        for moisture, frequency in zip(self.moisture.tolist(), self.frequency.tolist()):
            found.setdefault(moisture, []).append(frequency)
        return list(found.items())

    def residuals(self, modelled: Mapping[tuple[float, float], tuple[float, float]]) -> np.ndarray:
        """Model less measurement over its standard error, shape (2 n,): all k, then all b.

        Parameters
        ----------
        modelled : mapping
            (k, b) by (moisture, frequency).
        """
        pairs = [modelled[key] for key in zip(self.moisture.tolist(), self.frequency.tolist())]
        stiffness, damping = np.array(pairs).T
        return np.concatenate(
            (
                (stiffness - self.stiffness) / self.stiffness_error,
                (damping - self.damping) / self.damping_error,
            )
        )


def spectra_of(
    rows: list[tuple[float, float, float, float]],
    stiffness_error: float = STIFFNESS_ERROR,
    damping_error: float = DAMPING_ERROR,
) -> Spectra:
    """Spectra of rows (moisture, frequency, k, b) with these relative standard errors."""
    moisture, frequency, stiffness, damping = np.array(rows, dtype=float).T
    return Spectra(
        moisture,
        frequency,
        stiffness,
        damping,
        stiffness_error * np.abs(stiffness),
        damping_error * np.abs(damping),
    )


def read_spectra(path: str | Path) -> Spectra:
    """Read a CSV file with the columns `COLUMNS` and, where known, `ERROR_COLUMNS`; lines with # are skipped.

    Raises
    ------
    SpectraError
        A column is missing, a value is no number or out of range, or a row stands there twice.
    """
    path = Path(path)
    if not path.is_file():
        raise SpectraError(f"{path}: no such file")
    with open(path, newline="", encoding="utf-8-sig") as file:
        lines = [
            (n, [cell.strip() for cell in row])
            for n, row in enumerate(csv.reader(file), start=1)
            if any(cell.strip() for cell in row) and not row[0].lstrip().startswith("#")
        ]
    header = lines[0][1] if lines else []
    for name in COLUMNS:
        if name not in header:
            raise SpectraError(
                f"{path}: no column {name!r} among {', '.join(map(repr, header)) or 'none'}"
            )
    if len(lines) < 2:
        raise SpectraError(f"{path}: no rows of values")
    table = {
        name: np.array([_number(path, line, header, name) for line in lines[1:]])
        for name in (*COLUMNS, *ERROR_COLUMNS)
        if name in header
    }
    keys = list(zip(table["moisture"].tolist(), table["frequency_Hz"].tolist()))
    for place, key in enumerate(keys):
        if key in keys[:place]:
            raise SpectraError(
                f"{path}, line {lines[place + 1][0]}: moisture {key[0]:g} at {key[1]:g} Hz stands there twice"
            )
    stiffness, damping = table["stiffness_N_per_m"], table["damping_N_s_per_m"]
    return Spectra(
        table["moisture"],
        table["frequency_Hz"],
        stiffness,
        damping,
        table.get(ERROR_COLUMNS[0], STIFFNESS_ERROR * np.abs(stiffness)),
        table.get(ERROR_COLUMNS[1], DAMPING_ERROR * np.abs(damping)),
    )


def _number(path: Path, line: tuple[int, list[str]], header: list[str], name: str) -> float:
    number, cells = line
    place = header.index(name)
    text = cells[place] if place < len(cells) else ""
    try:
        value = float(text)
    except ValueError:
        value = float("nan")
    lowest = {"moisture": 0.0, "damping_N_s_per_m": -np.inf}.get(name, np.nextafter(0, 1))
    if not np.isfinite(value) or value < lowest:
        allowed = "a number" + {0.0: " of at least 0", -np.inf: ""}.get(lowest, " above 0")
        raise SpectraError(f"{path}, line {number}, {name!r}: {text!r} must be {allowed}")
    return value
