# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures of the contact law for docs/physics.md, all measured on spheres in YADE.

usage: PYTHONPATH=build/python yade -j1 -n -x benchmarks/law_plots.py [folder, default docs/images]
"""
from __future__ import annotations

import math
import sys
from collections.abc import Callable
from pathlib import Path

import grainfall  # noqa: F401
import numpy as np
from grainfall.materials import cole_friction
from matplotlib.figure import Figure
from yade import AsperityFriction, ConstantFriction, O

ROOT = Path(sys.argv[0]).resolve().parents[1]  # __file__ is YADE's own script here
sys.path.insert(0, str(ROOT / "tests" / "physics"))
import chung_ooi_oblique as co  # noqa: E402
import contact_scenes as cs  # noqa: E402

BLUE, ORANGE, GREEN, GREY = "#2166ac", "#d6604d", "#1b7837", "#777777"
QUARTZ = cs.Solid(76e9, 0.31, 2650)
RADIUS = 0.36e-3  # m
FRICTION = 0.5


def pair(law: tuple[list, list], steps: int, move: Callable[[int, int], tuple], **material) -> dict:
    """Two quartz grains, the lower held, the upper moved at velocity move(step, id) [m/s]; what acted.

    Arrays over the steps: overlap [m], slide [m], normal and shear force on the upper grain [N].
    """
    O.reset()
    O.materials.append(QUARTZ.material(**{"frictionAngle": math.atan(FRICTION), **material}))
    cs.add_sphere((0, 0, 0), RADIUS, 0, fixed=True)
    upper = cs.add_sphere((0, 0, 2 * RADIUS), RADIUS, 0, fixed=True)
    rows: dict[str, list[float]] = {name: [] for name in ("overlap", "slide", "normal", "shear")}

    def record() -> None:
        position, force = O.bodies[upper].state.pos, cs.force_on(upper)
        rows["overlap"].append(2 * RADIUS - position[2])
        rows["slide"].append(position[0])
        rows["normal"].append(force[2])
        rows["shear"].append(-force[0])
        O.bodies[upper].state.vel = move(O.iter, upper)

    cs.set_engines(law, record)
    O.dt = 1e-8
    O.run(steps, True)
    return {name: np.array(values) for name, values in rows.items()}


def plot_normal(figure: Figure) -> None:
    """Normal force of the two laws; impacts at several restitutions."""
    left, right = figure.subplots(1, 2)
    for law, colour, factor in (("hertz", BLUE, 1.0), ("report", ORANGE, 0.5)):
        seen = pair(cs.grain_law(normalLaw=law), 1000, lambda step, body: (0, 0, -0.1))
        micron, force = 1e6 * seen["overlap"], seen["normal"]
        left.plot(micron, force, color=colour, label=f"normalLaw='{law}'")
        stiffness = factor * 4 / 3 * QUARTZ.plane_modulus / 2 * math.sqrt(RADIUS / 2)
        left.plot(micron[::100], stiffness * seen["overlap"][::100] ** 1.5, "o", color=colour, ms=4)
    left.plot([], [], "o", color=GREY, ms=4, label="Hertz; Eq 3")
    left.set(xlabel="overlap, µm", ylabel="normal force, N", title="Two 0.72 mm quartz grains")
    left.legend(frameon=False)
    for restitution, colour in ((1.0, GREY), (0.9, GREEN), (0.6, BLUE), (0.3, ORANGE)):
        overlap, force, measured = impact(restitution)
        label = f"stated {restitution:g}, measured {measured:.4f}"
        right.plot(1e6 * overlap, force, color=colour, label=label)
    right.set(xlabel="overlap, µm", title="Impact at 0.1 m/s on a rigid plane: restitution")
    right.legend(frameon=False)


def impact(restitution: float) -> tuple[np.ndarray, np.ndarray, float]:
    """Overlap [m], force [N] and restitution of a grain on a rigid plane."""
    O.reset()
    contact = dict(frictionAngle=0.0, restitution=restitution)
    O.materials.append([QUARTZ.rigid_material(**contact), QUARTZ.material(**contact)])
    cs.add_plane(0)
    body = cs.add_sphere((0, 0, RADIUS), RADIUS, 1, velocity=(0, 0, -0.1))
    rows: list[tuple[float, float]] = []
    cs.set_engines(
        cs.grain_law(),
        lambda: rows.append((RADIUS - O.bodies[body].state.pos[2], cs.force_on(body)[2])),
    )
    duration = cs.HertzImpact.on_rigid_plane(QUARTZ, RADIUS, 0.1).duration
    O.dt = duration / 2000
    cs.run_for(1.5 * duration)
    overlap, force = np.array(rows).T
    touching = overlap > 0
    return overlap[touching], force[touching], O.bodies[body].state.vel[2] / 0.1


def plot_tangential(figure: Figure) -> None:
    """Shear spring under a changing normal force; Chung & Ooi's test 5."""
    left, right = figure.subplots(1, 2)
    laws = (("incremental", BLUE), ("secant", GREEN), ("report", ORANGE))
    for law, colour in laws:
        seen = pair(
            cs.grain_law(tangentialLaw=law), 4000, press_shear_release, frictionAngle=math.atan(10)
        )
        shown = slice(1000, None)
        slide, shear = 1e9 * seen["slide"][shown], 1e3 * seen["shear"][shown]
        style = "--" if law == "secant" else "-"  # on unloading the same as 'incremental'
        left.plot(slide, shear, style, color=colour, label=f"'{law}'")
    left.set(xlabel="tangential displacement, nm", ylabel="shear force, mN")
    left.set_title("Sheared, half unloaded, sheared back")
    left.legend(frameon=False)
    steel = cs.Solid(2.08e11, 0.30, 7850)
    test = co.Oblique(1e-5, 5.0, 0.3, 1.0, spinning=False)
    before = np.linspace(0.05, 8, 40)
    for law, colour in laws:
        result = co.on_rigid_plane(test, steel, 1.5 * before, law)
        right.plot(before, result.slip / (0.3 * result.normal), color=colour, label=f"'{law}'")
    half = co.on_rigid_plane(test, steel, 1.5 * before, "report", 0.5 * 2 ** (1 / 3))
    right.plot(
        before, half.slip / (0.3 * half.normal), ":", color=GREY, label="Eq 4, half of $k_t$"
    )
    for name, mark, label in (
        ("finite_elements", "ks", "finite elements"),
        ("steel", "wo", "published DEM"),
    ):
        x, y = cs.read_csv(f"chung_ooi_2011/test5_slip_{name}.csv").T
        right.plot(x[x < 8], y[x < 8], mark, mec="k", ms=4, label=label)
    right.set(xlabel="slip before, $v_{st}/(\\mu v_n)$", ylabel="slip after, the same")
    right.set_title("Chung & Ooi, test 5, steel")
    right.legend(frameon=False, fontsize=8)


def press_shear_release(step: int, body: int) -> tuple[float, float, float]:
    """Press 100 nm, shear 100 nm, let go by 50 nm, shear back."""
    speed = 1e-7 / (1000 * O.dt)
    if step < 1000:
        return (0, 0, -speed)
    if step < 2000:
        return (speed, 0, 0)
    if step < 3000:
        return (0, 0, speed / 2)
    return (-speed, 0, 0)


def plot_friction(figure: Figure) -> None:
    """Friction curves, and what enlarged grains make of one."""
    left, right = figure.subplots(1, 2, sharey=True)
    load = np.geomspace(1e-3, 1e2, 200)
    fitted = (0.8 - 0.2) / (1 - 20 ** (-1 / 3))
    curves = (
        ("power law (default of 'cole')", cole_friction(), BLUE),
        ("exponential", cole_friction("exponential"), GREEN),
        ("asperity", AsperityFriction(alpha=0.8 - fitted, c=fitted, muMax=0.8, muMin=0.2), ORANGE),
        ("constant", ConstantFriction(mu=0.5), GREY),
    )
    for label, curve, colour in curves:
        left.semilogx(load, [curve.coefficient(n) for n in load], color=colour, label=label)
    left.plot([1, 20], [0.8, 0.2], "ko", label="Cole 2015, as quoted in MR-2629")
    left.set(xlabel="normal force, N", ylabel="friction coefficient", ylim=(0, 1.0))
    left.legend(frameon=False, fontsize=8)
    for coarsening, colour in ((1, BLUE), (2, GREEN), (4, ORANGE)):
        mu = [sliding_friction(n, coarsening) for n in load[::8]]
        right.semilogx(load[::8], mu, "o-", ms=3, color=colour, label=f"k = {coarsening}")
    right.set(
        xlabel="normal force on the coarse grain, N", title="Grains k times as large: read at N/k²"
    )
    left.set_title("Curves")
    right.legend(frameon=False)


def sliding_friction(load: float, coarsening: float) -> float:
    """Shear over normal force of a contact that slides under `load` [N], grains made `coarsening` larger."""
    O.reset()
    O.materials.append(
        QUARTZ.material(friction=cole_friction(), referenceRadius=RADIUS / coarsening)
    )
    stiffness = 4 / 3 * QUARTZ.plane_modulus / 2 * math.sqrt(RADIUS / 2)
    overlap = (load / stiffness) ** (2 / 3)
    cs.add_sphere((0, 0, 0), RADIUS, 0, fixed=True)
    upper = cs.add_sphere((0, 0, 2 * RADIUS - overlap), RADIUS, 0, fixed=True)
    cs.set_engines(cs.grain_law())
    O.dt = 1e-8
    O.run(1, True)
    O.bodies[upper].state.vel = (5 * overlap / (50 * O.dt), 0, 0)
    O.run(50, True)
    physics = O.interactions[0, upper].phys
    return physics.shearForce.norm() / physics.normalForce.norm()


def main(folder: Path) -> None:
    """Write the pictures."""
    for name, draw in (
        ("law_normal", plot_normal),
        ("law_tangential", plot_tangential),
        ("law_friction", plot_friction),
    ):
        figure = Figure(figsize=(9.5, 3.8), layout="constrained")
        draw(figure)
        for axes in figure.axes:
            axes.spines[["top", "right"]].set_visible(False)
        figure.savefig(folder / f"{name}.png", dpi=90)


main(Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "docs" / "images")
