# SPDX-License-Identifier: GPL-2.0-or-later
"""Where prepared packings and finished runs are kept, and writing them so that no half file is ever read."""
from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import h5py


def cache_folder(kind: str, cache: Path | str = "") -> Path:
    """Folder of what is kept: as given, else that of its kind under $XDG_CACHE_HOME or ~/.cache."""
    if cache:
        return Path(cache).expanduser()
    root = os.environ.get("XDG_CACHE_HOME") or "~/.cache"
    return Path(root).expanduser() / "grainfall" / kind


def content_key(values: Mapping[str, Any]) -> str:
    """Twelve hexadecimal digits that differ between values."""
    text = json.dumps(values, sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()[:12]


@contextmanager
def written_whole(path: Path) -> Iterator[h5py.File]:
    """An HDF5 file to fill; it appears under its name only once it is complete."""
    path.parent.mkdir(parents=True, exist_ok=True)
    partial = path.with_suffix(f".{os.getpid()}.partial")
    with h5py.File(partial, "w") as file:
        yield file
    os.replace(partial, path)
