# SPDX-License-Identifier: GPL-2.0-or-later
"""The ledger as an engine: its place, what it refuses, saving and loading, threads, O.energy."""
from __future__ import annotations

import json
import math
import os
import subprocess
from pathlib import Path

import contact_scenes as cs
import ledger_scenes as scenes
import pytest
from yade import EnergyLedger, ForceResetter, Matrix3, NewtonIntegrator, O, wrapper


def collision(law=None, damping: float = 0.0) -> None:
    """Two frictional spheres about to meet; engines without a ledger."""
    O.materials.append(scenes.HARD.material(frictionAngle=0.4, restitution=0.8, label="sphere"))
    cs.add_sphere((0, 0, 0), 0.005, "sphere", (0, 0, 1))
    cs.add_sphere((0.002, 0, math.sqrt(96e-6)), 0.005, "sphere", (0, 0.3, -1))
    O.bodies[0].state.angVel = (100, 0, 50)
    cs.set_engines(law or cs.grain_law(), gravity=(0, 0, -9.81), damping=damping)
    O.dt = cs.HertzImpact.of_equal_spheres(scenes.HARD, 0.005, 2).duration / 100


def refused(match: str, steps: int = 1) -> None:
    """O.step raises in this thread; O.run may have finished before YADE looks for an error."""
    with pytest.raises(RuntimeError, match=match):
        for _ in range(steps):
            O.step()


def test_ledger_before_the_integrator_is_refused():
    collision()
    O.engines = [*O.engines[:-1], EnergyLedger(), O.engines[-1]]
    refused("EnergyLedger stands before NewtonIntegrator in O.engines: must stand after it")


def test_ledger_without_an_integrator_is_refused():
    O.engines = [ForceResetter(), EnergyLedger()]
    refused("EnergyLedger: no NewtonIntegrator in O.engines")


def test_two_integrators_are_refused():
    collision()
    O.engines = [*O.engines, NewtonIntegrator(), EnergyLedger()]
    refused("two NewtonIntegrators")


@pytest.mark.parametrize("engine", ["ForceResetter", "GlobalStiffnessTimeStepper"])
def test_engine_that_changes_forces_or_the_step_in_between_is_refused(engine):
    collision()
    O.engines = [*O.engines, getattr(wrapper, engine)(), EnergyLedger()]
    refused(f"EnergyLedger: {engine} stands between NewtonIntegrator and the ledger")


def test_order_is_looked_at_again_when_the_engines_change():
    collision()
    ledger = scenes.add_ledger()
    O.run(3, True)
    O.engines = [*O.engines[:-2], ledger, O.engines[-2]]
    refused("EnergyLedger stands before")


def test_integrator_that_is_switched_off_is_refused():
    collision()
    scenes.add_ledger()
    O.engines[-2].dead = True
    refused("NewtonIntegrator.dead = True: must be False")


def test_contacts_of_other_laws_are_refused_by_name():
    collision(cs.stock_law())
    scenes.add_ledger(iterPeriod=1)
    refused("contact 0-1 is a MindlinPhys: must be a GrainPhys", steps=30)


def test_deforming_cell_is_refused_and_one_at_rest_is_not():
    O.periodic = True
    O.cell.setBox(1, 1, 1)
    collision()
    ledger = scenes.add_ledger()
    O.run(200, True)
    assert ledger.relativeResidual < 1e-3
    O.cell.velGrad = Matrix3(1, 0, 0, 0, 0, 0, 0, 0, 0)
    refused("O.cell.velGrad is not zero: must be zero", steps=3)


@pytest.mark.parametrize("period", [0, -3])
def test_period_below_one_is_refused(period):
    with pytest.raises(ValueError, match=rf"EnergyLedger.iterPeriod = {period}: must be >= 1"):
        EnergyLedger(iterPeriod=period)
    ledger = EnergyLedger()
    with pytest.raises(ValueError, match="iterPeriod"):
        ledger.iterPeriod = period
    assert ledger.iterPeriod == 100


def test_energies_stand_in_the_scene_s_own_tracker():
    collision()
    O.trackEnergy = False
    ledger = scenes.add_ledger(iterPeriod=1, label="ledger")
    O.run(120, True)
    assert O.trackEnergy
    table, tracker = ledger.table(), dict(O.energy.items())
    for name in ("kineticTranslation", "potential", "elasticNormal", "imposedMotion", "residual"):
        assert tracker["ledger" + name[0].upper() + name[1:]] == table[name]
    for name in ("friction", "viscous", "rescaling", "shearKinematics"):
        assert tracker["grain" + name[0].upper() + name[1:]] == table[name]
    assert table["viscous"] > 0


@pytest.mark.parametrize("period", [1, 7, 100])
def test_reading_does_not_depend_on_the_period(period):
    collision()
    every, seldom = EnergyLedger(iterPeriod=1), EnergyLedger(iterPeriod=period)
    O.engines = [*O.engines, every, seldom]
    O.run(123, True)
    for name, value in every.table().items():
        if name not in ("energyInPlay", "largestResidual", "relativeResidual"):
            assert seldom.table()[name] == value, name


@pytest.mark.parametrize("damping", [0.0, 0.2])
@pytest.mark.parametrize("suffix", [".xml", ".yade.gz"])
def test_all_books_survive_saving_in_mid_impact(suffix, damping, tmp_path):
    collision(damping=damping)
    cs.add_sphere((0, 0, -0.009999), 0.005, "sphere", (0, 0, 1.5), fixed=True)
    scenes.add_ledger(iterPeriod=7)
    O.run(60, True)
    file = str(tmp_path / f"impact{suffix}")
    O.save(file)
    before = O.engines[-1].table()
    assert O.interactions.countReal() == 2
    assert all(before[name] for name in ("elasticShear", "viscous", "imposedMotion"))
    O.run(300, True)
    expected = O.engines[-1].table()
    O.reset()
    O.load(file)
    assert O.engines[-1].table() == pytest.approx(before, rel=1e-14)
    O.run(300, True)
    # Archives keep all digits; the sums are added up in another order at most.
    scale = expected["energyInPlay"]
    assert O.engines[-1].table() == pytest.approx(expected, rel=1e-12, abs=1e-13 * scale)


def test_steps_made_without_the_ledger_start_the_balance_anew():
    collision()
    ledger = scenes.add_ledger()
    O.run(20, True)
    ledger.dead = True
    O.run(20, True)
    O.bodies[0].state.vel = (0, 0, 5)
    ledger.dead = False
    O.run(20, True)
    assert ledger.firstStep == 40
    assert ledger.relativeResidual < 1e-3


def test_restart_forgets_what_was_changed_by_hand():
    collision()
    ledger = scenes.add_ledger()
    O.run(20, True)
    O.bodies[0].state.vel = (0, 0, 5)
    O.run(20, True)
    assert ledger.relativeResidual > 0.1
    ledger.restart()
    O.run(20, True)
    assert ledger.relativeResidual < 1e-3
    assert ledger.lastStep == 59


def test_ledger_outlives_its_scene():
    collision()
    ledger = scenes.add_ledger()
    O.run(20, True)
    told = ledger.table()
    O.reset()
    assert ledger.table() == told


def run_pack(threads: int, output: Path) -> dict:
    script = Path(__file__).with_name("energy_pack.py")
    command = ["yade", "-n", "-x", f"-j{threads}", str(script), str(output)]
    path = os.pathsep.join([str(script.parent), os.environ.get("PYTHONPATH", "")])
    environment = {**os.environ, "OMP_WAIT_POLICY": "passive", "PYTHONPATH": path}
    subprocess.run(command, check=True, capture_output=True, timeout=170, env=environment)
    return json.loads(output.read_text(encoding="utf-8"))


def test_two_threads_book_what_one_does(tmp_path):
    one, two = (run_pack(n, tmp_path / f"{n}.json") for n in (1, 2))
    assert (one.pop("threads"), two.pop("threads")) == (1, 2)
    assert one.pop("contacts") == two.pop("contacts") > 100
    # Sums in another order, and collisions that multiply the rounding of the motion.
    assert two == pytest.approx(one, abs=1e-9 * one["energyInPlay"], rel=1e-9)
