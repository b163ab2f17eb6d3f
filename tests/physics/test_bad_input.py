# SPDX-License-Identifier: GPL-2.0-or-later
"""A wrong value gives one error naming attribute, value and allowed range, before anything runs.

YADE itself checks nothing of this: a negative modulus would be met as a nan inside the interaction
loop, where an exception ends the process. Here each refusal leaves the object with its last good
value and YADE running.
"""
from __future__ import annotations

import math
import re
from collections.abc import Callable

import contact_scenes as cs
import pytest
from grainfall.materials import check_scene
from yade import (
    AsperityFriction,
    CombinedFriction,
    ConstantFriction,
    ExponentialFriction,
    GrainMat,
    GrainPair,
    Ip2_GrainMat_GrainMat_GrainPhys,
    Law2_ScGeom_GrainPhys_HertzMindlin,
    MoistureFactor,
    O,
    PowerLawFriction,
    TableFriction,
)

NAN = math.nan

# Class, attribute, value, how the value is written in the message, words of the allowed range.
NUMBERS = [
    (GrainMat, "young", -1e9, "-1e+09", "> 0"),
    (GrainMat, "young", 0.0, "0", "> 0"),
    (GrainMat, "young", NAN, "nan", "> 0"),
    (GrainMat, "young", math.inf, "inf", "finite"),
    (GrainMat, "poisson", 0.6, "0.6", "0.5"),
    (GrainMat, "poisson", -1.0, "-1", "-1"),
    (GrainMat, "poisson", NAN, "nan", "0.5"),
    (GrainMat, "density", 0.0, "0", "> 0"),
    (GrainMat, "density", -2650.0, "-2650", "> 0"),
    (GrainMat, "frictionAngle", -0.1, "-0.1", "pi/2"),
    (GrainMat, "frictionAngle", 26.6, "26.6", "radians"),
    (GrainMat, "frictionAngle", NAN, "nan", "radians"),
    (GrainMat, "restitution", 0.0, "0", "0.01"),
    (GrainMat, "restitution", 1.2, "1.2", "1"),
    (GrainMat, "restitution", -0.5, "-0.5", "0.01"),
    (GrainMat, "restitution", NAN, "nan", "0.01"),
    (GrainMat, "gravimetricMoisture", -0.01, "-0.01", "[0, 1]"),
    (GrainMat, "gravimetricMoisture", 2.3, "2.3", "[0, 1]"),
    (GrainMat, "gravimetricMoisture", NAN, "nan", "[0, 1]"),
    (GrainMat, "bridgeModel", "wet", "wet", "'willett-closed'"),
    (GrainMat, "bridgesPerGrain", 0.0, "0", ">= 1"),
    (GrainMat, "bridgesPerGrain", NAN, "nan", ">= 1"),
    (GrainMat, "surfaceTension", 0.0, "0", "> 0"),
    (GrainMat, "surfaceTension", NAN, "nan", "> 0"),
    (GrainMat, "contactAngle", -0.1, "-0.1", "0.8727"),
    (GrainMat, "contactAngle", 20.0, "20", "0.8727"),
    (GrainMat, "liquidViscosity", -1e-3, "-0.001", ">= 0"),
    (GrainMat, "lubricationCutoff", 0.0, "0", "> 0"),
    (GrainMat, "referenceRadius", -0.001, "-0.001", ">= 0"),
    (GrainMat, "referenceRadius", NAN, "nan", ">= 0"),
    (GrainMat, "friction", -0.3, "-0.3", ">= 0"),
    (GrainMat, "friction", NAN, "nan", ">= 0"),
    (GrainMat, "friction", "rough", "rough", "friction curve"),
    (ConstantFriction, "mu", -0.1, "-0.1", ">= 0"),
    (ConstantFriction, "mu", NAN, "nan", ">= 0"),
    (PowerLawFriction, "muRef", 0.0, "0", "> 0"),
    (PowerLawFriction, "loadRef", 0.0, "0", "> 0"),
    (PowerLawFriction, "exponent", -0.4, "-0.4", ">= 0"),
    (PowerLawFriction, "muMin", -0.1, "-0.1", ">= 0"),
    (PowerLawFriction, "muMax", 0.1, "0.1", "muMin"),
    (ExponentialFriction, "mu0", -0.8, "-0.8", ">= 0"),
    (ExponentialFriction, "muInf", -0.2, "-0.2", ">= 0"),
    (ExponentialFriction, "loadScale", 0.0, "0", "> 0"),
    (AsperityFriction, "c", -0.3, "-0.3", ">= 0"),
    (AsperityFriction, "alpha", NAN, "nan", "finite"),
    (AsperityFriction, "muMax", -1.0, "-1", ">= 0"),
    (CombinedFriction, "rule", "average", "average", "'geometric'"),
    (Ip2_GrainMat_GrainMat_GrainPhys, "frictionRule", "average", "average", "'geometric'"),
    (Ip2_GrainMat_GrainMat_GrainPhys, "restitutionRule", "", "''", "'geometric'"),
    (Law2_ScGeom_GrainPhys_HertzMindlin, "normalLaw", "linear", "linear", "'report'"),
    (Law2_ScGeom_GrainPhys_HertzMindlin, "tangentialLaw", "mindlin", "mindlin", "'secant'"),
]


def case_name(case) -> str:
    kind, attribute, value, *_ = case
    return f"{kind.__name__}.{attribute}={value}"


def assert_one_clear_error(action: Callable[[], object], *words: str) -> None:
    """The action raises ValueError in one line that holds all these words."""
    with pytest.raises(ValueError) as caught:
        action()
    message = str(caught.value)
    assert "\n" not in message.strip()
    assert message.count("must be") == 1
    for word in words:
        assert word in message, f"'{word}' is missing in: {message}"


@pytest.mark.parametrize("case", NUMBERS, ids=case_name)
def test_constructor_refuses_a_wrong_value(case):
    kind, attribute, value, written, allowed = case
    assert_one_clear_error(
        lambda: kind(**{attribute: value}), f"{kind.__name__}.{attribute}", written, allowed
    )


@pytest.mark.parametrize("case", NUMBERS, ids=case_name)
def test_assignment_refuses_a_wrong_value_and_keeps_the_good_one(case):
    kind, attribute, value, written, allowed = case
    target = kind()
    before = getattr(target, attribute)
    assert_one_clear_error(
        lambda: setattr(target, attribute, value), f"{kind.__name__}.{attribute}", written, allowed
    )
    assert getattr(target, attribute) == before


LISTS = {
    "loads that fall": (
        lambda: TableFriction([1, 5, 2], [0], [[0.5], [0.4], [0.3]]),
        ("TableFriction.loads[2]", "2", "above"),
    ),
    "a load given twice": (
        lambda: TableFriction([1, 1], [0], [[0.5], [0.4]]),
        ("TableFriction.loads[1]", "1", "above"),
    ),
    "a negative load": (
        lambda: TableFriction([-1, 1], [0], [[0.5], [0.4]]),
        ("TableFriction.loads[0]", "-1", ">= 0"),
    ),
    "no loads": (lambda: TableFriction([], [0], []), ("TableFriction.loads", "[]", "at least one")),
    "moistures that fall": (
        lambda: TableFriction([1], [0.1, 0.0], [[0.5, 0.4]]),
        ("TableFriction.moistures[1]", "0", "above"),
    ),
    "a row too few": (
        lambda: TableFriction([1, 5], [0, 0.1], [[0.5, 0.4]]),
        ("TableFriction.mu", "2", "4"),
    ),
    "a row too short": (
        lambda: TableFriction([1, 5], [0, 0.1], [[0.5, 0.4], [0.3]]),
        ("TableFriction.mu[1]", "1", "2"),
    ),
    "a negative coefficient": (
        lambda: TableFriction([1, 5], [0], [[0.5], [-0.4]]),
        ("TableFriction.mu[1]", "-0.4", ">= 0"),
    ),
    "factors without moistures": (
        lambda: MoistureFactor([0.0], [1.0, 0.5]),
        ("MoistureFactor.factors", "2", "1"),
    ),
    "a negative factor": (
        lambda: MoistureFactor([0.0, 0.1], [1.0, -0.5]),
        ("MoistureFactor.factors[1]", "-0.5", ">= 0"),
    ),
    "factors at falling moistures": (
        lambda: MoistureFactor([0.1, 0.0], [1.0, 0.5]),
        ("MoistureFactor.moistures[1]", "0", "above"),
    ),
    "half of a combination": (
        lambda: CombinedFriction(first=None, second=0.3),
        ("CombinedFriction.first", "None", "friction curve"),
    ),
    "a word in a combination": (
        lambda: CombinedFriction("rough", 0.3),
        ("CombinedFriction.first", "rough", "friction curve"),
    ),
    "a bridge of less than nothing": (
        lambda: GrainMat(bridgeVolume=-1e-12),
        ("GrainMat.bridgeVolume", "-1e-12", ">= 0"),
    ),
    "a pair of one": (lambda: GrainPair(first="sand"), ("GrainPair.second", "''", "label")),
    "a pair that gains energy": (
        lambda: GrainPair("sand", "steel", restitution=1.5),
        ("GrainPair.restitution", "1.5", "1"),
    ),
    "a pair with negative friction": (
        lambda: GrainPair("sand", "steel", friction=-0.5),
        ("GrainPair.friction", "-0.5", ">= 0"),
    ),
    "a material where a pair belongs": (
        lambda: Ip2_GrainMat_GrainMat_GrainPhys(pairs=[GrainMat()]),
        ("Ip2_GrainMat_GrainMat_GrainPhys.pairs[0]", "GrainMat", "GrainPair"),
    ),
}


@pytest.mark.parametrize("name", LISTS)
def test_lists_and_partners_that_do_not_fit_are_refused(name):
    action, words = LISTS[name]
    assert_one_clear_error(action, *words)


def test_there_are_more_than_twenty_five_wrong_values():
    assert len(NUMBERS) + len(LISTS) >= 25


def test_unknown_attribute_is_refused_by_name():
    with pytest.raises(AttributeError, match="moisture"):
        GrainMat(moisture=0.02)


def test_pair_of_an_unknown_label_is_found_by_the_check_of_the_scene():
    O.materials.append(GrainMat(label="sand"))
    cs.set_engines(cs.grain_law({"pairs": [GrainPair("sand", "steal", friction=0.2)]}))
    assert_one_clear_error(check_scene, "GrainPair.second", "'steal'", "'sand'")


@pytest.mark.parametrize(
    "attributes, word",
    [
        (lambda: dict(friction=TableFriction([1], [0, 0.1], [[0.5, 0.4]])), "moisture"),
        (lambda: dict(friction=0.4, referenceRadius=1e-4), "referenceRadius"),
        (lambda: dict(gravimetricMoisture=0.023, density=2650), "pendular"),
    ],
    ids=[
        "moisture curve in a dry scene",
        "coarse grain with constant friction",
        "more water than separate bridges hold",
    ],
)
def test_effect_that_cannot_act_is_warned_of_by_the_check_of_the_scene(attributes, word):
    O.materials.append(GrainMat(label="sand", **attributes()))
    cs.set_engines(cs.grain_law())
    (warning,) = check_scene()
    assert warning.startswith("sand: ")
    assert word in warning


def test_scene_without_mistakes_passes_its_check():
    O.materials.append([GrainMat(label="sand"), GrainMat(label="steel")])
    cs.set_engines(cs.grain_law({"pairs": [GrainPair("sand", "steel", friction=0.2)]}))
    assert check_scene() == []


@pytest.mark.parametrize(
    "attribute, bad",
    [("young", "-1e9"), ("restitution", "1.625"), ("mu", "-0.375"), ("normalLaw", "hurtz")],
)
def test_saved_scene_with_a_wrong_value_is_refused_when_loaded(attribute, bad, tmp_path):
    O.materials.append(GrainMat(friction=ConstantFriction(0.375)))
    cs.set_engines(cs.grain_law())
    file = tmp_path / "scene.xml"
    O.save(str(file))
    saved = file.read_text(encoding="utf-8")
    changed, count = re.subn(f"<{attribute}>[^<]*<", f"<{attribute}>{bad}<", saved)
    assert count == 1
    file.write_text(changed, encoding="utf-8")
    O.reset()
    with pytest.raises((ValueError, RuntimeError), match=f"{attribute} = .*must be"):
        O.load(str(file))


def test_a_simulation_runs_as_if_nothing_had_happened_after_a_refusal():
    """The impact is Hertz's: neither material nor law kept anything of the refused values."""
    solid, radius, speed = cs.Solid(7.0e10, 0.3, 2700), 0.01, 1.0
    O.materials.append([solid.material(label="sphere"), solid.rigid_material(label="plane")])
    cs.add_plane("plane")
    sphere = cs.add_sphere((0, 0, radius), radius, "sphere", velocity=(0, 0, -speed))
    hertz = cs.HertzImpact.on_rigid_plane(solid, radius, speed)
    cs.set_engines(cs.grain_law())
    O.dt = hertz.duration / 500
    for attribute, value in (("young", -1.0), ("poisson", 0.7), ("restitution", 0.0)):
        with pytest.raises(ValueError):
            setattr(O.materials[0], attribute, value)
    with pytest.raises(ValueError):
        O.engines[2].lawDispatcher.functors[0].normalLaw = "linear"
    cs.run_for(1.1 * hertz.duration)
    assert O.bodies[sphere].state.vel[2] == pytest.approx(speed, rel=1e-6)
