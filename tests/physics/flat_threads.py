# SPDX-License-Identifier: GPL-2.0-or-later
"""YADE script: scenes on the flat path, what bodies and contacts are like at their ends.

usage: yade -n -x [-j2] flat_threads.py <start.yade.gz> <output.pickle>

The first scene starts from a file; the last saves and loads itself in the middle of its impacts.
"""
from __future__ import annotations

import builtins
import pickle
import sys
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(sys.argv[0]).resolve().parent))

import flat_scenes as scenes  # noqa: E402
import yade.wrapper as w  # noqa: E402
from grainfall.projectiles import make_projectile, projectile  # noqa: E402
from yade import O, utils  # noqa: E402

STEPS = 300
WET = dict(gravimetricMoisture=0.01, liquidViscosity=1e-3)


def run(steps: int) -> dict[str, Any]:
    """The state after so many steps more, which must have run flat."""
    O.run(steps, True)
    loop = next(e for e in O.engines if isinstance(e, w.GrainInteractionLoop))
    assert loop.path == "flat", loop.path
    return scenes.state()


def one_step() -> dict[str, Any]:
    O.load(sys.argv[1])
    scenes.engines(True)
    return run(1)


def build(law: dict[str, Any] | None = None, more: list | tuple = (), **material: Any) -> None:
    O.reset()
    scenes.pack(scenes.sand(**material), count=6)
    scenes.engines(True, law=law, more=more)


def bed(law: dict[str, Any] | None = None, **material: Any) -> dict[str, Any]:
    """A bed falls together; with its energies."""
    build(law, [scenes.ledger()], **material)
    state = run(STEPS)
    O.run(50 - O.iter % 50 + 1, True)  # to the ledger's next balance
    return {**state, "energies": dict(O.energy.items()), "residual": O.engines[-1].relativeResidual}


def changing_bodies() -> dict[str, Any]:
    """Grains come and go in the middle of the run."""
    build()
    O.engines = [*O.engines, w.PyRunner(command="change()", iterPeriod=100, nDo=3)]

    def change() -> None:
        O.bodies[3].state.vel = (1, 0, 0)
        if O.iter < 150:
            O.bodies.append(utils.sphere((0.015, 0.015, 0.08), 0.004, material=O.materials[0]))
            O.bodies.erase(10)

    builtins.change = change
    return run(STEPS + 50)


def build_with_clumps() -> None:
    """Moist, with partial slip; two clumps have come down among the grains when half of the steps are done."""
    build({"tangentialLaw": "mindlin-deresiewicz"}, **WET)
    for x in (0.01, 0.03):
        O.bodies[scenes.add_clump((x, 0.02, 0.059))].state.vel = (0.1, 0, -1)


def saved_in_the_middle() -> dict[str, Any]:
    build_with_clumps()
    run(STEPS // 2)
    file = sys.argv[2] + ".middle.yade.gz"
    O.save(file)
    O.reset()
    O.load(file)
    return run(STEPS // 2)


def kept_on() -> dict[str, Any]:
    """The same, never saved."""
    build_with_clumps()
    return run(STEPS)


def obstacles() -> dict[str, Any]:
    """A projectile and a turning plate among moist grains in boxes; the load on the projectile is summed up."""
    O.reset()
    scenes.pack(scenes.sand(**WET), count=6, boxes=True)
    steel = scenes.sand(label="steel", young=1e9)
    shell = O.bodies.append(
        make_projectile(
            projectile("m70-half"), nose_at=(0.02, 0.02, 0.056), velocity=(0, 0, -2), material=steel
        )
    )
    plate = utils.box((0.04, 0.03, 0.06), (0.01, 0.01, 0.002), fixed=True, material=O.materials[0])
    O.bodies.append(plate)
    plate.state.vel, plate.state.angVel = (0, 0, -2), (20, 10, 30)
    scenes.engines(
        True,
        [w.Ig2_Box_Sphere_ScGeom(), w.Ig2_SolidOfRevolution_Sphere_ScGeom()],
        [w.Bo1_Box_Aabb(), w.Bo1_SolidOfRevolution_Aabb()],
        [w.ProjectileLoad(body=shell)],
    )
    state = run(STEPS)
    load = O.engines[-1]
    return {**state, "impulse": load.noseImpulse.norm() + load.shaftImpulse.norm()}


def works_of_gravity() -> list[float]:
    """Of the same pack, on YADE's own loop, twenty times [J]."""
    works = []
    for _ in range(20):
        O.reset()
        scenes.pack(scenes.sand())
        scenes.engines(False, more=[scenes.ledger()])
        O.run(20, True)
        works.append(dict(O.energy.items())["gravWork"])
    return works


states = {
    "one step": one_step(),
    "dry bed": bed(),
    "moist bed": bed(**WET),
    "changing bodies": changing_bodies(),
    "saved": saved_in_the_middle(),
    "kept on": kept_on(),
    "obstacles": obstacles(),
    "works of gravity": works_of_gravity(),
}
Path(sys.argv[2]).write_bytes(pickle.dumps({"threads": O.numThreads, **states}))
