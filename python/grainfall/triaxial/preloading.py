# SPDX-License-Identifier: GPL-2.0-or-later
"""Standard preloading (MR-2629, section 3.2.1): each sample is brought to the same state before it is cycled.

1. Lateral and axial stress go together from the preparation's pressure to the lateral stress of the test: cell pressure
   and the membrane's tension, which follows the radius.
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
from grainfall.triaxial.parameters import rubber_tube
from grainfall.triaxial.samples import Sample

DAMPING = 0.5
#: Steps of each small rise of stress, and how many rises each ramp has.
RISE_STEPS, RISES = 100, 12
REST_STEPS, MOST_RESTS = 500, 24
UNBALANCED_LIMIT = 1e-5
#: Shortening above which a sample counts as fallen: sand at rest bears its load at strains of a hundredth.
FALLEN = 0.1
#: Unbalanced force above which a sample that has been left alone is not at rest.
MOVING = 1e-2


class SampleFell(ValueError):
    """The sample does not bear its stresses; the message says which, and what would help."""


def preload(
    sample: Sample, parameters: dict[str, Any], progress: Callable[[float, str], None]
) -> dict[str, Any]:
    """Preload the sample in the scene in hand; its upper platen is held still afterwards.

    Returns
    -------
    dict
        The state reached: stresses from contacts, void ratio, creep, size. The membrane's forces stay.

    Raises
    ------
    SampleFell
        The sample gives way.
    """
    integrator = O.engines[-1]
    tube = rubber_tube(parameters, sample.report["diameter_m"])
    scene.release_top(sample)
    integrator.damping = DAMPING
    membrane = scene.wrap_membrane(sample)
    for done in range(3 * RISES):
        held = parameters["confinement"] + tube.pressure(membrane.radius)
        lateral, axial = stress_path(parameters, sample.spec.pressure, held)[done]
        if done % RISES == 0:
            _set_step(sample, parameters)
        membrane = scene.load(sample, lateral, axial)
        advance(RISE_STEPS)
        _check_standing(sample, parameters, lateral, axial)
        progress(0.5 * done / (3 * RISES), f"{axial / 1e3:.3g} kPa axial")
    tension = tube.pressure(membrane.radius)
    lateral = parameters["confinement"] + tension
    axial = stress_path(parameters, lateral, lateral)[-1][1]
    membrane = scene.load(sample, lateral, axial)
    rests = _rest(sample, parameters, progress)
    before = scene.top_height(sample)
    advance(REST_STEPS * max(1, rests // 2))
    creep = (before - scene.top_height(sample)) / before
    integrator.damping = 0.0
    _check_standing(sample, parameters, lateral, axial, at_rest=True)
    scene.hold_top(sample)
    _stop_all()
    advance(1)
    stress = np.diag(scene.mean_stress(sample, membrane))
    below, above = scene.platen_forces(sample)
    return {
        "axial_stress_Pa": float(stress[2]),
        "lateral_stress_Pa": float(0.5 * (stress[0] + stress[1])),
        "cell_pressure_Pa": parameters["confinement"],
        "membrane_pressure_Pa": tension,
        "bridge_suction_Pa": scene.suction(sample, membrane),
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


def stress_path(
    parameters: dict[str, Any], start: float, lateral: float
) -> list[tuple[float, float]]:
    """Lateral and axial stress [Pa] of each rise: isotropic, up to the preload, back to the test.

    Parameters
    ----------
    start, lateral : float
        Isotropic pressure of the preparation and lateral stress of the test [Pa]. Without a lateral stress the first
        stage goes to the axial stress of the test, so that the platen always rests on the sand.
    """
    hold = parameters["axial_stress"]
    if hold is None:
        hold = lateral * parameters["stress_ratio"]
    peak = hold / parameters["stress_ratio"] * parameters["preload_ratio"]
    base = lateral if lateral > 0 else hold
    rise = np.arange(1, RISES + 1) / RISES
    first = zip(start + (lateral - start) * rise, start + (base - start) * rise)
    up = base + (peak - base) * rise
    back = peak + (hold - peak) * rise
    return [*first, *((lateral, axial) for axial in (*up, *back))]


def _check_standing(
    sample: Sample, parameters: dict[str, Any], lateral: float, axial: float, at_rest: bool = False
) -> None:
    """Raise `SampleFell` where the sample gives way under these stresses [Pa]; is it supposed to rest by now?"""
    shortening = 1 - scene.top_height(sample) / sample.top
    fallen = shortening > FALLEN or coordination(sample) == 0
    if not fallen and not (at_rest and scene.unbalanced_force(sample) > MOVING):
        return
    bridges = parameters["moisture"] > 0 and parameters["bridges"] != "none"
    state = f"has been shortened by {100 * shortening:.0f} %" + (
        "" if fallen else " and still moves"
    )
    reason = (
        "bridges do not hold it (suction goes with 1/diameter)"
        if bridges
        else "friction does not hold it"
    )
    raise SampleFell(
        f"the sample does not stand: under {axial:.4g} Pa axial and {lateral:.4g} Pa lateral stress it {state}; "
        f"{reason}. Raise --confinement or --membrane-thickness, or lower --axial-stress, --stress-ratio or "
        "--preload-ratio"
    )


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
