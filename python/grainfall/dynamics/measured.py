# SPDX-License-Identifier: GPL-2.0-or-later
"""Reading a record from the laboratory: time, displacement and force in a CSV file."""
from __future__ import annotations

import csv
import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

UNITS = {
    "time": {"s": 1.0, "ms": 1e-3, "us": 1e-6},
    "displacement": {"m": 1.0, "mm": 1e-3, "um": 1e-6, "nm": 1e-9},
    "force": {"N": 1.0, "kN": 1e3, "mN": 1e-3},
}
#: Fewer samples than this in a cycle leave amplitude and phase at the mercy of noise.
SAMPLES_PER_CYCLE = 8


class MeasurementError(ValueError):
    """A file that cannot be used; the message names it, the place and what is expected."""


@dataclass(frozen=True)
class Recording:
    """A record of one cyclic test.

    Parameters
    ----------
    time, displacement, force : numpy.ndarray, shape (n,)
        [s], [m], [N]; displacement and force positive in compression.
    """

    time: np.ndarray
    displacement: np.ndarray
    force: np.ndarray

    def check_frequencies(self, frequencies: list[float]) -> None:
        """Raise MeasurementError where the record is too short or too coarse for one of these [Hz]."""
        duration = self.time[-1] - self.time[0]
        coarsest = float(np.max(np.diff(self.time)))
        for frequency in frequencies:
            if not frequency > 0:
                raise MeasurementError(f"frequency = {frequency:g}: must be above 0 Hz")
            if duration * frequency < 2:
                raise MeasurementError(
                    f"{frequency:g} Hz: the record of {duration:g} s holds {duration * frequency:.2g} cycles; at "
                    "least 2 are needed"
                )
            if coarsest * frequency * SAMPLES_PER_CYCLE > 1:
                raise MeasurementError(
                    f"{frequency:g} Hz: samples {coarsest:g} s apart; at least {SAMPLES_PER_CYCLE} a cycle are needed"
                )


def read_recording(path: str | Path, **columns: str) -> Recording:
    """Read a CSV file whose header names each quantity with its unit: ``time_s``, ``displacement_nm``, ``force [N]``.

    Parameters
    ----------
    path : str or Path
        The file; lines that start with # are skipped; further columns are ignored.
    **columns : str
        For columns of other names: ``time='t [ms]'``, ``displacement='gauge_um'``, ``force='cell_N'``. The unit is
        what stands last, after an underscore or in brackets.

    Returns
    -------
    Recording
        In SI units.

    Raises
    ------
    MeasurementError
        A column is missing or has no known unit, a value is no number, or time does not increase.
    """
    path = Path(path)
    unknown = set(columns) - set(UNITS)
    if unknown:
        raise MeasurementError(f"{sorted(unknown)[0]!r}: must be one of {', '.join(UNITS)}")
    if not path.is_file():
        raise MeasurementError(f"{path}: no such file")
    with open(path, newline="", encoding="utf-8-sig") as file:
        numbered = [(n, row) for n, row in enumerate(csv.reader(file), start=1) if _counts(row)]
    if not numbered:
        raise MeasurementError(f"{path}: the file is empty")
    header = [name.strip() for name in numbered[0][1]]
    places = {q: _find(path, header, q, columns.get(q)) for q in UNITS}
    series = {
        quantity: np.array([_value(path, n, row, place, header) for n, row in numbered[1:]]) * scale
        for quantity, (place, scale) in places.items()
    }
    record = Recording(**series)
    if len(record.time) < 2:
        raise MeasurementError(f"{path}: {len(record.time)} rows of values; at least 2 are needed")
    backwards = np.flatnonzero(np.diff(record.time) <= 0)
    if len(backwards):
        raise MeasurementError(f"{path}, line {numbered[backwards[0] + 2][0]}: time must increase")
    return record


def _counts(row: list[str]) -> bool:
    return any(cell.strip() for cell in row) and not row[0].lstrip().startswith("#")


def _find(path: Path, header: list[str], quantity: str, name: str | None) -> tuple[int, float]:
    """Column of a quantity and the factor to SI units."""
    wanted = (
        [name] if name else [h for h in header if re.match(quantity + r"[\s_\[(]", h + " ", re.I)]
    )
    found = [h for h in wanted if h in header]
    if len(found) != 1:
        reason = "no column" if not found else f"{len(found)} columns"
        named = f" named {name!r}" if name else ""
        raise MeasurementError(
            f"{path}: {reason} for {quantity}{named} among {', '.join(map(repr, header))}; "
            f"expected {quantity} followed by its unit, such as '{quantity}_{next(iter(UNITS[quantity]))}'"
        )
    unit = re.search(r"([A-Za-zµμ]+)\s*[\])]?\s*$", found[0])
    text = re.sub("[µμ]", "u", unit.group(1)) if unit else ""
    if text not in UNITS[quantity] or text == found[0]:
        raise MeasurementError(
            f"{path}: column {found[0]!r}: its unit must be one of {', '.join(UNITS[quantity])}"
        )
    return header.index(found[0]), UNITS[quantity][text]


def _value(path: Path, line: int, row: list[str], place: int, header: list[str]) -> float:
    text = row[place] if place < len(row) else ""
    try:
        value = float(text)
    except ValueError:
        value = float("nan")
    if not np.isfinite(value):
        raise MeasurementError(f"{path}, line {line}, {header[place]!r}: {text!r} is no number")
    return value
