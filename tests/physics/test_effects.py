# SPDX-License-Identifier: GPL-2.0-or-later
"""Each contact runs what its own bodies ask for; what cannot act is said once; contacts follow changed materials."""
from __future__ import annotations

import math
import os
import subprocess
from pathlib import Path

import contact_scenes as cs
import pytest
from grainfall.effects import print_effects, running_effects
from grainfall.materials import check_scene
from priced_heap import heap
from yade import (
    ConstantFriction,
    GrainEffectPhys,
    GrainMat,
    GrainPair,
    GrainPhys,
    MoistureFactor,
    O,
    PowerLawFriction,
    TableFriction,
)

RADIUS = 2e-3
SOLID = cs.Solid(1e8, 0.2, 2650)


def law_and_maker() -> tuple:
    """The contact law of the scene in hand and what makes its contacts."""
    loop = O.engines[2]
    return loop.lawDispatcher.functors[0], loop.physDispatcher.functors[0]


def bed_with_a_wet_layer(grains: int = 7, wet: int = 3) -> None:
    """A column of touching grains, the one numbered `wet` moist."""
    O.materials.append(
        [
            SOLID.material(label="dry", restitution=0.8),
            SOLID.material(label="moist", restitution=0.8, gravimetricMoisture=0.01),
        ]
    )
    for n in range(grains):
        label = "moist" if n == wet else "dry"
        cs.add_sphere((0, 0, 1.999 * n * RADIUS), RADIUS, label, fixed=True)
    cs.set_engines(cs.grain_law())
    O.dt = 1e-6
    O.run(1, True)


def test_in_a_dry_bed_with_one_wet_layer_the_dry_contacts_run_the_dry_kernel():
    """Six contacts, two of them with the moist grain: half of its water's bridges goes to each."""
    bed_with_a_wet_layer()
    law, _ = law_and_maker()
    assert law.kernels == {
        "normal hertz; tangential incremental; friction: constant; dashpot": 4,
        "normal hertz; tangential incremental; friction: constant; dashpot; liquid bridges: willett": 2,
    }
    for i in O.interactions:
        assert (i.phys.bridge is not None) == (3 in (i.id1, i.id2))
    assert (
        law.effects["liquid bridges: willett"] == "moist: gravimetricMoisture 0.01; 2 contacts now"
    )


def test_a_dry_contact_in_a_moist_bed_pushes_as_in_a_dry_bed():
    """The force between two dry grains does not know of the wet layer: equal to the last bit."""
    forces = []
    for wet in (3, None):
        O.reset()
        bed_with_a_wet_layer(wet=wet)
        forces.append([*O.interactions[0, 1].phys.normalForce])
    assert forces[0] == forces[1]
    assert forces[0][2] > 0


@pytest.mark.parametrize("curve", ["load", "moisture", "scale"])
def test_effects_count_the_contacts_that_run_them(curve):
    attributes = {
        "load": dict(friction=PowerLawFriction()),
        "moisture": dict(
            friction=TableFriction([1, 2], [0, 0.1], [[0.5, 0.4], [0.4, 0.3]]),
            gravimetricMoisture=0.02,
            bridgeModel="none",
        ),
        "scale": dict(friction=PowerLawFriction(), referenceRadius=1e-4),
    }[curve]
    O.materials.append([SOLID.material(label="plain"), SOLID.material(label="sand", **attributes)])
    for n, label in enumerate(("plain", "plain", "sand", "sand")):
        cs.add_sphere((0, 0, 1.999 * n * RADIUS), RADIUS, label, fixed=True)
    cs.set_engines(cs.grain_law())
    O.dt = 1e-6
    O.run(1, True)
    law, _ = law_and_maker()
    # plain-sand reads a combination of both curves, so that two of three contacts run the effect.
    reasons = " ".join(law.effects.values())
    assert "2 contacts now" in reasons if curve != "load" else "1 contacts now" in reasons
    effect = {"moisture": "moisture in friction", "scale": "load scaling"}.get(curve)
    if effect is not None:
        assert law.effects[effect].endswith("2 contacts now")


def test_a_table_with_one_load_is_a_constant_and_runs_as_one():
    """There is nothing to look up: the contact carries one number."""
    table = TableFriction([1], [0, 0.1], [[0.5, 0.3]])
    O.materials.append(
        SOLID.material(label="sand", friction=table, gravimetricMoisture=0.05, bridgeModel="none")
    )
    for n in range(2):
        cs.add_sphere((0, 0, 1.999 * n * RADIUS), RADIUS, "sand", fixed=True)
    cs.set_engines(cs.grain_law())
    O.run(1, True)
    phys = O.interactions[0, 1].phys
    assert phys.friction is None
    assert math.tan(phys.tangensOfFrictionAngle) > 0
    assert phys.tangensOfFrictionAngle == pytest.approx(0.4, rel=1e-12)


def test_a_contact_without_effects_has_no_places_for_them():
    """In a bed with one moist layer: what a dry contact shows of effects is nothing, not an empty place."""
    bed_with_a_wet_layer()
    effects = {"friction", "moisture", "loadScale", "partialSlip", "bridge"}
    for i in O.interactions:
        wet = 3 in (i.id1, i.id2)
        assert isinstance(i.phys, GrainPhys)
        assert isinstance(i.phys, GrainEffectPhys) == wet
        assert effects & set(i.phys.dict()) == (effects if wet else set())
    dry = O.interactions[0, 1].phys
    assert [dry.friction, dry.partialSlip, dry.bridge] == [None] * 3
    assert (dry.moisture, dry.loadScale) == (0, 1)


WET = dict(gravimetricMoisture=0.005)
IDLE = {
    "moisture curve in a dry scene": (
        dict(friction=TableFriction([1], [0, 0.1], [[0.5, 0.4]])),
        {},
        {},
        "sand: friction depends on moisture, but the scene has no water",
    ),
    "moisture factor in a dry scene": (
        dict(friction=ConstantFriction(0.5, moistureFactor=MoistureFactor([0, 0.1], [1, 0.5]))),
        {},
        {},
        "sand: friction depends on moisture, but the scene has no water",
    ),
    "water that nothing reads": (
        dict(bridgeModel="none", **WET),
        {},
        {},
        "sand: gravimetricMoisture has no effect: there are no bridges and no friction depends on moisture",
    ),
    "more water than bridges hold": (
        dict(gravimetricMoisture=0.023, density=2650),
        {},
        {},
        "sand: bridges hold 0.0851 R^3; above 0.0577 R^3",
    ),
    "bridge volume without bridges": (
        dict(bridgeVolume=1e-12, bridgeModel="none"),
        {},
        {},
        "sand: bridgeVolume has no effect with bridgeModel 'none'",
    ),
    "viscosity without bridges": (
        dict(liquidViscosity=1e-3),
        {},
        {},
        "sand: liquidViscosity has no effect: the scene has no liquid bridges",
    ),
    "coarse grain with constant friction": (
        dict(friction=0.4, referenceRadius=1e-4),
        {},
        {},
        "sand: referenceRadius has no effect on constant friction",
    ),
    "friction of a frictionless law": (
        dict(friction=PowerLawFriction()),
        {},
        dict(tangentialLaw="none"),
        "sand: friction has no effect with tangentialLaw 'none'",
    ),
    "partial slip without friction": (
        dict(friction=0),
        {},
        dict(tangentialLaw="mindlin-deresiewicz"),
        "tangentialLaw 'mindlin-deresiewicz' has no effect: friction is 0 everywhere; 'none' costs less",
    ),
    "dashpot of an elastic grain": (
        dict(restitution=1),
        dict(dashpotAttraction=True),
        {},
        "Ip2_GrainMat_GrainMat_GrainPhys.dashpotAttraction has no effect: no restitution is below 1, so that "
        "there is no dashpot",
    ),
}


@pytest.mark.parametrize("name", IDLE)
def test_what_cannot_act_is_said_by_the_check_of_the_scene(name):
    material, maker, law, sentence = IDLE[name]
    O.materials.append(GrainMat(label="sand", **material))
    cs.set_engines(cs.grain_law(maker, **law))
    (warning,) = check_scene()
    assert warning.startswith(sentence)


ACTING = {
    "moisture curve in a moist scene": (
        dict(friction=TableFriction([1], [0, 0.1], [[0.5, 0.4]]), **WET),
        {},
        {},
    ),
    "viscous bridges": (dict(liquidViscosity=1e-3, **WET), {}, {}),
    "coarse moist grain": (dict(referenceRadius=1e-4, **WET), {}, {}),
    "coarse grain, curve of its pair": (
        dict(referenceRadius=1e-4),
        dict(pairs=[GrainPair("sand", "sand", friction=PowerLawFriction())]),
        {},
    ),
    "partial slip, friction of a pair": (
        dict(friction=0),
        dict(pairs=[GrainPair("sand", "sand", friction=0.3)]),
        dict(tangentialLaw="mindlin-deresiewicz"),
    ),
    "dashpot of a pair": (
        dict(),
        dict(pairs=[GrainPair("sand", "sand", restitution=0.5)], dashpotAttraction=True),
        {},
    ),
    "frictionless, as asked": (dict(friction=0), {}, dict(tangentialLaw="none")),
}


@pytest.mark.parametrize("name", ACTING)
def test_nothing_is_said_of_what_acts(name):
    material, maker, law = ACTING[name]
    O.materials.append(GrainMat(label="sand", **material))
    cs.set_engines(cs.grain_law(maker, **law))
    assert check_scene() == []


LOGGED = """
import sys
import grainfall
from yade import *
from grainfall.materials import check_scene
O.materials.append(GrainMat(label="sand", liquidViscosity=1e-3, friction=0.5))
for n in range(4):
    O.bodies.append(utils.sphere((0, 0, 1.99e-3 * n), 1e-3, material="sand"))
O.engines = [ForceResetter(), InsertionSortCollider([Bo1_Sphere_Aabb()]),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom()], [Ip2_GrainMat_GrainMat_GrainPhys()],
                    [Law2_ScGeom_GrainPhys_HertzMindlin(tangentialLaw="none")]), NewtonIntegrator()]
O.dt = 1e-7
if "checked" in sys.argv:
    assert len(check_scene()) == 2
O.run(10, True)
O.interactions.clear()
O.run(10, True)
"""


@pytest.mark.parametrize("checked, times", [(False, 1), (True, 0)])
def test_what_cannot_act_is_logged_once_unless_it_was_asked_for(checked, times, tmp_path):
    script = tmp_path / "scene.py"
    script.write_text(LOGGED, encoding="utf-8")
    command = ["yade", "-j1", "-n", "-x", str(script), *(["checked"] if checked else [])]
    run = subprocess.run(command, capture_output=True, text=True, timeout=120, env=dict(os.environ))
    text = run.stdout + run.stderr
    assert run.returncode == 0, text
    assert text.count("sand: liquidViscosity has no effect") == times
    assert text.count("sand: friction has no effect with tangentialLaw 'none'") == times


def test_contacts_made_anew_without_a_change_go_on_to_the_last_bit():
    """Forces, slip history and bridges are carried over; only the materials' parameters are read again."""

    def end(renew: bool) -> list[float]:
        O.reset()
        heap(engines=False)
        for _ in range(4):
            O.run(200, True)
            if renew:
                _, maker = law_and_maker()
                assert maker.renewContacts() == O.interactions.countReal() > 0
        return [x for b in O.bodies for x in (*b.state.pos, *b.state.vel, *b.state.angVel)]

    assert end(renew=True) == end(renew=False)


def test_a_contact_made_anew_has_the_restitution_that_its_material_has_now():
    """Two spheres touch with restitution 0.3; made anew with 1 they part with the speed they met with."""
    O.materials.append(SOLID.material(label="sand", restitution=0.3))
    speed = 0.5
    hertz = cs.HertzImpact.of_equal_spheres(SOLID, RADIUS, 2 * speed)
    for side in (-1, 1):
        place = (0, 0, side * (RADIUS - 1e-6 * hertz.overlap))
        cs.add_sphere(place, RADIUS, "sand", velocity=(0, 0, -side * speed))
    cs.set_engines(cs.grain_law())
    O.dt = hertz.duration / 1000
    O.run(1, True)
    O.materials[0].restitution = 1.0
    _, maker = law_and_maker()
    assert maker.renewContacts() == 1
    cs.run_for(1.1 * hertz.duration)
    # One step in a thousand was damped, at an overlap of 1e-6 of the largest (c goes with its fourth root).
    assert O.bodies[1].state.vel[2] == pytest.approx(speed, rel=3e-4)


def test_effects_that_are_engines_or_bodies_are_told_too(capsys):
    heap(side=2)
    effects = running_effects()
    assert effects["adaptive time step"] == "HertzTimeStepper"
    assert effects["energy ledger"] == "ledger"
    assert "projectile" not in effects
    print_effects()
    printed = capsys.readouterr().out
    assert printed.startswith("effects:")
    assert all(name in printed and reason in printed for name, reason in effects.items())


def loaded_libraries() -> str:
    """A script that prints which files importing the package loads."""
    return """
import sys
def loaded():
    with open("/proc/self/maps") as maps:
        return {line.split()[-1] for line in maps if ".so" in line and "/" in line}
before, modules = loaded(), set(sys.modules)
import grainfall
print("LOADED", *sorted(loaded() - before))
print("MODULES", *sorted(m for m in set(sys.modules) - modules if not m.startswith("grainfall")))
"""


def test_importing_the_package_loads_its_own_library_and_no_other(tmp_path):
    """No deal.II, HDF5 or plotting for a scene that does not call for them."""
    script = tmp_path / "libraries.py"
    script.write_text(loaded_libraries(), encoding="utf-8")
    command = ["yade", "-j1", "-n", "-x", str(script)]
    run = subprocess.run(command, capture_output=True, text=True, timeout=120, env=dict(os.environ))
    (libraries,) = [line for line in run.stdout.splitlines() if line.startswith("LOADED")]
    (modules,) = [line for line in run.stdout.splitlines() if line.startswith("MODULES")]
    assert [Path(name).name for name in libraries.split()[1:]] == ["_core.so"]
    heavy = {"scipy", "matplotlib", "h5py", "tqdm", "meshio", "dask"}
    assert not heavy & {name.split(".")[0] for name in modules.split()[1:]}
