# SPDX-License-Identifier: GPL-2.0-or-later
"""Files that show a projectile: STL for CAD and printing, VTP for ParaView."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

ZONES = ("nose", "shaft", "base")


def surface_mesh(body: Any, meridians: int = 48) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Triangles over a projectile's surface where it is now.

    Parameters
    ----------
    body : Body or SolidOfRevolution
        A body (mesh in global axes) or a shape alone (in its own).
    meridians : int
        Half planes around the axis, at least 3.

    Returns
    -------
    points : (n, 3) float
        Vertices [m].
    triangles : (m, 3) int
        Indices, counter-clockwise seen from outside.
    zones : (m,) int
        Index into `ZONES`.
    """
    shape = getattr(body, "shape", body)
    vertices, triangles, zones = shape.mesh(meridians)
    points = np.array(vertices, dtype=float).reshape(-1, 3)
    state = getattr(body, "state", None)
    if state is not None:
        turn = state.ori.toRotationMatrix()
        rotation = np.array([[turn[i, j] for j in range(3)] for i in range(3)])
        points = points @ rotation.T + np.array(list(state.pos))
    numbers = np.array([ZONES.index(zone) for zone in zones], dtype=np.int32)
    return points, np.array(triangles, dtype=np.int32).reshape(-1, 3), numbers


def outline(shape: Any) -> np.ndarray:
    """Generating curve of a SolidOfRevolution as a polyline, nose to base, in its own axes.

    Returns
    -------
    (n, 2) float
        Points (z, r) [m].
    """
    vertices, _, _ = shape.mesh(96)
    rings = dict.fromkeys((round(z, 12), round(float(np.hypot(x, y)), 12)) for x, y, z in vertices)
    return np.array(list(rings), dtype=float)


def write_stl(path: str | Path, body: Any, meridians: int = 96) -> None:
    """Write a binary STL file (lengths in m) of a body or shape."""
    points, triangles, _ = surface_mesh(body, meridians)
    corners = points[triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    record = np.zeros(
        len(triangles), dtype=[("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("pad", "<u2")]
    )
    record["normal"], record["corners"] = normals, corners
    with open(path, "wb") as file:
        file.write(b"Grainfall projectile, metres".ljust(80))
        file.write(np.uint32(len(triangles)).astype("<u4").tobytes())
        file.write(record.tobytes())


def write_vtp(path: str | Path, body: Any, meridians: int = 48) -> None:
    """Write VTK PolyData (XML, text); cell data `zone`: 0 nose, 1 shaft, 2 base."""
    points, triangles, zones = surface_mesh(body, meridians)

    def array(kind: str, name: str, values: np.ndarray) -> str:
        columns = values.shape[1] if name == "points" else 1
        text = " ".join(repr(v) for v in values.ravel().tolist())
        return (
            f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{columns}" '
            f'format="ascii">{text}</DataArray>'
        )

    offsets = 3 * np.arange(1, len(triangles) + 1)
    lines = (
        '<?xml version="1.0"?>',
        '<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian"><PolyData>',
        f'<Piece NumberOfPoints="{len(points)}" NumberOfPolys="{len(triangles)}">',
        f'<Points>{array("Float64", "points", points)}</Points>',
        f'<Polys>{array("Int32", "connectivity", triangles)}',
        f'{array("Int32", "offsets", offsets)}</Polys>',
        f'<CellData>{array("Int32", "zone", zones)}</CellData>',
        "</Piece></PolyData></VTKFile>",
    )
    Path(path).write_text("\n".join(lines) + "\n", encoding="ascii")
