# SPDX-License-Identifier: GPL-2.0-or-later
"""Single grains on a deformable wall in a YADE scene: impact, sliding, rolling, corners (MR-2629, Eq 22-27)."""
from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from femlink_walls import femlink
from wall_scenes import (
    CACHE,
    PATHS,
    QUARTZ,
    RADIUS,
    add_grain,
    array,
    block,
    impact,
    put_engines,
    put_materials,
    rebound,
    run_until,
)
import yade.wrapper
from yade import (
    Bo1_Facet_Aabb,
    GrainMat,
    Ig2_Facet_Sphere_ScGeom,
    O,
    PyRunner,
    utils,
)

RIGID = 1e16  # Pa: gives way by less than 1e-7 of a quartz grain's overlap


def hertz_impact(mass: float, coefficient: float, speed: float) -> tuple[float, float]:
    """Largest force (N) and duration (s) of an elastic impact, F = coefficient d^1.5 (Johnson 1985, sec. 11.4)."""
    overlap = (1.25 * mass * speed**2 / coefficient) ** 0.4
    return coefficient * overlap**1.5, 2.94 * overlap / speed


def on_facets(speed: float) -> tuple[object, object]:
    """The same impact on two rigid triangles of YADE's."""
    O.reset()
    put_materials()
    corners = [(-0.05, -0.05, 0), (0.05, -0.05, 0), (0.05, 0.05, 0), (-0.05, 0.05, 0)]
    for triangle in (corners[:3], [corners[0], corners[2], corners[3]]):
        O.bodies.append(utils.facet(triangle, material="face"))
    grain = add_grain((0.003, 0.002, RADIUS * (1 + 1e-6)), (0, 0, -speed))
    put_engines([], bounds=[Bo1_Facet_Aabb()], geometry=[Ig2_Facet_Sphere_ScGeom(hertzian=True)])
    return None, grain


def peak_and_duration(grain: object, wall: object) -> tuple[float, float]:
    """Largest force on the grain and the time that it felt one; leaves it rebounding."""
    force, steps = 0.0, 0
    while grain.state.vel[2] < 0 or steps == 0 or O.forces.f(grain.id)[2] != 0:
        O.step()
        here = O.forces.f(grain.id)[2]
        force = max(force, here)
        steps += here != 0
        assert O.iter < 2000
    return force, steps * O.dt


def test_a_grain_rebounds_from_theory_facets_and_a_stiff_wall_alike() -> None:
    # 1 %: the step is 1/130 of the impact, and the closed form's duration is rounded to 2.94.
    _, grain = on_facets(1.0)
    facets = (*peak_and_duration(grain, None), grain.state.vel[2])
    wall, grain = impact(RIGID)
    surface = (*peak_and_duration(grain, wall), grain.state.vel[2])
    modulus = 1 / ((1 - 0.2**2) / QUARTZ["young"] * (1 + 1e-3))
    theory = (*hertz_impact(grain.state.mass, 4 / 3 * modulus * RADIUS**0.5, 1.0), 1.0)
    assert surface == pytest.approx(facets, rel=0.01)
    assert surface == pytest.approx(theory, rel=0.01)


@pytest.mark.parametrize("path", PATHS)
def test_an_impact_makes_and_loses_no_energy_however_soft_the_wall(path: str) -> None:
    # K C from 1e-3 (7e10 Pa x 1000) to 1e4: the residual is the leapfrog's, as on a rigid wall: 1e-4 of the energy.
    for young in (RIGID, 7e10, 1e9, 2e7):
        wall, grain = impact(young, path)
        rebound(wall, grain)
        assert grain.state.vel[2] == pytest.approx(1.0, abs=2e-4), young
        assert ledger.largestResidual < 3e-4 * ledger.energyInPlay, young  # noqa: F821
        assert wall.disagreement < 2e-4


def test_both_paths_follow_the_same_impact() -> None:
    ends = []
    for path in PATHS:
        wall, grain = impact(2e7, path, slide=0.3, restitution=0.7)
        O.run(900, True)
        ends.append([array(grain.state.pos), array(grain.state.vel), array(grain.state.angVel)])
    # The same functors in the same order: rounding only.
    np.testing.assert_allclose(ends[0], ends[1], rtol=1e-9, atol=1e-12)


def test_the_wall_lends_its_energy_and_takes_it_back() -> None:
    wall, grain = impact(2e7)
    largest = 0.0
    while grain.state.vel[2] <= 0 or wall.contacts:
        O.run(10, True)
        largest = max(largest, ledger.table()["farField"])  # noqa: F821
    # The soft wall holds nearly all of it at the turning point (K C is 30 there).
    assert 0.9 < largest / (0.5 * grain.state.mass) < 1
    assert ledger.table()["farField"] == 0  # noqa: F821


def test_dashpots_act_on_the_speed_relative_to_the_wall() -> None:
    # On a wall 1000 times as soft as the contact the surfaces hardly approach: next to nothing is lost, though the
    # contact alone has a restitution of 0.3.
    wall, grain = impact(1e6, restitution=0.3)
    rebound(wall, grain)
    assert grain.state.vel[2] > 0.97
    wall, grain = impact(RIGID, restitution=0.3)
    rebound(wall, grain)
    # Schwager & Poschel's overlap at separation makes it a little more than 0.3 here: the law's own tests.
    assert grain.state.vel[2] == pytest.approx(0.3, abs=0.01)


def test_what_the_wall_gets_is_what_the_grains_lose() -> None:
    wall, grain = impact(2e7, slide=0.5)
    for _ in range(5):
        O.run(60, True)
        on_grain = array(O.forces.f(grain.id))
        forces = np.array([array(f) for f in wall.nodeForces()])
        # What was solved for goes to the nodes to rounding; the law finds the same but for the small angle by which
        # a site's axes may lag behind the contact.
        size = np.linalg.norm(on_grain)
        np.testing.assert_allclose(array(wall.force), forces.sum(axis=0), rtol=0, atol=1e-13 * size)
        np.testing.assert_allclose(forces.sum(axis=0), -on_grain, rtol=0, atol=1e-4 * size)
        # About the point of contact the nodal forces have no moment.
        touch = wall.touches()[0]
        nodes = np.array([array(x) for x in wall.nodePositions()])
        rest = nodes - np.array([array(u) for u in wall.nodeDisplacements()])
        point = array(touch["point"]) - array(touch["displacement"])
        moment = np.cross(rest - point, forces).sum(axis=0)
        # The load follows the contact in jumps of 0.5 % of the patch.
        assert np.abs(moment).max() < 0.01 * 0.0125 * np.linalg.norm(forces.sum(axis=0))


def drag(
    wall: object, grain: object, velocity: tuple[float, float], way: float, rolls: bool
) -> np.ndarray:
    """Puts the grain to rest, then pushes it along; (n, 3) forces on it over its weight."""
    grain.state.blockedDOFs = "XYZ"
    newton.damping = 0.3  # noqa: F821
    O.run(6000, True)
    # Dragged slowly: what a bouncing grain would add is not the wall's.
    newton.damping = 0 if rolls else 0.2  # noqa: F821
    grain.state.blockedDOFs = "" if rolls else "xyXYZ"
    grain.state.vel = (*velocity, 0)
    if rolls:
        grain.state.angVel = (-velocity[1] / RADIUS, velocity[0] / RADIUS, 0)
    forces: list[np.ndarray] = []
    yade.wrapper.Omega().engines = O.engines + [PyRunner(iterPeriod=5, command="record()")]
    import __main__

    __main__.record = lambda: forces.append(array(O.forces.f(grain.id)))
    O.run(int(way / np.hypot(*velocity) / O.dt), True)
    return np.array(forces) / (9.81 * grain.state.mass)


def dragged(
    young: float, rolls: bool, cells: int = 10, path: str = "general"
) -> tuple[np.ndarray, object]:
    """A grain crosses 60 mm of a mesh of 10 mm, aslant, over edges and close to corners."""
    O.reset()
    put_materials(restitution=0.3)
    wall = femlink.add_wall(block(young, cells=(cells, cells, 5)), "face", cache=CACHE)
    grain = add_grain((-0.031, -0.0137, RADIUS - 1e-7))
    put_engines([wall], path, gravity=9.81, dt=5e-6 if rolls else 2e-5, ledger=False)
    speed = 1.0 if rolls else 0.2
    forces = drag(wall, grain, (0.95 * speed, 0.31 * speed), 0.06, rolls)
    assert grain.state.pos[0] > 0.02
    return forces, grain


@pytest.mark.parametrize("path", PATHS)
def test_a_grain_dragged_over_the_mesh_feels_constant_friction(path: str) -> None:
    forces, grain = dragged(2e7, rolls=False, path=path)
    steady = forces[len(forces) // 10 :]
    friction = np.hypot(steady[:, 0], steady[:, 1])
    # 1e-3 of the friction: no jump where the contact passes from face to face or close to a corner.
    assert np.abs(friction - 0.5).max() < 1e-3 * 0.5
    assert np.abs(steady[:, 2] - 1).max() < 1e-3
    # Straight back along the way.
    np.testing.assert_allclose(steady[:, 1] / steady[:, 0], 0.31 / 0.95, rtol=1e-3)


def test_a_rolling_grain_goes_on_rolling_over_edges() -> None:
    forces, grain = dragged(2e7, rolls=True)
    steady = forces[len(forces) // 10 :]
    # An elastic wall takes nothing from a rolling grain; the load's jumps over the mesh tug at it by less than 1e-3.
    assert np.hypot(steady[:, 0], steady[:, 1]).max() < 1e-3
    assert np.hypot(grain.state.vel[0], grain.state.vel[1]) == pytest.approx(
        np.hypot(0.95, 0.31), rel=1e-4
    )


def test_shear_history_goes_from_face_to_face() -> None:
    # A grain held by friction is pulled over an edge without sliding: the shear force it started with goes along.
    O.reset()
    put_materials(friction=10.0)
    wall = femlink.add_wall(block(RIGID), "face", cache=CACHE)
    grain = add_grain((-5.2e-7, 0.0031, RADIUS - 1e-6))
    grain.state.blockedDOFs = "xyzXYZ"
    grain.state.vel = (0.1, 0, 0)
    put_engines([wall], dt=1e-7)
    O.run(5, True)
    faces = {touch["face"] for touch in wall.touches()}
    before = O.forces.f(grain.id)[0]
    O.run(100, True)
    assert {touch["face"] for touch in wall.touches()} != faces  # it has crossed x = 0
    # The spring is stretched by 5 and by 105 steps: force in proportion, edge or not.
    assert O.forces.f(grain.id)[0] / before == pytest.approx(21, rel=1e-5)


def in_the_container(place: tuple[float, float, float], path: str) -> tuple[object, object]:
    """A grain in a rigid container of 40 mm, open at z = 0, after one step."""
    O.reset()
    put_materials()
    mesh = femlink.container((0.04, 0.04, 0.04), 0.04, 0.01)
    model = femlink.cached_wall(mesh, {0: (RIGID, 0.3, 1600.0)}, cache=CACHE)
    wall = femlink.add_wall(model, "face", cache=CACHE)
    grain = add_grain(place)
    put_engines([wall], path, dt=1e-7)
    O.step()
    return wall, grain


@pytest.mark.parametrize("path", PATHS)
def test_a_grain_in_a_corner_of_three_faces_has_three_contacts(path: str) -> None:
    inset = RADIUS - 1e-6
    wall, grain = in_the_container((-0.02 + inset, -0.02 + inset, -0.04 + inset), path)
    normals = sorted(tuple(np.round(array(t["normal"]), 6)) for t in wall.touches())
    assert normals == [(0, 0, 1), (0, 1, 0), (1, 0, 0)]
    # Alike in the three directions, so the push is along the diagonal.
    push = array(O.forces.f(grain.id))
    np.testing.assert_allclose(push, push.mean(), rtol=1e-6)
    wall, grain = in_the_container((-0.02 + inset, 0.003, -0.04 + inset), path)
    assert len(wall.touches()) == 2
    wall, grain = in_the_container((0.001, 0.003, -0.04 + inset), path)
    assert len(wall.touches()) == 1


def test_a_grain_on_an_edge_or_a_node_of_a_flat_wall_has_one_contact() -> None:
    for place in ((0.0, 0.003), (0.0, 0.0), (0.01, 0.01), (0.0047, 0.01)):
        O.reset()
        put_materials()
        wall = femlink.add_wall(block(1e9), "face", cache=CACHE)
        add_grain((*place, RADIUS - 1e-6))
        put_engines([wall], dt=1e-7)
        O.step()
        assert len([i for i in O.interactions]) == 1
        assert array(wall.touches()[0]["normal"]) == pytest.approx([0, 0, 1], abs=1e-3)


def test_yade_s_own_linear_law_works_on_the_wall() -> None:
    from yade import (
        Bo1_Sphere_Aabb,
        ForceResetter,
        FrictMat,
        Ig2_Sphere_Sphere_ScGeom,
        InsertionSortCollider,
        InteractionLoop,
        Ip2_FrictMat_FrictMat_FrictPhys,
        Law2_ScGeom_FrictPhys_CundallStrack,
        NewtonIntegrator,
    )

    O.reset()
    O.materials.append(
        FrictMat(young=1e8, poisson=0.3, frictionAngle=0.5, density=2600, label="grain")
    )
    model = block(2e7)
    wall = femlink.add_wall(model, "grain", cache=CACHE)
    grain = add_grain((0.003, 0.002, RADIUS * (1 + 1e-6)), (0, 0, -1.0))
    bounds, geometry, _ = femlink.functors()
    O.engines = [
        ForceResetter(),
        InsertionSortCollider([Bo1_Sphere_Aabb(), *bounds]),
        wall,
        InteractionLoop(
            [Ig2_Sphere_Sphere_ScGeom(), *geometry],
            [Ip2_FrictMat_FrictMat_FrictPhys()],
            [Law2_ScGeom_FrictPhys_CundallStrack()],
        ),
        NewtonIntegrator(damping=0),
    ]
    O.dt = 2e-7
    seconds = rebound(wall, grain, chunk=5) * O.dt
    assert grain.state.vel[2] == pytest.approx(1.0, abs=1e-3)
    # Two springs in series: half a period. The contact is found to 5 steps of about 1500.
    spring = [i.phys.kn for i in O.interactions] or [kn_of(grain)]
    compliance = float(
        femlink.Wall(model).compliance(
            [model.surface.closest((0.003, 0.002, RADIUS))[0]], [[-0.4, -0.6]]
        )[0, 0]
    )
    period = np.pi * np.sqrt(grain.state.mass * (1 / spring[0] + compliance))
    assert seconds == pytest.approx(period, rel=0.01)


def kn_of(grain: object) -> float:
    """YADE's stiffness of a sphere on a plane of its own material: that of two springs E R of 1e8 and 1 radii."""
    return 2 * 1e8 * 1e8 * RADIUS * RADIUS * 1e8 / (1e8 * 1e8 * RADIUS + 1e8 * RADIUS)


def test_two_walls_share_a_scene_and_each_minds_its_own_grain() -> None:
    def run(youngs: dict[float, float]) -> list[np.ndarray]:
        O.reset()
        put_materials()
        walls, grains = [], []
        for x, young in youngs.items():
            walls.append(femlink.add_wall(block(young), "face", cache=CACHE, origin=(x, 0, 0)))
            grains.append(add_grain((x + 0.003, 0.002, RADIUS * (1 + 1e-6)), (0, 0, -1.0)))
        put_engines(walls)
        O.run(300, True)
        return [array(g.state.vel) for g in grains]

    together = run({0.0: 2e7, 0.2: 1e9})
    alone = [*run({0.0: 2e7}), *run({0.2: 1e9})]
    # Independent grains: rounding only, the collider's order of contacts may differ.
    np.testing.assert_allclose(together, alone, rtol=1e-10, atol=1e-12)


def test_a_clump_that_lands_on_the_wall_comes_back_alike_on_both_paths() -> None:
    """Two overlapping grains as one body, dropped flat; its members are in no array of the flat path."""
    ends = []
    for path in PATHS:
        O.reset()
        put_materials()
        wall = femlink.add_wall(block(2e7), "face", cache=CACHE)
        height = RADIUS * (1 + 1e-6)
        grains = [
            utils.sphere((x, 0.002, height), RADIUS, material="grain") for x in (-0.003, 0.003)
        ]
        clump, _ = O.bodies.appendClumped(grains, discretization=20)
        state = O.bodies[clump].state
        state.vel = (0, 0, -1.0)
        put_engines([wall], path)
        O.run(20, True)  # members take the clump's velocity with the first step
        assert wall.contacts == 2
        run_until(lambda: state.vel[2] > 0 and wall.contacts == 0)
        assert state.vel.norm() == pytest.approx(1.0, rel=2e-3)  # nothing is lost but to turning
        assert ledger.largestResidual < 1e-3 * ledger.energyInPlay  # noqa: F821
        ends.append([*state.vel, *state.angVel])
    np.testing.assert_allclose(ends[0], ends[1], rtol=1e-6, atol=1e-6)


def test_moving_the_boundary_pushes_the_grain_and_the_work_is_booked() -> None:
    O.reset()
    put_materials()
    wall = femlink.add_wall(block(2e7), "face", cache=CACHE, velocity=(0, 0, 1.0))
    grain = add_grain((0.003, 0.002, RADIUS * (1 + 1e-4)))
    put_engines([wall])
    run_until(lambda: grain.state.vel[2] > 1 and wall.contacts == 0)
    # An elastic bat: twice the speed; what the boundary has done is the grain's energy.
    assert grain.state.vel[2] == pytest.approx(2.0, abs=1e-3)
    assert wall.boundaryWork == pytest.approx(0.5 * grain.state.mass * 4, rel=2e-3)
    assert ledger.largestResidual < 1e-3 * ledger.energyInPlay  # noqa: F821
    assert wall.shift[2] == pytest.approx(1.0 * (O.iter - 1) * O.dt, rel=1e-9)


def test_ten_grains_of_their_own_material_get_their_own_stiffness() -> None:
    # A material per grain: the wall's solver reads each contact's own law.
    O.reset()
    put_materials()
    wall = femlink.add_wall(block(RIGID), "face", cache=CACHE)
    for i in range(5):
        O.materials.append(GrainMat(**{**QUARTZ, "young": 10.0 ** (7 + i)}, label=f"m{i}"))
        body = utils.sphere((-0.04 + 0.02 * i, 0.003, RADIUS - 1e-6), RADIUS, material=f"m{i}")
        O.bodies.append(body)
    put_engines([wall], dt=1e-9)
    O.step()
    by_sphere = {t["sphere"]: t["force"][2] for t in wall.touches()}
    law = {i.id2: i.phys.normalForce[2] for i in O.interactions}
    assert by_sphere == pytest.approx(law, rel=1e-6)  # the solver's tolerance
    forces = [law[b.id] for b in O.bodies if b.dynamic]
    assert forces == sorted(forces) and forces[-1] > 1000 * forces[0]


def moist(path: str, young: float, speed: float) -> tuple[Any, Any]:
    """A grain with water of its own about to hit the dry block."""
    wall, grain = impact(young, path, speed=speed)
    O.materials[0].gravimetricMoisture = 0.01
    return wall, grain


@pytest.mark.parametrize("path", PATHS)
def test_a_liquid_bridge_pulls_the_wall_as_it_pulls_the_grain(path: str) -> None:
    wall, grain = moist(path, 1e6, 0.01)
    grain.state.blockedDOFs = "xyzXYZ"  # it goes on as it is told
    O.run(20, True)
    grain.state.vel = (0, 0, 10)
    O.run(100, True)  # 0.2 mm up
    grain.state.vel = (0, 0, 0)
    O.run(4, True)
    (contact,) = (i for i in O.interactions if i.isReal)
    pull = contact.phys.bridge.attraction
    assert (
        pull > 1e-3 and contact.phys.normalForce == (0, 0, 0) and contact.geom.penetrationDepth < 0
    )
    # The wall takes the pull of the step before: at rest that is the present one.
    on_nodes = sum(array(force) for force in wall.nodeForces())
    np.testing.assert_allclose(array(wall.force), (0, 0, pull), rtol=1e-9, atol=1e-9 * pull)
    np.testing.assert_allclose(on_nodes, array(wall.force), rtol=0, atol=1e-12 * pull)
    # But for the small angle by which a site's axes may lag behind the contact.
    np.testing.assert_allclose(-array(O.forces.f(grain.id)), on_nodes, rtol=0, atol=1e-4 * pull)
    # It comes towards the grain, by the compliance of a disc and of the springs around it.
    highest = max(u[2] for u in wall.nodeDisplacements())
    assert 0.5 < highest / (pull * femlink.disc_compliance(1e6, 0.3, 1.25 * 0.01)) < 2


@pytest.mark.parametrize("path", PATHS)
def test_a_moist_impact_on_a_soft_wall_loses_what_its_bridge_takes(path: str) -> None:
    wall, grain = moist(path, 2e7, 1.0)
    rebound(wall, grain)
    energies = ledger.table()  # noqa: F821
    assert energies["farField"] == 0
    lost = 0.5 * grain.state.mass * (1 - grain.state.vel[2] ** 2)
    assert lost == pytest.approx(O.energy["grainBridge"], rel=0.05)
    assert ledger.largestResidual < 3e-4 * ledger.energyInPlay  # noqa: F821
