# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures and the summary page of a finished drop, made from the files in its results folder alone.

Files read: ``summary.json``, ``trace.csv``, ``snapshots/*.npz``. Files written: ``plots/*.png``,
``bed_forces.png``, ``summary.html``. Nothing here needs a running YADE, so a page can be made again later::

    /usr/bin/python3 -c "from grainfall.report import write_report; write_report('results/m70-full')"
"""

from __future__ import annotations

import json
from pathlib import Path

from grainfall.report.bed_picture import draw_bed, load_snapshot
from grainfall.report.html_page import write_page
from grainfall.report.plots import draw_trace, read_trace

__all__ = ["draw_bed", "draw_trace", "load_snapshot", "read_trace", "write_page", "write_report"]


def write_report(folder: str | Path) -> list[Path]:
    """Write plots, the picture of the bed and the HTML page of a results folder.

    Parameters
    ----------
    folder : str or Path
        Results folder of a drop.

    Returns
    -------
    list of Path
        The files written, the page last.

    Raises
    ------
    FileNotFoundError
        The folder has no ``summary.json`` or no ``trace.csv``.
    """
    folder = Path(folder)
    summary = json.loads((folder / "summary.json").read_text())
    trace = read_trace(folder / "trace.csv")

    pictures = [draw_trace(trace, summary, folder / "plots" / "trace.png")]
    snapshots = sorted((folder / "snapshots").glob("*.npz"))
    if snapshots:
        strongest = _snapshot_nearest(snapshots, summary.get("peak_force_time_s"))
        pictures.append(draw_bed(load_snapshot(strongest), folder / "bed_forces.png"))
    return [*pictures, write_page(summary, pictures, folder / "summary.html")]


def _snapshot_nearest(snapshots: list[Path], time: float | None) -> Path:
    """The snapshot next to the moment of peak force; the last one where that is not known."""
    if time is None:
        return snapshots[-1]
    return min(snapshots, key=lambda path: abs(load_snapshot(path).time - time))
