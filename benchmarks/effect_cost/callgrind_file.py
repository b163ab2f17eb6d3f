# SPDX-License-Identifier: GPL-2.0-or-later
"""Reads what callgrind has written: instructions by function, what a function calls included."""
from __future__ import annotations

import re
from pathlib import Path

NAME = re.compile(r"\((\d+)\)(?: (.*))?")


class Dump:
    """One dump: what triggered it, all instructions, and calls with their inclusive instructions by callee."""

    def __init__(self, path: Path) -> None:
        self.trigger = ""
        self.total = 0
        #: {function: [calls, inclusive instructions]}
        self.called: dict[str, list[int]] = {}
        self._names: dict[str, str] = {}
        callee, calls = "", 0
        for line in path.read_text().splitlines():
            if line.startswith("desc: Trigger:"):
                self.trigger = line.split(":", 2)[2].strip().removeprefix("Client Request: ")
            elif line.startswith(("summary:", "totals:")):
                self.total = int(line.split()[1])
            elif line.startswith(("fn=", "cfn=")):
                name = self._name(line.split("=", 1)[1])
                if line.startswith("cfn="):
                    callee = name
            elif line.startswith("calls="):
                calls = int(line[6:].split()[0])
            elif calls:
                entry = self.called.setdefault(callee, [0, 0])
                entry[0] += calls
                entry[1] += int(line.split()[1])
                calls = 0

    def _name(self, text: str) -> str:
        """Names are written out once and are numbers from then on."""
        match = NAME.fullmatch(text)
        if match is None:
            return text
        number, name = match.groups()
        if name:
            self._names[number] = name
        return self._names[number]

    def inclusive(self, pattern: str) -> tuple[int, int]:
        """Calls and instructions, callees included, of the outermost function whose name matches.

        A functor is entered through a thunk, a wet kernel calls the dry one: the outermost has the most.
        """
        found = [entry for name, entry in self.called.items() if re.search(pattern, name)]
        calls, cost = max(found, key=lambda entry: entry[1], default=(0, 0))
        return calls, cost


def read_dumps(folder: Path, stem: str) -> dict[str, Dump]:
    """All dumps of one run by what triggered them.

    Names that a dump does not repeat were written by an earlier one, so they are read in order.
    """
    dumps: dict[str, Dump] = {}
    paths = sorted(folder.glob(f"{stem}.*"), key=lambda path: int(path.suffix[1:]))
    for path in paths:
        dump = Dump(path)
        if dump.trigger:
            dumps[dump.trigger] = dump
    return dumps
