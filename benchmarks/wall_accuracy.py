# SPDX-License-Identifier: GPL-2.0-or-later
"""What accuracy of the deformable wall costs in time: degree, mesh, solver and interval, docs/physics/far_field.md.

usage: PYTHONPATH=build/python:benchmarks yade -j1 -n -x benchmarks/wall_accuracy.py

Degree, mesh and solver, with twice as many cells in the contact radius all cells half as large, also where they grow:
Hertz's pressure over a circle on a block, and the strain energy that it stores beside that in a half-space, 2/5 of
force times indentation; and a rigid sphere that touches node by node, its force beside Hertz's at contact radii from
0.6 to 1 of the circle's, root of the mean square, since single ones scatter as rows of nodes come into contact. The
block's fixed boundary, at 25 and at 50 contact radii, takes off a part that falls with one over its distance, so twice
the second result less the first is that of a half-space. Time: mesh, assembly, factor and condensation of the larger
block, processor seconds of one thread. Interval: from
benchmarks/results/wall_scene.json, which `make bench-wall` writes before.
"""
from __future__ import annotations

import json
import sys
import time
from pathlib import Path
from typing import Any

import grainfall  # noqa: F401  the package lives inside YADE
import matplotlib
import numpy as np
from grainfall import femlink
from speed.report import fill

ROOT = Path(sys.argv[0]).resolve().parents[1]
sys.path.append(str(ROOT / "tests" / "femlink"))
from femlink_walls import node_contacts  # noqa: E402

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

YOUNG, POISSON = 20e6, 0.3  # Pa, 1: sand
CONTACT_RADIUS = 0.01  # m
#: Of the cells towards the boundary, where one of them is as large as the contact radius.
GROWTH = 1.96
SPHERE = 0.1  # m
#: Degree, cells in the contact radius, solver.
CASES = (
    (1, 1, "direct"),
    (1, 2, "direct"),
    (1, 3, "direct"),
    (1, 4, "direct"),
    (2, 1, "direct"),
    (2, 2, "direct"),
    (1, 1, "iterative"),
)


def shape_values(degree: int, x: np.ndarray) -> np.ndarray:
    """Shape functions along one axis at x in [-1, 1], shape (len(x), degree + 1)."""
    if degree == 1:
        return np.stack([0.5 * (1 - x), 0.5 * (1 + x)], axis=1)
    return np.stack([0.5 * x * (x - 1), 1 - x**2, 0.5 * x * (x + 1)], axis=1)


def hertz_load(surface: femlink.Surface, degree: int) -> np.ndarray:
    """Forces on the loose nodes, (3 k,), under Hertz's pressure of unit peak over the circle, N."""
    points = 48  # of the midpoint rule along a side of a face
    x = (2 * np.arange(points) + 1) / points - 1
    values = shape_values(degree, x)
    forces = np.zeros(3 * (max(surface.loose) + 1))
    nodes = np.asarray(surface.nodes)
    for face in np.asarray(surface.faces):
        corners = nodes[face][:, :2]
        low, size = corners.min(axis=0), np.ptp(corners, axis=0)
        first, second = (low[i] + 0.5 * size[i] * (1 + x) for i in (0, 1))
        squared = (first[None, :] ** 2 + second[:, None] ** 2) / CONTACT_RADIUS**2
        pressure = np.sqrt(np.clip(1 - squared, 0, None)) * size.prod() / points**2
        # Nodes of a face: the first coordinate runs first.
        parts = np.einsum("ji,jb,ia->ba", pressure, values, values).ravel()
        for node, part in zip(face, parts):
            if surface.loose[node] >= 0:
                forces[3 * surface.loose[node] + 2] -= part
    return forces


def stored_energy(degree: int, cells: int, solver: str, radii: int) -> dict[str, Any]:
    """Strain energy over the half-space's, and what it took."""
    start = time.thread_time()
    mesh = femlink.half_space_block(
        1.25 * CONTACT_RADIUS,
        radii * CONTACT_RADIUS,
        CONTACT_RADIUS / cells,
        GROWTH ** (1 / cells),
    )
    continuum = femlink.Continuum(mesh, {0: (YOUNG, POISSON, 1600.0)}, degree=degree, solver=solver)
    model = continuum.condense()
    seconds = time.thread_time() - start
    load = hertz_load(model.surface, degree)
    energy = 0.5 * load @ model.compliance @ load
    # Unit peak pressure: force 2/3 pi a^2, indentation pi a (1 - nu^2)/(2 E) (Johnson 1985, sec. 3.4 and 4.2).
    force = 2 / 3 * np.pi * CONTACT_RADIUS**2
    indentation = 0.5 * np.pi * CONTACT_RADIUS * (1 - POISSON**2) / YOUNG
    return {
        "unknowns": continuum.unknowns,
        "surface_unknowns": len(load),
        "set_up_s": seconds,
        "memory_mb": sum(continuum.memory.values()) / 1e6,
        "force_error": -load.sum() / force - 1,
        "energy_over_half_space": energy / (0.4 * force * indentation),
        "force_over_hertz": sphere_forces(model),
    }


def sphere_forces(model: femlink.WallModel) -> np.ndarray:
    """Force of a rigid sphere over Hertz's, (21,), touching node by node, at contact radii of 0.6 to 1."""
    nodes = np.asarray(model.surface.nodes)
    distance = np.hypot(nodes[:, 0], nodes[:, 1])
    loose = np.asarray(model.surface.loose) >= 0
    near = np.flatnonzero(loose & (distance < 1.2 * CONTACT_RADIUS))
    faces, references = node_contacts(model.surface, near)
    stiff = 1e4 / np.diag(model.compliance)[2::3].max()
    wall, ratios = femlink.Wall(model), []
    for radius in np.linspace(0.6, 1.0, 21) * CONTACT_RADIUS:
        indentation = radius**2 / SPHERE
        found = wall.solve(
            faces,
            references,
            patch=0,
            free_overlap=list(indentation - distance[near] ** 2 / (2 * SPHERE)),
            relation="linear",
            coefficient=[stiff] * len(near),
            tolerance=1e-8,
        )
        if not found["converged"]:
            raise RuntimeError(f"sphere at a contact radius of {radius} m: not converged")
        hertz = 4 / 3 * YOUNG / (1 - POISSON**2) * SPHERE**0.5 * indentation**1.5
        ratios.append(found["force"][:, 0].sum() / hertz)
    return np.array(ratios)


def main() -> None:
    """Measure, write JSON, table and figure."""
    femlink.Continuum(
        femlink.box((1, 1, 1), (2, 2, 2)), {0: (YOUNG, POISSON, 0.0)}
    )  # loads deal.II
    rows = []
    for degree, cells, solver in CASES:
        near, far = (stored_energy(degree, cells, solver, radii) for radii in (25, 50))
        error = 2 * far["energy_over_half_space"] - near["energy_over_half_space"] - 1
        forces = 2 * far.pop("force_over_hertz") - near["force_over_hertz"] - 1
        row = {"degree": degree, "cells": cells, "solver": solver, **far, "error": error}
        row["sphere_rms"] = float(np.sqrt(np.mean(forces**2)))
        row["sphere_mean"] = float(np.mean(forces))
        rows.append(row)
        print(row, flush=True)
    (ROOT / "benchmarks/results/wall_accuracy.json").write_text(json.dumps(rows, indent=1) + "\n")
    seldom = json.loads((ROOT / "benchmarks/results/wall_scene.json").read_text())["interval"]
    draw(rows, seldom)
    fill(ROOT / "docs/physics/far_field.md", "wall_accuracy", table(rows))


def table(rows: list[dict[str, Any]]) -> str:
    """Markdown."""
    lines = [
        "| degree | cells in the contact radius | solver | unknowns | on the surface | energy over the half-space's, "
        "less 1 | rigid sphere's force off Hertz's, rms (mean) | set-up, s | memory, MB |",
        "|---|---|---|---|---|---|---|---|---|",
    ]
    for row in rows:
        lines.append(
            f"| {row['degree']} | {row['cells']} | {row['solver']} | {row['unknowns']} | {row['surface_unknowns']} | "
            f"{100 * row['error']:+.2f} % | {100 * row['sphere_rms']:.1f} % ({100 * row['sphere_mean']:+.1f} %) | "
            f"{row['set_up_s']:.2g} | {row['memory_mb']:.0f} |"
        )
    return "\n".join(lines)


def draw(rows: list[dict[str, Any]], seldom: list[dict[str, Any]]) -> None:
    """Error against time: of the continuum, of the interval."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.2, 3.8), constrained_layout=True)
    marks = {(1, "direct"): "o-", (2, "direct"): "s-", (1, "iterative"): "^"}
    for (degree, solver), mark in marks.items():
        found = [r for r in rows if (r["degree"], r["solver"]) == (degree, solver)]
        seconds = [r["set_up_s"] for r in found]
        errors = [100 * abs(r["error"]) for r in found]
        left.loglog(seconds, errors, mark, label=f"degree {degree}, {solver}")
        for row, x, y in zip(found, seconds, errors):
            left.annotate(
                f"{row['cells']}", (x, y), xytext=(5, 4), textcoords="offset points", fontsize=8
            )
    left.set(
        xlabel="set-up, s",
        ylabel="error of the energy, %",
        title="Hertz's pressure, by cells in the contact radius",
    )
    left.legend(fontsize=8)
    seconds = [1e3 * r["seconds"] / r["steps"] for r in seldom]
    right.semilogy(seconds, [100 * r["residual"] for r in seldom], "o-", label="energy residual")
    right.semilogy(
        seconds[1:],
        [100 * r["mean_height_off"] for r in seldom[1:]],
        "s--",
        label="mean height, off that of 1",
    )
    for row, x in zip(seldom, seconds):
        right.annotate(
            f"{row['interval']}",
            (x, 100 * row["residual"]),
            xytext=(5, 4),
            textcoords="offset points",
            fontsize=8,
        )
    right.set(xlabel="a step, ms", ylabel="%", title="200 grains thrown on soil, by interval")
    right.legend(fontsize=8, loc="lower left")
    for axes in (left, right):
        axes.grid(True, which="both", alpha=0.25)
    figure.savefig(ROOT / "docs/images/wall_accuracy.png", dpi=110)


if __name__ == "__main__":
    main()
