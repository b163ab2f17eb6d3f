# SPDX-License-Identifier: GPL-2.0-or-later
"""A saved contact goes on as if never saved; the number of threads does not change the physics."""
from __future__ import annotations

import json
import os
import subprocess
from pathlib import Path

import contact_scenes as cs
import numpy as np
import pytest
from yade import (
    AsperityFriction,
    ConstantFriction,
    ExponentialFriction,
    GrainPair,
    MoistureFactor,
    O,
    PowerLawFriction,
    TableFriction,
)

SOLID = cs.Solid(1.0e9, 0.25, 2500)
RADIUS = 0.005
SPEED = 2.0

CURVES = {
    "constant": lambda: ConstantFriction(0.3),
    "power law": lambda: PowerLawFriction(0.4, 1.0, 0.3, 0.1, 0.9),
    "exponential": lambda: ExponentialFriction(0.8, 0.2, 5.0),
    "asperity": lambda: AsperityFriction(0.2, 0.3, 0.9),
    "table": lambda: TableFriction([0.1, 10.0], [0.0, 0.1], [[0.9, 0.7], [0.2, 0.1]]),
}


def impact_under_way(friction) -> None:
    """Two spinning spheres collide obliquely, one with a plane as well; stops in mid impact."""
    friction.moistureFactor = MoistureFactor([0.0, 0.1], [1.0, 0.7])
    values = dict(friction=friction, restitution=0.7, gravimetricMoisture=0.04)
    O.materials.append(
        [SOLID.rigid_material(label="plane", **values), SOLID.material(label="sphere", **values)]
    )
    cs.add_plane("plane")
    lower = cs.add_sphere((0, 0, RADIUS), RADIUS, "sphere", velocity=(0.5, 0, -0.2))
    upper = cs.add_sphere((0, 0.4 * RADIUS, 2.95 * RADIUS), RADIUS, "sphere", (-1, 0.5, -SPEED))
    O.bodies[lower].state.angVel = (0, 100, 50)
    O.bodies[upper].state.angVel = (80, 0, 0)
    pair = GrainPair("sphere", "plane", restitution=0.9)
    cs.set_engines(cs.grain_law({"pairs": [pair]}))
    O.dt = cs.HertzImpact.of_equal_spheres(SOLID, RADIUS, SPEED).duration / 300
    O.run(120, True)
    assert O.interactions.countReal() == 2
    assert all(i.phys.shearForce.norm() > 0 for i in O.interactions if i.isReal)


def movers() -> list[float]:
    """Position, orientation, velocity and spin of each sphere, every bit of them."""
    numbers = []
    for body in O.bodies:
        if body.dynamic:
            state = body.state
            numbers += [*state.pos, *state.ori, *state.vel, *state.angVel]
    return numbers


@pytest.mark.parametrize("suffix", [".xml", ".xml.gz", ".yade", ".yade.gz"])
@pytest.mark.parametrize("name", CURVES)
def test_impact_saved_half_way_continues_to_the_last_bit(name, suffix, tmp_path):
    impact_under_way(CURVES[name]())
    file = str(tmp_path / f"impact{suffix}")
    O.save(file)
    before = movers()
    O.run(400, True)
    expected = movers()
    O.reset()
    O.load(file)
    assert movers() == before
    O.run(400, True)
    # No body has more than two contacts, so their order cannot matter: equal, not nearly equal.
    assert movers() == expected


@pytest.mark.parametrize("name", CURVES)
def test_material_comes_back_with_its_friction(name, tmp_path):
    impact_under_way(CURVES[name]())
    loads = (0.05, 0.5, 5.0, 50.0)
    told = [O.materials["sphere"].friction.coefficient(n, 0.04) for n in loads]
    file = str(tmp_path / "impact.xml")
    O.save(file)
    O.reset()
    O.load(file)
    material = O.materials["sphere"]
    assert [material.friction.coefficient(n, 0.04) for n in loads] == told
    assert (material.restitution, material.gravimetricMoisture) == (0.7, 0.04)


def test_elastic_energy_is_known_as_soon_as_a_scene_is_loaded(tmp_path):
    """Without dashpots: YADE does not save overlaps, and the force alone tells them."""
    O.materials.append(SOLID.material(frictionAngle=0.5))
    for n in range(2):
        cs.add_sphere((0, 0, 1.99 * n * RADIUS), RADIUS, 0)
    law = cs.grain_law()
    cs.set_engines(law)
    O.dt = 1e-6
    O.run(3, True)
    before = law[1][0].elasticEnergy()
    O.save(str(tmp_path / "pair.xml"))
    O.reset()
    O.load(str(tmp_path / "pair.xml"))
    after = O.engines[2].lawDispatcher.functors[0].elasticEnergy()
    assert before["normal"] > 0
    assert after["normal"] == pytest.approx(before["normal"], rel=1e-12)


def run_pack(threads: int, output: Path, *arguments: str) -> dict:
    script = Path(__file__).with_name("friction_pack.py")
    command = ["yade", "-n", "-x", f"-j{threads}", str(script), str(output), *arguments]
    # Threads that wait without spinning: else two of them crawl where a core is shared.
    environment = {**os.environ, "OMP_WAIT_POLICY": "passive"}
    subprocess.run(command, check=True, capture_output=True, timeout=170, env=environment)
    return json.loads(output.read_text(encoding="utf-8"))


@pytest.mark.parametrize(
    "law, moisture",
    [("incremental", "0"), ("incremental", "0.01"), ("mindlin-deresiewicz", "0.01")],
)
def test_two_threads_settle_a_frictional_pack_as_one_does(law, moisture, tmp_path):
    one, two = (run_pack(n, tmp_path / f"{n}.json", law, moisture) for n in (1, 2))
    assert (one["threads"], two["threads"]) == (1, 2)
    assert one["contacts"] > 300
    size = np.ptp(np.array(one["position"]), axis=0).max()
    difference = np.abs(np.array(one["position"]) - np.array(two["position"])).max()
    # Threads add forces in another order: rounding, multiplied by the collisions of settling.
    assert difference < 1e-9 * size
