# SPDX-License-Identifier: GPL-2.0-or-later
"""Every member that yade-headers/ declares, compared with live objects, both ways."""
from __future__ import annotations

import abi_probe
import pytest
from comparison import (
    declared,
    measured,
    members,
    memory_to_python,
    misplaced,
    python_to_memory,
    reachable,
)

ALL = members(declared())
IN_PYTHON = [pair for pair in ALL if reachable(*pair)]
MEASURED_ONLY = [pair for pair in ALL if not reachable(*pair) and pair in measured()]


def member(pair):
    return declared().classes[pair[0]].members[pair[1]]


@pytest.mark.parametrize("pair", IN_PYTHON, ids=".".join)
def test_a_value_set_in_python_is_read_through_our_headers(pair):
    assert python_to_memory(*pair, member(pair)) == ""


@pytest.mark.parametrize("pair", IN_PYTHON, ids=".".join)
def test_a_value_written_through_our_headers_is_seen_in_python(pair):
    assert memory_to_python(*pair, member(pair)) == ""


@pytest.mark.parametrize("pair", MEASURED_ONLY, ids=".".join)
def test_a_member_hidden_from_python_lies_where_it_was_measured(pair):
    assert misplaced(*pair, member(pair)) == ""


def test_compiled_code_uses_the_places_that_the_debug_information_names():
    for name, offset in abi_probe.compiled_offsets().items():
        assert offset == member(tuple(name.split("."))).offset, name
