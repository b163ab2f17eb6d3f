# SPDX-License-Identifier: GPL-2.0-or-later
"""The continuum at the moments of a run's snapshots for ParaView, made after the run from the files in its folder.

deal.II is loaded here, not while the run goes on. ``vtk/scene.pvd`` holds grains, contacts, projectile and continuum
together, ``vtk/scene.py`` shows them.
"""
from __future__ import annotations

from pathlib import Path

import numpy as np

from grainfall.drop.far_field import Continuum
from grainfall.drop.paraview_state import write_state

#: What stands behind the time in the names of a moment's files, and the name of the part in ParaView.
PARTS = {
    "spheres": "grains",
    "contacts": "contacts",
    "projectile": "projectile",
    "far-field": "continuum",
}


def write_far_field_files(folder: Path, continuum: Continuum) -> None:
    """Write ``vtk/*-far-field.vtu`` (displacement and stress that the drop has added), ``scene.pvd``, ``scene.py``.

    Moments whose file is there already are left as they are.
    """
    moments = sorted(
        path for path in (folder / "snapshots").glob("*.npz") if not _file(folder, path).exists()
    )
    if moments and continuum.model == "explicit":
        _write_with_inertia(folder, continuum, moments)
    elif moments:
        from grainfall import femlink

        field = femlink.Continuum(continuum.mesh(), continuum.materials(), continuum.degree)
        for path in moments:
            forces = np.load(path)["far_field_forces"]
            field.write_vtu(
                str(_file(folder, path)), field.solve(surface_forces=forces), _seconds(path.stem)
            )
    _write_collection(folder / "vtk")
    write_state(folder / "vtk", 2 * (max(continuum.cavity) + 2 * continuum.thickness))


def _write_with_inertia(folder: Path, continuum: Continuum, moments: list[Path]) -> None:
    from grainfall import femlink

    inertial = continuum.with_inertia()
    body = inertial.body()
    for path in moments:
        body.state = np.load(path)["far_field_state"]
        femlink.write_vtu(_file(folder, path), inertial.mesh, body)


def _file(folder: Path, snapshot: Path) -> Path:
    return folder / "vtk" / f"{snapshot.stem}-far-field.vtu"


def _seconds(name: str) -> float:
    """Time that a snapshot's name states [s]."""
    return int(name[:9]) * 1e-6


def _write_collection(folder: Path) -> None:
    """All parts of all moments in one ParaView collection."""
    lines = ['<?xml version="1.0"?>', '<VTKFile type="Collection" version="0.1"><Collection>']
    for path in sorted(folder.glob("*us-*.vt[up]")):
        word = next((word for word in PARTS if word in path.name), None)
        if word is not None:
            part = f'part="{list(PARTS).index(word)}" name="{PARTS[word]}"'
            when = f'timestep="{_seconds(path.name):.6f}"'
            lines.append(f'<DataSet {when} {part} file="{path.name}"/>')
    lines.append("</Collection></VTKFile>")
    (folder / "scene.pvd").write_text("\n".join(lines) + "\n", encoding="ascii")
