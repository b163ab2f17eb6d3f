# SPDX-License-Identifier: GPL-2.0-or-later
"""Running a triaxial test from parameters to results folder: prepare, preload, cycle, stop, resume, sum up."""

from __future__ import annotations

import builtins
import json
import os
import sys
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import yade.timing
from yade import O

from grainfall.contacts import Sand
from grainfall.effects import print_effects
from grainfall.materials import check_scene
from grainfall.options import resumed
from grainfall.progress import Progress
from grainfall.running import advance, undisturbed
from grainfall.triaxial import cyclic, scene
from grainfall.triaxial.loops import write_loops
from grainfall.triaxial.parameters import TABLE, frequency_list, peak_to_peak, softness
from grainfall.triaxial.preloading import preload
from grainfall.triaxial.preparation import RESTITUTION, read_state
from grainfall.triaxial.samples import SampleSpec, load_sample, obtain_sample, save_sample
from grainfall.triaxial.summary import make_summary, print_summary, test_results
from grainfall.wall_clock import Clock

STATE, PARAMETERS, SAMPLE = "state.yade.gz", "parameters.json", "sample.h5"
#: What belongs to the state but is not saved with a scene: membrane forces, and what is finished so far.
FORCES, FINISHED = "membrane_forces.npy", "finished.json"
#: Pieces of a cycle between two looks at the keyboard.
PIECES = 8
#: Isotropic pressure [Pa] below which stiff grains take too long to be pressed together.
LEAST_PREPARATION_PRESSURE = 1e3
#: Isotropic pressure of the preparation over the confinement of the test.
PREPARATION_PRESSURE = 0.5


def triaxial_test(**given: Any) -> dict[str, Any]:
    """Prepare a sample, preload it, cycle it and return the summary that is also written to the folder.

    Parameters
    ----------
    **given
        Any option of ``scenarios/triaxial_calibration.py`` with underscores for dashes, such as
        ``preset='small'``, ``frequencies='10,50'`` [Hz], ``moisture=0.023``, ``output='results/a'``.

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
    return TriaxialRun(folder, parameters, resumed=bool(given.get("resume"))).execute()


def _resolve(given: Mapping[str, Any]) -> tuple[Path, dict[str, Any]]:
    """Results folder and all parameters, those of the interrupted run where one is resumed."""
    if given.get("resume"):
        return resumed(TABLE, given, STATE, PARAMETERS)
    parameters = TABLE.resolve(given)
    return (
        Path(parameters["output"] or Path("results") / f"triaxial-{parameters['preset']}"),
        parameters,
    )


def sample_spec(parameters: Mapping[str, Any]) -> SampleSpec:
    """The sample that these parameters ask for; the platens are softened as the grains are."""
    p = parameters
    return SampleSpec(
        diameter=p["diameter"],
        height=p["height"],
        grain_diameter=p["grain_diameter"],
        grain_spread=p["grain_spread"],
        grain_density=p["grain_density"],
        young=p["young"],
        poisson=p["poisson"],
        platen_young=p["platen_young"] * softness(dict(p)),
        platen_poisson=p["platen_poisson"],
        void_ratio=p["void_ratio"],
        pressure=max(PREPARATION_PRESSURE * p["confinement"], LEAST_PREPARATION_PRESSURE),
        seed=p["seed"],
    )


class TriaxialRun:
    """One run and its results folder."""

    def __init__(self, folder: Path, parameters: dict[str, Any], resumed: bool) -> None:
        self.folder = folder
        self.parameters = parameters
        self.resumed = resumed
        self.clock = Clock()
        self.sample_was_cached = False
        self.interrupted = False
        #: Results of the preloading and of each stretch of cycles, and what earlier parts spent.
        self.finished: dict[str, Any] = {"preload": {}, "tests": [], "price": {}, "wall_seconds": 0}

    @property
    def stretches(self) -> list[list[float]]:
        """Frequencies [Hz] of each stretch of cycles."""
        frequencies = frequency_list(self.parameters)
        return [frequencies] if self.parameters["multisine"] else [[f] for f in frequencies]

    def execute(self) -> dict[str, Any]:
        """Prepare or load, cycle until all frequencies are done or Ctrl-C, and sum up."""
        self.folder.mkdir(parents=True, exist_ok=True)
        if self.resumed:
            self._load()
        else:
            self._prepare()
        if not self.parameters["quiet"]:
            print_effects()
        O.timingEnabled = True
        yade.timing.reset()
        try:
            for stretch in self.stretches[len(self.finished["tests"]) :]:
                test, results = self._cycle(stretch)
                with undisturbed():
                    self.finished["tests"].append(results)
                    write_loops(test, self.folder, len(self.finished["tests"]))
                    self._checkpoint()
        except KeyboardInterrupt:
            self.interrupted = True
        finally:
            cyclic.stop()
        return self._finish()

    def _prepare(self) -> None:
        """Sample from the cache or new, in the scene and preloaded."""
        p = self.parameters
        progress = Progress("sample", p["quiet"])
        self.sample, self.sample_was_cached = obtain_sample(
            sample_spec(p),
            p["sample_cache"],
            lambda stage, fraction: progress.update(fraction, stage),
        )
        progress.close()
        self.clock.lap("sample preparation")
        sand = Sand.of(p)
        self._build(self._preloading_sand(sand))
        progress = Progress("preloading", p["quiet"])
        self.finished["preload"] = preload(self.sample, p, progress.update)
        if p["preload_friction"] is not None:
            self._change_friction(sand)
        if not p["quiet"]:
            for warning in check_scene():
                print(f"warning: {warning}", file=sys.stderr)
        progress.close()
        ledger = [] if p["no_energy"] else [scene.energy_ledger()]
        O.engines = [*O.engines[:3], cyclic.actuator(), *O.engines[3:], *ledger]
        self.clock.lap("preloading")
        for old in self.folder.glob("loops_*.csv"):
            old.unlink()
        (self.folder / PARAMETERS).write_text(json.dumps(p, indent=1))
        save_sample(self.sample, self.folder / SAMPLE)
        with undisturbed():
            self._checkpoint()

    def _preloading_sand(self, sand: Sand) -> Sand:
        """The sand as it is preloaded: as it is, or the same in all runs."""
        friction = self.parameters["preload_friction"]
        if friction is None:
            return sand
        return replace(sand, friction=str(friction), moisture_factor="", restitution=RESTITUTION)

    def _build(self, sand: Sand) -> None:
        """The sample in an empty scene, of this sand."""
        scene.build(
            self.sample,
            sand,
            self.parameters["platen_friction"],
            self.parameters["gravity"],
            self.parameters["path"],
        )

    def _change_friction(self, sand: Sand) -> None:
        """Put the preloaded sample, shear forces included, into a new scene of this sand."""
        step = O.dt
        held = np.array([O.forces.permF(i) for i in range(len(self.sample.radii))])
        read_state(self.sample)
        self._build(sand)
        scene.apply_forces(held)
        O.dt = step
        advance(1)

    def _load(self) -> None:
        """Scene and sample of the interrupted run, after the last stretch that it finished."""
        self.sample = load_sample(self.folder / SAMPLE)
        self.finished = json.loads((self.folder / FINISHED).read_text())
        O.load(str(self.folder / STATE), quiet=True)
        scene.apply_forces(np.load(self.folder / FORCES))

    def _cycle(self, frequencies: list[float]) -> tuple[cyclic.CyclicTest, dict[str, Any]]:
        """Cycle at these frequencies until the response is steady; the record and its results."""
        p = self.parameters
        longest = p["dt_safety"] * scene.stable_step(self.sample)
        test = cyclic.CyclicTest(self.sample, frequencies, peak_to_peak(p), longest)
        cyclic.start(test)
        before = scene.dissipated()
        ledger = None if p["no_energy"] else builtins.energy_ledger
        if ledger is not None:
            ledger.restart()
        name = " + ".join(f"{frequency:g}" for frequency in frequencies) + " Hz"
        progress = Progress(name, p["quiet"])
        for cycle in range(p["most_cycles"] + 1):
            for piece in range(PIECES):
                begin, end = (test.steps_per_cycle * n // PIECES for n in (piece, piece + 1))
                advance(end - begin)
                done = (cycle + (piece + 1) / PIECES) / (p["most_cycles"] + 1)
                progress.update(done, f"cycle {cycle}, change {test.change():.1e}")
            test.end_cycle()
            if not np.all(np.isfinite(test.rows[-1])):
                raise FloatingPointError("a platen's force is not a number: reduce --dt-safety")
            if cycle >= p["least_cycles"] and test.change() < p["steady_change"]:
                break
        progress.close()
        cyclic.stop()
        return test, test_results(test, p, before, ledger)

    def _checkpoint(self) -> None:
        """Save the state after a finished stretch; the old one is replaced only once the new one is whole."""
        forces = np.array([O.forces.permF(i) for i in range(len(self.sample.radii))])
        np.save(self.folder / FORCES, forces)
        partial = self.folder / f"partial-{STATE}"
        O.save(str(partial), quiet=True)
        os.replace(partial, self.folder / STATE)
        (self.folder / FINISHED).write_text(json.dumps(self.finished, indent=1))

    def _finish(self) -> dict[str, Any]:
        """Summary, pictures and page."""
        self.clock.lap("cycles")
        summary = make_summary(self)
        self.finished["price"], self.finished["wall_seconds"] = (
            summary["price"],
            summary["wall_seconds"],
        )
        (self.folder / FINISHED).write_text(json.dumps(self.finished, indent=1))
        (self.folder / "summary.json").write_text(json.dumps(summary, indent=1) + "\n")
        if not self.parameters["no_plots"] and self.finished["tests"]:
            from grainfall.report.triaxial import write_report

            write_report(self.folder)
        if not self.parameters["quiet"]:
            print_summary(summary, self.folder)
        return summary
