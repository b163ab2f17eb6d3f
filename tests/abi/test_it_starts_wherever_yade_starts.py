# SPDX-License-Identifier: GPL-2.0-or-later
"""Scripts, batches, consoles, threads, other precisions: each in a process of its own."""
from __future__ import annotations

import os
import subprocess
from pathlib import Path

import pytest
from abi_build import LIBRARY_DIR, PACKAGE_DIR

ENVIRONMENT = {**os.environ, "PYTHONPATH": PACKAGE_DIR}

SCENE = """
from yade import *
import grainfall
O.materials.append(GrainMat(young=1e8, restitution=0.8, friction=ExponentialFriction(0.8, 0.2, 5.0), label='sand'))
for i in range(12):
    O.bodies.append(utils.sphere((0.01 * (i % 3), 0.004 * (i % 5), 0.19 * i), 0.1, material='sand', fixed=(i == 0)))
O.engines = [ForceResetter(), InsertionSortCollider([Bo1_Sphere_Aabb()]),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom()], [Ip2_GrainMat_GrainMat_GrainPhys()],
                    [Law2_ScGeom_GrainPhys_HertzMindlin()]),
    NewtonIntegrator(gravity=(0, 0, -9.81), damping=0)]
O.dt = 1e-5
O.run(300, True)
print('TOP', *('%.17g' % x for x in O.bodies[11].state.pos))
"""


def run(*command: str, cwd: Path, stdin: str = "", **variables: str) -> subprocess.CompletedProcess:
    environment = {**ENVIRONMENT, **variables}
    return subprocess.run(
        command, cwd=cwd, env=environment, input=stdin, capture_output=True, text=True, timeout=180
    )


def script(folder: Path, text: str) -> str:
    path = folder / "script.py"
    path.write_text(text, encoding="utf-8")
    return str(path)


def top_of(output: str) -> list[float]:
    return [
        float(x) for x in next(ln for ln in output.splitlines() if ln.startswith("TOP")).split()[1:]
    ]


def test_one_and_two_threads_compute_the_same_trajectory(tmp_path):
    results = []
    for threads in ("-j1", "-j2"):
        done = run("yade", threads, "-n", "-x", script(tmp_path, SCENE), cwd=tmp_path)
        assert done.returncode == 0, done.stdout + done.stderr
        results.append(top_of(done.stdout))
    for one, two in zip(*results, strict=True):
        assert abs(one - two) <= 1e-9 * (1 + abs(one))  # forces are summed in another order


def test_a_batch_runs_each_line_of_its_table(tmp_path):
    text = (
        "from yade import *\nimport grainfall\n"
        "utils.readParamsFromTable(mu=0.1)\nfrom yade.params.table import mu\n"
        "O.materials.append(GrainMat(friction=ConstantFriction(mu)))\n"
        "O.save(O.tags['id'] + '.xml')\n"
        "open('result.%g' % mu, 'w').write(str(O.materials[0].friction.mu))\n"
    )
    (tmp_path / "mu.table").write_text("mu\n0.25\n0.75\n", encoding="utf-8")
    done = run(
        "yade-batch", "-j1", "--log", "$.@.log", "mu.table", script(tmp_path, text), cwd=tmp_path
    )
    assert done.returncode == 0, done.stdout + done.stderr
    written = {path.suffix and path.name: path.read_text() for path in tmp_path.glob("result.*")}
    assert written == {"result.0.25": "0.25", "result.0.75": "0.75"}, done.stdout
    assert len(list(tmp_path.glob("*.xml"))) == 2


def test_in_the_console_the_names_are_at_hand_after_the_import(tmp_path):
    typed = "import grainfall\nprint('MADE', GrainMat(restitution=0.25).restitution)\n"
    done = run("yade", "-n", cwd=tmp_path, stdin=typed)
    assert "MADE 0.25" in done.stdout, done.stdout + done.stderr


def test_engines_from_before_the_import_accept_our_bodies(tmp_path):
    # The default engines exist when YADE starts; without a refresh the first step ends the process.
    text = """
from yade import *
from yade import utils
import grainfall
body = Body()
body.shape, body.material = SolidOfRevolution(), GrainMat()
O.engines = O.engines + [ParallelEngine([[InteractionLoop([], [], [])]])]
O.bodies.append(utils.sphere((0, 0, 0), 0.1, material=GrainMat()))
O.bodies.append(body)
O.dt = 1e-9
O.step()
O.reset()
O.engines = utils.defaultEngines
O.bodies.append(utils.sphere((0, 0, 0), 0.1, material=GrainMat()))
O.step()
print('STEPS', O.iter)
"""
    done = run("yade", "-n", "-x", script(tmp_path, text), cwd=tmp_path)
    assert "STEPS 1" in done.stdout, done.stdout + done.stderr


def test_a_file_with_our_classes_opens_after_the_import_only(tmp_path):
    saved = run(
        "yade", "-n", "-x", script(tmp_path, SCENE + "O.save('scene.yade.gz')\n"), cwd=tmp_path
    )
    assert saved.returncode == 0, saved.stdout + saved.stderr
    load = "O.load('scene.yade.gz')\nO.run(10, True)\nprint('LOADED', O.iter)\n"
    with_us = run("yade", "-n", "-x", script(tmp_path, "import grainfall\n" + load), cwd=tmp_path)
    assert "LOADED 310" in with_us.stdout, with_us.stdout + with_us.stderr
    without = run("yade", "-n", "-x", script(tmp_path, load), cwd=tmp_path)
    assert "unregistered class" in without.stderr and "LOADED" not in without.stdout


@pytest.mark.parametrize("name, bits", [("longdouble", 80), ("float128", 128), ("mpfr150", 498)])
def test_another_precision_is_refused_in_one_sentence(name, bits, tmp_path):
    done = run(f"yade-{name}", "-n", "-x", script(tmp_path, "import grainfall\n"), cwd=tmp_path)
    assert (
        f"ImportError: grainfall found YADE 2023.02a ({bits}-bit real numbers), "
        "but only YADE 2023.02a (64-bit real numbers) is verified.\n"
    ) in done.stderr


def test_a_python_without_yade_is_told_what_to_start(tmp_path):
    done = run("/usr/bin/python3", "-c", "import grainfall", cwd=tmp_path)
    assert done.returncode == 1
    assert "ImportError: grainfall found no YADE in this interpreter" in done.stderr
    assert "start the script with 'yade'" in done.stderr


def test_a_plain_python_that_knows_yade_s_folder_works_too(tmp_path):
    paths = f"{PACKAGE_DIR}:{LIBRARY_DIR}/py"
    code = "import grainfall, yade; print('KNOWN', yade.GrainMat().restitution, GrainMat is yade.GrainMat)"
    done = run("/usr/bin/python3", "-c", code, cwd=tmp_path, PYTHONPATH=paths)
    assert "KNOWN 1.0 True" in done.stdout, done.stdout + done.stderr
