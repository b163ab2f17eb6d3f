# SPDX-License-Identifier: GPL-2.0-or-later
"""Slots of the virtual tables as our headers order them, compared with the installed libraries."""
from __future__ import annotations

import abi_probe
import installed
import pytest
import yade.wrapper
from comparison import declared

# Their tables are not exported; they are compared as parts of the tables of the classes derived from them.
WITHOUT_TABLE = {"Indexable"}
POLYMORPHIC = sorted(set(declared().virtual_tables) - WITHOUT_TABLE)
# Functor families, each with a parameter that only it has.
FAMILIES = {
    "BoundFunctor": "shared_ptr<yade::Bound>&",
    "IGeomFunctor": "bool const&",
    "IPhysFunctor": "const boost::shared_ptr<yade::Material>&",
    "LawFunctor": "yade::Interaction*",
}
# Not made from Python, or (EnergyTracker) without a dictionary of attributes in YADE itself.
NOT_ASKED = {"BodyContainer", "InteractionContainer", "EnergyTracker"}
CONSTRUCTIBLE = [
    name for name in POLYMORPHIC if hasattr(yade.wrapper, name) and name not in NOT_ASKED
]


@pytest.mark.parametrize("name", POLYMORPHIC)
def test_each_slot_holds_the_function_that_the_library_has_there(name):
    assert installed.table_differences(name, declared().virtual_tables[name]) == []


@pytest.mark.parametrize("family", FAMILIES)
def test_the_function_that_a_dispatcher_calls_has_our_result_and_parameters(family):
    base = next(
        installed.split_types(name.removeprefix("FunctorWrapper<").removesuffix(">"))
        for name in declared().classes
        if name.startswith("FunctorWrapper<") and FAMILIES[family] in name
    )
    ours = (base[0], *map(installed.plain_type, base[1:]))
    assert ours in installed.called_signatures(family)


@pytest.mark.parametrize("name", CONSTRUCTIBLE)
def test_functions_called_through_our_tables_answer_for_the_right_class(name):
    instance = getattr(yade.wrapper, name)()
    called = abi_probe.call_virtual_functions(instance)
    base = type(instance).__mro__[1].__name__
    assert called["getClassName"] == name
    assert called["getBaseClassNumber"] == 1
    assert called["getBaseClassName"] == {"instance": "Factorable"}.get(base, base)
    assert called["pyDict"].keys() == instance.dict().keys()
    if hasattr(instance, "dispIndex"):
        assert called["getClassIndex"] == instance.dispIndex
        assert called["getMaxCurrentlyUsedClassIndexOfKin"] >= instance.dispIndex


def test_a_material_s_functions_stand_before_the_index_functions():
    called = abi_probe.call_virtual_functions(yade.wrapper.CpmMat())
    assert called["newAssocState"] == "CpmState"


def test_a_functor_names_its_arguments_and_their_order():
    types, order = abi_probe.functor_arguments(yade.wrapper.Ig2_Facet_Sphere_ScGeom())
    assert types == ["Facet", "Sphere"]
    assert order == "Facet Sphere"


def test_an_engine_s_activation_goes_through_its_own_slot():
    stepper = yade.wrapper.GlobalStiffnessTimeStepper(active=False)
    assert abi_probe.call_virtual_functions(stepper)["isActivated"] is False
    assert abi_probe.call_virtual_functions(yade.wrapper.ForceResetter())["isActivated"] is True
