# SPDX-License-Identifier: GPL-2.0-or-later
"""Who takes part, and how one sample of each is taken: a process of its own on the same bed."""
from __future__ import annotations

import json
import os
import shutil
import subprocess
import tempfile
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from speed import bed as beds
from speed import peers
from speed.bed import Bed

ROOT = Path(__file__).resolve().parents[2]
#: Pairs nearer than this belong to the bare kernel's list of contacts [m]: nothing moves so far in 100 steps, nor
#: three times as far in 200.
CONTACT_MARGIN = 1e-5


@dataclass(frozen=True)
class Run:
    """What is to be timed.

    Parameters
    ----------
    bed : Bed
        The bed at the start.
    threads : int
        Threads, or MPI ranks.
    warm_up, steps : int
        Steps before the clock is read first, and between the two readings.
    skin : float
        Pairs nearer than this are listed [m]; twice YADE's verletDist.
    """

    bed: Bed
    threads: int
    warm_up: int
    steps: int
    skin: float


@dataclass
class Sample:
    """What was measured.

    Parameters
    ----------
    wall, processor : float
        Seconds a step; the processor's nan where it was not measured (more than one MPI rank).
    rebuilds : int
        Searches for neighbours between the two readings.
    bodies : numpy.ndarray, shape (n, 11)
        The bed at the end.
    extra : dict
        More numbers of this contender.
    """

    wall: float
    processor: float
    rebuilds: int
    bodies: np.ndarray
    extra: dict[str, float] = field(default_factory=dict)


@dataclass(frozen=True)
class Contender:
    """One program with one set of options.

    Parameters
    ----------
    name, label : str
        Key in the results, and name in tables.
    sample : callable
        Takes a `Run` and an empty folder.
    absent : str
        Why it cannot run here; empty if it can.
    most_threads : int
        Threads it can use.
    moving_skin : float
        Pairs listed where the projectile moves [m]: the best of 0.25 to 2 mm for this program; 0: it does
        not take part there.
    """

    name: str
    label: str
    sample: Callable[[Run, Path], Sample]
    absent: str = ""
    most_threads: int = 2
    moving_skin: float = 7.5e-4


def contenders(build: Path) -> list[Contender]:
    """All of them, present or not."""
    no_yade = "" if shutil.which("yade") else "yade is not installed"
    no_lammps = "" if shutil.which("lmp") else "LAMMPS (Debian: lammps) is not installed"
    no_liggghts = "" if shutil.which("liggghts") else "LIGGGHTS (Debian: liggghts) is not installed"
    no_flat = no_yade or _flat_path_absent(build)

    def yade(path: str, own_verlet: bool = True) -> Callable[[Run, Path], Sample]:
        return lambda run, folder: _yade_sample(build, path, own_verlet, run, folder)

    def lammps(law: str) -> Callable[[Run, Path], Sample]:
        return lambda run, folder: _peer_sample("lmp", law, run, folder)

    return [
        Contender("stock_yade_default", "stock YADE, default", yade("stock", False), no_yade),
        Contender("stock_yade", "stock YADE, tuned", yade("stock"), no_yade),
        Contender("general", "Grainfall, general path", yade("general"), no_yade),
        Contender("flat", "Grainfall, flat path", yade("flat"), no_flat, moving_skin=2.5e-4),
        Contender(
            "lammps_granular",
            "LAMMPS granular",
            lammps("granular"),
            no_lammps,
            moving_skin=1.5e-3,
        ),
        Contender(
            "lammps_hertz_history",
            "LAMMPS gran/hertz/history",
            lammps("hertz/history"),
            no_lammps,
            moving_skin=1.5e-3,
        ),
        Contender(
            "liggghts",
            "LIGGGHTS hertz history",
            lambda run, folder: _peer_sample("liggghts", "", run, folder),
            no_liggghts,
            moving_skin=2e-3,
        ),
        Contender(
            "kernel",
            "bare kernel and leapfrog",
            lambda run, folder: _kernel_sample(bare_loop(build), run, folder),
            most_threads=1,
            moving_skin=0,
        ),
    ]


def bare_loop(build: Path) -> Path:
    """The program `bare_loop` of a build."""
    return build / "benchmarks" / "speed" / "bare_loop"


def take(contender: Contender, run: Run) -> Sample:
    """One sample in a folder that is removed afterwards."""
    with tempfile.TemporaryDirectory(prefix="grainfall_speed_") as folder:
        return contender.sample(run, Path(folder))


def yade_environment(build: Path) -> dict[str, str]:
    """Environment in which YADE finds this build and this benchmark."""
    path = f"{(build / 'python').resolve()}:{ROOT / 'benchmarks'}"
    # Sleeping threads, so that a second thread does not spin while the first is alone.
    return {**os.environ, "PYTHONPATH": path, "OMP_WAIT_POLICY": "passive"}


def _flat_path_absent(build: Path) -> str:
    script = """import os
import grainfall
from speed.yade_scene import has_flat_path
os._exit(0 if has_flat_path() else 3)
"""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "probe.py"
        file.write_text(script, encoding="ascii")
        command = ["yade", "-j1", "-n", "-x", str(file)]
        done = subprocess.run(command, env=yade_environment(build), capture_output=True)
    return "" if done.returncode == 0 else "this build has no flat path"


def _yade_sample(build: Path, path: str, own_verlet: bool, run: Run, folder: Path) -> Sample:
    report, bodies = folder / "report.json", folder / "bodies.f64"
    command = ["yade", f"-j{run.threads}", "-n", "-x", ROOT / "benchmarks/speed/yade_run.py", path]
    command += [run.bed.path, "--side", repr(run.bed.side), "--report", report, "--bodies", bodies]
    command += ["--warm-up", run.warm_up, "--steps", run.steps]
    if own_verlet:
        command += ["--verlet", repr(run.skin / 2)]
    log = _call([str(word) for word in command], folder, yade_environment(build))
    if not report.exists():
        raise RuntimeError(f"the run of YADE's {path} path gave no report:\n{log[-2000:]}")
    numbers = json.loads(report.read_text(encoding="utf-8"))
    return Sample(
        numbers.pop("wall_seconds"),
        numbers.pop("processor_seconds"),
        numbers.pop("rebuilds"),
        np.fromfile(bodies).reshape(-1, 11),
        numbers,
    )


def _peer_sample(program: str, law: str, run: Run, folder: Path) -> Sample:
    peers.write_data(run.bed, folder / "bed.data")
    if program == "lmp":
        text = peers.lammps_input(run.bed, law, run.warm_up, run.steps, run.skin)
    else:
        text = peers.liggghts_input(run.bed, run.warm_up, run.steps, run.skin)
    (folder / "in.bed").write_text(text, encoding="ascii")
    # The shell tells the program its process number, under which the system keeps its processor time.
    start = f'exec {program} -var pid "$$" -in in.bed -log none'
    command = ["sh", "-c", start]
    if run.threads > 1:
        command = ["mpirun", "-np", str(run.threads), "--bind-to", "none", "--oversubscribe"]
        command += ["--allow-run-as-root"] if os.geteuid() == 0 else []
        command += ["sh", "-c", start]
    log = _call(command, folder, {**os.environ, "OMP_NUM_THREADS": "1"})
    loop_seconds, rebuilds = peers.read_log(log)
    clock = np.loadtxt(folder / "processor")[:, 0]
    memory = np.loadtxt(folder / "memory", usecols=1)
    return Sample(
        loop_seconds / run.steps,
        (clock[1] - clock[0]) * 1e-9 / run.steps if run.threads == 1 else float("nan"),
        rebuilds,
        peers.read_bodies(folder / "bodies", run.bed),
        {"bytes_all": float(memory[1] - memory[0]) * 1024} if run.threads == 1 else {},
    )


def _kernel_sample(program: Path, run: Run, folder: Path) -> Sample:
    out = folder / "bodies.f64"
    numbers = beds.run_bare_loop(
        program,
        run.bed.path,
        out,
        run.bed.side,
        run.steps,
        warm_up=run.warm_up,
        contacts_only=CONTACT_MARGIN if run.warm_up + run.steps <= 100 else 3 * CONTACT_MARGIN,
    )
    # A rattler may come to touch; more than that would be work left out.
    if numbers["missed"] > 1e-3 * numbers["contacts"]:
        raise RuntimeError(f"the bare kernel missed {numbers['missed']} contacts: bed not at rest")
    seconds = numbers["step_seconds"]
    extra = {key: numbers[key] for key in ("force_seconds", "motion_seconds", "contacts")}
    return Sample(seconds, seconds, 0, np.fromfile(out).reshape(-1, 11), extra)


def _call(command: list[str], folder: Path, environment: dict[str, str]) -> str:
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True)
    if done.returncode != 0:
        tail = (done.stdout + done.stderr)[-2000:]
        raise RuntimeError(f"{' '.join(command)} failed with {done.returncode}:\n{tail}")
    return done.stdout + done.stderr
