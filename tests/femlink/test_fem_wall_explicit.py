# SPDX-License-Identifier: GPL-2.0-or-later
"""A wall with inertia under grains: waves carry energy away, soil yields, the books close (MR-2629, section 5.2)."""
from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from femlink_walls import femlink
from wall_scenes import (
    CACHE,
    PATHS,
    RADIUS,
    add_grain,
    array,
    block,
    put_engines,
    put_materials,
    run_until,
)
from yade import FemWall, HertzTimeStepper, O

STEP = 5e-7  # s


def solid(young: float = 2e9, **law: object) -> object:
    return femlink.Solid(young, 0.3, 1600.0, **law)


def impact(
    material: object,
    path: str = "general",
    speed: float = 1.0,
    slide: float = 0.0,
    **options: object,
) -> tuple[object, object]:
    """A steel-heavy grain about to hit a block of 60 x 60 x 30 mm; wall engine and grain."""
    O.reset()
    put_materials()
    mesh = femlink.box((0.06, 0.06, 0.03), (6, 6, 3))
    wall = femlink.add_explicit_wall(mesh, {0: material}, "face", **options)
    grain = add_grain((0.003, 0.002, RADIUS * (1 + 1e-6)), (slide, 0, -speed))
    put_engines([wall], path, dt=STEP)
    return wall, grain


def leave(wall: object, grain: object) -> None:
    run_until(lambda: grain.state.vel[2] > 0 and wall.contacts == 0, most=40000)


def test_a_stiff_heavy_wall_sends_the_grain_back() -> None:
    wall, grain = impact(femlink.Solid(1e14, 0.3, 1e9))
    leave(wall, grain)
    # Momentum of 1.4 g at 1 m/s into cells of tonnes: nothing is lost but what the leapfrog loses, 1e-3.
    assert grain.state.vel[2] == pytest.approx(1.0, abs=2e-3)


@pytest.mark.parametrize("path", PATHS)
@pytest.mark.parametrize("outer", ["fixed", "absorbing"])
def test_what_the_grain_loses_is_in_the_waves_or_went_through_the_boundary(
    outer: str, path: str
) -> None:
    wall, grain = impact(solid(), path, outer=outer, slide=0.3)
    leave(wall, grain)
    books = ledger.table()  # noqa: F821
    lost = 0.5 * grain.state.mass * (1.09 - sum(v * v for v in grain.state.vel))
    assert lost > 0
    # Forces are exchanged once a step: the wall's work is a sum of F(n) du, the grain's leapfrog a mean: 1 %.
    assert ledger.largestResidual < 0.01 * ledger.energyInPlay  # noqa: F821
    carried = books["farField"] + books["farFieldDissipation"]
    assert carried == pytest.approx(
        lost - books["friction"] - books["rescaling"], abs=0.02 * lost + 1e-6
    )
    assert (books["farFieldDissipation"] > 0) == (outer == "absorbing")


def test_both_paths_find_the_same() -> None:
    ends = []
    for path in PATHS:
        wall, grain = impact(solid(), path, slide=0.3)
        O.run(300, True)
        ends.append((array(grain.state.pos), array(grain.state.vel)))
    np.testing.assert_allclose(ends[0], ends[1], rtol=1e-9, atol=1e-13)


def test_a_slow_load_meets_the_quasi_static_wall() -> None:
    # Pushed in by 20 um in 1 ms, 10 times as long as the block's slowest wave crosses it. Both walls of degree 1; at
    # rest the explicit one's displacement is within 1.6 % of the other's (docs/physics/far_field.md).
    forces = []
    for explicit in (False, True):
        O.reset()
        put_materials(friction=0.0)
        if explicit:
            mesh = femlink.box((0.06, 0.06, 0.03), (6, 6, 3))
            wall = femlink.add_explicit_wall(mesh, {0: solid(2e8)}, "face", outer="fixed")
        else:
            model = block(2e8, size=(0.06, 0.06, 0.03), cells=(6, 6, 3))
            wall = femlink.add_wall(model, "face", cache=CACHE)
        grain = add_grain((0.003, 0.002, RADIUS), (0, 0, -0.02))
        grain.state.blockedDOFs = "xyzXYZ"
        put_engines([wall], dt=1e-6, ledger=False)
        O.run(1000, True)
        forces.append(O.forces.f(grain.id)[2])
    assert forces[1] == pytest.approx(forces[0], rel=0.03)


def test_soil_that_yields_keeps_the_crater_and_the_energy() -> None:
    wall, grain = impact(solid(2e8), speed=2.0, outer="absorbing")
    leave(wall, grain)
    elastic = grain.state.vel[2]
    wall, grain = impact(
        solid(2e8, law="j2", yield_stress=1e4, hardening=1e5), speed=2.0, outer="absorbing"
    )
    leave(wall, grain)
    plastic = wall.continuum.energies["plastic"]
    energy = 0.5 * grain.state.mass * 4
    assert plastic > 0.01 * energy
    assert grain.state.vel[2] < elastic
    assert ledger.largestResidual < 0.02 * ledger.energyInPlay  # noqa: F821
    # What it has not got back went into flow, through the boundary, or still is in the block.
    assert energy - 0.5 * grain.state.mass * grain.state.vel[2] ** 2 > plastic
    O.bodies.erase(grain.id)
    ledger.restart()  # noqa: F821
    O.run(4000, True)
    depth = np.array([array(u) for u in wall.nodeDisplacements()])[:, 2].min()
    assert depth < -1e-5  # m: a dent stays, long after the waves have left


@pytest.mark.parametrize("interval", [1, 4])
def test_saved_in_the_middle_it_goes_on_to_the_last_bit(interval: int, tmp_path: Path) -> None:
    wall, grain = impact(
        solid(law="j2", yield_stress=1e6), "flat", interval=interval, outer="absorbing", slide=0.2
    )
    O.run(40, True)
    assert wall.contacts == 1
    scene = str(tmp_path / "scene.yade.gz")
    O.save(scene)
    O.run(50, True)
    went_on = array(O.bodies[grain.id].state.pos), array(wall.nodePositions())
    O.load(scene)
    O.run(50, True)
    wall = next(e for e in O.engines if isinstance(e, FemWall))
    assert (array(O.bodies[grain.id].state.pos) == went_on[0]).all()
    assert (array(wall.nodePositions()) == went_on[1]).all()


def test_dry_sand_that_bears_its_weight_yields_under_a_grain_and_goes_on_from_a_file(
    tmp_path: Path,
) -> None:
    dry = solid(2e8, law="drucker-prager", friction_angle=0.6)
    wall, grain = impact(dry, "flat", outer="absorbing", gravity=(0, 0, -9.81))
    O.run(200, True)
    scene = str(tmp_path / "scene.yade.gz")
    O.save(scene)
    O.run(50, True)
    went_on = array(O.bodies[grain.id].state.pos), array(wall.nodePositions())
    books = wall.continuum.energies
    assert 0 < books["plastic"] < 0.5 * grain.state.mass
    assert ledger.largestResidual < 0.02 * ledger.energyInPlay  # noqa: F821
    O.load(scene)
    O.run(50, True)
    wall = next(e for e in O.engines if isinstance(e, FemWall))
    assert (array(O.bodies[grain.id].state.pos) == went_on[0]).all()
    assert (array(wall.nodePositions()) == went_on[1]).all()


def test_moving_the_continuum_seldom_costs_little_accuracy() -> None:
    speeds = []
    for interval in (1, 5):
        wall, grain = impact(solid(2e8), interval=interval, outer="absorbing")
        leave(wall, grain)
        speeds.append(grain.state.vel[2])
    # The forces that move it are half an interval old on the average: 1.25 us of an impact of some 100 us.
    assert speeds[1] == pytest.approx(speeds[0], abs=0.05)


def test_the_time_stepper_knows_the_wall_s_nodes() -> None:
    # Cells so light that a quartz contact on them swings faster than the grain itself.
    wall, grain = impact(femlink.Solid(2e9, 0.3, 0.01))
    stepper = HertzTimeStepper(safety=0.5)
    O.engines = [*O.engines[:4], stepper, *O.engines[4:]]
    O.dt = 1e-9
    O.run(60, True)
    assert stepper.reason == "a contact on the nodes of a wall with inertia"
    assert grain.id in stepper.decidingContact


def test_bad_input_is_refused() -> None:
    O.reset()
    put_materials()
    mesh = femlink.box((0.06, 0.06, 0.03), (2, 2, 1))
    with pytest.raises(ValueError, match="element = 'tetra'"):
        femlink.add_explicit_wall(mesh, {0: solid()}, "face", element="tetra")
    with pytest.raises(
        ValueError, match="FemWall.velocity = .*0 with a continuum that has inertia"
    ):
        femlink.add_explicit_wall(mesh, {0: solid()}, "face", velocity=(0, 0, 1.0))
