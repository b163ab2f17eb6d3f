# SPDX-License-Identifier: GPL-2.0-or-later
"""The parts of the triaxial test, each against a result that is known."""
from __future__ import annotations

import math

import numpy as np
import pytest
from yade import O

from grainfall.contacts import Sand
from grainfall.dynamics import loop_energy
from grainfall.packings import Cylinder, random_packing
from grainfall.running import advance
from grainfall.triaxial import cyclic, scene
from grainfall.triaxial.membrane import RubberTube, wrap
from grainfall.triaxial.samples import Sample, SampleSpec, load_sample, save_sample

YOUNG, POISSON, RADIUS, DENSITY = 7e9, 0.2, 2e-3, 2650.0
PLATEN_YOUNG, PLATEN_POISSON = 69e9, 0.33
SPEC = SampleSpec(
    diameter=2 * RADIUS,
    height=20 * RADIUS,
    grain_diameter=2 * RADIUS,
    grain_spread=0.0,
    grain_density=DENSITY,
    young=YOUNG,
    poisson=POISSON,
    platen_young=PLATEN_YOUNG,
    platen_poisson=PLATEN_POISSON,
    void_ratio=0.6,
    pressure=1e4,
    seed=1,
)
SAND = Sand(
    density=DENSITY,
    young=YOUNG,
    poisson=POISSON,
    restitution=1.0,
    friction="0.5",
    moisture=0.0,
    moisture_factor="",
    reference_diameter=0.0,
    normal_law="hertz",
    tangential_law="incremental",
)


def hertz(force, radius, *constants):
    """Overlap [m] and tangent stiffness [N/m] of a contact with relative radius and (young, poisson) of both bodies."""
    modulus = 1 / sum((1 - nu**2) / young for young, nu in constants)
    overlap = (3 * force / (4 * modulus * math.sqrt(radius))) ** (2 / 3)
    return overlap, 2 * modulus * math.sqrt(radius * overlap)


def column(count, force):
    """A column of spheres that presses on its platens with this force [N], and its stiffness [N/m]."""
    grain, platen = (YOUNG, POISSON), (PLATEN_YOUNG, PLATEN_POISSON)
    between, stiffness = hertz(force, RADIUS / 2, grain, grain)
    at_platen, platen_stiffness = hertz(force, RADIUS, grain, platen)
    heights = RADIUS - at_platen + (2 * RADIUS - between) * np.arange(count)
    centres = np.column_stack((np.zeros((count, 2)), heights))
    sample = Sample(SPEC, centres, np.full(count, RADIUS), heights[-1] + RADIUS - at_platen)
    sample.contacts = np.array(
        [(i, i + 1) for i in range(count - 1)] + [(0, count), (count - 1, count + 1)]
    )
    sample.shear = np.zeros((len(sample.contacts), 3))
    return sample, 1 / ((count - 1) / stiffness + 2 / platen_stiffness)


def cycle(sample, frequency, peak_to_peak, cycles):
    """Build the sample's scene and cycle it; the finished test."""
    scene.build(sample, SAND, platen_friction=0.3, gravity=False)
    scene.hold_top(sample)
    O.engines = [*O.engines[:3], cyclic.actuator(), *O.engines[3:]]
    advance(1)
    test = cyclic.CyclicTest(sample, [frequency], peak_to_peak, 0.2 * scene.stable_step(sample))
    cyclic.start(test)
    for _ in range(cycles):
        advance(test.steps_per_cycle)
        test.end_cycle()
    cyclic.stop()
    return test


def test_a_column_of_grains_is_as_stiff_as_its_hertz_contacts_in_a_row():
    # The platen moves by 1e-3 of the overlaps' sum, so the secant differs from the tangent by far less than 1e-4;
    # 200 Hz is 1/30 of the column's first natural frequency, 0.2 % in k, of which removing inertia leaves 1e-5.
    sample, stiffness = column(8, force=5.0)
    moved = 1e-3 * 5.0 / stiffness
    test = cycle(sample, 200.0, moved, 3)
    (lower,), (upper,) = test.responses(2), test.responses(2, "upper")
    free = cyclic.inertia_free(lower, upper)
    assert free.real == pytest.approx(stiffness, rel=3e-4)
    # Nothing dissipates: no dashpot, no slip.
    assert abs(free.imag) < 1e-3 * stiffness
    assert upper.stiffness < stiffness < lower.stiffness


def test_the_largest_stable_step_of_a_column_is_that_of_its_end_grain():
    # The end grain is held by its neighbour and by the stiffer platen. Along the axis their normal stiffnesses add,
    # about a lateral axis their shear stiffnesses (8 G* a) at the arm R; the inertia is 0.4 m R^2.
    sample, _ = column(4, force=5.0)
    scene.build(sample, SAND, platen_friction=0.0, gravity=False)
    advance(1)
    grain, platen = (YOUNG, POISSON), (PLATEN_YOUNG, PLATEN_POISSON)
    normal = shear = 0.0
    for radius, bodies in ((RADIUS / 2, (grain, grain)), (RADIUS, (grain, platen))):
        overlap, stiffness = hertz(5.0, radius, *bodies)
        compliance = sum((2 - nu) * 2 * (1 + nu) / young for young, nu in bodies)
        normal += stiffness
        shear += 8 / compliance * math.sqrt(radius * overlap)
    mass = DENSITY * 4 / 3 * math.pi * RADIUS**3
    expected = math.sqrt(2 / max(normal / mass, shear / (0.4 * mass)))
    assert scene.stable_step(sample) == pytest.approx(expected, rel=1e-3)


def test_an_elastic_column_gives_back_what_it_takes():
    sample, stiffness = column(4, force=5.0)
    test = cycle(sample, 200.0, 1e-3 * 5.0 / stiffness, 2)
    stored = 0.5 * stiffness * test.peak_to_peak**2
    _, displacement, _, force = test.table(1).T
    assert abs(loop_energy(displacement, force)) < 1e-3 * stored


def ring_of_grains(around=12, layers=6, radius=RADIUS):
    """Touching rings of equal spheres in layers, and the distance of their centres from the axis."""
    distance = radius / math.sin(math.pi / around)
    angle = 2 * np.pi * np.arange(around) / around
    rows = [
        np.column_stack(
            (
                distance * np.cos(angle),
                distance * np.sin(angle),
                np.full(around, radius * (2 * i + 1)),
            )
        )
        for i in range(layers)
    ]
    return np.concatenate(rows), np.full(around * layers, radius), distance


def test_a_membrane_pushes_with_its_pressure_and_pushes_nothing_aside():
    centres, radii, distance = ring_of_grains()
    height = 12 * RADIUS
    membrane = wrap(centres, radii, 0.0, height)
    forces = membrane.forces(1e4, len(radii))
    # It rests on the grains' outsides and sags a little between them.
    assert distance < membrane.radius < distance + RADIUS
    np.testing.assert_allclose(forces.sum(axis=0), 0.0, atol=1e-12 * np.abs(forces).sum())
    inwards = -np.einsum("ij,ij->i", forces[:, :2], centres[:, :2]) / distance
    assert np.all(inwards > 0)
    # p times the lateral surface, up to the cosine of the angle between cell and grain: 15 degrees at most, 1.2 % in
    # the mean
    assert inwards.sum() == pytest.approx(1e4 * 2 * np.pi * membrane.radius * height, rel=0.02)


def test_a_stretched_membrane_gives_back_the_work_that_stretched_it():
    # Per height: pressure times the area swept is E strain^2/2 in a wall of thickness t and length 2 pi R0.
    tube = RubberTube(young=1.4e6, thickness=0.3e-3, radius=17e-3)
    radii = np.linspace(17e-3, 19e-3, 2001)
    force = [tube.pressure(r) * 2 * np.pi * r for r in radii]
    stored = 0.5 * 1.4e6 * (2 / 17) ** 2 * 0.3e-3 * 2 * np.pi * 17e-3
    assert np.trapz(force, radii) == pytest.approx(stored, rel=1e-9)
    assert tube.pressure(16.9e-3) == 0


def test_an_inner_grain_feels_no_membrane():
    centres, radii, _ = ring_of_grains()
    inside = np.append(centres, [[0.0, 0.0, 6 * RADIUS]], axis=0)
    forces = wrap(inside, np.append(radii, RADIUS), 0.0, 12 * RADIUS).forces(1e4, len(radii) + 1)
    assert np.all(forces[-1] == 0)


def test_a_random_packing_of_a_cylinder_lies_inside_without_much_overlap():
    rng = np.random.default_rng(3)
    cylinder = Cylinder(0.03, 0.06)
    radii = np.full(120, 2.9e-3)
    centres = random_packing(cylinder, radii, rng)
    slack = 1e-12
    assert np.all(np.hypot(centres[:, 0], centres[:, 1]) <= cylinder.diameter / 2 - radii + slack)
    assert np.all(
        (centres[:, 2] >= radii - slack) & (centres[:, 2] <= cylinder.depth - radii + slack)
    )
    gaps = np.linalg.norm(centres[:, None] - centres[None], axis=2) + np.eye(120)
    assert gaps.min() > 2 * 2.9e-3 - 0.05 * 2.9e-3


def test_a_sample_comes_back_from_its_file_as_it_was(tmp_path):
    sample, _ = column(4, force=5.0)
    save_sample(sample, tmp_path / "sample.h5")
    again = load_sample(tmp_path / "sample.h5")
    assert again.spec == sample.spec and again.top == sample.top
    for name in ("centres", "radii", "contacts", "shear"):
        np.testing.assert_array_equal(getattr(again, name), getattr(sample, name))
