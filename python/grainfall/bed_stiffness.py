# SPDX-License-Identifier: GPL-2.0-or-later
"""Small-strain moduli of a bed of grains, for a continuum that goes on where the bed ends.

With the mean force N = 4 pi R^2 p / (phi z) in every contact (Walton 1987, J. Mech. Phys. Solids 35:213; Digby
1981), grains that move with the mean strain give

    K = phi z k_n / (6 pi R)        G = phi z (k_n + 3/2 k_t) / (10 pi R)

k_n, k_t: Hertz' and Mindlin's tangent stiffness at N; phi: solid fraction, z: contacts a grain. Contacts of unequal
force, and grains that relax, make a random packing softer: by 0.9225 for the first, by 0.960 (K) and 0.725 (G) for
the second, as measured by tests/physics/test_small_strain_stiffness.py. Below 1e-5 strain; where grains slide,
the bed is softer.
"""
from __future__ import annotations

import math
from dataclasses import dataclass

from grainfall.beds import Bed
from grainfall.constants import GRAVITY

UNEQUAL_FORCES, RELAXED_BULK, RELAXED_SHEAR = 0.9225, 0.960, 0.725
#: Horizontal over vertical stress at rest (Jaky 1944, 1 - sin 30 degrees).
AT_REST = 0.5


@dataclass(frozen=True)
class Moduli:
    """Young's modulus [Pa], Poisson's ratio, density [kg/m3]."""

    young: float
    poisson: float
    density: float


def bed_pressure(bed: Bed) -> float:
    """Mean stress in the middle of the bed's depth [Pa], without what walls carry."""
    vertical = bulk_density(bed) * GRAVITY * bed.surface / 2
    return vertical * (1 + 2 * AT_REST) / 3


def bulk_density(bed: Bed) -> float:
    """Mass of grains over volume [kg/m3]."""
    return bed.spec.sand.density * bed.report["solid_fraction_core"]


def bed_moduli(bed: Bed) -> Moduli:
    """Moduli of the bed in the middle of its depth."""
    sand, report = bed.spec.sand, bed.report
    fraction, contacts = report["solid_fraction_core"], report["coordination_number"]
    radius = float(bed.radii.mean())
    normal_force = 4 * math.pi * radius**2 * bed_pressure(bed) / (fraction * contacts)
    effective_modulus = sand.young / (2 * (1 - sand.poisson**2))
    normal = (6 * effective_modulus**2 * radius / 2 * normal_force) ** (1 / 3)
    tangential = normal * 2 * (1 - sand.poisson) / (2 - sand.poisson)
    dense = fraction * contacts / (math.pi * radius) * UNEQUAL_FORCES
    bulk = RELAXED_BULK * dense * normal / 6
    shear = RELAXED_SHEAR * dense * (normal + 1.5 * tangential) / 10
    young = 9 * bulk * shear / (3 * bulk + shear)
    poisson = (3 * bulk - 2 * shear) / (2 * (3 * bulk + shear))
    return Moduli(young, poisson, bulk_density(bed))
