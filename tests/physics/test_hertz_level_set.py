# SPDX-License-Identifier: GPL-2.0-or-later
"""Level-set bodies of spherical shape collide as spheres do, within what their grid resolves.

Grid spacing is a twentieth of the radius; surface nodes 1602. With stock YADE's law the peak force
of two such bodies is 0.3 % below Hertz's (1.2 % at twice the spacing), so the tolerance is 1 %.
"""
from __future__ import annotations

import math

import contact_scenes as cs
import numpy as np
import pytest
from yade import (
    Bo1_Box_Aabb,
    Bo1_LevelSet_Aabb,
    Bo1_Wall_Aabb,
    ForceResetter,
    Ig2_Box_LevelSet_ScGeom,
    Ig2_LevelSet_LevelSet_ScGeom,
    Ig2_Wall_LevelSet_ScGeom,
    InsertionSortCollider,
    InteractionLoop,
    NewtonIntegrator,
    O,
    utils,
)

pytestmark = pytest.mark.filterwarnings("ignore:dynamic=True is deprecated")  # in levelSetBody

SOLID = cs.Solid(7.0e9, 0.3, 2700)
RADIUS = 0.01
SPEED = 1.0
STEPS_PER_CONTACT = 200
TOLERANCE = 0.01


def level_set_sphere(centre):
    """A sphere given by its distance field on a grid."""
    return utils.levelSetBody(
        "sphere",
        center=tuple(centre),
        radius=RADIUS,
        spacing=RADIUS / 20,
        nSurfNodes=1602,
        nodesPath=1,
        material="grain",
    )


def peak_force(body_id: int, direction: np.ndarray, duration: float) -> float:
    """Largest force [N] along `direction` on a body during `duration` [s]."""
    forces = [0.0]
    O.engines = [
        ForceResetter(),
        InsertionSortCollider(
            [Bo1_LevelSet_Aabb(), Bo1_Wall_Aabb(), Bo1_Box_Aabb()], verletDist=0.0
        ),
        InteractionLoop(
            [Ig2_LevelSet_LevelSet_ScGeom(), Ig2_Wall_LevelSet_ScGeom(), Ig2_Box_LevelSet_ScGeom()],
            *cs.grain_law(),
        ),
        cs.recorder(lambda: forces.append(float(cs.force_on(body_id) @ direction))),
        NewtonIntegrator(damping=0),
    ]
    O.dt = duration / STEPS_PER_CONTACT
    cs.run_for(1.2 * duration)
    return max(forces)


@pytest.mark.parametrize("tilt", [0.0, 0.1, 0.3], ids=lambda tilt: f"tilt {tilt}")
def test_two_level_set_spheres_collide_with_the_peak_force_of_hertz(tilt):
    O.materials.append(SOLID.material(label="grain"))
    direction = np.array([math.sin(tilt), 0, math.cos(tilt)])
    for side in (-1, 1):
        body = level_set_sphere(side * RADIUS * direction)
        body.state.vel = tuple(-side * SPEED / 2 * direction)
        O.bodies.append(body)
    hertz = cs.HertzImpact.of_equal_spheres(SOLID, RADIUS, SPEED)
    force = peak_force(1, direction, hertz.duration)
    assert force == pytest.approx(hertz.force, rel=TOLERANCE)


def wall():
    return utils.wall(0, axis=2, sense=0, material="plane")


def box():
    return utils.box(
        (0, 0, -RADIUS), (5 * RADIUS, 5 * RADIUS, RADIUS), fixed=True, material="plane"
    )


@pytest.mark.parametrize("plane", [wall, box])
def test_level_set_sphere_on_a_flat_body_has_the_full_stiffness_of_hertz(plane):
    O.materials.append([SOLID.material(label="grain"), SOLID.rigid_material(label="plane")])
    O.bodies.append(plane())
    body = level_set_sphere((0, 0, RADIUS))
    body.state.vel = (0, 0, -SPEED)
    sphere = O.bodies.append(body)
    hertz = cs.HertzImpact.on_rigid_plane(SOLID, RADIUS, SPEED)
    force = peak_force(sphere, np.array([0, 0, 1.0]), hertz.duration)
    assert force == pytest.approx(hertz.force, rel=TOLERANCE)
