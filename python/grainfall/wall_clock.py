# SPDX-License-Identifier: GPL-2.0-or-later
"""What a run costs: wall time by phase and by engine."""
from __future__ import annotations

import time
from collections.abc import Mapping

from yade import O


class Clock:
    """Wall time by phase."""

    def __init__(self) -> None:
        self.started = self._lap = time.monotonic()
        self.phases: dict[str, float] = {}

    def lap(self, phase: str) -> None:
        """Book the time since the last lap to this phase."""
        now = time.monotonic()
        self.phases[phase] = self.phases.get(phase, 0.0) + now - self._lap
        self._lap = now

    @property
    def total(self) -> float:
        """Wall time since the start [s]."""
        return time.monotonic() - self.started


def engine_seconds(clock: Clock, phase: str, earlier: Mapping[str, float]) -> dict[str, float]:
    """Wall time by engine [s], and of what happened outside them.

    Parameters
    ----------
    clock : Clock
        Of this part of the run.
    phase : str
        The clock's phase in which the engines ran.
    earlier : mapping
        What the earlier parts of a resumed run spent.
    """
    price = {
        engine.label or engine.__class__.__name__: engine.execTime * 1e-9 for engine in O.engines
    }
    price.update(clock.phases)
    outside = price.pop(phase, 0.0) - sum(engine.execTime for engine in O.engines) * 1e-9
    price["checkpoints, snapshots, waiting"] = max(0.0, outside)
    for name, seconds in earlier.items():
        price[name] = price.get(name, 0.0) + seconds
    return price
