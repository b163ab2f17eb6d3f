# SPDX-License-Identifier: GPL-2.0-or-later
"""For the physics tests: scenes of one contact, closed forms of Hertz's impact, recording, data.

SI units throughout. Coordinates: planes have their normal along +z, bodies fall along -z and slide
along +x.
"""
from __future__ import annotations

import csv
import math
from collections.abc import Callable, Iterable
from pathlib import Path

import __main__
import numpy as np
from grainfall import hertz
from grainfall.hertz import HertzImpact, sphere_mass  # noqa: F401  tests find them here
from yade import (
    Bo1_Box_Aabb,
    Bo1_Facet_Aabb,
    Bo1_Sphere_Aabb,
    Bo1_Wall_Aabb,
    ForceResetter,
    GrainMat,
    Ig2_Box_Sphere_ScGeom,
    Ig2_Facet_Sphere_ScGeom,
    Ig2_Sphere_Sphere_ScGeom,
    Ig2_Wall_Sphere_ScGeom,
    InsertionSortCollider,
    InteractionLoop,
    Ip2_FrictMat_FrictMat_MindlinPhys,
    Ip2_GrainMat_GrainMat_GrainPhys,
    Law2_ScGeom_GrainPhys_HertzMindlin,
    Law2_ScGeom_MindlinPhys_Mindlin,
    NewtonIntegrator,
    O,
    PyRunner,
    utils,
)

DATA = Path(__file__).resolve().parents[1] / "data"

# A plane this much stiffer than the sphere changes E* and G* by less than 1e-6 of their rigid-plane
# values.
RIGID = 1e6


class Solid(hertz.Solid):
    """Elastic solid that is made into materials."""

    def material(self, **attributes) -> GrainMat:
        """GrainMat of this solid; without friction unless asked."""
        values = dict(
            young=self.young, poisson=self.poisson, density=self.density, frictionAngle=0.0
        )
        return GrainMat(**{**values, **attributes})

    def rigid_material(self, **attributes) -> GrainMat:
        """GrainMat for a plane that is rigid beside this solid."""
        return self.material(**{"young": self.young * RIGID, **attributes})


def grain_law(ip2: dict | None = None, **law) -> tuple[list, list]:
    """Our functors: attributes of the Ip2 as a dictionary, of the law as keywords."""
    return (
        [Ip2_GrainMat_GrainMat_GrainPhys(**(ip2 or {}))],
        [Law2_ScGeom_GrainPhys_HertzMindlin(**law)],
    )


def stock_law(**ip2) -> tuple[list, list]:
    """YADE's own Hertz-Mindlin functors; its Ip2 accepts GrainMat, which is a FrictMat."""
    return [Ip2_FrictMat_FrictMat_MindlinPhys(**ip2)], [Law2_ScGeom_MindlinPhys_Mindlin()]


def set_engines(
    law: tuple[list, list],
    record: Callable[[], None] | None = None,
    gravity: tuple[float, float, float] = (0, 0, 0),
    damping: float = 0.0,
    hertzian: bool = True,
    period: int = 1,
) -> None:
    """Ordinary engines for spheres, walls, boxes and facets.

    `record` is called every `period` steps between the contact forces and the motion they cause:
    positions are then those that the forces belong to.
    """
    engines = [
        ForceResetter(),
        InsertionSortCollider(
            [Bo1_Sphere_Aabb(), Bo1_Wall_Aabb(), Bo1_Box_Aabb(), Bo1_Facet_Aabb()]
        ),
        InteractionLoop(
            [
                Ig2_Sphere_Sphere_ScGeom(),
                Ig2_Wall_Sphere_ScGeom(hertzian=hertzian),
                Ig2_Box_Sphere_ScGeom(),
                Ig2_Facet_Sphere_ScGeom(hertzian=hertzian),
            ],
            *law,
        ),
    ]
    if record is not None:
        engines.append(recorder(record, period))
    O.engines = engines + [NewtonIntegrator(damping=damping, gravity=gravity)]


def recorder(function: Callable[[], None], period: int = 1) -> PyRunner:
    """Engine that calls a Python function every `period` steps; PyRunner knows only commands."""
    __main__.grainfall_record = function
    return PyRunner(command="grainfall_record()", iterPeriod=period, initRun=True)


def add_sphere(
    position: Iterable[float],
    radius: float,
    material,
    velocity: Iterable[float] = (0, 0, 0),
    fixed: bool = False,
) -> int:
    """Append a sphere; `fixed` bodies keep the velocity they are given. Returns its id."""
    body = utils.sphere(tuple(position), radius, material=material)
    body.state.vel = tuple(velocity)
    if fixed:
        body.state.blockedDOFs = "xyzXYZ"
    return O.bodies.append(body)


def add_plane(material, height: float = 0.0) -> int:
    """Append an infinite wall with its normal along z. Returns its id."""
    return O.bodies.append(utils.wall(height, axis=2, sense=0, material=material))


def run_for(duration: float) -> None:
    """Run whole steps that cover `duration` [s] in one call."""
    O.run(math.ceil(duration / O.dt), True)


def force_on(body_id: int) -> np.ndarray:
    """Contact force on a body in this step, shape (3,) [N]."""
    return np.array(O.forces.f(body_id))


def read_csv(name: str) -> np.ndarray:
    """Digitised curve below tests/data: rows of numbers after the citation and the column names."""
    with open(DATA / name, newline="", encoding="utf-8") as file:
        citation = file.readline()
        assert citation.startswith("# "), f"{name}: the first line must cite the source"
        rows = list(csv.reader(file))[1:]
    return np.array([[float(x) for x in row] for row in rows])
