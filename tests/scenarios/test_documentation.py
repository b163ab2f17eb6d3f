# SPDX-License-Identifier: GPL-2.0-or-later
"""docs/equations.md names every equation of the report, and files and names that exist."""
from __future__ import annotations

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PAGE = (ROOT / "docs" / "equations.md").read_text(encoding="utf-8")
REFERENCES = sorted(set(re.findall(r"`([\w./-]+\.(?:hpp|cpp|py))#([^`]+)`", PAGE)))


def rows() -> dict[int, list[str]]:
    """Cells of the tables' rows that begin with an equation's number."""
    table: dict[int, list[str]] = {}
    for line in PAGE.splitlines():
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if line.startswith("|") and cells[0].isdigit():
            assert int(cells[0]) not in table, f"Eq {cells[0]} has two rows"
            table[int(cells[0])] = cells[1:]
    return table


def test_every_equation_of_the_report_has_a_row():
    assert sorted(rows()) == list(range(1, 28))


def test_what_is_computed_is_tested_and_the_rest_says_so():
    for number, (_, computed, tested) in rows().items():
        if "not built yet" in computed or computed == "identity":
            assert not tested, f"Eq {number} has a test but no code"
        else:
            assert "#" in computed and "#" in tested, f"Eq {number} lacks code or test"


@pytest.mark.parametrize("path, name", REFERENCES)
def test_named_code_exists(path, name):
    file = ROOT / path
    assert file.is_file(), f"docs/equations.md names {path}, which is not there"
    assert name in file.read_text(encoding="utf-8"), f"{path} has no {name!r}"
