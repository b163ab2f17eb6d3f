# SPDX-License-Identifier: GPL-2.0-or-later
"""Deliberate mistakes in a copy of the headers, each of which the comparisons must find."""
from __future__ import annotations

import shutil

import installed
import pytest
from comparison import declared, disagreements
from declarations import HEADERS, Declarations, compile_declarations
from test_every_declaration_is_covered import uncovered

MISTAKES = {
    "core/State.hpp": ("    Vector3r vel;", "    Real intruder;\n    Vector3r vel;"),
    "core/Cell.hpp": (
        "    Vector3r _cos;\n    Vector3r _refSize;",
        "    Vector3r _refSize;\n    Vector3r _cos;",
    ),
    "core/Material.hpp": (
        "    virtual shared_ptr<State> newAssocState() const;\n    virtual bool stateTypeOk(State*) const;",
        "    virtual bool stateTypeOk(State*) const;\n    virtual shared_ptr<State> newAssocState() const;",
    ),
    "core/GlobalEngine.hpp": (
        "class GlobalEngine : public Engine {",
        "class Newcomer : public Engine {\npublic:\n    Real secret;\n};\n\nclass GlobalEngine : public Engine {",
    ),
}


@pytest.fixture(scope="module")
def mistaken(tmp_path_factory) -> Declarations:
    """Declarations of a copy of yade-headers/ with all of the mistakes."""
    copy = tmp_path_factory.mktemp("headers") / "yade-headers"
    shutil.copytree(HEADERS, copy)
    for name, (right, wrong) in MISTAKES.items():
        text = (copy / name).read_text(encoding="utf-8")
        assert text.count(right) == 1, f"{name} no longer has the line that this test spoils"
        (copy / name).write_text(text.replace(right, wrong), encoding="utf-8")
    return compile_declarations(copy)


def test_a_member_moved_by_an_intruder_reads_another_value(mistaken):
    found = disagreements("State", mistaken.classes["State"])
    assert any(text.startswith("State.vel is ") for text in found)
    assert disagreements("State", declared().classes["State"]) == []


def test_a_class_with_an_intruder_has_another_size(mistaken):
    assert mistaken.classes["State"].size == declared().classes["State"].size + 8


def test_two_hidden_members_in_swapped_order_are_not_where_they_were_measured(mistaken):
    found = disagreements("Cell", mistaken.classes["Cell"])
    assert sorted(text.split(":")[0] for text in found) == ["Cell._cos", "Cell._refSize"]


def test_two_virtual_functions_in_swapped_order_stand_in_wrong_slots(mistaken):
    found = installed.table_differences("Material", mistaken.virtual_tables["Material"])
    assert len(found) == 2 and all("newAssocState" in text for text in found)
    assert installed.table_differences("Material", declared().virtual_tables["Material"]) == []


def test_a_new_class_without_a_comparison_is_reported(mistaken):
    missing = uncovered(mistaken)
    assert "size of Newcomer" in missing
    assert "virtual table of Newcomer" in missing
    assert "Newcomer.secret: neither in Python nor in measured_offsets.csv" in missing
