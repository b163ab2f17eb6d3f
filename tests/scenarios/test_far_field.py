# SPDX-License-Identifier: GPL-2.0-or-later
"""The drop test with a deformable continuum in the place of its rigid box."""
from __future__ import annotations

import builtins
import xml.etree.ElementTree as ElementTree
from collections.abc import Callable
from pathlib import Path
from typing import Any

import meshio
import numpy as np
import pytest
from scenario_script import SMALL, start_script
from yade import O

from grainfall.bed_stiffness import bed_moduli
from grainfall.beds import Bed, obtain_bed
from grainfall.constants import GRAVITY
from grainfall.drop import drop_test
from grainfall.drop.parameters import TABLE
from grainfall.drop.scene import bed_spec, build_scene, projectile_id
from grainfall.run_notes import energy_balance

# The bed of 660 grains is soft (2e7 Pa), and so is the continuum that goes on from it: 2e5 Pa.
CONTINUUM = {"far_field": "quasi-static", "far_field_interval": 10}

BAD = [
    ({"far_field": "elastic"}, r"--far-field = 'elastic'.*rigid, quasi-static, explicit"),
    (
        {"far_field": "quasi-static", "far_field_friction_angle": 0.5},
        r"--far-field-friction-angle = 0.5: needs a continuum that yields",
    ),
    (
        {"far_field": "explicit", "far_field_friction_angle": 0.5, "far_field_dilatancy": 0.6},
        r"--far-field-dilatancy = 0.6: must be a number in \[0, 0.5\]",
    ),
    (
        {"far_field": "explicit", "far_field_degree": 2},
        r"--far-field-degree = 2: must be 1 with --far-field explicit",
    ),
    ({"far_field_young": 1e6}, r"--far-field-young = 1000000.0: needs a continuum"),
    ({"far_field_interval": 5}, r"--far-field-interval = 5: needs a continuum"),
    ({**CONTINUUM, "far_field_young": 0}, r"--far-field-young = 0.*\[1000, 1e\+13\] Pa"),
    ({**CONTINUUM, "far_field_poisson": 0.5}, r"--far-field-poisson = 0.5.*\[0, 0.4999\]"),
    ({**CONTINUUM, "far_field_degree": 3}, r"--far-field-degree = 3.*\[1, 2\]"),
    ({**CONTINUUM, "far_field_interval": 0}, r"--far-field-interval = 0.*at least 1"),
    ({**CONTINUUM, "far_field_element": 0.2}, r"--far-field-element = 0.2.*\(0, 0.15\] m"),
    ({**CONTINUUM, "far_field_thickness": 0}, r"--far-field-thickness = 0.*above 0 m"),
    ({"near_field_radius": 0.1, "box_width": 0.15}, r"--near-field-radius = 0.1, --box-width = "),
    ({"near_field_radius": 0.02}, r"--box-length = 0.04: must be above 0.05.* diameter"),
]


@pytest.mark.parametrize(("options", "message"), BAD)
def test_what_cannot_be_used_is_refused_before_the_run(options, message, refuses) -> None:
    refuses(drop_test, message, **options)


@pytest.fixture(scope="session")
def wall_cache(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """One store of continua for all tests."""
    return tmp_path_factory.mktemp("walls")


@pytest.fixture
def resting_bed(bed_cache: Path, wall_cache: Path) -> Callable[..., Bed]:
    """The small drop's scene with the projectile held far above the bed."""

    def build(**changes: Any) -> Bed:
        options = {**SMALL, "bed_cache": str(bed_cache), "record_interval": 1e-9, **changes}
        if options.get("far_field"):
            options["far_field_cache"] = str(wall_cache)
        parameters = TABLE.resolve(options)
        bed, _ = obtain_bed(bed_spec(parameters), bed_cache)
        build_scene(parameters, bed)
        body = O.bodies[projectile_id(bed)]
        body.state.pos = (0, 0, 1)
        body.state.vel = (0, 0, 0)
        body.state.blockedDOFs = "xyzXYZ"
        return bed

    return build


def kinetic_energy(bed: Bed) -> float:
    """Of the grains [J]."""
    states = [O.bodies[i].state for i in range(len(bed.radii))]
    return sum(0.5 * s.mass * s.vel.squaredNorm() for s in states)


def weight(bed: Bed) -> float:
    """Of the grains [N]."""
    return GRAVITY * sum(O.bodies[i].state.mass for i in range(len(bed.radii)))


@pytest.mark.parametrize("path", ["flat", "general"])
def test_a_bed_does_not_notice_that_its_box_becomes_deformable(resting_bed, path) -> None:
    # Forces on all grains are the same, so that after a few steps the speeds are: what differs is the
    # compliance at contacts whose overlap has changed by a millionth since.
    energy = {}
    for outside in ({}, CONTINUUM):
        bed = resting_bed(path=path, **outside)
        O.run(5, True)
        energy[bool(outside)] = kinetic_energy(bed)
    assert energy[True] == pytest.approx(energy[False], rel=0.01)
    # The same grains on a continuum that had not been there when they were poured sink by its displacement under
    # their weight, 0.2 mm: thousands of times that.
    assert np.linalg.norm(np.array(builtins.far_field.datum), axis=1).max() > 1e-4
    assert builtins.far_field.disagreement < 1e-4


def test_a_bed_is_as_quiet_on_the_continuum_as_in_its_box_and_the_wall_carries_its_weight(
    resting_bed,
) -> None:
    energy, carried = {}, {}
    for outside in ({}, CONTINUUM):
        bed = resting_bed(**outside)
        builtins.energy_ledger.iterPeriod = 1
        planes = range(len(bed.radii), len(bed.radii) + 5)
        forces = []
        for _ in range(10):
            O.run(20, True)
            if outside:
                forces.append(-builtins.far_field.force[2])
            else:
                forces.append(-sum(O.forces.f(i)[2] for i in planes))
        energy[bool(outside)], carried[bool(outside)] = kinetic_energy(bed), np.array(forces)
    # Numerical damping has ended with settling, so that in the box too the bed stirs a little; the continuum's give
    # adds to that some percent at most.
    assert energy[True] == pytest.approx(energy[False], rel=0.05)
    np.testing.assert_allclose(carried[True], carried[False], rtol=0.01)
    # The bed has settled to an unbalanced force of 0.8 %.
    assert np.mean(carried[True]) == pytest.approx(weight(bed), rel=0.015)
    # What is not accounted for is a thousandth of what the weight has put into the wall. (Were the wall to jump where
    # each common solution finds it, the dashpots would make that several times as much.)
    assert builtins.energy_ledger.largestResidual < 1e-3 * builtins.far_field.storedEnergy


def test_a_stiff_continuum_is_the_rigid_box(small_drop, wall_cache) -> None:
    # Ten thousand times as stiff as the grains' bed. Runs differ in the last digits of their forces, which collisions
    # amplify; over 4 ms of impact that is 1e-6 of the depth, with a soft continuum 1e-3.
    rigid, _ = small_drop("rigid")
    options = {"far_field_cache": str(wall_cache), **CONTINUUM}
    stiff, _ = small_drop("stiff", far_field_young=1e10, **options)
    assert stiff["depth_m"] == pytest.approx(rigid["depth_m"], rel=1e-5)
    assert stiff["far_field"]["largest_displacement_m"] < 1e-7


def test_a_drop_in_a_continuum_states_it_and_balances(small_drop, wall_cache) -> None:
    options = {**CONTINUUM, "far_field_interval": 1, "far_field_cache": str(wall_cache)}
    summary, folder = small_drop(duration=5e-3, dt_safety=0.1, vtk_interval=2e-3, **options)
    wall = summary["far_field"]
    assert wall["cells"] > 0 and wall["unknowns"] > wall["surface_unknowns"] > 0
    assert wall["compliance_bytes"] == 8 * wall["surface_unknowns"] ** 2
    assert wall["interval"] == 1 and wall["setup_seconds"] > 0
    assert wall["contacts"] > 50 and wall["strain_energy_J"] > 0
    assert wall["largest_displacement_m"] > 0
    assert wall["largest_disagreement"] < 0.05
    assert summary["path"] == "flat"
    # As in the rigid box: test_drop_results.py.
    assert 0 < summary["energy_residual_relative"] < 1e-3
    rows = np.genfromtxt(folder / "far_field.csv", delimiter=",", names=True)
    assert rows["time_s"][-1] == pytest.approx(5e-3, rel=0.01)
    # Continuum and grains at the same moments, and one file that names them all.
    vtk = folder / "vtk"
    moments = {path.name[:11] for path in vtk.glob("*-far-field.vtu")}
    assert moments == {path.name[:11] for path in vtk.glob("*-projectile.vtp")} and len(moments) > 1
    named = [part.get("file") for part in ElementTree.parse(vtk / "scene.pvd").iter("DataSet")]
    assert len(named) == 4 * len(moments) and all((vtk / name).exists() for name in named)
    compile((vtk / "scene.py").read_text(), "scene.py", "exec")
    shown = meshio.read(vtk / f"{max(moments)}-far-field.vtu")
    moved = np.linalg.norm(shown.point_data["displacement"], axis=1).max()
    assert 0 < moved <= wall["largest_displacement_m"] * 1.1


@pytest.mark.parametrize(
    "interval, remedy",
    [(None, "--dt-safety"), (1, "--dt-safety"), (10, "--far-field-interval or --dt-safety")],
)
def test_a_bad_balance_asks_for_a_smaller_interval_only_where_there_is_one(
    interval, remedy
) -> None:
    parameters = {"energy_limit": 1e-3, "far_field_interval": interval}
    summary = {"energy_residual_relative": 2e-3, "parameters": parameters}
    (line,) = energy_balance(summary, "the energy in play")
    assert line.endswith(f"reduce {remedy}.")


def test_a_drop_in_a_continuum_with_inertia_states_it_and_balances(small_drop, wall_cache) -> None:
    summary, folder = small_drop(
        "explicit", duration=6e-3, dt_safety=0.1, vtk_interval=3e-3, far_field="explicit"
    )
    wall = summary["far_field"]
    assert wall["model"] == "explicit" and wall["outer"] == "absorbing"
    assert wall["contacts"] > 50 and wall["largest_displacement_m"] > 0
    # Forces and motion are exchanged once in 10 steps: 2.0e-3.
    assert summary["energy_residual_relative"] < 3e-3
    moments = sorted((folder / "vtk").glob("*-far-field.vtu"))
    assert len(moments) > 1
    moved = np.linalg.norm(meshio.read(moments[-1]).point_data["displacement_m"], axis=1).max()
    assert 0 < moved <= wall["largest_displacement_m"] * 1.1


def test_a_drop_goes_deeper_where_the_continuum_is_sand_that_yields(small_drop, wall_cache) -> None:
    options = {"duration": 20e-3, "dt_safety": 0.1, "far_field": "explicit"}
    elastic, _ = small_drop("elastic", **options)
    summary, folder = small_drop(
        "yields", far_field_friction_angle=0.5, vtk_interval=3e-3, **options
    )
    wall = summary["far_field"]
    assert (wall["friction_angle"], wall["dilatancy"]) == (0.5, 0.0)
    # 3.2e-3; 1.3e-3 with --far-field-interval 1, 0.9e-3 in the rigid box.
    assert summary["energy_residual_relative"] < 5e-3
    assert summary["depth_m"] > elastic["depth_m"]
    # Sand at rest does not flow: it yields beside the projectile, by millimetres.
    assert 1 < wall["largest_displacement_m"] / elastic["far_field"]["largest_displacement_m"] < 10
    moment = meshio.read(sorted((folder / "vtk").glob("*-far-field.vtu"))[0])
    vertical = moment.cell_data["stress_Pa"][0][:, 2]
    # Below the floor: the weight of some 0.1 m of sand at 1600 kg/m3.
    assert -1e4 < vertical.min() < -500


def test_the_continuum_is_as_stiff_as_its_bed_unless_told_otherwise(resting_bed) -> None:
    bed = resting_bed()
    moduli = bed_moduli(bed)
    # Published order of magnitude: the grains' modulus times the cube root of (pressure over it): 2e7 (260/2e7)^(1/3)
    # is 5e5 Pa. The shear modulus rises with the cube root of the pressure, so with that of the grains' density.
    assert 1e5 < moduli.young < 5e5
    assert 0 < moduli.poisson < 0.3
    assert moduli.density == pytest.approx(2650 * bed.report["solid_fraction_core"])


def test_a_stopped_run_goes_on_in_its_continuum(small_drop, wall_cache) -> None:
    options = {"far_field_cache": str(wall_cache), **CONTINUUM}
    whole, _ = small_drop("whole", duration=7e-3, **options)
    _, folder = small_drop("parts", duration=4e-3, **options)
    resumed = drop_test(resume=str(folder), duration=7e-3, no_plots=True, quiet=True)
    assert resumed["steps"] == whole["steps"]
    # Sums in another order; the solver's tolerance is 1e-8 of the largest force.
    assert resumed["depth_m"] == pytest.approx(whole["depth_m"], rel=1e-6)
    assert resumed["far_field"]["strain_energy_J"] == pytest.approx(
        whole["far_field"]["strain_energy_J"], rel=1e-4
    )


def test_a_run_ends_before_the_projectile_reaches_the_continuum(small_drop, wall_cache) -> None:
    # 5 cm of sand, thrown at 12 m/s: the nose would be at the floor after 5 ms.
    summary, _ = small_drop(
        drop_height=None,
        impact_speed=12.0,
        duration=0.02,
        far_field_cache=str(wall_cache),
        no_energy=True,
        **CONTINUUM,
    )
    assert summary["simulated_seconds"] < 0.01
    assert any("of the continuum, with which it has no contact" in n for n in summary["notes"])


def test_a_rigid_box_loads_nothing_of_the_continuum(bed_cache, tmp_path) -> None:
    script = tmp_path / "rigid.py"
    options = {**SMALL, "duration": 1e-3, "no_plots": True, "quiet": True}
    options |= {"bed_cache": str(bed_cache), "output": str(tmp_path / "drop")}
    script.write_text(
        "import os\n"
        "from pathlib import Path\n"
        "import grainfall\n"
        "from grainfall.drop import drop_test\n"
        f"drop_test(**{options!r})\n"
        "maps = Path('/proc/self/maps').read_text()\n"
        "os._exit(('deal.ii' in maps) + 2 * ('femlink' in maps))\n"
    )
    process = start_script({}, script)
    text, _ = process.communicate(timeout=120)
    assert process.returncode == 0, text
