# SPDX-License-Identifier: GPL-2.0-or-later
"""Beds of Table 1's grains for the benchmark: made once, kept in a cache, the same for every contender.

Random packing (`grainfall.packings`), settled by the bare loop under a background drag, sorted along
x, y, z in columns so that no contender suffers from a random order. A bed is a file of float64, 11 a
body: position [m], velocity [m/s], spin [rad/s], radius [m], mass [kg].
"""
from __future__ import annotations

import json
import math
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree

RADIUS, MASS = 2.5e-3, 1.0e-3  # m, kg: Table 1 of MR-2629
YOUNG, POISSON, FRICTION, RESTITUTION = 2.8e9, 0.4, 0.5, 0.5  # G = 1e9 Pa
PROJECTILE_RADIUS, PROJECTILE_MASS, IMPACT_SPEED = 0.0285, 10.0, 2.0  # m, kg, m/s
TIME_STEP = 1e-5  # s
GRAVITY = 9.81  # m/s2
SKIN = 2.5e-4  # m: pairs nearer than this are listed, anew when a grain has moved half of it
SOLID_FRACTION = 0.6
SEED = 1
# Drag [1/s] and steps of settling: first against the overlaps of the packing, then falling together, then rest.
SETTLING = ((2000.0, 800), (40.0, 4000), (400.0, 1500))
PENETRATION_STEPS = 1500  # 15 ms: the sphere is then a crater's depth in the bed
#: Beds larger than this are four of a quarter of their grains, mirrored side by side: settled sooner.
LARGEST_SETTLED = 130_000


@dataclass(frozen=True)
class Bed:
    """A bed in a file.

    Parameters
    ----------
    path : Path
        The file.
    side : float
        Inside of the square box [m]; the floor is z = 0, the axis of the box the z axis.
    grains : int
        Number of grains; a projectile, if there is one, is the last body.
    """

    path: Path
    side: float
    grains: int

    def bodies(self) -> np.ndarray:
        """All bodies, shape (n, 11), n = grains or one more."""
        return np.fromfile(self.path).reshape(-1, 11)


def box_side(grains: int) -> float:
    """Side of the box [m]: that of the preset table1 (0.17 m for 50 000), scaled to the same shape."""
    return 0.17 * (grains / 50_000) ** (1 / 3)


def settled_bed(grains: int, cache: Path, bare_loop: Path) -> Bed:
    """A bed at rest, from the cache or made now."""
    large = grains > LARGEST_SETTLED
    side = 2 * box_side(grains // 4) if large else box_side(grains)
    bed = Bed(cache / f"settled_{grains}_seed{SEED}.f64", side, grains)
    if bed.path.exists():
        return bed
    cache.mkdir(parents=True, exist_ok=True)
    print(f"making a bed of {grains} grains", flush=True)
    work = bed.path.with_suffix(".part")
    if large:
        _mirrored(settled_bed(grains // 4, cache, bare_loop)).tofile(work)
        stages = SETTLING[-1:]
    else:
        _random_bed(grains, side).tofile(work)
        stages = SETTLING
    for drag, steps in stages:
        run_bare_loop(bare_loop, work, work, side, steps, drag=drag)
    rows = _sorted(np.fromfile(work).reshape(-1, 11))
    rows[:, 3:9] = 0
    rows.tofile(work)
    work.rename(bed.path)
    return bed


def struck_bed(grains: int, cache: Path, bare_loop: Path) -> Bed:
    """The same bed 15 ms after a sphere of 10 kg and 57 mm met it at 2 m/s, everything moving."""
    still = settled_bed(grains, cache, bare_loop)
    bed = Bed(cache / f"struck_{grains}_seed{SEED}.f64", still.side, grains)
    if bed.path.exists():
        return bed
    rows = with_sphere(still.bodies())
    work = bed.path.with_suffix(".part")
    rows.tofile(work)
    run_bare_loop(bare_loop, work, work, bed.side, PENETRATION_STEPS)
    work.rename(bed.path)
    return bed


def with_sphere(grains: np.ndarray) -> np.ndarray:
    """The grains and a sphere on them that has just touched, moving down, shape (n + 1, 11)."""
    reach = PROJECTILE_RADIUS + RADIUS
    near = grains[np.hypot(grains[:, 0], grains[:, 1]) < reach]
    touching_at = near[:, 2] + np.sqrt(reach**2 - near[:, 0] ** 2 - near[:, 1] ** 2)
    sphere = np.zeros((1, 11))
    sphere[0, [2, 5]] = touching_at.max(), -IMPACT_SPEED
    sphere[0, 9:] = PROJECTILE_RADIUS, PROJECTILE_MASS
    return np.vstack((grains, sphere))


def mean_overlap(grains: np.ndarray) -> float:
    """Mean overlap of the grains that touch, rows of shape (n, 11) [m]."""
    pairs = cKDTree(grains[:, :3]).query_pairs(2 * RADIUS, output_type="ndarray")
    apart = np.linalg.norm(grains[pairs[:, 0], :3] - grains[pairs[:, 1], :3], axis=1)
    return float(np.mean(2 * RADIUS - apart))


def run_bare_loop(
    program: Path, bed_in: Path, bed_out: Path, side: float, steps: int, **options: float
) -> dict[str, float]:
    """Step a bed with the bare loop; what it printed."""
    words = {"side": repr(side), "steps": steps, "time_step": TIME_STEP, "skin": SKIN, **options}
    command = [program, bed_in, bed_out, *(f"{name}={value}" for name, value in words.items())]
    return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


def _random_bed(grains: int, side: float) -> np.ndarray:
    """Grains at random with small overlaps, shape (grains, 11)."""
    # The package itself needs a running YADE; this module of it does not.
    sys.path.append(str(Path(__file__).resolve().parents[2] / "python" / "grainfall"))
    from packings import Box, random_packing

    depth = grains * 4 / 3 * math.pi * RADIUS**3 / (SOLID_FRACTION * side**2)
    radii = np.full(grains, RADIUS)
    # The looser layer at walls and floor makes room for 1.02 depths.
    box = Box(side, side, 1.02 * depth)
    rows = np.zeros((grains, 11))
    rows[:, :3] = random_packing(box, radii, np.random.default_rng(SEED), tolerance=0.02)
    rows[:, 9:] = RADIUS, MASS
    return rows


def _mirrored(tile: Bed) -> np.ndarray:
    """Four mirror images side by side: grains that touched a wall touch each other, at rest as they were."""
    quarter = tile.bodies()
    images = []
    for x_sign in (1, -1):
        for y_sign in (1, -1):
            image = quarter.copy()
            image[:, 0] = x_sign * (image[:, 0] - tile.side / 2)
            image[:, 1] = y_sign * (image[:, 1] - tile.side / 2)
            images.append(image)
    return np.vstack(images)


def _sorted(rows: np.ndarray) -> np.ndarray:
    """Rows in blocks of four diameters, so that neighbours in space are neighbours in memory."""
    block = np.floor(rows[:, :3] / (8 * RADIUS)).astype(int)
    return rows[np.lexsort((rows[:, 0], block[:, 0], block[:, 1], block[:, 2]))]
