# SPDX-License-Identifier: GPL-2.0-or-later
"""Lets YADE's own commands see a scene that runs on the flat path as it is.

The flat path knows when an engine or the end of a run is about to look at bodies and contacts, and writes them
before. Two commands come unannounced: `O.pause()` in the middle of a run, and `O.save()`, after which a
loaded scene must go on to the last bit as the present one does.
"""
from __future__ import annotations

import functools
import time
from typing import Any

import yade.wrapper

#: Wall time between two looks at a run that is about to stop [s].
POLL = 1e-3


def install() -> None:
    """Put the flat path's word into `O.pause`, `O.save` and `O.saveTmp`. Harmless if repeated."""
    omega = yade.wrapper.Omega
    if getattr(omega.pause, "sees_flat_path", False):
        return
    omega.pause = _pausing(omega.pause)
    omega.save = _saving(omega.save)
    omega.saveTmp = _saving(omega.saveTmp)


def _flat_loops(omega: Any) -> list[Any]:
    kind = yade.wrapper.GrainInteractionLoop
    return [e for e in omega.engines if isinstance(e, kind) and not e.dead and e.path == "flat"]


def _pausing(original: Any) -> Any:
    @functools.wraps(original)
    def pause(self: Any) -> None:
        loops = _flat_loops(self) if self.running else []
        if loops and not any(loop.isRunThread() for loop in loops):
            for loop in loops:
                loop.requestStop()
            while self.running:
                time.sleep(POLL)
        original(self)

    pause.sees_flat_path = True  # type: ignore[attr-defined]
    return pause


def _saving(original: Any) -> Any:
    @functools.wraps(original)
    def save(self: Any, *arguments: Any, **keywords: Any) -> Any:
        for loop in _flat_loops(self):
            loop.sortAnew()
        return original(self, *arguments, **keywords)

    return save
