# SPDX-License-Identifier: GPL-2.0-or-later
"""No class or member stands in yade-headers/ without a comparison with the library."""
from __future__ import annotations

from pathlib import Path

from comparison import OBJECTS, PYTHON_FORM, SENTINELS, declared, measured, members, reachable
from declarations import HEADERS, Declarations, declared_names
from test_objects_have_the_library_s_size import FOLLOWS, NEVER_LAID_OUT, SIZED
from test_virtual_tables_have_yade_s_order import POLYMORPHIC, WITHOUT_TABLE

# Templates that are ours alone (YADE has others in their place, without exported tables) or hold no data.
OUR_TEMPLATES = {"Functor1D", "Functor2D", "FunctorWrapper", "Singleton"}


def uncovered(declarations: Declarations) -> list[str]:
    """Everything in the declarations that no test compares."""
    missing = []
    for name, cls in declarations.classes.items():
        template = name.split("<")[0]
        if (
            name != template and template not in OUR_TEMPLATES
        ):  # a template with data: its members are compared
            missing += [name] if not cls.members else []
        elif name == template and name not in {*SIZED, *FOLLOWS, *NEVER_LAID_OUT}:
            missing.append(f"size of {name}")
    for name in set(declarations.virtual_tables) - {*POLYMORPHIC, *WITHOUT_TABLE}:
        missing.append(f"virtual table of {name}")
    for pair in members(declarations):
        name = ".".join(pair)
        if pair[0] in NEVER_LAID_OUT or pair in measured():
            continue
        kind = declarations.classes[pair[0]].members[pair[1]].type
        known = (
            kind in SENTINELS
            or pair in PYTHON_FORM
            or (kind == "shared_ptr" and pair[1] in OBJECTS)
        )
        if not reachable(*pair):
            missing.append(f"{name}: neither in Python nor in measured_offsets.csv")
        elif not known:
            missing.append(f"{name}: no sentinel of type {kind}")
    return missing


def test_every_class_and_member_is_compared_with_the_library():
    assert uncovered(declared()) == []


def test_every_class_in_the_headers_was_seen_by_the_compiler():
    classes, templates = declared_names(HEADERS)
    seen = {name.split("<")[0] for name in declared().classes}
    assert (classes | templates) - seen == set()


def test_every_measured_place_belongs_to_a_declared_member():
    assert set(measured()) - set(members(declared())) == set()


def test_each_header_says_which_facts_it_states_and_how_they_were_verified():
    for header in sorted(Path(HEADERS).rglob("*.hpp")):
        opening = header.read_text(encoding="utf-8").split("#pragma once")[0]
        assert "Facts:" in opening and "Verified:" in opening, header
