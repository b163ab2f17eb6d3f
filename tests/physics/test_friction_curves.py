# SPDX-License-Identifier: GPL-2.0-or-later
"""Friction measured on sliding contacts follows the curve that the material was given.

Spheres are pressed into a rigid plane by a prescribed overlap and dragged along it without turning
until they slide. The ratio of the forces on the sphere is compared with the curve written out here,
at the normal force measured. There is no dashpot, so the sliding force is the limit itself: 1e-6
asks for rounding only.
"""
from __future__ import annotations

import math
from collections.abc import Callable

import contact_scenes as cs
import numpy as np
import pytest
from yade import (
    AsperityFriction,
    CombinedFriction,
    ConstantFriction,
    ExponentialFriction,
    FrictionCurve,
    GrainPair,
    MoistureFactor,
    O,
    PowerLawFriction,
    TableFriction,
)

TOLERANCE = 1e-6
SOLID = cs.Solid(1.0e9, 0.25, 2500)
RADIUS = 0.005
LOADS = np.geomspace(0.02, 80, 10)  # N; Cole's range of 1 to 20 N and the constant parts outside it
MOISTURES = (0.0, 0.023, 0.08)
COLE_EXPONENT = math.log(4) / math.log(20)

TABLE_LOADS = [0.1, 1.0, 5.0, 20.0]
TABLE_MOISTURES = [0.0, 0.05, 0.10]
TABLE_MU = [[0.90, 0.80, 0.75], [0.70, 0.66, 0.60], [0.45, 0.40, 0.38], [0.25, 0.22, 0.20]]
FACTOR_MOISTURES, FACTORS = [0.0, 0.05, 0.10], [1.0, 0.8, 0.7]


def bilinear(load: float, moisture: float) -> float:
    """TABLE_MU between its points, constant beyond."""
    at_moisture = [np.interp(moisture, TABLE_MOISTURES, row) for row in TABLE_MU]
    return float(np.interp(load, TABLE_LOADS, at_moisture))


Formula = Callable[[float, float], float]

CURVES: dict[str, tuple[Callable[[], FrictionCurve], Formula]] = {
    "constant": (lambda: ConstantFriction(0.4), lambda load, w: 0.4),
    "power law": (
        lambda: PowerLawFriction(0.5, 2.0, 0.4, 0.15, 1.1),
        lambda load, w: min(1.1, max(0.15, 0.5 * (load / 2.0) ** -0.4)),
    ),
    "Cole preset": (
        lambda: PowerLawFriction(),
        lambda load, w: min(0.8, max(0.2, 0.8 * load**-COLE_EXPONENT)),
    ),
    "exponential": (
        lambda: ExponentialFriction(0.8, 0.2, 5.0),
        lambda load, w: 0.2 + 0.6 * math.exp(-load / 5.0),
    ),
    "asperity": (
        lambda: AsperityFriction(0.2, 0.3, 0.9),
        lambda load, w: min(0.9, 0.2 + 0.3 * load ** (-1 / 3)),
    ),
    "table": (lambda: TableFriction(TABLE_LOADS, TABLE_MOISTURES, TABLE_MU), bilinear),
    "combined": (
        lambda: CombinedFriction(ExponentialFriction(0.8, 0.2, 5.0), ConstantFriction(0.4), "mean"),
        lambda load, w: 0.5 * (0.2 + 0.6 * math.exp(-load / 5.0) + 0.4),
    ),
}


def dragged(
    loads: np.ndarray, sphere: dict, plane: dict | None = None, ip2: dict | None = None
) -> tuple[np.ndarray, np.ndarray]:
    """Drag spheres pressed on with these forces [N]; returns normal forces [N] and ratios |F_t|/F_n
    [-].

    `sphere` and `plane` are attributes of the materials, labelled 'sphere' and 'plane'; plane
    defaults to sphere.
    """
    O.reset()
    # Bridges would add to the force on the sphere; they have tests of their own.
    no_bridges = {"bridgeModel": "none"}
    O.materials.append(
        [
            SOLID.rigid_material(label="plane", **no_bridges, **(plane or sphere)),
            SOLID.material(label="sphere", **no_bridges, **sphere),
        ]
    )
    cs.add_plane("plane")
    ids = []
    for i, load in enumerate(loads):
        stiffness = 4 / 3 * SOLID.plane_modulus * math.sqrt(RADIUS)
        height = RADIUS - (load / stiffness) ** (2 / 3)
        ids.append(cs.add_sphere((0, 4 * RADIUS * i, height), RADIUS, "sphere", fixed=True))
    cs.set_engines(cs.grain_law(ip2))
    O.dt = 1e-6
    # Mindlin's spring holds up to mu F_n/k_t, 0.06 mm at 80 N: 0.2 mm of path leave no contact
    # sticking.
    for i in ids:
        O.bodies[i].state.vel = (2e-4 / (100 * O.dt), 0, 0)
    O.run(100, True)
    assert all(contact.phys.isSliding for contact in O.interactions if contact.isReal)
    forces = np.array([cs.force_on(i) for i in ids])
    return forces[:, 2], np.hypot(forces[:, 0], forces[:, 1]) / forces[:, 2]


@pytest.mark.parametrize("moisture", MOISTURES)
@pytest.mark.parametrize("name", CURVES)
def test_sliding_friction_is_the_curve_at_ten_loads_and_three_moistures(name, moisture):
    make, formula = CURVES[name]
    load, ratio = dragged(LOADS, dict(friction=make(), gravimetricMoisture=moisture))
    assert load == pytest.approx(LOADS, rel=1e-5)  # the plane is rigid to 1e-6
    assert ratio == pytest.approx([formula(n, moisture) for n in load], rel=TOLERANCE)


@pytest.mark.parametrize("moisture", MOISTURES)
@pytest.mark.parametrize("name", CURVES)
def test_moisture_factor_multiplies_the_sliding_friction(name, moisture):
    make, formula = CURVES[name]
    curve = make()
    curve.moistureFactor = MoistureFactor(FACTOR_MOISTURES, FACTORS)
    load, ratio = dragged(LOADS, dict(friction=curve, gravimetricMoisture=moisture))
    factor = np.interp(moisture, FACTOR_MOISTURES, FACTORS)
    expected = [factor * formula(n, moisture) for n in load]
    assert ratio == pytest.approx(expected, rel=TOLERANCE)


@pytest.mark.parametrize("name", CURVES)
def test_curve_object_tells_the_same_coefficient(name):
    make, formula = CURVES[name]
    curve = make()
    for moisture in MOISTURES:
        told = [curve.coefficient(n, moisture) for n in LOADS]
        assert told == pytest.approx([formula(n, moisture) for n in LOADS], rel=1e-12)


def test_cole_preset_goes_through_0_8_at_1_newton_and_0_2_at_20_newton():
    _, ratio = dragged(np.array([1.0, 20.0]), dict(friction=PowerLawFriction()))
    # The plane's modulus moves the load by 1e-6, half of which is felt in the coefficient.
    assert ratio == pytest.approx([0.8, 0.2], rel=1e-5)


def test_without_a_curve_friction_is_the_tangent_of_the_friction_angle():
    _, ratio = dragged(LOADS, dict(frictionAngle=0.6))
    assert ratio == pytest.approx(math.tan(0.6), rel=TOLERANCE)


def test_a_number_is_a_constant_friction():
    _, ratio = dragged(LOADS, dict(friction=0.35))
    assert ratio == pytest.approx(0.35, rel=TOLERANCE)


@pytest.mark.parametrize("coarsening", [1.0, 3.0, 10.0])
def test_grain_that_stands_for_a_smaller_one_is_read_at_its_load_over_the_square(coarsening):
    curve, formula = CURVES["exponential"]
    attributes = dict(friction=curve(), referenceRadius=RADIUS / coarsening)
    load, ratio = dragged(LOADS, attributes)
    expected = [formula(n / coarsening**2, 0.0) for n in load]
    assert ratio == pytest.approx(expected, rel=TOLERANCE)


RULES: dict[str, Callable[[float, float], float]] = {
    "min": min,
    "max": max,
    "mean": lambda a, b: (a + b) / 2,
    "geometric": lambda a, b: math.sqrt(a * b),
}


@pytest.mark.parametrize("rule", RULES)
def test_unlike_materials_combine_their_curves_at_the_load_of_the_contact(rule):
    sand, steel = CURVES["exponential"], CURVES["constant"]  # they cross at 5.5 N
    load, ratio = dragged(
        LOADS, dict(friction=sand[0]()), dict(friction=steel[0]()), {"frictionRule": rule}
    )
    expected = [RULES[rule](sand[1](n, 0.0), steel[1](n, 0.0)) for n in load]
    assert ratio == pytest.approx(expected, rel=TOLERANCE)


@pytest.mark.parametrize("labels", [("sphere", "plane"), ("plane", "sphere")])
def test_explicit_pair_overrides_the_rule_in_either_order(labels):
    make, formula = CURVES["asperity"]
    pair = GrainPair(first=labels[0], second=labels[1], friction=make())
    load, ratio = dragged(LOADS, dict(friction=0.9), dict(friction=0.1), {"pairs": [pair]})
    assert ratio == pytest.approx([formula(n, 0.0) for n in load], rel=TOLERANCE)


def test_contact_is_as_wet_as_the_wetter_body():
    make, formula = CURVES["table"]
    curve = make()
    wet, dry = dict(friction=curve, gravimetricMoisture=0.08), dict(friction=curve)
    for sphere, plane in ((wet, dry), (dry, wet)):
        load, ratio = dragged(LOADS, sphere, plane)
        assert ratio == pytest.approx([formula(n, 0.08) for n in load], rel=TOLERANCE)


def test_friction_does_not_depend_on_speed_or_path():
    """Dragged back and forth twice, the force keeps its size and turns with the motion."""
    load, first = dragged(LOADS[4:5], dict(friction=CURVES["power law"][0]()))
    sphere = O.bodies[1]
    for velocity in ((-1.0, 0, 0), (0, 3.0, 0), (0.3, -0.4, 0)):
        sphere.state.vel = velocity
        O.run(400, True)
        force = cs.force_on(1)
        direction = np.array(velocity) / np.linalg.norm(velocity)
        assert force == pytest.approx(force[2] * (np.array([0, 0, 1]) - first[0] * direction))
