# SPDX-License-Identifier: GPL-2.0-or-later
"""A triaxial sample in YADE: grains, two platens, the membrane's forces, and the step they allow."""
from __future__ import annotations

import builtins
import math
from collections.abc import Iterator
from typing import Any

import numpy as np
import yade.wrapper
from yade import O, Vector3, utils

from grainfall.bed_scene import grain_centres, restore_contacts
from grainfall.constants import GRAVITY
from grainfall.contacts import Sand, contact_loop, integrator
from grainfall.triaxial.membrane import Membrane, wrap
from grainfall.triaxial.samples import Sample

HELD = "xyzXYZ"
SLIDING = "xyXYZ"


def build(
    sample: Sample, sand: Sand, platen_friction: float, gravity: bool, path: str = "flat"
) -> None:
    """Fill an empty scene with the sample between its platens; grain i becomes body i.

    Labels: ``contact_law``, ``contact_maker``, ``contacts``, ``integrator``, ``collider``.

    Parameters
    ----------
    sand : Sand
        Contact parameters of the grains.
    platen_friction : float
        Friction coefficient of grains on platens.
    gravity : bool
        Do the grains have weight?
    path : str
        As `contact_loop` takes it.
    """
    w = yade.wrapper
    O.reset()
    spec = sample.spec
    platen = sand.material(
        "platen",
        young=spec.platen_young,
        poisson=spec.platen_poisson,
        friction=platen_friction,
        referenceRadius=0.0,
    )
    grain = sand.material("sand")
    O.materials.append([grain, platen])
    O.bodies.append(
        [
            utils.sphere(centre, radius, material=grain)
            for centre, radius in zip(sample.centres.tolist(), sample.radii.tolist())
        ]
    )
    O.bodies.append(utils.wall(0.0, axis=2, sense=1, material=platen))
    O.bodies.append(utils.wall(sample.top, axis=2, sense=-1, material=platen))
    pair = w.GrainPair("sand", "platen", friction=platen_friction)
    bounds = [w.Bo1_Sphere_Aabb(), w.Bo1_Wall_Aabb()]
    verlet = 0.1 * float(sample.radii.min())
    O.engines = [
        w.ForceResetter(label="force_resetter"),
        w.InsertionSortCollider(bounds, verletDist=verlet, label="collider"),
        contact_loop(sand, [pair], [], path),
        integrator(path, gravity=(0, 0, -GRAVITY if gravity else 0), damping=0, label="integrator"),
    ]
    restore_contacts(sample)


def release_top(sample: Sample) -> None:
    """Let the upper platen slide along the axis, with the mass of the sand above it in a tenth of the sample."""
    body = O.bodies[sample.top_platen]
    mass = 0.1 * sample.spec.grain_density * 4 / 3 * math.pi * float((sample.radii**3).sum())
    body.state.mass = mass
    body.dynamic = True
    body.state.blockedDOFs = SLIDING


def hold_top(sample: Sample) -> None:
    """Fix the upper platen where it stands; from now on it moves only as it is told."""
    body = O.bodies[sample.top_platen]
    body.state.blockedDOFs = HELD
    body.state.vel = Vector3(0, 0, 0)
    O.forces.setPermF(sample.top_platen, Vector3(0, 0, 0))


def top_height(sample: Sample) -> float:
    """Height of the upper platen [m]."""
    return O.bodies[sample.top_platen].state.pos[2]


def wrap_membrane(sample: Sample) -> Membrane:
    """Membrane around the grains where they are now."""
    centres = grain_centres(len(sample.radii))
    return wrap(centres, sample.radii, 0.0, top_height(sample))


def apply_forces(forces: np.ndarray) -> None:
    """Give bodies 0, 1, ... these permanent forces, shape (n, 3) [N]; YADE does not save them with a scene."""
    for body, force in enumerate(forces.tolist()):
        O.forces.setPermF(body, Vector3(force))


def load(sample: Sample, confinement: float, axial: float) -> Membrane:
    """Put these stresses [Pa] on the sample as it stands; the upper platen must slide."""
    membrane = wrap_membrane(sample)
    apply_forces(membrane.forces(confinement, len(sample.radii)))
    thrust = axial * math.pi * membrane.radius**2
    O.forces.setPermF(sample.top_platen, Vector3(0, 0, -thrust))
    return membrane


def volume(sample: Sample, membrane: Membrane) -> float:
    """Volume between platens and membrane [m3]."""
    return math.pi * membrane.radius**2 * top_height(sample)


def void_ratio(sample: Sample, membrane: Membrane) -> float:
    """Volume of voids over volume of grains, overlaps not subtracted."""
    return volume(sample, membrane) / (4 / 3 * math.pi * float((sample.radii**3).sum())) - 1


def platen_forces(sample: Sample) -> tuple[float, float]:
    """Thrust of the grains on the lower and on the upper platen [N], both positive in compression.

    Valid after a step; permanent forces do not count.
    """
    forces = O.forces
    below = -forces.f(sample.bottom_platen)[2]
    above = forces.f(sample.top_platen)[2] - forces.permF(sample.top_platen)[2]
    return below, above


def unbalanced_force(sample: Sample) -> float:
    """Mean resultant on a grain over mean force in a contact; membrane and weight count as forces.

    YADE's own measure also takes in the upper platen, whose resultant never falls to that of a grain.
    """
    forces = O.forces
    mass_forces = builtins.integrator.gravity
    resultants = [
        (forces.f(i) + O.bodies[i].state.mass * mass_forces).norm()
        for i in range(len(sample.radii))
    ]
    contacts = [
        (contact.phys.normalForce + contact.phys.shearForce).norm() for contact in _contacts()
    ]
    mean_contact = float(np.mean(contacts)) if contacts else 0.0
    return float(np.mean(resultants)) / mean_contact if mean_contact else math.inf


def mean_stress(sample: Sample, membrane: Membrane) -> np.ndarray:
    """Mean stress between platens and membrane from contacts and bridges (Love-Weber), shape (3, 3) [Pa].

    V sigma_ij = sum over contacts of branch_i force_j. The branch of a contact with a platen ends at the contact
    point. The membrane bears on its grains at the surface: its part is that of branches from the grains' centres to
    its points, under the forces that the grains feel from it now. Compression is positive.
    """
    total = np.zeros((3, 3))
    for contact, branch in _branches(sample):
        total += np.outer(branch, contact.phys.normalForce + contact.phys.shearForce)
        total += np.outer(branch, _bridge_force(contact))
    centres = grain_centres(len(sample.radii))
    held = np.array([O.forces.permF(i) for i in range(len(centres))])
    strength = float(np.linalg.norm(held)) / max(
        float(np.linalg.norm(membrane.forces(1.0, len(centres)))), 1e-300
    )
    arms = membrane.points - centres[membrane.grains]
    total += strength * membrane.cell_area * arms.T @ membrane.normals
    return total / volume(sample, membrane)


def suction(sample: Sample, membrane: Membrane) -> float:
    """By how much liquid bridges press the grains together: their part of the mean stress, tension positive [Pa]."""
    virial = sum(float(np.dot(b, _bridge_force(contact))) for contact, b in _branches(sample))
    return -virial / 3 / volume(sample, membrane)


def _contacts() -> list[Any]:
    """Real contacts in the order of their bodies: that of O.interactions depends on when somebody looked."""
    real = (contact for contact in O.interactions if contact.isReal)
    return sorted(real, key=lambda c: (min(c.id1, c.id2), max(c.id1, c.id2)))


def _branches(sample: Sample) -> Iterator[tuple[Any, np.ndarray]]:
    """Each contact with its branch [m] from body 1 to body 2, as its force acts."""
    for contact in _contacts():
        ends = [
            np.array(O.bodies[i].state.pos if i < len(sample.radii) else contact.geom.contactPoint)
            for i in (contact.id1, contact.id2)
        ]
        yield contact, ends[1] - ends[0]


def _bridge_force(contact: Any) -> np.ndarray:
    """Force of the contact's liquid bridge on body 2 [N], shape (3,); YADE's normalForce is without it."""
    bridge = contact.phys.bridge
    if bridge is None:
        return np.zeros(3)
    return (bridge.viscousForce - bridge.attraction) * np.array(contact.geom.normal)


def stable_step(sample: Sample) -> float:
    """Largest step that the contacts of this moment allow without damping [s].

    sqrt(2) min sqrt(m/K) over grains and directions, K the sum of a grain's contact stiffnesses along (or, with its
    moment of inertia, about) an axis: the rule of YADE's manual. For a grain without contacts nothing follows, and
    without any contact the step is infinite. `HertzTimeStepper.criticalStep`, which counts dashpots, coupled rotation
    and the Rayleigh step too, was 0.54 to 0.92 of it in five samples from 1 to 200 kPa.
    """
    count = len(sample.radii)
    along, about = np.zeros((count, 3)), np.zeros((count, 3))
    for contact in _contacts():
        square = np.array(contact.geom.normal) ** 2
        normal, shear = contact.phys.kn, contact.phys.ks
        for grain in (contact.id1, contact.id2):
            if grain < count:
                along[grain] += normal * square + shear * (1 - square)
                about[grain] += shear * (1 - square) * sample.radii[grain] ** 2
    mass = np.array([O.bodies[i].state.mass for i in range(count)])[:, None]
    inertia = 0.4 * mass * sample.radii[:, None] ** 2
    rate = max(float((along / mass).max()), float((about / inertia).max()))
    return math.sqrt(2 / rate) if rate > 0 else math.inf


def set_friction(mu: float) -> None:
    """Give all grains, and the contacts between them that there are, this constant friction coefficient."""
    grain = O.materials[0]
    grain.friction = mu
    for contact in O.interactions:
        if contact.isReal and contact.phys.friction is None:
            contact.phys.tangensOfFrictionAngle = mu


def energy_ledger() -> Any:
    """The engine that balances the energies of the cycles; platen and membrane count as supplied work."""
    return yade.wrapper.EnergyLedger(iterPeriod=1000, label="energy_ledger")


def dissipated() -> dict[str, float]:
    """What the contacts have dissipated since the scene began [J]."""
    booked: dict[str, Any] = dict(O.energy.items())
    return {
        "friction": booked.get("grainFriction", 0.0),
        "viscous": booked.get("grainViscous", 0.0),
        "rescaling": booked.get("grainRescaling", 0.0),
        "bridgeRupture": booked.get("grainBridge", 0.0),
    }
