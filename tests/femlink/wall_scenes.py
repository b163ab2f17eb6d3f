# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes with a deformable wall: a block under spheres, and the same with rigid walls."""
from __future__ import annotations

import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from femlink_walls import femlink
from yade import (
    Bo1_Sphere_Aabb,
    EnergyLedger,
    ForceResetter,
    GrainIntegrator,
    GrainInteractionLoop,
    GrainMat,
    Ig2_Sphere_Sphere_ScGeom,
    InsertionSortCollider,
    InteractionLoop,
    Ip2_GrainMat_GrainMat_GrainPhys,
    Law2_ScGeom_GrainPhys_HertzMindlin,
    NewtonIntegrator,
    O,
    utils,
)

RADIUS = 0.005  # m
QUARTZ = {"young": 70e9, "poisson": 0.2, "density": 2650.0}
CACHE = Path(tempfile.mkdtemp(prefix="grainfall-walls-"))
PATHS = ("general", "flat")


def block(
    young: float = 20e6,
    size: Sequence[float] = (0.1, 0.1, 0.05),
    cells: Sequence[int] = (10, 10, 5),
    poisson: float = 0.3,
    **options: Any,
) -> Any:
    """Wall model of a block, its top coupling at z = 0, held on its other sides."""
    mesh = femlink.box(tuple(size), tuple(cells), **options)
    return femlink.cached_wall(mesh, {0: (young, poisson, 1600.0)}, cache=CACHE)


def put_materials(restitution: float = 1.0, friction: float = 0.5, face: float = 1000.0) -> None:
    """'grain' of quartz and 'face', `face` times as stiff: the wall supplies its own compliance."""
    common = {"restitution": restitution, "friction": friction}
    O.materials.append(GrainMat(**QUARTZ, **common, label="grain"))
    stiff = {**QUARTZ, "young": face * QUARTZ["young"]}
    O.materials.append(GrainMat(**stiff, **common, label="face"))


def add_grain(
    place: Sequence[float], velocity: Sequence[float] = (0, 0, 0), radius: float = RADIUS
) -> Any:
    """Sphere of 'grain', returned as body."""
    body = utils.sphere(tuple(place), radius, material="grain")
    body.state.vel = tuple(velocity)
    return O.bodies[O.bodies.append(body)]


def put_engines(
    walls: Sequence[Any],
    path: str = "general",
    gravity: float = 0.0,
    damping: float = 0.0,
    dt: float = 2e-7,
    bounds: Sequence[Any] = (),
    geometry: Sequence[Any] = (),
    ledger: bool = True,
    law: Any = None,
) -> None:
    """ForceResetter, collider, walls, loop, integrator and, with period 1, the ledger."""
    more_bounds, more_geometry, more_laws = femlink.functors()
    loop, newton = (
        (GrainInteractionLoop, GrainIntegrator)
        if path == "flat"
        else (InteractionLoop, NewtonIntegrator)
    )
    O.engines = [
        ForceResetter(),
        InsertionSortCollider([Bo1_Sphere_Aabb(), *more_bounds, *bounds], label="collider"),
        *walls,
        loop(
            [Ig2_Sphere_Sphere_ScGeom(), *more_geometry, *geometry],
            [Ip2_GrainMat_GrainMat_GrainPhys()],
            [law or Law2_ScGeom_GrainPhys_HertzMindlin(), *more_laws],
            label="loop",
        ),
        newton(gravity=(0, 0, -gravity), damping=damping, label="newton"),
    ]
    if ledger:
        O.engines = O.engines + [EnergyLedger(iterPeriod=1, label="ledger")]
    O.dt = dt


def impact(
    young: float,
    path: str = "general",
    speed: float = 1.0,
    restitution: float = 1.0,
    slide: float = 0.0,
    place: Sequence[float] = (0.003, 0.002),
    friction: float = 0.5,
    dt: float = 2e-7,
    **attributes: Any,
) -> tuple[Any, Any]:
    """One grain about to hit the block; wall engine and grain."""
    O.reset()
    put_materials(restitution, friction)
    wall = femlink.add_wall(block(young), "face", cache=CACHE, **attributes)
    grain = add_grain((place[0], place[1], RADIUS * (1 + 1e-6)), (slide, 0, -speed))
    put_engines([wall], path, dt=dt)
    return wall, grain


def run_until(done: Callable[[], bool], chunk: int = 50, most: int = 20000) -> int:
    """Steps until `done` says so."""
    steps = 0
    while not done():
        O.run(chunk, True)
        steps += chunk
        assert steps < most, "it does not come to an end"
    return steps


def rebound(wall: Any, grain: Any, **options: int) -> int:
    """Runs until the grain has left the wall."""
    return run_until(lambda: grain.state.vel[2] > 0 and wall.contacts == 0, **options)


def array(vector: Any) -> np.ndarray:
    """A YADE vector, or a list of them, as numpy."""
    return (
        np.array([tuple(v) for v in vector])
        if isinstance(vector, list)
        else np.array(tuple(vector))
    )
