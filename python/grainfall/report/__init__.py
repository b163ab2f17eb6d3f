# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures and the summary page of a finished drop, made from the files in its results folder alone.

Files read: ``summary.json``, ``trace.csv``, ``snapshots/*.npz``. Files written: ``plots/*.png``,
``bed_forces.png``, ``summary.html``. Nothing here needs a running YADE, so a page can be made again later::

    /usr/bin/python3 -c "from grainfall.report import write_report; write_report('results/m70-full')"
"""

from __future__ import annotations

import json
from pathlib import Path

from grainfall.report.bed_picture import Snapshot, draw_bed, load_snapshot
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
    chosen = _snapshot_near(folder, summary.get("peak_force_camera_time_s"))
    if chosen is not None:
        pictures.append(draw_bed(chosen, folder / "bed_forces.png"))
    return [*pictures, write_page(summary, pictures, folder / "summary.html")]


def _snapshot_near(folder: Path, time: float | None) -> Snapshot | None:
    """The snapshot next to this time after the first touch, the last one where no time is known."""
    snapshots = [load_snapshot(path) for path in sorted((folder / "snapshots").glob("*.npz"))]
    if not snapshots or time is None:
        return snapshots[-1] if snapshots else None
    touching = [s for s in snapshots if s.time > 0] or snapshots
    return min(touching, key=lambda snapshot: abs(snapshot.time - time))
