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
    """Contacts of the scene: ids shape (c, 2), normal force [N], normals, branches [m], shear forces on
    the second sphere [N]."""

    ids: np.ndarray
    force: np.ndarray
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
        force = phys.normalForce.dot(geom.normal)
        ids = (contact.id1, contact.id2)
        rows.append((*ids, force, *geom.normal, *branch, *phys.shearForce))
    table = np.array(sorted(rows))
    parts = np.split(table, [2, 3, 6, 9], axis=1)
    ids, force, normal, branch, shear = parts
    return Contacts(ids, force[:, 0], normal, branch, shear)


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


def stiffnesses(contacts: Contacts) -> tuple[np.ndarray, np.ndarray]:
    """Hertz's 2 E* a and Mindlin's 8 G* a of each contact [N/m], from its overlap alone."""
    overlap = 2 * RADIUS - np.linalg.norm(contacts.branch, axis=1)
    contact_radius = np.sqrt(RADIUS / 2 * overlap)
    normal = 2 * SHEAR_MODULUS / (1 - POISSON) * contact_radius
    return normal, 8 * SHEAR_MODULUS / (2 * (2 - POISSON)) * contact_radius


def sum_over_contacts(
    direction: np.ndarray, contacts: Contacts, frictionless: bool = False
) -> float:
    """direction : C : direction [Pa] of affine motion."""
    normal, shear = stiffnesses(contacts)
    moved = contacts.branch @ direction.T
    along = (moved * contacts.normal).sum(axis=1)
    across = (moved**2).sum(axis=1) - along**2
    # YADE's remedy against ratcheting lengthens shear increments by 2 R/(2 R - overlap).
    longer = 2 * RADIUS / np.linalg.norm(contacts.branch, axis=1)
    stiff = normal * along**2 + (0 if frictionless else shear * longer * across)
    return float(stiff.sum()) / O.cell.volume


def affine_moduli(contacts: Contacts) -> tuple[float, float]:
    """K and G [Pa] by the sums over contacts."""
    square = (contacts.branch**2).sum(axis=1)
    normal, shear = stiffnesses(contacts)
    bulk = (normal * square).sum() / (9 * O.cell.volume)
    return bulk, ((normal + 1.5 * shear) * square).sum() / (15 * O.cell.volume)


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
    amount = 3e-8  # 0.7 % of the smallest overlap, 4e-5 of the mean one
    start = build(random_packing)
    strain(direction, amount)
    plus = read_contacts()
    build(random_packing)
    strain(direction, -amount)
    minus = read_contacts()
    measured = work_per_strain(direction, minus, plus) / (2 * amount)
    # Hertz's curvature drops out of central differences; the spring's rescaling, which knows loading from
    # unloading, leaves a part of strain over overlap.
    assert measured == pytest.approx(sum_over_contacts(direction, start), rel=1e-6)


def test_affine_moduli_of_a_lattice_are_those_of_effective_medium_theory():
    lattice = sp.face_centred_cubic(3, 2e-4)
    contacts = build(lattice)
    assert len(contacts.force) == 6 * len(lattice.centres)
    # Solid fraction and branch vectors know of the overlap, the theory does not: 1e-4 a factor.
    assert affine_moduli(contacts) == pytest.approx(effective_medium(lattice, contacts), rel=3e-4)


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


def relaxed_over_affine(
    packing: sp.Packing, direction: np.ndarray, amount: float, law: str
) -> float:
    """Stiffness against a strain after which the spheres have come to rest, over the affine one."""
    contacts = build(packing, law, held=False)
    O.run(300, True)
    start = stress_along(direction, read_contacts())
    strain(direction, amount, 100)
    O.run(800, True)
    assert utils.unbalancedForce() < 1e-4
    increment = stress_along(direction, read_contacts()) - start
    return increment / amount / sum_over_contacts(direction, contacts, law == "none")


def stress_along(direction: np.ndarray, contacts: Contacts) -> float:
    """stress : direction [Pa], tension positive."""
    force = contacts.force[:, None] * contacts.normal + contacts.shear
    return -float((force * (contacts.branch @ direction.T)).sum()) / O.cell.volume


def test_a_lattice_has_nothing_to_relax():
    # Every sphere is a centre of inversion. The strain is 1e-3 of overlap over radius.
    ratio = relaxed_over_affine(sp.face_centred_cubic(3, 2e-4), STRAINS["xy"], 1e-7, "incremental")
    assert ratio == pytest.approx(1.0, rel=1e-3)


def test_a_packing_that_relaxes_is_softer_more_in_shear_than_in_compression(random_packing):
    # Overlaps change by 1 %, which is what the ratios are uncertain by.
    bulk = relaxed_over_affine(random_packing, STRAINS["isotropic"], -1e-5, "incremental")
    shear = relaxed_over_affine(random_packing, STRAINS["xy"], 1e-5, "incremental")
    assert shear < 0.8
    assert shear < bulk < 0.98


def test_without_friction_the_shear_stiffness_nearly_vanishes_at_jamming(random_packing):
    """O'Hern et al. (2003): K stays of the order of the contact stiffness, G goes to zero with pressure."""
    bulk = relaxed_over_affine(random_packing, STRAINS["isotropic"], -1e-5, "none")
    shear = relaxed_over_affine(random_packing, STRAINS["xy"], 1e-5, "none")
    assert bulk > 0.7
    assert 0 < shear < 0.15
