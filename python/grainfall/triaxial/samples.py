# SPDX-License-Identifier: GPL-2.0-or-later
"""Triaxial samples at rest under isotropic pressure: what they depend on, and the store they are kept in.

A sample knows nothing of the sand's friction, damping or moisture: one sample serves all runs that differ in these
(`grainfall.triaxial.preparation` makes it, the preloading of each run brings its own friction in).
"""
from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from grainfall.store import cache_folder, content_key, written_whole

_FORMAT = 1


@dataclass(frozen=True)
class SampleSpec:
    """All that a sample depends on.

    Parameters
    ----------
    diameter, height : float
        Of the sample [m]; reached within a grain diameter or so.
    grain_diameter, grain_spread : float
        Mean grain diameter [m] and relative half-width of its uniform distribution.
    grain_density : float
        [kg/m3].
    young, poisson : float
        Elastic constants of a grain [Pa], [-].
    platen_young, platen_poisson : float
        Elastic constants of the platens [Pa], [-].
    void_ratio : float
        Volume of voids over volume of grains to be reached.
    pressure : float
        Isotropic pressure of the preparation [Pa].
    seed : int
        Of the random packing.
    """

    diameter: float
    height: float
    grain_diameter: float
    grain_spread: float
    grain_density: float
    young: float
    poisson: float
    platen_young: float
    platen_poisson: float
    void_ratio: float
    pressure: float
    seed: int

    @property
    def grain_count(self) -> int:
        """Number of grains that fill the sample at the wanted void ratio."""
        mean_volume = np.pi / 6 * self.grain_diameter**3 * (1 + self.grain_spread**2)
        volume = np.pi / 4 * self.diameter**2 * self.height
        return max(1, round(volume / (1 + self.void_ratio) / mean_volume))

    def key(self) -> str:
        """Twelve hexadecimal digits that differ between specs."""
        return content_key({"format": _FORMAT, **asdict(self)})


@dataclass
class Sample:
    """Grains between two platens, at rest, with their contacts.

    Parameters
    ----------
    spec : SampleSpec
        What it was made from.
    centres : numpy.ndarray, shape (n, 3)
        Grain centres [m]; lower platen at z = 0, axis on the z axis.
    radii : numpy.ndarray, shape (n,)
        Grain radii [m].
    top : float
        Height of the upper platen [m].
    contacts : numpy.ndarray, shape (c, 2)
        Pairs of bodies; n is the lower platen, n + 1 the upper one.
    shear : numpy.ndarray, shape (c, 3)
        Elastic shear force carried by each contact [N].
    report : dict
        Void ratio, coordination number and how rest was reached.
    """

    spec: SampleSpec
    centres: np.ndarray
    radii: np.ndarray
    top: float
    contacts: np.ndarray = field(default_factory=lambda: np.empty((0, 2), dtype=np.int64))
    shear: np.ndarray = field(default_factory=lambda: np.empty((0, 3)))
    report: dict[str, Any] = field(default_factory=dict)

    @property
    def bottom_platen(self) -> int:
        """Body number of the lower platen."""
        return len(self.radii)

    @property
    def top_platen(self) -> int:
        """Body number of the upper platen."""
        return len(self.radii) + 1


Progress = Callable[[str, float], None]


def obtain_sample(spec: SampleSpec, cache: Path | str, progress: Progress) -> tuple[Sample, bool]:
    """A sample of this spec, from the cache if it is there, and whether it was.

    Parameters
    ----------
    cache : path
        Folder of prepared samples; '' for ~/.cache/grainfall/samples.
    """
    path = cache_folder("samples", cache) / f"{spec.key()}.h5"
    if path.exists():
        return load_sample(path), True
    from grainfall.triaxial.preparation import prepare_sample

    save_sample(prepare_sample(spec, progress), path)
    return load_sample(path), False


_ARRAYS = {"centres": "m", "radii": "m", "contacts": "-", "shear": "N"}


def save_sample(sample: Sample, path: Path) -> None:
    """Write a sample to an HDF5 file, all at once."""
    with written_whole(path) as file:
        for name, unit in _ARRAYS.items():
            file.create_dataset(name, data=getattr(sample, name), compression="gzip")
            file[name].attrs["unit"] = unit
        file.attrs["top_m"] = sample.top
        file.attrs["spec"] = json.dumps(asdict(sample.spec))
        file.attrs["report"] = json.dumps(sample.report)
        file.attrs["format"] = _FORMAT


def load_sample(path: Path) -> Sample:
    """Read a sample that `save_sample` wrote."""
    with h5py.File(path, "r") as file:
        if file.attrs.get("format") != _FORMAT:
            raise ValueError(f"{path} is not a sample of this version of Grainfall; remove it")
        arrays = {name: file[name][:] for name in _ARRAYS}
        return Sample(
            spec=SampleSpec(**json.loads(file.attrs["spec"])),
            top=float(file.attrs["top_m"]),
            report=json.loads(file.attrs["report"]),
            **arrays,
        )
