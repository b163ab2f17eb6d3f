# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes that run on both paths, and what is compared of them."""
from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from grainfall.projectiles import make_projectile
from yade import (
    Bo1_Sphere_Aabb,
    Bo1_Wall_Aabb,
    EnergyLedger,
    ForceResetter,
    GrainIntegrator,
    GrainInteractionLoop,
    GrainMat,
    Ig2_Sphere_Sphere_ScGeom,
    Ig2_Wall_Sphere_ScGeom,
    InsertionSortCollider,
    InteractionLoop,
    Ip2_GrainMat_GrainMat_GrainPhys,
    Law2_ScGeom_GrainPhys_HertzMindlin,
    NewtonIntegrator,
    O,
    utils,
)
import yade.wrapper

RADIUS = 0.005
GRAVITY = 9.81
#: Largest relative difference of the paths after one step, and after 300 with impacts, which amplify rounding.
ONE_STEP, MANY_STEPS = 1e-12, 1e-9
LAWS = ("incremental", "mindlin-deresiewicz", "report", "secant", "none")


def sand(**changes: Any) -> Any:
    """Material of the grains."""
    attributes = {
        "young": 1e8,
        "poisson": 0.25,
        "density": 2500,
        "restitution": 0.6,
        "friction": 0.5,
        "label": "sand",
    }
    return GrainMat(**{**attributes, **changes})


def pack(material: Any, count: int = 4, pitch: float = 1.96, boxes: bool = False) -> None:
    """count^3 grains of three sizes, a little out of order, over the floor of a box of five walls, or of five
    boxes with the same inner faces."""
    O.materials.append(material)
    step = pitch * RADIUS
    for i in range(count**3):
        place = np.array([i % count, i // count % count, i // count**2]) * step
        shift = 0.05 * RADIUS * math.sin(7.0 * i)
        radius = RADIUS * (1, 0.99, 0.98)[i % 3]
        body = utils.sphere(place + (shift, -shift, shift), radius, material=material)
        body.state.vel = (0.2 * math.sin(3.0 * i), 0.2 * math.cos(5.0 * i), 0)
        O.bodies.append(body)
    low, high = -1.1 * RADIUS, (count - 1) * step + 1.1 * RADIUS
    for axis, position in ((0, low), (0, high), (1, low), (1, high), (2, low)):
        if boxes:
            half = np.full(3, 0.7 * (high - low))
            half[axis] = 2 * RADIUS
            centre = np.full(3, 0.5 * (low + high))
            centre[axis] = position + (half[axis] if position > 0 else -half[axis])
            O.bodies.append(utils.box(tuple(centre), tuple(half), fixed=True, material=material))
        else:
            O.bodies.append(utils.wall(position, axis=axis, sense=0, material=material))


def add_clump(place: tuple[float, float, float]) -> int:
    """Two unequal spheres that overlap, as one body; its id."""
    first = np.array(place)
    grains = [
        utils.sphere(tuple(first + shift), radius, material=O.materials[0])
        for shift, radius in (((0.0, 0, 0), 0.004), ((0.004, 0.001, 0.002), 0.003))
    ]
    clump, _ = O.bodies.appendClumped(grains, discretization=20)
    return clump


def engines(
    flat: bool,
    geometry: Sequence[Any] = (),
    bounds: Sequence[Any] = (),
    more: Sequence[Any] = (),
    law: dict[str, Any] | None = None,
    damping: float = 0,
    hertzian: bool = True,
) -> None:
    """Engines of the flat or of the general path, in YADE's order; `more` come last."""
    loop = GrainInteractionLoop if flat else InteractionLoop
    newton = GrainIntegrator if flat else NewtonIntegrator
    O.engines = [
        ForceResetter(),
        InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb(), *bounds], label="collider"),
        loop(
            [Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom(hertzian=hertzian), *geometry],
            [Ip2_GrainMat_GrainMat_GrainPhys()],
            [Law2_ScGeom_GrainPhys_HertzMindlin(label="contact_law", **(law or {}))],
            label="loop",
        ),
        newton(gravity=(0, 0, -GRAVITY), damping=damping, label="newton"),
        *more,
    ]
    O.dt = 1e-5


def build(flat: bool, law: dict[str, Any] | None = None, **material: Any) -> None:
    """The pack and its engines."""
    pack(sand(**material))
    engines(flat, law=law)


def box_engines(flat: bool, **changes: Any) -> None:
    """The same with boxes among the grains."""
    w = yade.wrapper
    engines(flat, [w.Ig2_Box_Sphere_ScGeom()], [w.Bo1_Box_Aabb()], **changes)


def projectile_engines(flat: bool, more: Sequence[Any] = ()) -> None:
    """The same with a solid of revolution among the grains."""
    w = yade.wrapper
    functors = [w.Ig2_SolidOfRevolution_Sphere_ScGeom(), w.Ig2_Wall_SolidOfRevolution_ScGeom()]
    engines(flat, functors, [w.Bo1_SolidOfRevolution_Aabb()], more)


def ledger() -> Any:
    """The engine that balances the energies."""
    return EnergyLedger(iterPeriod=50, label="ledger")


def drop_projectile(profile: Any, material: Any) -> int:
    """A projectile above the pack; its id."""
    return O.bodies.append(
        make_projectile(
            profile, nose_at=(0.015, 0.015, 0.037), velocity=(0, 0, -2), material=material
        )
    )


def state() -> dict[str, np.ndarray]:
    """Everything that a user can see of bodies and contacts, each an array; contacts in the order of their ids."""
    bodies = [body for body in O.bodies]
    contacts = sorted(
        (i for i in O.interactions if i.isReal),
        key=lambda i: (min(i.id1, i.id2), max(i.id1, i.id2)),
    )
    return {
        "position": np.array([b.state.pos for b in bodies]),
        "velocity": np.array([b.state.vel for b in bodies]),
        "spin": np.array([b.state.angVel for b in bodies]),
        "orientation": np.array([[b.state.ori[k] for k in range(4)] for b in bodies]),
        "force": np.array([O.forces.f(b.id) for b in bodies]),
        "torque": np.array([O.forces.t(b.id) for b in bodies]),
        "ids": np.array([(i.id1, i.id2) for i in contacts]),
        "normal": np.array([i.geom.normal for i in contacts]),
        "point": np.array([i.geom.contactPoint for i in contacts]),
        "overlap": np.array([i.geom.penetrationDepth for i in contacts]),
        "normal force": np.array([i.phys.normalForce for i in contacts]),
        "shear force": np.array([i.phys.shearForce for i in contacts]),
        "elastic shear": np.array([i.phys.shearElastic for i in contacts]),
        "stiffness": np.array([(i.phys.kn, i.phys.ks) for i in contacts]),
        "sliding": np.array([i.phys.isSliding for i in contacts], dtype=float),
    }


def on_both_paths(
    build: Callable[[bool], None], steps: int
) -> tuple[dict[str, Any], dict[str, Any]]:
    """What the scene looks like after so many steps: on the flat path, on the general path."""
    results = []
    for flat in (True, False):
        O.reset()
        build(flat)
        O.run(steps, True)
        if flat:
            assert yade.wrapper.Omega().engines[2].path == "flat"
        results.append(state())
    return results[0], results[1]


def one_step_on_both_paths(
    set_engines: Callable[[bool], None]
) -> tuple[dict[str, Any], dict[str, Any]]:
    """What the present scene looks like a step later: on the flat path, on the general path."""
    O.saveTmp("start")
    results = []
    for flat in (True, False):
        O.loadTmp("start")
        set_engines(flat)
        O.run(1, True)
        if flat:
            assert yade.wrapper.Omega().engines[2].path == "flat"
        results.append(state())
    return results[0], results[1]


def differences(first: dict[str, Any], second: dict[str, Any]) -> dict[str, float]:
    """Largest difference of each quantity over its largest magnitude.

    A spin, torque or tangential force that is zero but for rounding is measured by what a slip, a force would make.
    """
    size = {name: float(np.abs(second[name]).max()) for name in first if first[name].size}
    size["spin"] = max(size["spin"], size["velocity"] / RADIUS)
    size["torque"] = max(size["torque"], size["force"] * RADIUS)
    for name in {"shear force", "elastic shear"} & set(size):
        size[name] = max(size[name], size["normal force"])
    return {
        name: float(np.abs(first[name] - second[name]).max()) / max(scale, 1e-300)
        for name, scale in size.items()
    }


def assert_equal(
    results: tuple[dict[str, Any], dict[str, Any]], tolerance: float, contacts: int = 20
) -> None:
    """Two states with the same contacts, more than so many, and quantities that differ by at most `tolerance`."""
    first, second = results
    assert len(second["ids"]) > contacts
    assert np.array_equal(first["ids"], second["ids"])
    assert {k: v for k, v in differences(first, second).items() if not v <= tolerance} == {}


def assert_saving_changes_no_bit(file: str, steps: int = 200) -> None:
    """The scene goes on for `steps`, is saved, goes on as long; the saved one, loaded, ends in the same state."""
    O.run(steps, True)
    O.save(file)
    O.run(steps, True)
    kept_on = state()
    O.load(file)
    O.run(steps, True)
    loop = next(e for e in O.engines if isinstance(e, GrainInteractionLoop))
    assert loop.path == "flat"
    assert {k: v for k, v in differences(state(), kept_on).items() if v != 0} == {}
