# SPDX-License-Identifier: GPL-2.0-or-later
"""Elastic oblique impact of a sphere on a plane, after Maw, Barber & Fawcett (1976) Wear 38:101.

In their numbers psi = kappa vt/(mu vn), with vt the tangential velocity of the contact patch, vn the
normal approach velocity and kappa = 2 (1 - nu)/(2 - nu), the rebound psi2 depends on the incidence
psi1 and on chi = 7 kappa/4 alone. The reference solves the impact with the contact's springs one by
one (Lyashenko & Popov 2015 show that this is Maw, Barber & Fawcett's solution): it shares nothing
with the law but the mechanics. From psi1 = 4 chi - 1 on the patch slides throughout and momentum
alone gives psi2 = psi1 - 4 chi.
"""
from __future__ import annotations

import math

import contact_scenes as cs
import numpy as np
from yade import O

SOLID = cs.Solid(1.0e11, 0.3, 2500)
RADIUS = 0.0025  # m
SPEED = 0.05  # normal, m/s: the overlap stays below 1e-4 of the radius
FRICTION = 0.1
STEPS_PER_CONTACT = 1000

KAPPA = 2 * (1 - SOLID.poisson) / (2 - SOLID.poisson)
CHI = 7 * KAPPA / 4


def reference_rebound(incidence: np.ndarray, springs: int = 800, steps: int = 4000) -> np.ndarray:
    """psi2 for each psi1 of `incidence`, shape (n,), both of that shape.

    Units: largest overlap, normal speed and mass are 1; displacements along the plane are divided by
    3/2 mu/kappa' so that a spring that touches at y slips at tau = overlap - y. Springs stand at equal
    distances s, y = s^2.
    """
    stiffness = 1.25  # overlap is 1 where 2/5 stiffness = 1/2
    touch = ((np.arange(springs) + 0.5) / springs) ** 2
    # d(psi)/dt = -kappa/mu (T/m) (1 + 1/K^2) with T = 3/2 mu stiffness integral tau ds.
    coupling = 3.5 * KAPPA * 1.5 * stiffness / springs
    duration = 4 * math.sqrt(math.pi) / 5 * math.gamma(0.4) / math.gamma(0.9)
    dt = duration / steps
    tau = np.zeros((len(incidence), springs))
    psi = np.array(incidence, dtype=float)
    overlap, speed = 0.0, 1.0
    while True:
        speed -= stiffness * overlap**1.5 * dt
        psi -= coupling * tau.sum(axis=1) * dt
        deeper = overlap + speed * dt
        if deeper <= 0:
            return psi
        part = np.where(touch < overlap, 1.0, (deeper - touch) / (deeper - overlap))
        limit = np.maximum(deeper - touch, 0.0)
        tau = np.clip(tau + psi[:, None] * dt * part, -limit, limit)
        overlap = deeper


def rebound(incidence: np.ndarray, tangential_law: str) -> np.ndarray:
    """psi2 that the law gives for each psi1 of `incidence`, shape (n,), both of that shape."""
    O.reset()
    friction = dict(frictionAngle=math.atan(FRICTION))
    O.materials.append(
        [
            SOLID.rigid_material(label="plane", **friction),
            SOLID.material(label="sphere", **friction),
        ]
    )
    cs.add_plane("plane")
    scale = KAPPA / (FRICTION * SPEED)
    ids = [
        cs.add_sphere((0, 4 * RADIUS * i, RADIUS), RADIUS, "sphere", (psi / scale, 0, -SPEED))
        for i, psi in enumerate(incidence)
    ]
    cs.set_engines(cs.grain_law(tangentialLaw=tangential_law))
    duration = cs.HertzImpact.on_rigid_plane(SOLID, RADIUS, SPEED).duration
    O.dt = duration / STEPS_PER_CONTACT
    cs.run_for(1.05 * duration)
    assert O.interactions.countReal() == 0
    velocity = np.array([O.bodies[i].state.vel[0] for i in ids])
    spin = np.array([O.bodies[i].state.angVel[1] for i in ids])
    return scale * (velocity - spin * RADIUS)
