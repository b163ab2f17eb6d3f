# SPDX-License-Identifier: GPL-2.0-or-later
"""Preparation of a bed of sand: packing, settling, levelling, stiffening.

1. Spheres are placed at random at the wanted solid fraction (`grainfall.packings`), a little too deep.
2. They settle under gravity with grains softened as far as the bed's own weight allows, which makes the
   time step long; friction is the sand's own.
3. Grains above the wanted depth (or beyond the wanted number) are taken off, as a ruler levels sand.
4. The grains are stiffened in stages to the sand's modulus, the bed coming to rest after each. Stiffening
   makes it spring up a little; whenever its kinetic energy has passed a maximum all velocities are set to
   zero (kinetic damping), without which it would bounce for thousands of steps.

At rest means: kinetic energy per grain below 2e-4 of the energy m g d of lifting a grain by its diameter
(6 mm/s for a grain of 1 cm), and unbalanced force (mean resultant over mean contact force) below 0.01.
Stages before the last stop at a multiple of these limits. What was reached is reported, and a drop on a bed
that does not rest warns.
"""
from __future__ import annotations

import dataclasses
import time
from collections.abc import Callable, Mapping
from functools import partial

import numpy as np
import yade.wrapper
from yade import O, Vector3, utils

from grainfall.bed_scene import add_bed, grain_centres, read_contacts
from grainfall.beds import Bed, BedSpec, Progress
from grainfall.constants import GRAVITY
from grainfall.contacts import contact_loop, integrator, rayleigh_step
from grainfall.packings import Box, grain_radii, random_packing, solid_fraction_in

KINETIC_LIMIT = 2e-4
UNBALANCED_LIMIT = 0.01
DAMPING = 0.4
SETTLING_RESTITUTION = 0.8
# Fraction of the Rayleigh step. Dashpots lower the critical step: beds of 1000 grains kept boiling at 0.5 of it
# with restitution 0.6, at 0.35 with 0.3 and at 0.15 with 0.1. Settling therefore uses at least 0.8.
STEP_FRACTION = 0.3
CHECK_INTERVAL = 40
# After so many steps a stage ends whether or not the bed rests; the report says which.
MAX_STEPS = {"settle": 10_000, "stiffen": 8000}


def prepare_bed(spec: BedSpec, progress: Progress) -> Bed:
    """Prepare a bed in YADE; the present scene is discarded.

    Parameters
    ----------
    progress : callable
        Called with the name of the stage and the fraction done.
    """
    started = time.time()
    rng = np.random.default_rng(spec.seed)
    box, radii = _overfilled(spec, rng)
    progress("packing", 0.0)
    centres = random_packing(box, radii, rng)
    bed = Bed(spec, centres, radii)
    moduli = stiffening_stages(spec)
    steps = 0
    for stage, young in enumerate(moduli):
        kind = "stiffen" if stage else "settle"
        last = stage == len(moduli) - 1
        slack = 1 if last else 10 if stage else 2
        steps += _come_to_rest(bed, stage > 0, young, slack, partial(progress, kind))
        if stage == 0:
            _level(bed)
    read_contacts(bed)
    bed.report = {
        **_measure(bed),
        "preparation_steps": steps,
        "preparation_wall_seconds": time.time() - started,
        "kinetic_energy_per_grain_over_m_g_d": kinetic_ratio(bed),
        "unbalanced_force": utils.unbalancedForce(),
    }
    return bed


def _overfilled(spec: BedSpec, rng: np.random.Generator) -> tuple[Box, np.ndarray]:
    """Box to fill, a little deeper than wanted, and the radii that fill it."""
    depth = spec.depth
    if spec.grains:
        mean_volume = np.pi / 6 * spec.diameter**3 * (1 + spec.spread**2)
        depth = spec.grains * mean_volume / (spec.solid_fraction * spec.length * spec.width)
    box = Box(spec.length, spec.width, 1.05 * depth + 2 * spec.diameter)
    return box, grain_radii(box, spec.diameter, spec.spread, spec.solid_fraction, rng)


def stiffening_stages(spec: BedSpec) -> list[float]:
    """Young's moduli [Pa] from the softest that the bed's weight allows up to the sand's, at most twentyfold apart.

    The softest is 3000 times the pressure at the floor: overlaps then stay near 1 % of the radius.
    """
    depth = spec.depth or 0.1
    softest = min(spec.sand.young, 3000 * 0.6 * spec.sand.density * GRAVITY * depth)
    count = int(np.ceil(np.log(spec.sand.young / softest) / np.log(20) - 1e-9)) + 1
    return np.geomspace(softest, spec.sand.young, max(count, 1)).tolist()


def _come_to_rest(
    bed: Bed, stop_at_peaks: bool, young: float, slack: float, progress: Callable[[float], None]
) -> int:
    """Run the bed with this modulus until it rests; the steps it took. Updates the centres."""
    max_steps = MAX_STEPS["stiffen" if stop_at_peaks else "settle"]
    count = len(bed.radii)
    sand = dataclasses.replace(
        bed.spec.sand, young=young, restitution=max(bed.spec.sand.restitution, SETTLING_RESTITUTION)
    )
    O.reset()
    wall_friction = bed.spec.wall_friction
    wall = sand.material(
        "wall", friction=wall_friction, referenceRadius=0.0, gravimetricMoisture=0.0
    )
    add_bed(bed, sand.material("sand"), wall)
    pair = yade.wrapper.GrainPair("sand", "wall", friction=wall_friction)
    O.engines = [
        yade.wrapper.ForceResetter(),
        yade.wrapper.InsertionSortCollider(
            [yade.wrapper.Bo1_Sphere_Aabb(), yade.wrapper.Bo1_Wall_Aabb()],
            verletDist=0.1 * float(bed.radii.min()),
        ),
        contact_loop(sand, [pair], []),
        integrator(gravity=(0, 0, -GRAVITY), damping=DAMPING),
    ]
    O.dt = STEP_FRACTION * rayleigh_step(bed.radii.min(), sand.density, young, sand.poisson)
    previous = 0.0
    while O.iter < max_steps:
        O.run(CHECK_INTERVAL, True)
        kinetic, unbalanced = kinetic_ratio(bed), utils.unbalancedForce()
        progress(O.iter / max_steps)
        if kinetic < slack * KINETIC_LIMIT and unbalanced < slack * UNBALANCED_LIMIT:
            break
        if stop_at_peaks and kinetic < previous:
            _stop_all()
            kinetic = 0.0
        previous = kinetic
    bed.centres = grain_centres(count)
    return O.iter


def _stop_all() -> None:
    still = Vector3(0, 0, 0)
    for body in O.bodies:
        body.state.vel = still
        body.state.angVel = still


def kinetic_ratio(bed: Bed) -> float:
    """Kinetic energy per grain over m g d, the energy that lifts a mean grain by its diameter."""
    grain_mass = bed.spec.sand.density * 4 / 3 * np.pi * float(np.mean(bed.radii**3))
    lift = grain_mass * GRAVITY * 2 * float(bed.radii.mean())
    return utils.kineticEnergy() / len(bed.radii) / lift


def _level(bed: Bed) -> None:
    """Take off the grains centred above the wanted depth, or the topmost beyond the wanted number."""
    height = bed.centres[:, 2]
    if bed.spec.grains:
        keep = np.zeros(len(height), dtype=bool)
        keep[np.argsort(height)[: bed.spec.grains]] = True
    else:
        keep = height <= bed.spec.depth
    bed.centres, bed.radii = bed.centres[keep], bed.radii[keep]


def unrest(report: Mapping[str, float]) -> str:
    """What keeps a prepared bed from being at rest, in words; empty if nothing does."""
    limits = {
        "kinetic_energy_per_grain_over_m_g_d": KINETIC_LIMIT,
        "unbalanced_force": UNBALANCED_LIMIT,
    }
    missed = [
        f"{name} is {report[name]:.2g} (limit {limit:g})"
        for name, limit in limits.items()
        if name in report and not report[name] <= 1.1 * limit
    ]
    return f"the bed is not at rest: {', '.join(missed)}" if missed else ""


def _measure(bed: Bed) -> dict[str, float]:
    """Surface, solid fraction and coordination of the finished bed."""
    count = len(bed.radii)
    between_grains = np.all(bed.contacts < count, axis=1)
    touching = np.bincount(bed.contacts[bed.contacts < count].ravel(), minlength=count)
    margin = 2 * bed.spec.diameter
    surface = surface_height(bed)
    half = np.array([bed.spec.length / 2, bed.spec.width / 2])
    fraction = solid_fraction_in(
        np.array([*(margin - half), margin]),
        np.array([*(half - margin), surface - margin]),
        bed.centres,
        bed.radii,
    )
    volume = 4 / 3 * np.pi * float((bed.radii**3).sum())
    return {
        "surface_height_m": surface,
        "solid_fraction_core": fraction,
        "solid_fraction_box": volume / (bed.spec.length * bed.spec.width * surface),
        "coordination_number": 2 * float(between_grains.sum()) / count,
        "rattler_fraction": float(np.mean(touching < 2)),
    }


def surface_height(bed: Bed) -> float:
    """Height of the sand's surface: mean top of the highest grain in each cell of 1.5 diameters [m]."""
    cell = 1.5 * bed.spec.diameter
    columns = np.floor(bed.centres[:, :2] / cell).astype(int)
    columns -= columns.min(axis=0)
    index = columns[:, 0] * (columns[:, 1].max() + 1) + columns[:, 1]
    highest = np.full(index.max() + 1, -np.inf)
    np.maximum.at(highest, index, bed.centres[:, 2] + bed.radii)
    return float(np.mean(highest[np.isfinite(highest)]))
