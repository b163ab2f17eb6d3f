# SPDX-License-Identifier: GPL-2.0-or-later
"""Small scenes shared by the tests of the projectile; contacts by YADE's own Hertz-Mindlin law."""

from __future__ import annotations

from typing import Any

import numpy as np
from yade import O, wrapper
from yade.utils import sphere as yade_sphere

YOUNG = 1e7  # Pa; soft, so that a contact lasts many steps


def material(friction_angle: float = 0.0, density: float = 2650.0) -> Any:
    """Append and return a FrictMat."""
    O.materials.append(
        wrapper.FrictMat(young=YOUNG, poisson=0.3, density=density, frictionAngle=friction_angle)
    )
    return O.materials[-1]


def grain(position: Any, radius: float, velocity: Any = (0, 0, 0), **keywords: Any) -> Any:
    """Append and return a sphere of the last material."""
    body = yade_sphere(position, radius, material=O.materials[-1], **keywords)
    body.state.vel = velocity
    O.bodies.append(body)
    return body


def run(steps: int) -> None:
    """Run and wait."""
    O.run(steps, True)


def engines(time_step: float, gravity: float = 0.0, load_of: int = -1, **physics: Any) -> Any:
    """Set O.engines and O.dt; return the ProjectileLoad, or None without `load_of`."""
    load = wrapper.ProjectileLoad(body=load_of) if load_of >= 0 else None
    O.engines = [
        wrapper.ForceResetter(),
        wrapper.InsertionSortCollider(
            [
                wrapper.Bo1_Sphere_Aabb(),
                wrapper.Bo1_Wall_Aabb(),
                wrapper.Bo1_Box_Aabb(),
                wrapper.Bo1_SolidOfRevolution_Aabb(),
            ]
        ),
        wrapper.InteractionLoop(
            [
                wrapper.Ig2_Sphere_Sphere_ScGeom(avoidGranularRatcheting=False),
                wrapper.Ig2_Wall_Sphere_ScGeom(hertzian=True, noRatch=False),
                wrapper.Ig2_SolidOfRevolution_Sphere_ScGeom(),
                wrapper.Ig2_Wall_SolidOfRevolution_ScGeom(),
                wrapper.Ig2_Box_SolidOfRevolution_ScGeom(),
            ],
            [wrapper.Ip2_FrictMat_FrictMat_MindlinPhys(**physics)],
            [wrapper.Law2_ScGeom_MindlinPhys_Mindlin()],
        ),
        *([load] if load else []),
        wrapper.NewtonIntegrator(gravity=(0, 0, -gravity), damping=0),
    ]
    O.dt = time_step
    return load


def real_contacts(body: Any) -> list[Any]:
    """Interactions of a body that have geometry and physics."""
    return [i for i in O.interactions if i.isReal and body.id in (i.id1, i.id2)]


def vector(value: Any) -> np.ndarray:
    """A YADE vector as numpy array (3,)."""
    return np.array(list(value))


def spin_momentum(body: Any) -> np.ndarray:
    """Angular momentum [kg m2/s] about the body's own centroid, global axes (3,)."""
    state = body.state
    if body.aspherical:
        return vector(state.angMom)
    return vector(state.inertia) * vector(state.angVel)


def kinetic_energy(body: Any) -> float:
    """Translation and rotation [J]."""
    state = body.state
    local_spin = vector(state.ori.conjugate() * state.angVel)
    return 0.5 * state.mass * vector(state.vel) @ vector(state.vel) + 0.5 * float(
        vector(state.inertia) @ local_spin**2
    )
