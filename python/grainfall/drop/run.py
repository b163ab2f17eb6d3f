# SPDX-License-Identifier: GPL-2.0-or-later
"""Running a drop from parameters to results folder: prepare, run, stop, resume, sum up."""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import yade.timing
from yade import O

from grainfall.bed_settling import unrest
from grainfall.beds import Bed, load_bed, obtain_bed, save_bed
from grainfall.drop import trace as traces
from grainfall.drop.parameters import QUICK, TABLE
from grainfall.drop.results import touch_time
from grainfall.drop.scene import bed_spec, build_scene, projectile_id
from grainfall.drop.snapshots import Snapshots
from grainfall.drop.summary import make_summary, print_summary
from grainfall.effects import print_effects
from grainfall.materials import check_scene
from grainfall.options import OptionError, resumed
from grainfall.progress import Progress
from grainfall.projectile_mesh import outline
from grainfall.running import advance
from grainfall.wall_clock import Clock

if TYPE_CHECKING:
    from grainfall.drop.far_field_record import FarFieldRecord

STATE, PARAMETERS, BED, EARLIER = "state.yade.gz", "parameters.json", "bed.h5", "earlier_parts.json"
#: The nose has come to rest when it sinks slower than the rest speed over this time [s].
REST_DURATION = 10e-3
#: At most this long the run is left alone [s].
LOOK_INTERVAL = REST_DURATION / 5


def drop_test(**given: Any) -> dict[str, Any]:
    """Drop a projectile on a bed of sand and return the summary that is also written to the folder.

    Parameters
    ----------
    **given
        Any option of ``scenarios/drop_test.py`` with underscores for dashes, such as
        ``preset='m70-full'``, ``grain_diameter=0.008`` [m], ``moisture=0.023``, ``output='results/a'``.

    Returns
    -------
    dict
        Contents of ``summary.json``; units are in the keys.

    Raises
    ------
    OptionError
        A parameter is unknown or out of range; nothing has been run or written then.
    """
    folder, parameters = _resolve(given)
    run = DropRun(folder, parameters, resumed=bool(given.get("resume")))
    return run.execute()


def _resolve(given: Mapping[str, Any]) -> tuple[Path, dict[str, Any]]:
    """Results folder and all parameters, those of the interrupted run where one is resumed."""
    if given.get("resume"):
        return resumed(TABLE, given, STATE, PARAMETERS)
    parameters = TABLE.resolve(given, [lambda values: QUICK if values["quick"] else {}])
    if parameters["drop_height"] is None and parameters["impact_speed"] is None:
        raise OptionError("--drop-height or --impact-speed: one of the two must be given")
    folder = Path(parameters["output"] or Path("results") / parameters["preset"])
    return folder, parameters


class DropRun:
    """One run and its results folder."""

    def __init__(self, folder: Path, parameters: dict[str, Any], resumed: bool) -> None:
        self.folder = folder
        self.parameters = parameters
        self.resumed = resumed
        self.clock = Clock()
        self.bed_was_cached = False
        #: Of the continuum around the bed; None where the box is rigid.
        self.far_field: FarFieldRecord | None = None
        #: What the earlier parts of a resumed run spent and saw.
        self.earlier: dict[str, Any] = {"wall_seconds": 0.0, "price": {}, "largest_overlap": 0.0}
        self.interrupted = False

    def execute(self) -> dict[str, Any]:
        """Prepare or load, run until rest, the end or Ctrl-C, and sum up."""
        self.folder.mkdir(parents=True, exist_ok=True)
        bed = self._load() if self.resumed else self._prepare()
        self.trace = traces.Trace(self.folder, projectile_id(bed), bed.surface)
        if self.resumed:
            self.trace.load(until=O.time)
            if self.far_field:
                self.far_field.load(until=O.time)
        self.snapshots = self._snapshots(bed)
        self.snapshots.largest_relative_overlap = self.earlier["largest_overlap"]
        traces.set_current(self.trace)
        if not self.parameters["quiet"]:
            print_effects()
        O.timingEnabled = True
        yade.timing.reset()
        try:
            self._run()
        finally:
            traces.set_current(None)
            self._checkpoint()
        return self._finish(bed)

    def _prepare(self) -> Bed:
        """Bed from the cache or newly settled, scene built; the parameters are written first."""
        text = json.dumps(self.parameters, indent=1)
        progress = Progress("bed", self.parameters["quiet"])
        bed, self.bed_was_cached = obtain_bed(
            bed_spec(self.parameters),
            self.parameters["bed_cache"],
            self.parameters["bed"],
            lambda stage, fraction: progress.update(fraction, stage),
        )
        progress.close()
        for old in (*self.folder.glob("snapshots/*.npz"), *self.folder.glob("vtk/*")):
            old.unlink()
        (self.folder / PARAMETERS).write_text(text)
        save_bed(bed, self.folder / BED)
        self.clock.lap("bed preparation")
        continuum = build_scene(self.parameters, bed)
        if continuum:
            from grainfall.drop.far_field_record import FarFieldRecord

            self.far_field = FarFieldRecord.begin(self.folder, continuum)
        for warning in filter(None, [*check_scene(), unrest(bed.report)]):
            print(f"warning: {warning}", file=sys.stderr)
        self.clock.lap("scene")
        return bed

    def _load(self) -> Bed:
        """Scene and bed of the interrupted run; contacts come back in another order, so that the trajectory
        differs from an uninterrupted one in the last digits."""
        bed = load_bed(self.folder / BED)
        if (self.folder / EARLIER).exists():
            self.earlier = json.loads((self.folder / EARLIER).read_text())
        O.load(str(self.folder / STATE), quiet=True)
        if self.parameters["far_field"] != "rigid":
            from grainfall.drop.far_field_record import FarFieldRecord

            self.far_field = FarFieldRecord(self.folder)
        return bed

    def _snapshots(self, bed: Bed) -> Snapshots:
        p = self.parameters
        shape = O.bodies[projectile_id(bed)].shape
        box = (p["box_length"], p["box_width"], bed.surface)
        return Snapshots(self.folder, len(bed.radii), outline(shape), box)

    def _run(self) -> None:
        """Run in chunks until the end; Ctrl-C stops between two of them."""
        p = self.parameters
        progress = Progress("drop", p["quiet"])
        next_snapshot = O.time if p["vtk_interval"] else float("inf")
        next_checkpoint = O.time + p["checkpoint_interval"]
        try:
            while O.time < p["duration"] and not self._at_rest() and not self._at_far_field():
                if O.time >= next_snapshot:
                    self._snapshot()
                    next_snapshot += p["vtk_interval"]
                if O.time >= next_checkpoint:
                    self._checkpoint()
                    next_checkpoint += p["checkpoint_interval"]
                goal = min(p["duration"], next_snapshot, next_checkpoint, O.time + LOOK_INTERVAL)
                self._advance(max(1, round((goal - O.time) / O.dt)))
                progress.update(O.time / p["duration"], self._state())
        except KeyboardInterrupt:
            self.interrupted = True
        else:
            progress.update(1.0, self._state())
            if p["vtk_interval"]:
                self._snapshot()
        progress.close()

    def _snapshot(self) -> None:
        self.snapshots.write(self._touch(), self.far_field.snapshot() if self.far_field else {})

    def _advance(self, steps: int) -> None:
        """Run so many steps and see that the projectile is still there."""
        advance(steps)
        if self.far_field:
            self.far_field.sample()
        if self.trace.rows and not np.isfinite(self.trace.rows[-1][1]):
            raise FloatingPointError(
                "the projectile's position is not a number: reduce --dt-safety or --time-step"
            )

    def _touch(self) -> float | None:
        """Time of the first touch [s]; None before it."""
        trace = self.trace.arrays()
        return touch_time(trace) if np.any(trace["contacts"] > 0) else None

    def _at_rest(self) -> bool:
        """Has the nose, once in contact, stopped sinking? Toppling afterwards is not waited for."""
        now = self.trace.rows[-1] if self.trace.rows else None
        if now is None or now[8] == 0:
            return False
        before = next(
            (row for row in reversed(self.trace.rows) if row[0] <= now[0] - REST_DURATION), None
        )
        in_contact = before is not None and before[8] > 0
        return in_contact and now[1] - before[1] < self.parameters["rest_speed"] * REST_DURATION

    def _at_far_field(self) -> bool:
        """Would the projectile reach the continuum before the next look?"""
        return self.far_field is not None and self.far_field.is_reached(
            self.parameters, self.trace.body, 1.5 * LOOK_INTERVAL
        )

    def _state(self) -> str:
        if not self.trace.rows:
            return ""
        row = self.trace.rows[-1]
        return f"{O.time * 1e3:.1f} ms, {row[2]:.2f} m/s, {row[1] * 1e3:.1f} mm deep"

    def _checkpoint(self) -> None:
        """Save trace and scene; the old state is replaced only once the new one is whole."""
        self.trace.flush()
        if self.far_field:
            self.far_field.flush()
        partial = self.folder / f"partial-{STATE}"
        O.save(str(partial), quiet=True)
        os.replace(partial, self.folder / STATE)

    def _finish(self, bed: Bed) -> dict[str, Any]:
        """Summary, HDF5 file, pictures and page."""
        self.clock.lap("drop")
        summary = make_summary(self, bed)
        spent = {
            "wall_seconds": summary["wall_seconds"],
            "price": summary["price"],
            "largest_overlap": self.snapshots.largest_relative_overlap,
        }
        (self.folder / EARLIER).write_text(json.dumps(spent, indent=1))
        (self.folder / "summary.json").write_text(json.dumps(summary, indent=1) + "\n")
        self.trace.write_hdf5()
        if self.far_field:
            from grainfall.drop.far_field_files import write_far_field_files

            write_far_field_files(self.folder, self.far_field.continuum)
        if not self.parameters["no_plots"]:
            from grainfall.report import write_report

            write_report(self.folder)
        if not self.parameters["quiet"]:
            print_summary(summary, self.folder)
        return summary
