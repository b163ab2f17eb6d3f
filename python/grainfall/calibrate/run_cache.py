# SPDX-License-Identifier: GPL-2.0-or-later
"""Model runs kept on disk by the hash of their parameters, so that a calibration can be stopped and repeated."""
from __future__ import annotations

import json
import os
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from grainfall.store import content_key

#: Digits to which parameters are told apart: the optimiser repeats points only up to rounding.
DIGITS = 10


class RunCache:
    """A function of parameters that is computed once for each set of them.

    Parameters
    ----------
    function : callable
        Gets a dict of plain values and the folder that its run may use; returns a value that JSON can hold.
    folder : Path or str
        Where ``<hash>.json`` is kept; a folder ``<hash>`` beside it is handed to the function.
    """

    def __init__(self, function: Callable[[dict[str, Any], Path], Any], folder: Path | str) -> None:
        self.function = function
        self.folder = Path(folder)
        #: How many calls were computed and how many were found.
        self.computed = 0
        self.found = 0

    def __call__(self, parameters: Mapping[str, Any]) -> Any:
        """The function's value: found, or computed and kept."""
        rounded = {name: _rounded(value) for name, value in sorted(parameters.items())}
        key = content_key(rounded)
        path = self.folder / f"{key}.json"
        if path.exists():
            self.found += 1
            return json.loads(path.read_text())["value"]
        value = self.function(rounded, self.folder / key)
        self.computed += 1
        self.folder.mkdir(parents=True, exist_ok=True)
        partial = path.with_suffix(f".{os.getpid()}.partial")
        partial.write_text(json.dumps({"parameters": rounded, "value": value}, indent=1))
        os.replace(partial, path)
        return value


def _rounded(value: Any) -> Any:
    return float(f"{value:.{DIGITS}g}") if isinstance(value, float) else value
