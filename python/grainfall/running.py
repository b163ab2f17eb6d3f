# SPDX-License-Identifier: GPL-2.0-or-later
"""Running the scene in hand from a script that stays in charge."""
from __future__ import annotations

import time

from yade import O

#: Wall time between two looks at the running simulation [s].
POLL = 0.02


def wait() -> None:
    """Wait for the simulation to stop; an error in one of its engines is raised here."""
    while O.running:
        time.sleep(POLL)
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
