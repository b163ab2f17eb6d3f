# SPDX-License-Identifier: GPL-2.0-or-later
"""Running the scene in hand from a script that stays in charge."""
from __future__ import annotations

import signal
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from yade import O

#: Wall time between two looks at the running simulation [s]: short at first, for runs of a few steps, then longer.
FIRST_POLL, LONGEST_POLL = 0.5e-3, 20e-3


def wait() -> None:
    """Wait for the simulation to stop; an error in one of its engines is raised here."""
    poll = FIRST_POLL
    while O.running:
        time.sleep(poll)
        poll = min(2 * poll, LONGEST_POLL)
    O.wait()


def advance(steps: int) -> None:
    """Run so many steps; polled rather than waited for, so that Ctrl-C gets through.

    On Ctrl-C the step in hand is finished and the scene left whole before KeyboardInterrupt goes on.
    """
    try:
        O.run(steps)
        wait()
    except KeyboardInterrupt:
        O.pause()
        wait()
        raise


@contextmanager
def undisturbed() -> Iterator[None]:
    """Hold Ctrl-C back until the block is done: files that belong together are then written together."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    caught: list[Any] = []
    before = signal.signal(signal.SIGINT, lambda *arguments: caught.append(arguments))
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)
    if caught:
        raise KeyboardInterrupt
