# SPDX-License-Identifier: GPL-2.0-or-later
"""Beds: at rest, as dense as asked, kept and found again."""
from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import yade
from yade import O, utils

from grainfall.bed_scene import add_bed, grain_centres, restore_contacts
from grainfall.bed_settling import KINETIC_LIMIT, UNBALANCED_LIMIT, unrest
from grainfall.beds import BedSpec, load_bed, obtain_bed
from grainfall.contacts import Sand, contact_loop, rayleigh_step

SAND = Sand(
    density=2650.0,
    young=2e7,
    poisson=0.2,
    restitution=0.6,
    friction="cole",
    moisture=0.0,
    moisture_factor="",
    reference_diameter=0.72e-3,
    normal_law="hertz",
    tangential_law="incremental",
)
SPEC = BedSpec(
    length=0.08,
    width=0.08,
    depth=0.05,
    grains=0,
    diameter=8e-3,
    spread=0.1,
    solid_fraction=0.6,
    wall_friction=0.3,
    seed=1,
    sand=SAND,
)


@pytest.fixture
def bed(bed_cache):
    return obtain_bed(SPEC, bed_cache)[0]


def test_a_bed_is_at_rest_by_its_own_report(bed):
    assert bed.report["kinetic_energy_per_grain_over_m_g_d"] < KINETIC_LIMIT
    assert bed.report["unbalanced_force"] < UNBALANCED_LIMIT


def test_a_bed_that_does_not_rest_is_called_so(bed):
    assert unrest(bed.report) == ""
    restless = {**bed.report, "kinetic_energy_per_grain_over_m_g_d": 5e-3}
    assert "kinetic_energy_per_grain_over_m_g_d is 0.005 (limit 0.0002)" in unrest(restless)


def test_a_bed_has_the_depth_and_the_solid_fraction_asked_for(bed):
    # The surface is rough by a grain; settling makes the packing up to 0.03 denser than it was thrown.
    assert bed.surface == pytest.approx(SPEC.depth, abs=SPEC.diameter)
    assert SPEC.solid_fraction - 0.02 < bed.report["solid_fraction_core"] < 0.64


def test_a_bed_is_as_dense_as_random_packings_are(bed):
    # Between random loose packing, 0.555 (Onoda & Liniger 1990, Phys. Rev. Lett. 64:2727), and random close
    # packing, 0.637 (Scott & Kilgour 1969, J. Phys. D 2:863).
    assert 0.555 < bed.report["solid_fraction_core"] < 0.637


def test_grains_inside_a_bed_have_the_contacts_of_a_jammed_packing_with_friction(bed):
    # Isostatic are 4 contacts a grain with friction and 6 without (Song, Wang & Makse 2008, Nature 453:629),
    # grains that carry no load left out. 86 inner grains here: standard error 0.15.
    count, margin = len(bed.radii), 2 * SPEC.diameter
    touching = np.bincount(bed.contacts[bed.contacts < count].ravel(), minlength=count)
    x, y, z = bed.centres.T
    inner = (np.abs(x) < SPEC.length / 2 - margin) & (np.abs(y) < SPEC.width / 2 - margin)
    inner &= (z > margin) & (z < bed.surface - margin)
    carrying = touching[inner & (touching >= 2)]
    assert 4.0 < carrying.mean() < 6.0


def test_grains_lie_inside_the_box_and_overlap_little(bed):
    x, y, z = bed.centres.T
    # Overlaps with the walls stay below 2 % of a radius, as those between grains.
    margin = 0.98 * bed.radii
    assert np.all(np.abs(x) <= SPEC.length / 2 - margin)
    assert np.all(np.abs(y) <= SPEC.width / 2 - margin)
    assert np.all(z >= margin)


def test_a_bed_is_settled_once_and_then_found(bed_cache, bed):
    again, cached = obtain_bed(SPEC, bed_cache)
    assert cached
    np.testing.assert_array_equal(again.centres, bed.centres)
    np.testing.assert_array_equal(again.shear, bed.shear)


def test_a_bed_can_be_kept_under_a_name_and_the_name_guards_its_parameters(tmp_path, bed_cache):
    named = replace(SPEC, depth=0.035)
    first, cached = obtain_bed(named, tmp_path, "shallow")
    assert not cached and (tmp_path / "shallow.h5").exists()
    np.testing.assert_array_equal(load_bed(tmp_path / "shallow.h5").radii, first.radii)
    assert obtain_bed(named, tmp_path, "shallow")[1]
    with pytest.raises(ValueError, match="shallow.*depth"):
        obtain_bed(SPEC, tmp_path, "shallow")


def test_the_same_seed_makes_the_same_bed(tmp_path, bed):
    again, cached = obtain_bed(SPEC, tmp_path)
    assert not cached
    np.testing.assert_array_equal(again.centres, bed.centres)


def test_a_bed_taken_from_the_store_stays_at_rest(bed):
    # Its contacts come back with their shear forces, so without any damping but the dashpots the grains
    # move by less than a thousandth of their diameter while the projectile would fall through the sand.
    O.reset()
    add_bed(bed, SAND.material("sand"), SAND.material("wall", friction=0.3, referenceRadius=0.0))
    pair = yade.wrapper.GrainPair("sand", "wall", friction=0.3)
    bounds = [yade.wrapper.Bo1_Sphere_Aabb(), yade.wrapper.Bo1_Wall_Aabb()]
    O.engines = [
        yade.wrapper.ForceResetter(),
        yade.wrapper.InsertionSortCollider(bounds),
        contact_loop(SAND, [pair], []),
        yade.wrapper.NewtonIntegrator(gravity=(0, 0, -9.81), damping=0),
    ]
    O.dt = 0.2 * rayleigh_step(bed.radii.min(), SAND.density, SAND.young, SAND.poisson)
    O.trackEnergy = True
    restore_contacts(bed)
    O.run(1, True)
    assert utils.unbalancedForce() < 2 * UNBALANCED_LIMIT
    # The restored springs are not taken for newly made energy.
    law = O.engines[2].lawDispatcher.functors[0]
    assert abs(dict(O.energy.items())["grainRescaling"]) < 0.01 * law.elasticEnergy()["shear"]
    O.run(round(0.02 / O.dt), True)
    moved = np.linalg.norm(grain_centres(len(bed.radii)) - bed.centres, axis=1)
    assert np.median(moved) < 1e-3 * SPEC.diameter
