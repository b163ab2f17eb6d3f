# SPDX-License-Identifier: GPL-2.0-or-later
"""YADE script: one packing under the plain law, under ours with every effect off, and with each effect on.

usage: yade -n -x cases.py FOLDER-OF-PLAIN-LAW OUTPUT.json count|time

`count`, under callgrind (see measure.py): a few steps of each case, counted one by one. `time`: nanoseconds and bytes.
"""
from __future__ import annotations

import json
import math
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import yade
from yade import O

sys.path.insert(0, sys.argv[1])
import plain_law  # noqa: E402

RADIUS = 1e-3  # m
TIME_STEP = 1e-7  # s
SPEED = 0.5  # m/s, of each grain in a direction of its own: part of the contacts slide
WARM_UP, COUNTED = 3, 4
ROUNDS, TIMED = 25, 40
ELASTIC = dict(young=1e8, poisson=0.2, density=2650.0)
FRICTION, RESTITUTION = 0.5, 0.7
PACKING = Path(__file__ if __file__.endswith("cases.py") else sys.argv[0]).resolve().parents[2]
PACKING = PACKING / "tests" / "data" / "packings" / "jammed_500.csv"


def pack(material: Any) -> None:
    """500 spheres that touch, each with a velocity of its own; the same in every case."""
    centres = 0.998 * RADIUS * np.loadtxt(PACKING, delimiter=",", skiprows=2)
    velocities = SPEED * np.random.default_rng(3).normal(size=centres.shape)
    O.materials.append(material)
    for centre, velocity in zip(centres.tolist(), velocities.tolist()):
        body = yade.utils.sphere(centre, RADIUS, material=material)
        body.state.vel = velocity
        O.bodies.append(body)


def run(makers: list, laws: list, extra: list) -> None:
    """Engines around these functors, warmed up."""
    w = yade.wrapper
    O.engines = [
        w.ForceResetter(),
        w.InsertionSortCollider([w.Bo1_Sphere_Aabb()], verletDist=0.5 * RADIUS),
        w.InteractionLoop([w.Ig2_Sphere_Sphere_ScGeom()], makers, laws),
        w.NewtonIntegrator(damping=0),
        *extra,
    ]
    O.dt = TIME_STEP
    O.run(WARM_UP, True)


def plain(law: str, **attributes: Any) -> Callable[[], None]:
    """The build without effects, or with the one that the attributes of its contacts ask for."""

    def build() -> None:
        w = yade.wrapper
        pack(w.FrictMat(frictionAngle=float(np.arctan(FRICTION)), **ELASTIC))
        restitution = 1.0 if law.endswith("Elastic") else RESTITUTION
        maker = w.Ip2_FrictMat_FrictMat_PlainPhys(restitution=restitution, **attributes)
        run([maker], [getattr(w, f"Law2_ScGeom_{law}")()], [])

    return build


def ours(
    law: dict | None = None,
    engines: Callable[[], list] = list,
    booking: bool = False,
    **material: Any,
) -> Callable[[], None]:
    """Our law; attributes of the material may be functions that make them."""

    def build() -> None:
        w = yade.wrapper
        values = {
            **ELASTIC,
            "frictionAngle": float(np.arctan(FRICTION)),
            "restitution": RESTITUTION,
            **{name: value() if callable(value) else value for name, value in material.items()},
        }
        O.trackEnergy = booking
        pack(w.GrainMat(**values))
        law_functor = w.Law2_ScGeom_GrainPhys_HertzMindlin(**(law or {}))
        run([w.Ip2_GrainMat_GrainMat_GrainPhys()], [law_functor], engines())

    return build


def curve(name: str, **attributes: Any) -> Callable[[], Any]:
    """A friction curve made when it is needed, after the classes have been registered."""
    return lambda: getattr(yade.wrapper, name)(**attributes)


def moist_curve() -> Any:
    factor = yade.wrapper.MoistureFactor([0, 0.1], [1, 0.8])
    return yade.wrapper.PowerLawFriction(moistureFactor=factor, **POWER)


#: About FRICTION at the loads of this packing, so that as many contacts slide.
POWER = dict(muRef=0.5, loadRef=1e-2, exponent=0.1, muMin=0.3, muMax=0.8)
BRIDGES = dict(gravimetricMoisture=0.01)
TABLE = dict(loads=[1e-4, 1e-2, 1.0], moistures=[0.0], mu=[0.8, 0.5, 0.3])

#: Two grains' shares of the water [m3], surface tension [N/m]: what our law makes of BRIDGES.
PLAIN_BRIDGE = [2 * 0.01 * 2.65 * 4 / 3 * math.pi * RADIUS**3 / 6, 0.0728]

PLAIN = {
    "plain build": plain("PlainPhys_Damped"),
    "plain build, no damping": plain("PlainPhys_Elastic"),
    "plain build, frictionless": plain("PlainPhys_Frictionless"),
    "plain build, power law": plain("PlainPowerLawPhys_Damped", powerLaw=list(POWER.values())),
    "plain build, liquid bridges": plain("PlainWetPhys_Damped", bridge=PLAIN_BRIDGE),
}
OURS = {
    "all effects off": ours(),
    "damping off": ours(restitution=1.0),
    "tangential force off": ours(law=dict(tangentialLaw="none")),
    "friction: power law": ours(friction=curve("PowerLawFriction", **POWER)),
    "friction: exponential": ours(
        friction=curve("ExponentialFriction", mu0=0.8, muInf=0.3, loadScale=1e-2)
    ),
    "friction: asperity": ours(friction=curve("AsperityFriction", alpha=0.3, c=0.04, muMax=0.8)),
    "friction: table of loads": ours(friction=curve("TableFriction", **TABLE)),
    "moisture in friction (power law)": ours(friction=moist_curve, bridgeModel="none", **BRIDGES),
    "load scaling (power law)": ours(
        friction=curve("PowerLawFriction", **POWER), referenceRadius=0.9e-3
    ),
    "partial slip": ours(law=dict(tangentialLaw="mindlin-deresiewicz")),
    "liquid bridges": ours(**BRIDGES),
    "liquid bridges, closed form": ours(bridgeModel="willett-closed", **BRIDGES),
    "liquid bridges with viscous film": ours(liquidViscosity=1e-3, **BRIDGES),
    "energy booking": ours(booking=True),
    "energy ledger": ours(
        booking=True, engines=lambda: [yade.wrapper.EnergyLedger(iterPeriod=1000)]
    ),
    "adaptive time step": ours(
        engines=lambda: [yade.wrapper.HertzTimeStepper(minStep=TIME_STEP, maxStep=TIME_STEP)]
    ),
}


def libraries() -> list[str]:
    """Our own libraries that this process has loaded, and deal.II."""
    with open("/proc/self/maps", encoding="utf-8") as maps:
        files = {Path(line.split()[-1]) for line in maps if ".so" in line}
    return sorted(
        f.name for f in files if f.parent.name in ("grainfall", "femlink") or "deal.II" in f.name
    )


def build(case: Callable[[], None]) -> dict[str, Any]:
    """A fresh scene of this case; bytes that its bodies and contacts took, contacts, share that slides."""
    O.reset()
    before = plain_law.heap_bytes()
    case()
    real = [i for i in O.interactions if i.isReal]
    return {
        "heap": plain_law.heap_bytes() - before,
        "contacts": len(real),
        "sliding": sum(i.phys.isSliding for i in real) / len(real),
        "libraries": libraries(),
    }


def count(name: str, case: Callable[[], None]) -> dict[str, Any]:
    """Let callgrind count some steps of this case."""
    facts = build(case)
    plain_law.start_counting()
    O.run(COUNTED, True)
    plain_law.stop_counting(name)
    return facts


def time_steps(cases: dict[str, Callable[[], None]]) -> dict[str, list[float]]:
    """Processor time [s] a step of each case, in turns, shape (rounds,) each."""
    seconds: dict[str, list[float]] = {name: [] for name in cases}
    for _ in range(ROUNDS):
        for name, case in cases.items():
            O.reset()
            case()
            start = time.process_time()
            O.run(TIMED, True)
            seconds[name].append((time.process_time() - start) / TIMED)
    return seconds


def main(output: str, mode: str) -> None:
    plain_law.register_classes()
    build(PLAIN["plain build"])  # whatever YADE allocates once
    result: dict[str, Any] = {"steps": COUNTED, "cases": {}}
    measure = count if mode == "count" else lambda name, case: build(case)
    for name, case in PLAIN.items():
        result["cases"][name] = measure(name, case)
    import grainfall  # noqa: F401

    # The same build once more, now that our classes are known to YADE.
    name = "plain build beside grainfall"
    result["cases"][name] = measure(name, PLAIN["plain build"])
    for name, case in OURS.items():
        result["cases"][name] = measure(name, case)
    if mode == "time":
        for name, seconds in time_steps({**PLAIN, **OURS}).items():
            result["cases"][name]["step_seconds"] = seconds
    Path(output).write_text(json.dumps(result))


main(*sys.argv[2:4])
