# SPDX-License-Identifier: GPL-2.0-or-later
"""The trial behind ``grainfall.price``, in a YADE process of its own: trial.py REQUEST.json ANSWER.json

Copies of the scene, one as it is and one for each effect turned round, run the same steps, a few at a time in turns.
Times are compared within a turn, states at the end.
"""
from __future__ import annotations

import json
import os
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np
from yade import O, utils

import grainfall  # noqa: F401  registers the classes
from grainfall.effects import contact_law
from grainfall.materials import check_scene
from grainfall.pricing.comparison import entry
from grainfall.pricing.variants import Variant, add_ledger, remove_engines, variants
from grainfall.running import advance

WARM_UP = 5
MOST_ROUNDS, LEAST_ROUNDS = 15, 3
STEPPERS = ("HertzTimeStepper", "GlobalStiffnessTimeStepper")


class Trial:
    """Copies of one scene in the places of YADE's list of scenes: 0 as it is, then the variants of a group."""

    def __init__(self, request: dict[str, Any]) -> None:
        self.request = request
        self.permanent_forces = np.load(request["permanent_forces"])
        self.places = 1
        self.bytes_per_copy = 0

    def load(self, place: int, variant: Variant | None) -> None:
        """A fresh copy in this place, with one effect turned round."""
        while place >= self.places:
            O.addScene()
            self.places += 1
        O.switchToScene(place)
        before = resident_bytes()
        O.load(self.request["scene"], quiet=True)
        if self.request["ledger_period"]:
            add_ledger(self.request["ledger_period"])
        for body, numbers in enumerate(self.permanent_forces):
            if numbers.any():
                O.forces.setPermF(body, tuple(numbers[:3]))
                O.forces.setPermT(body, tuple(numbers[3:]))
        if variant is None:
            self.variants = variants(self.request["ledger_period"])
        remove_engines(*STEPPERS)
        check_scene()  # the user has been told
        if variant is not None:
            variant.apply()
        self.bytes_per_copy = max(self.bytes_per_copy, resident_bytes() - before, 1)

    def run(self, place: int, steps: int) -> float:
        """Time of so many steps of this copy [s]: of the processor, or with several threads of the engines."""
        O.switchToScene(place)
        O.timingEnabled = self.request["threads"] > 1
        engines = list(O.engines)
        before, start = sum(e.execTime for e in engines), time.process_time()
        advance(steps)
        if self.request["threads"] > 1:
            return (sum(e.execTime for e in engines) - before) * 1e-9
        return time.process_time() - start

    def groups(self) -> list[list[Variant]]:
        """The variants, in groups whose copies fit into half of the free memory."""
        free = os.sysconf("SC_AVPHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
        size = max(1, int(0.5 * free / self.bytes_per_copy))
        return [self.variants[i : i + size] for i in range(0, len(self.variants), size)]


def resident_bytes() -> int:
    """Memory that this process holds [B]."""
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE")


def state() -> dict[str, Any]:
    """What a copy is compared by."""
    forces = [i.phys.normalForce.norm() for i in O.interactions if i.isReal]
    stored = contact_law().elasticEnergy()
    return {
        "positions": {b.id: np.array(b.state.pos) for b in O.bodies},
        "force": float(sum(forces)),
        "kinetic": float(utils.kineticEnergy()),
        "stored": stored["normal"] + stored["shear"],
        "contacts": len(forces),
    }


def run_group(trial: Trial, group: list[Variant], seconds: float) -> tuple[np.ndarray, list, int]:
    """Run the scene as it is and a group of variants in turns.

    Returns
    -------
    (seconds a step, shape (rounds, 1 + variants); states at the end; steps of each copy)
    """
    trial.load(0, None)
    for place, variant in enumerate(group, 1):
        trial.load(place, variant)
    places = range(len(group) + 1)
    for place in places:
        trial.run(place, WARM_UP)
    round_time = sum(trial.run(place, WARM_UP) for place in places) / WARM_UP
    steps = max(LEAST_ROUNDS, int(seconds / round_time))
    rounds = min(MOST_ROUNDS, steps)
    chunk = steps // rounds
    times = np.empty((rounds, len(places)))
    for turn in range(rounds):
        for place in np.roll(places, turn):
            times[turn, place] = trial.run(int(place), chunk) / chunk
    states = []
    for place in places:
        O.switchToScene(place)
        states.append(state())
    return times, states, 2 * WARM_UP + rounds * chunk


def main(request: dict[str, Any]) -> dict[str, Any]:
    """Price the scene of the request."""
    trial = Trial(request)
    trial.load(0, None)
    groups = trial.groups()
    entries: list[dict[str, Any]] = []
    for group in groups:
        times, states, steps = run_group(trial, group, request["seconds"] / len(groups))
        for place, variant in enumerate(group, 1):
            pair = (states[0], states[place])
            entries.append(entry(variant, times[:, place], times[:, 0], pair))
    return {
        "effects": entries,
        "bodies": len(O.bodies),
        "contacts": states[0]["contacts"],
        "steps": steps,
        "rounds": len(times),
        "threads": O.numThreads,
        "clock": "processor time" if O.numThreads == 1 else "wall time of the engines",
        "kinetic_J": states[0]["kinetic"],
        "stored_J": states[0]["stored"],
        "stood_still": request["stand_still"],
    }


answer = main(json.loads(Path(sys.argv[1]).read_text()))
partial = Path(sys.argv[2] + ".part")
partial.write_text(json.dumps(answer))
partial.rename(sys.argv[2])
