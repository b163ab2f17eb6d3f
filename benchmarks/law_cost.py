# SPDX-License-Identifier: GPL-2.0-or-later
"""What a step costs with Grainfall's contact law and with YADE's own, in the same settled packing.

usage: PYTHONPATH=build/python yade -n -x [-j2] benchmarks/law_cost.py [--grains-per-side 15]
[--rounds 15]
                                    [--steps 60] [--output benchmarks/results/law_cost.json]

One packing is settled once. In each round every law in turn gets that packing back (positions, no
velocities, no contacts), makes its contacts, and is timed. Ratios to the stock law, and of partial
slip to the incremental law, are formed within a round; the median over the rounds is given, with
the quartiles. The step is measured in processor time, which other programs on the machine disturb
least; the interaction loop by YADE's own timers.
"""
from __future__ import annotations

import argparse
import json
import math
import sys
import time
from collections.abc import Callable
from pathlib import Path

import grainfall  # noqa: F401
import numpy as np
from yade import (
    Bo1_Sphere_Aabb,
    Bo1_Wall_Aabb,
    ExponentialFriction,
    ForceResetter,
    GrainMat,
    Ig2_Sphere_Sphere_ScGeom,
    Ig2_Wall_Sphere_ScGeom,
    InsertionSortCollider,
    InteractionLoop,
    Ip2_FrictMat_FrictMat_MindlinPhys,
    Ip2_GrainMat_GrainMat_GrainPhys,
    Law2_ScGeom_GrainPhys_HertzMindlin,
    Law2_ScGeom_MindlinPhys_Mindlin,
    MoistureFactor,
    NewtonIntegrator,
    O,
    PowerLawFriction,
    utils,
)

RADIUS = 0.0025  # m
YOUNG = 1e7  # Pa; soft, so that settling is quick: the law's arithmetic does not depend on it
TIME_STEP = 3e-5  # s
FRICTION = 0.5
RESTITUTION = 0.5
WARM_UP_STEPS = 20

Functors = tuple[list, list]


def stock(**ip2) -> Functors:
    return [Ip2_FrictMat_FrictMat_MindlinPhys(**ip2)], [Law2_ScGeom_MindlinPhys_Mindlin()]


def ours(**law) -> Functors:
    return [Ip2_GrainMat_GrainMat_GrainPhys()], [Law2_ScGeom_GrainPhys_HertzMindlin(**law)]


def partial_slip() -> Functors:
    return ours(tangentialLaw="mindlin-deresiewicz")


# Name, functors, attributes of the material, name of the law that it is compared with.
LAWS: list[tuple[str, Callable[[], Functors], dict, str]] = [
    ("stock, elastic", stock, {}, "stock, elastic"),
    ("ours, elastic", ours, {}, "stock, elastic"),
    (
        "stock, damped",
        lambda: stock(en=RESTITUTION, es=RESTITUTION),
        {},
        "stock, damped",
    ),
    ("ours, damped", ours, {"restitution": RESTITUTION}, "stock, damped"),
    ("ours, elastic, partial slip", partial_slip, {}, "ours, elastic"),
    (
        "ours, damped, partial slip",
        partial_slip,
        {"restitution": RESTITUTION},
        "ours, damped",
    ),
    (
        "ours, damped, power law of the load",
        ours,
        {"restitution": RESTITUTION, "friction": lambda: PowerLawFriction()},
        "stock, damped",
    ),
    (
        "ours, damped, exponential, moist",
        ours,
        {
            "restitution": RESTITUTION,
            "gravimetricMoisture": 0.023,
            "friction": lambda: ExponentialFriction(
                mu0=0.8,
                muInf=0.2,
                loadScale=5.0,
                moistureFactor=MoistureFactor([0.0, 0.1], [1.0, 0.8]),
            ),
        },
        "stock, damped",
    ),
]


def set_material(attributes: dict) -> None:
    """Give the one material of the scene the values of this law, and the defaults for the rest."""
    values = {"restitution": 1.0, "gravimetricMoisture": 0.0, "friction": None, **attributes}
    for name, value in values.items():
        setattr(O.materials[0], name, value() if callable(value) else value)


def set_functors(functors: Functors) -> None:
    ip2, law = functors
    O.engines = [
        ForceResetter(),
        InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()], verletDist=0.1 * RADIUS),
        InteractionLoop(
            [Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom(hertzian=True)], ip2, law
        ),
        NewtonIntegrator(damping=0.3, gravity=(0, 0, -9.81)),
    ]


def settle(grains_per_side: int, steps: int) -> tuple[np.ndarray, float]:
    """Let a loose, disordered cubic array fall into its box.

    Returns positions, shape (n, 3) [m], and YADE's unbalanced force [-], small when all is at rest.
    """
    O.reset()
    angle = math.atan(FRICTION)
    O.materials.append(GrainMat(young=YOUNG, poisson=0.25, density=2650, frictionAngle=angle))
    random = np.random.default_rng(1)
    pitch = 2.1 * RADIUS
    lattice = np.stack(np.meshgrid(*3 * [np.arange(grains_per_side)], indexing="ij"), axis=-1)
    centres = (
        pitch * lattice.reshape(-1, 3)
        + random.uniform(-0.05, 0.05, (lattice.size // 3, 3)) * RADIUS
    )
    for centre in centres:
        O.bodies.append(utils.sphere(tuple(centre), RADIUS))
    low, high = -1.1 * RADIUS, pitch * (grains_per_side - 1) + 1.1 * RADIUS
    for axis in (0, 1):
        for position in (low, high):
            O.bodies.append(utils.wall(position, axis=axis, sense=0))
    O.bodies.append(utils.wall(low, axis=2, sense=0))
    set_material({"restitution": 0.2})
    set_functors(ours())
    O.dt = TIME_STEP
    O.run(steps, True)
    return np.array([b.state.pos for b in O.bodies]), utils.unbalancedForce()


def restore(positions: np.ndarray) -> None:
    """The settled packing at rest, without contacts."""
    O.interactions.clear()
    for body, position in zip(O.bodies, positions):
        body.state.pos = tuple(position)
        body.state.vel = body.state.angVel = (0, 0, 0)


def time_a_law(
    make: Callable[[], Functors], material: dict, positions: np.ndarray, steps: int
) -> dict:
    """Microseconds a step, of processor time and of the interaction loop's clock; contacts met."""
    set_material(material)
    set_functors(make())
    restore(positions)
    O.run(WARM_UP_STEPS, True)
    loop = next(e for e in O.engines if isinstance(e, InteractionLoop))
    loop.execTime = 0
    O.timingEnabled = True
    start = time.process_time()
    O.run(steps, True)
    processor = time.process_time() - start
    O.timingEnabled = False
    return {
        "step_us": processor / steps * 1e6,
        "interaction_loop_us": loop.execTime / steps / 1e3,
        "contacts": O.interactions.countReal(),
    }


def summarise(samples: dict[str, list[dict]]) -> dict[str, dict]:
    """Medians over the rounds, and medians and quartiles of the ratios formed within each round."""
    result = {}
    for name, _, _, reference in LAWS:
        entry: dict = {"compared_with": reference}
        for quantity in ("interaction_loop_us", "step_us"):
            own = np.array([s[quantity] for s in samples[name]])
            other = np.array([s[quantity] for s in samples[reference]])
            low, middle, high = np.percentile(own / other, (25, 50, 75))
            label = quantity.removesuffix("_us")
            entry[quantity] = round(float(np.median(own)), 1)
            entry[f"{label}_ratio"] = round(float(middle), 4)
            entry[f"{label}_ratio_quartiles"] = [round(float(low), 4), round(float(high), 4)]
        entry["contacts"] = samples[name][-1]["contacts"]
        entry["ns_per_contact"] = round(1e3 * entry["interaction_loop_us"] / entry["contacts"], 1)
        result[name] = entry
    return result


def print_table(laws: dict[str, dict]) -> None:
    columns = "{:<38}{:>12}{:>12}{:>12}{:>12}"
    print(columns.format("law", "step [us]", "loop [us]", "step ratio", "loop ratio"))
    for name, entry in laws.items():
        numbers = [entry[k] for k in ("step_us", "interaction_loop_us")]
        ratios = [f"{entry[k]:.3f}" for k in ("step_ratio", "interaction_loop_ratio")]
        print(columns.format(name, *numbers, *ratios))


def main(arguments: list[str]) -> None:
    parser = argparse.ArgumentParser(prog="law_cost.py", description=__doc__.splitlines()[0])
    parser.add_argument("--grains-per-side", type=int, default=15, help="cube root of the grains")
    parser.add_argument("--settling-steps", type=int, default=12000, help="steps of 3e-5 s")
    parser.add_argument("--rounds", type=int, default=15, help="rounds, each with every law")
    parser.add_argument("--steps", type=int, default=60, help="timed steps a law and round")
    default = Path(__file__ if __file__.endswith("law_cost.py") else sys.argv[0]).parent / "results"
    parser.add_argument("--output", type=Path, default=default / "law_cost.json")
    options = parser.parse_args(arguments)

    positions, unbalanced = settle(options.grains_per_side, options.settling_steps)
    samples: dict[str, list[dict]] = {name: [] for name, *_ in LAWS}
    for _ in range(options.rounds):
        for name, make, material, _ in LAWS:
            samples[name].append(time_a_law(make, material, positions, options.steps))
    report = {
        "grains": options.grains_per_side**3,
        "unbalanced_force": round(unbalanced, 5),
        "threads": O.numThreads,
        "rounds": options.rounds,
        "steps": options.steps,
        "laws": summarise(samples),
    }
    options.output.parent.mkdir(parents=True, exist_ok=True)
    options.output.write_text(json.dumps(report, indent=2) + "\n", encoding="utf-8")
    print_table(report["laws"])
    print(f"written: {options.output}")


main(sys.argv[1:])
