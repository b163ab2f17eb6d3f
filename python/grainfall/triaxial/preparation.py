# SPDX-License-Identifier: GPL-2.0-or-later
"""Preparation of a triaxial sample at a wanted void ratio.

1. Spheres are placed at random in a cylinder that is larger than the sample, without overlap.
2. Membrane and upper platen compress them under the preparation's pressure with a friction so high that the packing
   comes out looser than wanted.
3. Friction is lowered step by step; the sample compacts under the pressure, and this ends when the void ratio is
   reached. (A packing's density under pressure depends on the friction at which it was made; the friction used here
   is a tool of preparation and has nothing to do with that of the sand.)
4. Friction is raised again, so that no contact stands at its limit, and the sample comes to rest.

At rest means an unbalanced force (mean resultant over mean contact force) below 1e-3.
"""
from __future__ import annotations

import math
import time

import numpy as np
from yade import O

from grainfall.bed_scene import grain_centres
from grainfall.contacts import Sand, rayleigh_step
from grainfall.packings import Cylinder, random_packing
from grainfall.running import advance
from grainfall.triaxial import scene
from grainfall.triaxial.membrane import Membrane
from grainfall.triaxial.samples import Progress, Sample, SampleSpec

LOOSE_FRACTION = 0.5
#: Spheres are packed this much larger than they are, so that the overlaps that remain vanish with the enlargement.
ENLARGEMENT = 1.03
DAMPING = 0.3
#: While the loose packing collapses: its fall would otherwise make it dense whatever the friction.
COLLAPSE_DAMPING = 0.8
RESTITUTION = 0.8
# Fraction of the Rayleigh step: see grainfall.bed_settling.
STEP_FRACTION = 0.3
#: Once the sample is under pressure the step follows the contacts' stiffness, looked up every so many chunks.
STABLE_FRACTION, STEP_CHUNKS = 0.4, 20
LOOSE_FRICTION, LEAST_FRICTION, FINAL_FRICTION = 1.0, 1e-3, 0.5
FRICTION_FACTOR = 0.8
FREEZING_LIMIT, UNBALANCED_LIMIT = 0.01, 1e-3
#: Steps between two fittings of the membrane.
CHUNK = 50
MAX_CHUNKS = {"compress": 150, "compact": 300, "rest": 200}
#: Axial and lateral strain over one chunk below which compression under the present friction has ended.
STRAIN_LIMIT = 2e-4


def prepare_sample(spec: SampleSpec, progress: Progress) -> Sample:
    """Prepare a sample in YADE; the present scene is discarded.

    Parameters
    ----------
    progress : callable
        Called with the name of the stage and the fraction done.
    """
    started = time.time()
    progress("packing", 0.0)
    sample = _loose(spec)
    _build(sample)
    membrane = _compress(sample, progress)
    membrane, friction = _compact(sample, membrane, progress)
    scene.set_friction(FINAL_FRICTION)
    _rest(sample, progress)
    membrane = scene.wrap_membrane(sample)
    read_state(sample)
    sample.report = {
        "void_ratio": scene.void_ratio(sample, membrane),
        "diameter_m": 2 * membrane.radius,
        "height_m": sample.top,
        "coordination_number": coordination_number(sample),
        "friction_at_which_the_void_ratio_was_reached": friction,
        "unbalanced_force": scene.unbalanced_force(sample),
        "preparation_steps": O.iter,
        "preparation_wall_seconds": time.time() - started,
    }
    return sample


def _loose(spec: SampleSpec) -> Sample:
    """Spheres in a cylinder of the sample's shape, enlarged so that they fill `LOOSE_FRACTION` of it."""
    rng = np.random.default_rng(spec.seed)
    count = spec.grain_count
    radii = spec.grain_diameter / 2 * (1 + spec.grain_spread * rng.uniform(-1, 1, count))
    stretch = (1 / (1 + spec.void_ratio) / LOOSE_FRACTION) ** (1 / 3)
    cylinder = Cylinder(spec.diameter * stretch, spec.height * stretch)
    centres = random_packing(cylinder, ENLARGEMENT * radii, rng, tolerance=ENLARGEMENT - 1)
    return Sample(spec, centres, radii, cylinder.depth)


def _build(sample: Sample) -> None:
    spec = sample.spec
    sand = Sand(
        density=spec.grain_density,
        young=spec.young,
        poisson=spec.poisson,
        restitution=RESTITUTION,
        friction=str(LOOSE_FRICTION),
        moisture=0.0,
        moisture_factor="",
        reference_diameter=0.0,
        normal_law="hertz",
        tangential_law="incremental",
    )
    scene.build(sample, sand, platen_friction=0.0, gravity=False)
    scene.release_top(sample)
    O.engines[-1].damping = COLLAPSE_DAMPING
    smallest = float(sample.radii.min())
    O.dt = STEP_FRACTION * rayleigh_step(smallest, spec.grain_density, spec.young, spec.poisson)


def _compress(sample: Sample, progress: Progress) -> Membrane:
    """Bring the loose packing under pressure, at first gently."""
    limit = MAX_CHUNKS["compress"]
    previous = math.inf
    for chunk in range(limit):
        pressure = sample.spec.pressure * min(1.0, 0.05 + chunk / (0.3 * limit))
        membrane = scene.load(sample, pressure, pressure)
        advance(CHUNK)
        progress("compress", chunk / limit)
        present = scene.volume(sample, membrane)
        settled = (
            abs(previous / present - 1) < STRAIN_LIMIT and scene.unbalanced_force(sample) < 0.1
        )
        if pressure == sample.spec.pressure and settled:
            break
        previous = present
    O.engines[-1].damping = DAMPING
    return membrane


def _follow_stiffness(sample: Sample, chunk: int) -> None:
    """Lengthen the step to what the contacts allow, every `STEP_CHUNKS` chunks."""
    if chunk % STEP_CHUNKS == 0:
        step = STABLE_FRACTION * scene.stable_step(sample)
        if math.isfinite(step):
            O.dt = step


def _compact(sample: Sample, membrane: Membrane, progress: Progress) -> tuple[Membrane, float]:
    """Lower friction until the void ratio is reached; the friction at which it was."""
    limit = MAX_CHUNKS["compact"]
    friction = LOOSE_FRICTION
    previous = math.inf
    for chunk in range(limit):
        present = scene.void_ratio(sample, membrane)
        if present <= sample.spec.void_ratio:
            break
        if abs(previous - present) < STRAIN_LIMIT:
            if friction <= LEAST_FRICTION:
                break
            friction = max(FRICTION_FACTOR * friction, LEAST_FRICTION)
            scene.set_friction(friction)
        previous = present
        membrane = scene.load(sample, sample.spec.pressure, sample.spec.pressure)
        _follow_stiffness(sample, chunk)
        advance(CHUNK)
        progress("compact", chunk / limit)
    return membrane, friction


def _rest(sample: Sample, progress: Progress) -> None:
    """Let the sample come to rest; the membrane follows it until it hardly moves, then its forces are kept."""
    for chunk in range(MAX_CHUNKS["rest"]):
        _follow_stiffness(sample, chunk)
        if chunk == 0 or scene.unbalanced_force(sample) > FREEZING_LIMIT:
            scene.load(sample, sample.spec.pressure, sample.spec.pressure)
        advance(CHUNK)
        progress("rest", chunk / MAX_CHUNKS["rest"])
        if scene.unbalanced_force(sample) < UNBALANCED_LIMIT:
            break


def read_state(sample: Sample) -> None:
    """Copy centres, contacts and platen from the scene into the sample."""
    sample.centres = grain_centres(len(sample.radii))
    sample.top = scene.top_height(sample)
    pairs, shear = [], []
    for contact in O.interactions:
        if contact.isReal:
            pairs.append((contact.id1, contact.id2))
            shear.append(contact.phys.shearElastic)
    sample.contacts = np.array(pairs, dtype=np.int64).reshape(-1, 2)
    sample.shear = np.array(shear, dtype=float).reshape(-1, 3)


def coordination_number(sample: Sample) -> float:
    """Contacts between grains, twice, over the number of grains."""
    between = np.all(sample.contacts < len(sample.radii), axis=1)
    return 2 * float(between.sum()) / len(sample.radii)
