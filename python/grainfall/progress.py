# SPDX-License-Identifier: GPL-2.0-or-later
"""Progress on a terminal (a bar) or in a log file (a line now and then)."""

from __future__ import annotations

import sys
import time

from tqdm import tqdm


class Progress:
    """A bar for one phase of a run.

    Parameters
    ----------
    title : str
        What is going on.
    quiet : bool
        Say nothing.
    line_interval : float
        Seconds between two lines where standard error is no terminal.
    """

    def __init__(self, title: str, quiet: bool = False, line_interval: float = 15.0) -> None:
        self.title = title
        self.quiet = quiet
        self.line_interval = line_interval
        self._last_line = -1e9
        self._bar: tqdm | None = None
        if not quiet and sys.stderr.isatty():
            form = "{desc}: {percentage:3.0f}%|{bar}| {elapsed}<{remaining} {postfix}"
            self._bar = tqdm(total=1.0, desc=title, bar_format=form, leave=True)

    def update(self, fraction: float, text: str = "") -> None:
        """Show that this fraction is done, with a few words of state."""
        if self.quiet:
            return
        if self._bar is not None:
            self._bar.n = min(fraction, 1.0)
            self._bar.set_postfix_str(text)
        elif time.monotonic() - self._last_line >= self.line_interval or fraction >= 1:
            self._last_line = time.monotonic()
            print(
                f"{self.title}: {100 * min(fraction, 1.0):3.0f} %  {text}",
                file=sys.stderr,
                flush=True,
            )

    def close(self) -> None:
        """Leave the bar as it stands."""
        if self._bar is not None:
            self._bar.close()
            self._bar = None
