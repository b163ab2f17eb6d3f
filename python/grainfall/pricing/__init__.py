# SPDX-License-Identifier: GPL-2.0-or-later
"""What each effect of the scene in hand costs and changes: ``grainfall.price(seconds=5)``.

The scene is copied to a file and priced in a YADE process of its own, so that nothing can happen to it.
"""
from __future__ import annotations

import json
import math
import os
import shutil
import subprocess
import tempfile
from pathlib import Path
from typing import Any

from grainfall import _core
from grainfall.pricing.price_list import PriceList

TRIAL = Path(__file__).with_name("trial.py")
#: Engines that stand still during the trial, because they run the user's Python or write files.
STILL = ("PyRunner", "Recorder", "VTKRecorder", "SnapshotEngine")


def price(seconds: float = 5.0, show: bool = True) -> PriceList:
    """What each effect of the scene in hand costs, and what it changes.

    Copies of the scene run in turns, as it is and with one effect turned off (or on, where it can be turned on
    without further parameters). The scene itself is left as it is, to the last bit.

    Parameters
    ----------
    seconds : float
        Time that the copies run [s]; starting YADE and copying the scene come on top.
    show : bool
        Print the table.

    Returns
    -------
    PriceList
        One `EffectPrice` for each effect; ``as_dict()`` gives plain values.

    Raises
    ------
    ValueError
        ``seconds`` is not a positive number, or the scene has no bodies or no contact law of ours.
    RuntimeError
        The simulation is running, or its copy could not be run.
    """
    check(seconds)
    with tempfile.TemporaryDirectory(prefix="grainfall-price-") as folder:
        request = write_request(Path(folder), float(seconds))
        answer = run_trial(request)
    prices = PriceList.from_dict(answer)
    if show:
        print(prices.table())
    return prices


def check(seconds: Any) -> None:
    """Raise if these seconds, or this scene, cannot be priced."""
    from yade import O

    from grainfall.effects import contact_law

    number = isinstance(seconds, (int, float)) and not isinstance(seconds, bool)
    if not number or not (seconds > 0 and math.isfinite(seconds)):
        raise ValueError(f"seconds = {seconds!r}: must be a number above 0 and finite")
    if O.running:
        raise RuntimeError("grainfall.price: the simulation is running: O.pause() first")
    if len(O.bodies) == 0:
        raise ValueError("O.bodies: empty: must hold the scene that is to be priced")
    if contact_law() is None:
        raise ValueError(
            "O.engines: must hold an InteractionLoop with Law2_ScGeom_GrainPhys_HertzMindlin to be priced"
        )


def write_request(folder: Path, seconds: float) -> Path:
    """Put a copy of the scene, and what YADE does not save with it, into the folder."""
    import numpy as np
    import yade.wrapper
    from yade import O

    stands_still = tuple(getattr(yade.wrapper, n) for n in STILL if hasattr(yade.wrapper, n))
    still = {e.__class__.__name__ for e in O.engines if isinstance(e, stands_still)}
    # Saving makes the ledger settle its books; the copy gets a new one.
    ledgers = [e for e in O.engines if isinstance(e, yade.wrapper.EnergyLedger)]
    scene, forces = folder / "scene.yade", folder / "permanent_forces.npy"
    _core.write_scene(str(scene), [*still, "EnergyLedger"])
    # YADE may be asked for permanent forces only where there are any, and once it has made room for all bodies.
    ids = range(len(O.bodies)) if O.forces.getPermForceUsed() else range(0)
    if ids:
        O.forces.f(0, sync=True)
    np.save(forces, np.array([[*O.forces.permF(i), *O.forces.permT(i)] for i in ids]))
    request = {
        "seconds": seconds,
        "scene": str(scene),
        "permanent_forces": str(forces),
        "ledger_period": ledgers[0].iterPeriod if ledgers else 0,
        "stand_still": sorted(still),
        "threads": O.numThreads,
    }
    path = folder / "request.json"
    path.write_text(json.dumps(request))
    return path


def run_trial(request: Path) -> dict[str, Any]:
    """Run the trial in a YADE process of its own and read its answer."""
    threads = json.loads(request.read_text())["threads"]
    answer = request.with_name("answer.json")
    package_folder = str(Path(__file__).resolve().parents[2])
    paths = filter(None, [package_folder, os.environ.get("PYTHONPATH")])
    # Threads that wait without spinning: the console's own may stand beside them.
    environment = {
        "OMP_WAIT_POLICY": "passive",
        **os.environ,
        "PYTHONPATH": os.pathsep.join(paths),
    }
    program = shutil.which("yade") or "/usr/bin/yade"
    finished = subprocess.run(
        [program, f"-j{threads}", "-n", "-x", str(TRIAL), str(request), str(answer)],
        env=environment,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    if not answer.exists():
        last = "\n".join(finished.stdout.strip().splitlines()[-5:])
        raise RuntimeError(f"grainfall.price: the copy of the scene could not be run:\n{last}")
    return json.loads(answer.read_text())
