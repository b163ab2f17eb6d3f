# SPDX-License-Identifier: GPL-2.0-or-later
"""Standard preloading (MR-2629, section 3.2.1): each sample is brought to the same state before it is cycled.

1. Confinement and axial stress rise together from the preparation's pressure to the confinement.
2. Axial stress goes up to the preload and back to the stress of the test.
3. The sample rests under forces that no longer change, until the resultant forces have died out.
4. Creep check: it is left alone for as long again; the axial strain in that time is reported.

Grains bear the run's own friction, damping and moisture throughout. Numerical damping acts during preloading only.
"""
from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from yade import O, Vector3

from grainfall.running import advance
from grainfall.triaxial import scene
from grainfall.triaxial.samples import Sample

DAMPING = 0.5
#: Steps of each small rise of stress, and how many rises each ramp has.
RISE_STEPS, RISES = 100, 12
REST_STEPS, MOST_RESTS = 500, 24
UNBALANCED_LIMIT = 1e-5


def preload(
    sample: Sample, parameters: dict[str, Any], progress: Callable[[float, str], None]
) -> dict[str, Any]:
    """Preload the sample in the scene in hand; its upper platen is held still afterwards.

    Returns
    -------
    dict
        The state reached: stresses from contacts, void ratio, creep, size. The membrane's forces stay.
    """
    confinement = parameters["confinement"]
    integrator = O.engines[-1]
    scene.release_top(sample)
    integrator.damping = DAMPING
    for done, (lateral, axial) in enumerate(stress_path(parameters, sample.spec.pressure)):
        if done % RISES == 0:
            _set_step(sample, parameters)
        scene.load(sample, lateral, axial)
        advance(RISE_STEPS)
        progress(0.5 * done / (3 * RISES), f"{axial / 1e3:.3g} kPa axial")
    membrane = scene.load(sample, confinement, confinement * parameters["stress_ratio"])
    rests = _rest(sample, parameters, progress)
    before = scene.top_height(sample)
    advance(REST_STEPS * max(1, rests // 2))
    creep = (before - scene.top_height(sample)) / before
    integrator.damping = 0.0
    scene.hold_top(sample)
    _stop_all()
    advance(1)
    stress = np.diag(scene.mean_stress(sample, membrane))
    below, above = scene.platen_forces(sample)
    return {
        "axial_stress_Pa": float(stress[2]),
        "lateral_stress_Pa": float(0.5 * (stress[0] + stress[1])),
        "lower_platen_force_N": below,
        "upper_platen_force_N": above,
        "void_ratio": scene.void_ratio(sample, membrane),
        "diameter_m": 2 * membrane.radius,
        "height_m": scene.top_height(sample),
        "coordination_number": coordination(sample),
        "unbalanced_force": scene.unbalanced_force(sample),
        "creep_strain": creep,
        "steps": O.iter,
    }


def stress_path(parameters: dict[str, Any], start: float) -> list[tuple[float, float]]:
    """Lateral and axial stress [Pa] of each rise: isotropic, up to the preload, back to the test."""
    confinement = parameters["confinement"]
    preload_stress = confinement * parameters["preload_ratio"]
    hold = confinement * parameters["stress_ratio"]
    rise = np.arange(1, RISES + 1) / RISES
    isotropic = start + (confinement - start) * rise
    up = confinement + (preload_stress - confinement) * rise
    back = preload_stress + (hold - preload_stress) * rise
    path = [(p, p) for p in isotropic]
    path += [(confinement, axial) for axial in (*up, *back)]
    return path


def _rest(
    sample: Sample, parameters: dict[str, Any], progress: Callable[[float, str], None]
) -> int:
    """Wait until forces balance; how many times `REST_STEPS` it took."""
    for rests in range(1, MOST_RESTS + 1):
        _set_step(sample, parameters)
        advance(REST_STEPS)
        unbalanced = scene.unbalanced_force(sample)
        progress(0.5 + 0.4 * rests / MOST_RESTS, f"unbalanced {unbalanced:.1e}")
        if unbalanced < UNBALANCED_LIMIT:
            break
    return rests


def _set_step(sample: Sample, parameters: dict[str, Any]) -> None:
    """The step that the contacts' stiffness allows, with the safety asked for."""
    O.dt = parameters["dt_safety"] * scene.stable_step(sample)


def _stop_all() -> None:
    for body in O.bodies:
        body.state.vel = body.state.angVel = Vector3(0, 0, 0)


def coordination(sample: Sample) -> float:
    """Contacts between grains in the scene, twice, over the number of grains."""
    count = len(sample.radii)
    between = sum(1 for i in O.interactions if i.isReal and max(i.id1, i.id2) < count)
    return 2 * between / count
