# SPDX-License-Identifier: GPL-2.0-or-later
"""ProjectileLoad: forces by zone, and what they must sum to; files; threads."""

from __future__ import annotations

import json
import os
import subprocess
import textwrap
from pathlib import Path

import numpy as np
import pytest
from projectile_scene import engines, grain, material, run, vector
from yade import O, Vector3, wrapper

from grainfall.projectiles import (
    flat_cylinder,
    make_projectile,
    pointing,
    projectile_forces,
)

ZONES = ("nose", "shaft", "base")


def buried_projectile(grains=300):
    """A tilted projectile among grains that touch it, with friction."""
    material(friction_angle=0.4)
    body = make_projectile("m70-half", orientation=pointing((0.3, 0.2, -1)))
    O.bodies.append(body)
    random = np.random.default_rng(7)
    radius = 0.003
    while len(O.bodies) <= grains:
        local = random.uniform((-0.02, -0.02, -0.055), (0.02, 0.02, 0.045))
        if abs(body.shape.closestPoint(local)[0] - radius) < 1e-4:
            grain(body.state.pos + body.state.ori * Vector3(*local), radius, (0, 0, 0.2))
    return body


def test_forces_and_moments_by_zone_sum_to_what_the_integrator_receives():
    body = buried_projectile()
    load = engines(1e-6, load_of=body.id)
    run(50)
    assert load.noseContacts > 5 and load.shaftContacts > 5 and load.baseContacts > 5
    force, torque = vector(O.forces.f(body.id)), vector(O.forces.t(body.id))
    assert vector(load.totalForce) == pytest.approx(force, abs=1e-12 * np.linalg.norm(force))
    assert vector(load.totalTorque) == pytest.approx(torque, abs=1e-11 * np.linalg.norm(torque))
    assert sum(vector(getattr(load, z + "Force")) for z in ZONES) == pytest.approx(
        vector(load.totalForce)
    )
    now = projectile_forces(body)
    assert now["contacts"] == load.contacts
    assert vector(now["shaft"]) == pytest.approx(vector(load.shaftForce), rel=1e-12)


def test_a_force_belongs_to_the_zone_that_is_touched():
    material()
    a, length, radius = 0.05, 0.2, 0.01
    body = make_projectile(flat_cylinder(2 * a, length, density=1000.0))
    O.bodies.append(body)
    reach = radius - 1e-5
    grain((0.02, 0, -length / 2 - reach), radius)
    grain((a + reach, 0, 0.03), radius)
    grain((0.01, 0, length / 2 + reach), radius)
    load = engines(1e-9, load_of=body.id)
    run(1)
    nose, shaft, base = (vector(getattr(load, z + "Force")) for z in ZONES)
    assert nose[2] > 0 and np.abs(nose[:2]).max() < 1e-12 * nose[2]
    assert shaft[0] < 0 and np.abs(shaft[1:]).max() < 1e-12 * -shaft[0]
    assert base[2] < 0 and np.abs(base[:2]).max() < 1e-12 * -base[2]
    # Moment about the centroid: position of the contact times force.
    half = 0.5e-5
    assert load.noseTorque[1] == pytest.approx(-0.02 * nose[2], rel=1e-9)
    assert load.shaftTorque[1] == pytest.approx(0.03 * shaft[0], rel=1e-9)
    assert load.baseTorque[1] == pytest.approx(-0.01 * base[2], rel=1e-9)
    assert load.shaftTorque[2] == pytest.approx(0, abs=half * 1e-6 * -shaft[0])


def test_a_wrong_body_is_an_error_that_names_it():
    material()
    other = grain((0, 0, 0), 0.01)
    for number in (-1, other.id, 17):
        with pytest.raises(RuntimeError, match=rf"ProjectileLoad.body = {number}; allowed: id of"):
            wrapper.ProjectileLoad(body=number)()


@pytest.mark.parametrize("suffix", [".xml", ".yade.gz"])
def test_a_run_saved_in_mid_contact_goes_on_as_if_it_had_not_been(tmp_path, suffix):
    body = buried_projectile(60)
    engines(1e-6, load_of=body.id)
    run(100)
    path = str(tmp_path / ("scene" + suffix))
    O.save(path)
    run(100)
    expected = list(body.state.pos) + list(body.state.vel) + list(body.state.angVel)
    force = list(O.engines[3].totalForce)
    O.reset()
    O.load(path)
    run(100)
    body = O.bodies[0]
    actual = list(body.state.pos) + list(body.state.vel) + list(body.state.angVel)
    # Text files keep 17 digits; the scene is too short to amplify the last one.
    assert actual == pytest.approx(expected, rel=1e-9, abs=1e-12)
    assert list(O.engines[3].totalForce) == pytest.approx(force, rel=1e-7)
    assert body.shape.zones == [] and body.shape.volume > 0


SCENE = """
    import json, sys
    sys.path.insert(0, {folder!r})
    import grainfall
    from yade import O
    from test_projectile_load import buried_projectile
    from projectile_scene import engines, run
    body = buried_projectile()
    load = engines(1e-6, load_of=body.id, en=0.8)
    run(300)
    state = body.state
    print("result", json.dumps([list(state.pos), list(state.vel), list(state.angVel),
                                list(load.noseForce), list(load.shaftForce), list(load.baseForce)]))
"""


def test_two_threads_give_the_answer_of_one(tmp_path):
    # The order of summation differs: 1e-9 of the largest component after 300 steps in contact.
    script = tmp_path / "scene.py"
    script.write_text(textwrap.dedent(SCENE.format(folder=str(Path(__file__).parent))))

    def result(threads):
        out = subprocess.run(
            ["yade", f"-j{threads}", "-n", "-x", str(script)],
            capture_output=True,
            text=True,
            timeout=120,
            env={**os.environ, "OMP_NUM_THREADS": str(threads)},
        ).stdout
        line = next(line for line in out.splitlines() if line.startswith("result "))
        return [np.array(values) for values in json.loads(line[len("result ") :])]

    for one, two in zip(result(1), result(2)):
        assert np.abs(one - two).max() <= 1e-9 * np.abs(one).max()
