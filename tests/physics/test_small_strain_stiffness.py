# SPDX-License-Identifier: GPL-2.0-or-later
"""Small-strain stiffness of packings against effective-medium theory.

If every sphere moves with the mean strain and none turns (affine motion), the moduli are sums over the
contacts, exactly and whatever the fabric (the isotropic averages of C_ijkl = 1/V sum of (k_n n n + k_t
(1 - n n)) l l):

    K = 1/(9 V) sum k_n l^2          G = 1/(15 V) sum (k_n + 3/2 k_t) l^2

Walton (1987, J. Mech. Phys. Solids 35:213) and Digby (1981) put the mean force N = 4 pi R^2 P/(phi z) into
every contact: K = phi z k_n(N)/(6 pi R), G = phi z (k_n + 3/2 k_t)/(10 pi R). In a lattice all forces are
equal and this is exact. In a random packing they are not, and since k ~ N^(1/3) is concave the formula
exceeds the sum by <N>^(1/3)/<N^(1/3)>, 8 % here: that, and nothing else, separates the two. A packing that
may relax is softer than either.
"""
from __future__ import annotations

import math
from dataclasses import dataclass

import contact_scenes as cs
import numpy as np
import pytest
import sphere_packing as sp
from yade import O, Matrix3, utils

SHEAR_MODULUS, POISSON = 29e9, 0.31  # Pa, -: quartz
QUARTZ = cs.Solid(2 * SHEAR_MODULUS * (1 + POISSON), POISSON, 2650)
RADIUS = 0.36e-3  # m: the sand of MR-2629
STRAINS = {
    "isotropic": np.eye(3) / 3,
    "x - y": np.diag([0.5, -0.5, 0]),
    "y - z": np.diag([0, 0.5, -0.5]),
    "xy": np.array([[0, 0.5, 0], [0.5, 0, 0], [0, 0, 0]]),
    "yz": np.array([[0, 0, 0], [0, 0, 0.5], [0, 0.5, 0]]),
    "xz": np.array([[0, 0, 0.5], [0, 0, 0], [0.5, 0, 0]]),
}


@dataclass(frozen=True)
class Contacts:
    """Contacts of the scene: ids shape (c, 2), force [N], stiffnesses [N/m], normals, branches [m],
    shear forces on the second sphere [N]."""

    ids: np.ndarray
    force: np.ndarray
    normal_stiffness: np.ndarray
    shear_stiffness: np.ndarray
    normal: np.ndarray
    branch: np.ndarray
    shear: np.ndarray

    @property
    def mean_force_deficit(self) -> float:
        """<N^(1/3)> over <N>^(1/3) [-]."""
        return float((self.force ** (1 / 3)).mean() / self.force.mean() ** (1 / 3))


def read_contacts() -> Contacts:
    """All real contacts, ordered by ids."""
    rows = []
    for contact in O.interactions:
        shift = O.cell.hSize * contact.cellDist
        branch = O.bodies[contact.id2].state.pos + shift - O.bodies[contact.id1].state.pos
        geom, phys = contact.geom, contact.phys
        stiffness = (phys.kn, phys.ks)
        force = phys.normalForce.dot(geom.normal)
        ids = (contact.id1, contact.id2)
        rows.append((*ids, force, *stiffness, *geom.normal, *branch, *phys.shearForce))
    table = np.array(sorted(rows))
    parts = np.split(table, [2, 3, 4, 5, 8, 11], axis=1)
    ids, force, kn, ks, normal, branch, shear = parts
    return Contacts(ids, force[:, 0], kn[:, 0], ks[:, 0], normal, branch, shear)


def build(packing: sp.Packing, tangential_law: str = "incremental", held: bool = True) -> Contacts:
    """The packing in a periodic cell, its spheres held against all but the mean strain; its contacts."""
    O.reset()
    O.materials.append(QUARTZ.material(frictionAngle=math.atan(10.0)))
    O.periodic = True
    O.cell.setBox(*[packing.side * RADIUS] * 3)
    for centre in packing.centres:
        body = cs.add_sphere(centre * RADIUS, RADIUS, 0, fixed=held)
    cs.set_engines(cs.grain_law(tangentialLaw=tangential_law), damping=0 if held else 0.3)
    O.cell.homoDeform = 2
    stiffness = 2 * SHEAR_MODULUS / (1 - POISSON) * RADIUS * math.sqrt(0.5 * 2e-3)
    O.dt = 0.1 * math.sqrt(O.bodies[body].state.mass / stiffness)
    O.run(1, True)
    return read_contacts()


def strain(direction: np.ndarray, amount: float, steps: int = 10) -> None:
    """Deform the cell by `amount` times `direction`, tension positive, in `steps` steps."""
    O.cell.velGrad = Matrix3(*(direction * amount / (steps * O.dt)).ravel())
    O.run(steps, True)
    O.cell.velGrad = Matrix3.Zero
    O.run(2, True)


def work_per_strain(direction: np.ndarray, before: Contacts, after: Contacts) -> float:
    """Increment of stress : direction [Pa], tension positive, from the contact forces' increments."""
    np.testing.assert_array_equal(before.ids, after.ids)
    force = (after.force - before.force)[:, None] * before.normal + after.shear - before.shear
    moved = before.branch @ direction.T
    return -float((force * moved).sum()) / O.cell.volume


def sum_over_contacts(direction: np.ndarray, contacts: Contacts) -> float:
    """direction : C : direction [Pa] of affine motion."""
    moved = contacts.branch @ direction.T
    along = (moved * contacts.normal).sum(axis=1)
    across = (moved**2).sum(axis=1) - along**2
    # YADE's remedy against ratcheting lengthens shear increments by 2 R/(2 R - overlap).
    longer = 2 * RADIUS / np.linalg.norm(contacts.branch, axis=1)
    stiff = contacts.normal_stiffness * along**2 + contacts.shear_stiffness * longer * across
    return float(stiff.sum()) / O.cell.volume


def affine_moduli(contacts: Contacts) -> tuple[float, float]:
    """K and G [Pa] by the sums over contacts."""
    square = (contacts.branch**2).sum(axis=1)
    bulk = (contacts.normal_stiffness * square).sum() / (9 * O.cell.volume)
    both = contacts.normal_stiffness + 1.5 * contacts.shear_stiffness
    return bulk, (both * square).sum() / (15 * O.cell.volume)


def effective_medium(packing: sp.Packing, contacts: Contacts) -> tuple[float, float]:
    """K and G [Pa] of Walton and Digby from solid fraction, coordination number and pressure alone."""
    pressure = (contacts.force[:, None] * contacts.normal * contacts.branch).sum()
    pressure /= 3 * O.cell.volume
    product = packing.solid_fraction * 2 * len(contacts.force) / len(packing.centres)
    cube = product**2 * SHEAR_MODULUS**2 * pressure / (math.pi**2 * (1 - POISSON) ** 2)
    shear = (5 - 4 * POISSON) / (5 * (2 - POISSON)) * (1.5 * cube) ** (1 / 3)
    return (cube / 18) ** (1 / 3), shear


@pytest.fixture(scope="module")
def random_packing() -> sp.Packing:
    return sp.read_random()


@pytest.mark.parametrize("name", STRAINS)
def test_affine_stress_increment_is_the_sum_over_contacts(random_packing, name):
    direction = STRAINS[name]
    amount = 1e-7  # an eightieth of the smallest overlap; a ten-thousandth of the mean one
    start = build(random_packing)
    strain(direction, amount)
    plus = read_contacts()
    build(random_packing)
    strain(direction, -amount)
    minus = read_contacts()
    measured = work_per_strain(direction, minus, plus) / (2 * amount)
    # Central differences: Hertz's curvature enters by the square of strain over overlap.
    assert measured == pytest.approx(sum_over_contacts(direction, start), rel=2e-6)


def test_affine_moduli_of_a_lattice_are_those_of_effective_medium_theory():
    lattice = sp.face_centred_cubic(3, 2e-4)
    contacts = build(lattice)
    assert len(contacts.force) == 6 * len(lattice.centres)
    # Solid fraction and branch vectors know of the overlap, the theory does not: 1e-4 a factor.
    assert affine_moduli(contacts) == pytest.approx(effective_medium(lattice, contacts), rel=5e-4)


def test_affine_moduli_of_a_random_packing_are_effective_medium_theory_s_but_for_unequal_forces(
    random_packing,
):
    contacts = build(random_packing)
    theory = np.array(effective_medium(random_packing, contacts))
    moduli = np.array(affine_moduli(contacts))
    deficit = contacts.mean_force_deficit
    assert 0.90 < deficit < 0.95
    # The 1 % of agreement that the theory is good for is met once unequal forces are allowed for, and
    # without that it is missed by 8 %.
    assert moduli == pytest.approx(deficit * theory, rel=5e-3)
    assert np.all(moduli < 0.95 * theory)


@pytest.mark.parametrize("name", ["isotropic", "xy"])
def test_relaxed_moduli_lie_below_the_affine_ones(random_packing, name):
    direction = STRAINS[name]
    amount = 1e-5 if name == "xy" else -1e-5
    moduli = {}
    for law in ("incremental", "none"):
        contacts = build(random_packing, law, held=False)
        O.run(2000, True)
        start = read_contacts()
        affine = sum_over_contacts(direction, contacts)
        strain(direction, amount, 100)
        O.run(3000, True)
        force = stress_along(direction) - stress_of(direction, start)
        moduli[law] = force / amount / affine
    print(name, moduli)
    assert 0.3 < moduli["incremental"] < 0.99


def stress_of(direction: np.ndarray, contacts: Contacts) -> float:
    """stress : direction [Pa], tension positive."""
    force = contacts.force[:, None] * contacts.normal + contacts.shear
    return -float((force * (contacts.branch @ direction.T)).sum()) / O.cell.volume


def stress_along(direction: np.ndarray) -> float:
    return stress_of(direction, read_contacts())
