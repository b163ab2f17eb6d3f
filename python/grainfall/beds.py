# SPDX-License-Identifier: GPL-2.0-or-later
"""Beds of sand at rest in a box: what they depend on, and the store they are kept in.

A bed is prepared once (`grainfall.bed_settling`), kept in an HDF5 file under a name or under the hash of
its parameters, and put into a scene when needed (`grainfall.bed_scene`).
"""
from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from grainfall.contacts import Sand
from grainfall.store import cache_folder, content_key, written_whole

_FORMAT = 1


@dataclass(frozen=True)
class BedSpec:
    """All that a bed depends on.

    Parameters
    ----------
    length, width, depth : float
        Inside of the box, and depth of sand [m]; the depth is ignored where `grains` is given.
    grains : int
        Number of grains; 0: as many as fill the depth.
    diameter, spread : float
        Mean grain diameter [m] and relative half-width of its uniform distribution.
    solid_fraction : float
        Packed volume over volume before settling.
    wall_friction : float
        Friction coefficient of grains on walls and floor.
    seed : int
        Of the random packing.
    sand : Sand
        Contact parameters.
    """

    length: float
    width: float
    depth: float
    grains: int
    diameter: float
    spread: float
    solid_fraction: float
    wall_friction: float
    seed: int
    sand: Sand

    def key(self) -> str:
        """Twelve hexadecimal digits that differ between specs."""
        return content_key({"format": _FORMAT, **asdict(self)})


@dataclass
class Bed:
    """Grains at rest, with their contacts.

    Parameters
    ----------
    spec : BedSpec
        What it was made from.
    centres : numpy.ndarray, shape (n, 3)
        Grain centres [m]; floor at z = 0, box centred on the z axis.
    radii : numpy.ndarray, shape (n,)
        Grain radii [m].
    contacts : numpy.ndarray, shape (c, 2)
        Pairs of bodies; n to n + 4 are the walls -x, +x, -y, +y and the floor.
    shear : numpy.ndarray, shape (c, 3)
        Elastic shear force carried by each contact [N].
    report : dict
        Solid fraction, coordination number, surface height and how rest was reached.
    """

    spec: BedSpec
    centres: np.ndarray
    radii: np.ndarray
    contacts: np.ndarray = field(default_factory=lambda: np.empty((0, 2), dtype=np.int64))
    shear: np.ndarray = field(default_factory=lambda: np.empty((0, 3)))
    report: dict[str, Any] = field(default_factory=dict)

    @property
    def surface(self) -> float:
        """Height of the levelled surface [m]."""
        return self.report["surface_height_m"]


Progress = Callable[[str, float], None]


def _silent(stage: str, fraction: float) -> None:
    """Progress reporter that says nothing."""


def obtain_bed(
    spec: BedSpec, cache: Path | str = "", name: str = "", progress: Progress = _silent
) -> tuple[Bed, bool]:
    """A bed of this spec, from the cache if it is there, and whether it was.

    Parameters
    ----------
    cache : path
        Folder of prepared beds; '' for ~/.cache/grainfall/beds.
    name : str
        Name to keep it under; '' for the hash of the spec.
    """
    path = cache_folder("beds", cache) / f"{name or spec.key()}.h5"
    if path.exists():
        bed = load_bed(path)
        if bed.spec != spec:
            different = [
                key for key, value in asdict(spec).items() if asdict(bed.spec)[key] != value
            ]
            raise ValueError(
                f"the bed {name!r} in {path.parent} was prepared with another {', '.join(different)}; "
                "choose another --bed name, or remove that file"
            )
        return bed, True
    from grainfall.bed_settling import prepare_bed

    bed = prepare_bed(spec, progress)
    save_bed(bed, path)
    return load_bed(path), False


_ARRAYS = {
    "centres": "m",
    "radii": "m",
    "contacts": "-",
    "shear": "N",
}


def save_bed(bed: Bed, path: Path) -> None:
    """Write a bed to an HDF5 file, all at once: a reader never meets half a file."""
    with written_whole(path) as file:
        for name, unit in _ARRAYS.items():
            file.create_dataset(name, data=getattr(bed, name), compression="gzip")
            file[name].attrs["unit"] = unit
        file.attrs["spec"] = json.dumps(asdict(bed.spec))
        file.attrs["report"] = json.dumps(bed.report)
        file.attrs["format"] = _FORMAT


def load_bed(path: Path) -> Bed:
    """Read a bed that `save_bed` wrote."""
    with h5py.File(path, "r") as file:
        if file.attrs.get("format") != _FORMAT:
            raise ValueError(f"{path} is not a bed of this version of Grainfall; remove it")
        spec = json.loads(file.attrs["spec"])
        spec["sand"] = Sand(**spec["sand"])
        arrays = {name: file[name][:] for name in _ARRAYS}
        return Bed(BedSpec(**spec), **arrays, report=json.loads(file.attrs["report"]))
