# SPDX-License-Identifier: GPL-2.0-or-later
"""A bed of sand in YADE: its bodies, its contacts, and reading them back."""
from __future__ import annotations

import math
from typing import Any

import numpy as np
from yade import O, Vector3, utils

from grainfall.beds import Bed, BedSpec

WALL_COUNT = 5


def add_bed(bed: Bed, sand: Any, wall: Any) -> None:
    """Add grains and walls to an empty scene; grain i becomes body i, the walls follow.

    Parameters
    ----------
    sand, wall : GrainMat
        Materials of grains and of the box.
    """
    add_grains(bed, sand, wall)
    O.bodies.append(box_walls(bed.spec, wall))


def add_grains(bed: Bed, sand: Any, wall: Any) -> None:
    """Add the grains and both materials to an empty scene; grain i becomes body i."""
    if len(O.bodies) > 0:
        raise RuntimeError("a bed needs an empty scene: call O.reset() first")
    O.materials.append([sand, wall])
    O.bodies.append(
        [
            utils.sphere(centre, radius, material=sand)
            for centre, radius in zip(bed.centres.tolist(), bed.radii.tolist())
        ]
    )


def wall_planes(spec: BedSpec) -> tuple[tuple[float, int, int], ...]:
    """Position [m], axis and inward sense of the walls -x, +x, -y, +y and the floor."""
    x, y = spec.length / 2, spec.width / 2
    return ((-x, 0, 1), (x, 0, -1), (-y, 1, 1), (y, 1, -1), (0.0, 2, 1))


def box_walls(spec: BedSpec, material: Any) -> list[Any]:
    """Walls -x, +x, -y, +y and the floor, each facing inwards."""
    return [
        utils.wall(position, axis, sense, material=material)
        for position, axis, sense in wall_planes(spec)
    ]


def restore_contacts(bed: Bed) -> None:
    """Make the contacts that the bed was saved with and give them their shear forces and bridges.

    To be called once the engines are set; without it a loaded bed would have to find its friction anew
    and would sag.
    """
    for (first, second), shear in zip(bed.contacts.tolist(), bed.shear.tolist()):
        contact = utils.createInteraction(first, second)
        contact.phys.shearElastic = Vector3(shear)
        if contact.phys.bridge is not None:  # kept by its bridge, if not by touch
            contact.phys.bridge.formed = True
        # Without the stiffness that belongs to it, the law would take the spring's energy for new.
        overlap = max(contact.geom.penetrationDepth, 0.0)
        contact.phys.ks = contact.phys.shearCoefficient * math.sqrt(overlap)


def grain_centres(count: int) -> np.ndarray:
    """Centres of bodies 0 to count - 1, shape (count, 3) [m]."""
    return np.array([O.bodies[index].state.pos for index in range(count)], dtype=float).reshape(
        -1, 3
    )


def read_contacts(bed: Bed) -> None:
    """Copy the contacts between grains and with walls from the scene into the bed."""
    pairs, shear = [], []
    for contact in O.interactions:
        if contact.isReal and max(contact.id1, contact.id2) < len(bed.radii) + WALL_COUNT:
            pairs.append((contact.id1, contact.id2))
            shear.append(contact.phys.shearElastic)
    bed.contacts = np.array(pairs, dtype=np.int64).reshape(-1, 2)
    bed.shear = np.array(shear, dtype=float).reshape(-1, 3)
