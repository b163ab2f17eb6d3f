# SPDX-License-Identifier: GPL-2.0-or-later
"""What a user of YADE expects of any class holds for ours: registration, help, files, labels, logging."""
from __future__ import annotations

import importlib
import pickle
import pydoc
import sys

import grainfall
import pytest
import yade
import yade.log
import yade.system
import yade.wrapper
from comparison import same
from yade import utils
from yade.minieigenHP import Matrix3, Quaternion, Vector3, Vector3i

O = yade.wrapper.Omega()  # noqa: E741  YADE's own name
FILES = ("xml", "xml.gz", "yade", "yade.gz")
# Classes that are not valid before these are given.
NEEDED = {"GrainPair": {"first": "sand", "second": "steel"}}
SAMPLE_VALUES = {
    "flag": False,
    "natural": 11,
    "big": -5,
    "text": "grain <&> 'sand'",
    "position": Vector3(4, 5, 6),
    "cell": Vector3i(7, 8, 9),
    "turn": Quaternion(0, 1, 0, 0),
    "matrix": Matrix3(1, 2, 3, 4, 5, 6, 7, 8, 9),
    "numbers": [0.1, 1e300, -3.0],
    "integers": [1, -2],
    "texts": ["a", "b c"],
    "vectors": [Vector3(1, 0, 0), Vector3(0, 1, 0)],
    "table": [[1.0, 2.0], [3.0]],
}


def sample(**keywords):
    return yade.wrapper.AbiSample(**keywords)


def scene_with_a_contact():
    """Two overlapping grains, the lower one fixed, both of a labelled material."""
    curve = yade.wrapper.PowerLawFriction(muRef=0.5, loadRef=1.0, exponent=0.2)
    sand = yade.wrapper.GrainMat(young=1e8, restitution=0.8, friction=curve, label="sand")
    O.materials.append(sand)
    O.bodies.append(utils.sphere((0, 0, 0), 0.1, material="sand", fixed=True))
    O.bodies.append(utils.sphere((0, 0.05, 0.19), 0.1, material="sand"))
    O.engines = [
        yade.ForceResetter(),
        yade.InsertionSortCollider([yade.Bo1_Sphere_Aabb()]),
        yade.InteractionLoop(
            [yade.Ig2_Sphere_Sphere_ScGeom()],
            [yade.wrapper.Ip2_GrainMat_GrainMat_GrainPhys(label="maker")],
            [yade.wrapper.Law2_ScGeom_GrainPhys_HertzMindlin(label="law")],
        ),
        yade.NewtonIntegrator(gravity=(0, 0, -9.81), damping=0),
    ]
    O.dt = 1e-5
    O.run(20, True)


@pytest.mark.parametrize("name", grainfall.CLASS_NAMES)
def test_a_class_is_found_wherever_yade_s_are(name):
    cls = getattr(yade.wrapper, name)
    assert getattr(yade, name) is cls
    assert name in yade.__all__
    assert name in yade.system._allSerializables
    assert hasattr(sys.modules["__main__"], name)


@pytest.mark.parametrize("name", grainfall.CLASS_NAMES)
def test_an_object_is_copied_by_pickling_and_lists_its_attributes(name):
    instance = getattr(yade.wrapper, name)(**NEEDED.get(name, {}))
    copy = pickle.loads(pickle.dumps(instance))
    assert type(copy) is type(instance)
    assert copy.dict().keys() == instance.dict().keys() <= set(dir(instance))


def test_importing_again_changes_nothing():
    before = list(yade.__all__)
    importlib.reload(grainfall)
    assert yade.__all__ == before
    assert grainfall.CLASS_NAMES


def test_help_shows_description_defaults_and_types():
    text = pydoc.plain(pydoc.render_doc(yade.wrapper.GrainMat))
    assert "friction that may depend on load and moisture" in text
    assert ":ydefault:`1.0` :yattrtype:`Real` :yattrflags:`0`" in text
    assert "frictionAngle" in text  # inherited


def test_child_classes_and_dispatch_hierarchy_include_ours():
    assert "GrainMat" in yade.system.childClasses("Material")
    assert "PowerLawFriction" in yade.system.childClasses("FrictionCurve")
    assert O.isChildClassOf("GrainMat", "ElastMat")
    assert yade.wrapper.GrainMat().dispHierarchy() == [
        "GrainMat",
        "FrictMat",
        "ElastMat",
        "Material",
    ]
    assert yade.wrapper.GrainPhys.__mro__[1] is yade.wrapper.FrictPhys


def test_attributes_of_every_kind_are_set_by_keyword_and_shown_by_dict():
    made = sample(number=2.5, material=yade.FrictMat(young=7), **SAMPLE_VALUES)
    shown = made.dict()
    for name, value in SAMPLE_VALUES.items():
        assert same(shown[name], value), name
    assert made.material.young == 7
    assert "secret" not in shown and not hasattr(made, "secret")


def test_vectors_are_returned_by_reference_and_numbers_by_value():
    made = sample()
    made.position[1] = 77
    assert made.position == Vector3(1, 77, 3)
    made.numbers.append(5)
    assert made.numbers == [1.0, 2.0]


def test_hooks_and_positional_arguments_work_as_in_yade():
    made = yade.wrapper.AbiSample(4.0)
    assert (made.number, made.doubled) == (4.0, 8.0)
    made.number = 5.0  # triggers postLoad
    assert made.doubled == 10.0
    with pytest.raises(AttributeError, match="No such attribute: colour"):
        sample(colour=1)
    with pytest.raises(RuntimeError, match="positional"):
        yade.wrapper.AbiSample(1, 2)
    with pytest.raises(AttributeError):
        made.postLoads = 3  # read-only


@pytest.mark.parametrize("ending", FILES)
def test_attributes_of_every_kind_survive_a_file(ending, tmp_path):
    kept = sample(number=2.5, material=yade.FrictMat(young=7), **SAMPLE_VALUES)
    kept.next = sample(number=-1)
    kept.objects = [kept.next, yade.Sphere(radius=3)]
    O.miscParams = [kept]
    O.save(str(tmp_path / f"scene.{ending}"))
    O.reset()
    O.load(str(tmp_path / f"scene.{ending}"))
    (read,) = [item for item in O.miscParams if type(item).__name__ == "AbiSample"]
    for name, value in SAMPLE_VALUES.items():
        assert same(getattr(read, name), value), name
    assert (read.number, read.doubled, read.material.young) == (2.5, 5.0, 7)
    assert read.objects[0].number == read.next.number == -1
    assert read.objects[1].radius == 3


@pytest.mark.parametrize("ending", [*FILES, "memory"])
def test_a_scene_goes_on_after_loading_as_if_it_had_never_stopped(ending, tmp_path):
    scene_with_a_contact()
    if ending == "memory":
        O.saveTmp("contact")
    else:
        O.save(str(tmp_path / f"scene.{ending}"))
    O.run(50, True)
    expected = (O.bodies[1].state.pos, O.interactions[0, 1].phys.normalForce)
    if ending == "memory":
        O.loadTmp("contact")
    else:
        O.reset()
        O.load(str(tmp_path / f"scene.{ending}"))
    contact = O.interactions[0, 1].phys
    assert type(contact).__name__ == "GrainEffectPhys"
    assert contact.friction.muRef == O.materials["sand"].friction.muRef == 0.5
    O.run(50, True)
    reached = (O.bodies[1].state.pos, O.interactions[0, 1].phys.normalForce)
    for value, goal in zip(reached, expected, strict=True):
        # Files keep all digits of what they save; ScGeom's own caches are rebuilt, which costs the last ones.
        assert (value - goal).norm() <= 1e-12 * goal.norm()


def test_reload_returns_to_the_saved_step(tmp_path):
    scene_with_a_contact()
    O.save(str(tmp_path / "scene.xml"))
    O.load(str(tmp_path / "scene.xml"))
    O.run(5, True)
    O.reload()
    assert O.iter == 20
    assert type(O.materials["sand"]).__name__ == "GrainMat"


def test_labels_name_materials_and_functors():
    scene_with_a_contact()
    assert O.materials["sand"].label == "sand"
    import builtins

    assert (
        builtins.law is not None
        and type(builtins.law).__name__ == "Law2_ScGeom_GrainPhys_HertzMindlin"
    )
    assert type(builtins.maker).__name__ == "Ip2_GrainMat_GrainMat_GrainPhys"


def test_messages_follow_the_level_that_the_user_sets(capfd):
    made = sample()
    assert "AbiSample" in yade.log.getAllLevels()
    yade.log.setLevel("AbiSample", yade.log.ERROR)
    made.warn("not to be seen")
    yade.log.setLevel("AbiSample", yade.log.WARN)
    made.warn("to be seen")
    seen = capfd.readouterr().err
    assert "to be seen" in seen and "not to be seen" not in seen
    assert "AbiSample" in seen
