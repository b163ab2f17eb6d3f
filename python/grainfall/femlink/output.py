# SPDX-License-Identifier: GPL-2.0-or-later
"""The explicit continuum for ParaView."""
from __future__ import annotations

from pathlib import Path

import numpy as np

from grainfall.femlink import _wall

# Corners of a hexahedron run around its faces in VTK, x first here.
_VTK_CORNERS = [0, 1, 3, 2, 4, 5, 7, 6]


def write_vtu(path: Path | str, mesh: _wall.HexMesh, continuum: _wall.ExplicitContinuum) -> None:
    """Write grid, displacement, velocity, plastic strain and stress of the present time.

    Parameters
    ----------
    path
        File to write, .vtu.
    mesh
        The one that the continuum was made of.
    continuum
        Its displacements (m), velocities (m/s), plastic strain and mean Cauchy stress by cell (xx, yy, zz, xy,
        yz, xz as VTK has them, Pa).
    """
    import meshio

    stress = continuum.stress[:, [0, 1, 2, 5, 3, 4]]
    meshio.Mesh(
        mesh.vertices,
        [("hexahedron", mesh.cells[:, _VTK_CORNERS])],
        point_data={
            "displacement_m": continuum.displacement,
            "velocity_m_per_s": continuum.velocities,
        },
        cell_data={
            "plastic_strain": [np.asarray(continuum.plastic_strain)],
            "stress_Pa": [stress],
            "region": [np.asarray(mesh.regions)],
        },
    ).write(path)
