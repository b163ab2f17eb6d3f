# SPDX-License-Identifier: GPL-2.0-or-later
"""The scene of a drop: bed, projectile just above it, engines."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import yade.wrapper
from yade import O, Quaternion

from grainfall.bed_scene import WALL_COUNT, add_bed, restore_contacts
from grainfall.beds import Bed, BedSpec
from grainfall.constants import GRAVITY
from grainfall.contacts import Sand, contact_loop, integrator, rayleigh_step
from grainfall.drop.trace import ENERGY_EVERY
from grainfall.projectiles import make_projectile, projectile

if TYPE_CHECKING:
    from grainfall.drop.far_field import Continuum

#: The projectile starts this many mean grain diameters above the highest grain.
CLEARANCE_DIAMETERS = 0.5


def bed_spec(parameters: Mapping[str, Any]) -> BedSpec:
    """The bed that these parameters ask for."""
    p = parameters
    return BedSpec(
        length=p["box_length"],
        width=p["box_width"],
        depth=p["bed_depth"],
        grains=p["grains"],
        diameter=p["grain_diameter"],
        spread=p["grain_spread"],
        solid_fraction=p["solid_fraction"],
        wall_friction=p["wall_friction"],
        seed=p["seed"],
        sand=Sand.of(p),
    )


def projectile_id(bed: Bed) -> int:
    """Body number of the projectile: grains first, then the walls, then it."""
    return len(bed.radii) + WALL_COUNT


def impact_speed(parameters: Mapping[str, Any]) -> float:
    """Speed on reaching the surface [m/s]: as given, or that of free fall from the drop height."""
    if parameters["impact_speed"] is not None:
        return parameters["impact_speed"]
    return math.sqrt(2 * GRAVITY * (parameters["drop_height"] or 0.0))


def time_step(parameters: Mapping[str, Any], bed: Bed) -> float:
    """First time step [s]: as given, or a fraction of the smallest grain's Rayleigh step."""
    if parameters["time_step"] is not None:
        return parameters["time_step"]
    sand = Sand.of(parameters)
    rayleigh = rayleigh_step(float(bed.radii.min()), sand.density, sand.young, sand.poisson)
    return parameters["dt_safety"] * rayleigh


def build_scene(parameters: Mapping[str, Any], bed: Bed) -> Continuum | None:
    """Fill an empty scene: bodies, engines, step. Labels: see `_engines`. What is around the box, unless rigid."""
    p = parameters
    sand = Sand.of(p)
    O.reset()
    wall = sand.material(
        "wall", friction=p["wall_friction"], referenceRadius=0.0, gravimetricMoisture=0.0
    )
    if p["far_field"] != "rigid":
        return _build_in_continuum(p, bed, sand, wall)
    add_bed(bed, sand.material("sand"), wall)
    O.bodies.append(_projectile(p, bed))
    O.engines = _engines(p, sand, bed)
    O.dt = time_step(p, bed)
    restore_contacts(bed)
    return None


def _build_in_continuum(p: Mapping[str, Any], bed: Bed, sand: Sand, wall: Any) -> Continuum:
    """The same in a deformable far field."""
    from grainfall.drop import far_field

    continuum, model = far_field.add_bed_in_continuum(p, bed, sand.material("sand"), wall)
    O.bodies.append(_projectile(p, bed))
    engine = far_field.add_faces(p, model)
    O.engines = _engines(p, sand, bed, engine)
    O.dt = time_step(p, bed)
    far_field.restore_contacts_on_faces(bed, engine, model)
    return continuum


def _projectile(p: Mapping[str, Any], bed: Bed) -> Any:
    """The projectile above the bed, at the speed it has fallen to there."""
    material = yade.wrapper.GrainMat(
        young=p["projectile_young"],
        poisson=p["projectile_poisson"],
        restitution=p["projectile_restitution"],
        friction=p["projectile_friction"],
        contactAngle=p["contact_angle"],
        label="projectile",
    )
    O.materials.append(material)
    height = (
        float((bed.centres[:, 2] + bed.radii).max()) + CLEARANCE_DIAMETERS * p["grain_diameter"]
    )
    fall = height - bed.surface
    speed = math.sqrt(max(impact_speed(p) ** 2 - 2 * GRAVITY * fall, 0.0))
    tilt = math.radians(p["tilt_degrees"])
    axis = (-math.sin(tilt), 0, -math.cos(tilt))
    return make_projectile(
        replace(projectile(p["profile"]), mass=p["mass"]),
        nose_at=(p["offset_x"], p["offset_y"], height),
        velocity=(0, 0, -speed),
        angular_velocity=[p["spin"] * component for component in axis],
        orientation=Quaternion((0, 1, 0), tilt),
        material=material,
    )


def _engines(p: Mapping[str, Any], sand: Sand, bed: Bed, wall: Any = None) -> list[Any]:
    """Engines in YADE's order; the recorder stands where forces and positions belong to one moment."""
    w = yade.wrapper
    # At 0.15 R the collider runs about every ten steps while the projectile is fast.
    verlet = 0.15 * float(bed.radii.min())
    bounds = [w.Bo1_Sphere_Aabb(), w.Bo1_Wall_Aabb(), w.Bo1_SolidOfRevolution_Aabb()]
    contact = [w.Ig2_SolidOfRevolution_Sphere_ScGeom(), w.Ig2_Wall_SolidOfRevolution_ScGeom()]
    laws: list[Any] = []
    if wall is not None:
        from grainfall.drop.far_field import functors

        for functor_list, more in zip((bounds, contact, laws), functors()):
            functor_list += more
    on_projectile = {
        "friction": p["projectile_friction"],
        "restitution": p["projectile_restitution"],
    }
    pairs = [
        w.GrainPair("sand", "projectile", **on_projectile),
        w.GrainPair("sand", "wall", friction=p["wall_friction"]),
    ]
    # The stepper stands before what multiplies forces with the step, so that all use the same one.
    adaptive = p["time_step_control"] == "hertz"
    stepper = [w.HertzTimeStepper(safety=p["dt_safety"], label="time_stepper")] if adaptive else []
    every = max(1, round(p["record_interval"] / time_step(p, bed)))
    rate = {"virtPeriod": p["record_interval"]} if adaptive else {"iterPeriod": every}
    command = "import grainfall.drop.trace; grainfall.drop.trace.{}()"
    engines = [
        w.ForceResetter(label="force_resetter"),
        w.InsertionSortCollider(bounds, verletDist=verlet, label="collider"),
        *([wall] if wall is not None else []),
        contact_loop(sand, pairs, contact, p["path"], blind=["recorder"], laws=laws),
        *stepper,
        w.ProjectileLoad(body=projectile_id(bed), label="projectile_load"),
        w.PyRunner(command=command.format("record"), label="recorder", **rate),
        integrator(p["path"], gravity=(0, 0, -GRAVITY), damping=0, label="integrator"),
    ]
    if p["no_energy"]:
        return engines
    every_energy = every * ENERGY_EVERY
    return engines + [
        w.EnergyLedger(iterPeriod=every_energy, label="energy_ledger"),
        w.PyRunner(
            command=command.format("record_energies"),
            iterPeriod=every_energy,
            initRun=True,
            label="energy_recorder",
        ),
    ]
