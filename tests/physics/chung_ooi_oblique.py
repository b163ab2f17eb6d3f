# SPDX-License-Identifier: GPL-2.0-or-later
"""For tests 5, 6 and 8 of Chung & Ooi (2011): spheres whose contact slips when it is made.

In units of mass, radius and normal speed such an impact depends on four numbers only: slip over
friction times normal speed, restitution, k_t/k_n and the mass ratio. The slip is the velocity of the
sphere's patch along that of its partner [m/s], positive before the impact. Arrays run over the
impacts; each impact has its own spheres, side by side in one scene.
"""
from __future__ import annotations

import math
from dataclasses import dataclass

import contact_scenes as cs
import numpy as np
from yade import O

STEPS_PER_CONTACT = 1000
# Damped contacts last longer than Hertz's; at restitution 0.5 by a tenth.
CONTACTS_RUN = 1.3


@dataclass(frozen=True)
class Oblique:
    """radius [m], normal_speed [m/s], friction [-], restitution [-] of one test.

    spinning: does the slip come from spin (tests 6, 8) or from motion along the partner (test 5)?
    """

    radius: float
    normal_speed: float
    friction: float
    restitution: float
    spinning: bool

    @property
    def sliding_loss(self) -> float:
        """Slip lost if the contact slides throughout [m/s]: 3.5 mu (1 + e) v_n."""
        return 3.5 * self.friction * (1 + self.restitution) * self.normal_speed

    def velocities(self, slip: float) -> tuple[tuple, tuple]:
        """Velocity [m/s] and spin [rad/s] before the impact, falling along -z."""
        if self.spinning:
            return (0, 0, -self.normal_speed), (0, -slip / self.radius, 0)
        return (slip, 0, -self.normal_speed), (0, 0, 0)


@dataclass(frozen=True)
class Rebound:
    """After the impact, shape (n,) each: normal [m/s], slip [m/s], spin [rad/s]."""

    normal: np.ndarray
    slip: np.ndarray
    spin: np.ndarray


def on_rigid_plane(
    impact: Oblique,
    solid: cs.Solid,
    slip: np.ndarray,
    tangential_law: str = "incremental",
    stiffness_factor: float = 1.0,
) -> Rebound:
    """Impacts on one rigid plane, for each slip [m/s]; tangential stiffness times `stiffness_factor`."""
    _materials(impact, solid, solid.rigid_material)
    cs.add_plane("partner")
    ids = [_add(impact, 4 * impact.radius * i, s) for i, s in enumerate(slip)]
    hertz = cs.HertzImpact.on_rigid_plane(solid, impact.radius, impact.normal_speed)
    return _rebound(impact, ids, hertz, tangential_law, stiffness_factor)


def on_heavy_sphere(
    impact: Oblique, solid: cs.Solid, slip: np.ndarray, tangential_law: str = "incremental"
) -> Rebound:
    """Impacts on spheres at rest of the same elastic constants, 5 times the size, 1000 times as dense."""
    _materials(impact, solid, solid.material, density=1000 * solid.density)
    ids, large = [], 5 * impact.radius
    for i, s in enumerate(slip):
        cs.add_sphere((0, 2.1 * large * i, -large), large, "partner")
        ids.append(_add(impact, 2.1 * large * i, s))
    mass = cs.sphere_mass(solid.density, impact.radius)
    hertz = cs.HertzImpact(
        solid.plane_modulus / 2, impact.radius * 5 / 6, mass, impact.normal_speed
    )
    return _rebound(impact, ids, hertz, tangential_law)


def _materials(impact: Oblique, solid: cs.Solid, partner, **attributes) -> None:
    O.reset()
    contact = dict(frictionAngle=math.atan(impact.friction), restitution=impact.restitution)
    O.materials.append(
        [
            partner(label="partner", **contact, **attributes),
            solid.material(label="sphere", **contact),
        ]
    )


def _add(impact: Oblique, y: float, slip: float) -> int:
    velocity, spin = impact.velocities(slip)
    position = (0, y, impact.radius)
    body = cs.add_sphere(position, impact.radius, "sphere", velocity=velocity)
    O.bodies[body].state.angVel = spin
    return body


def _rebound(
    impact: Oblique,
    ids: list[int],
    hertz: cs.HertzImpact,
    tangential_law: str,
    stiffness_factor: float = 1.0,
) -> Rebound:
    cs.set_engines(cs.grain_law(tangentialLaw=tangential_law))
    O.dt = hertz.duration / STEPS_PER_CONTACT
    O.run(2, True)
    assert O.interactions.countReal() == len(ids)
    for contact in O.interactions:
        contact.phys.shearCoefficient *= stiffness_factor
    cs.run_for(CONTACTS_RUN * hertz.duration)
    assert O.interactions.countReal() == 0
    velocity = np.array([O.bodies[i].state.vel for i in ids])
    spin = np.array([O.bodies[i].state.angVel[1] for i in ids])
    return Rebound(velocity[:, 2], velocity[:, 0] - spin * impact.radius, spin)
