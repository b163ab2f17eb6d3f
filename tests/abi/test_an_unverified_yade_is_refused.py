# SPDX-License-Identifier: GPL-2.0-or-later
"""The guard's sentences: version, precision, build; at import and at configuration."""
from __future__ import annotations

import dataclasses
import re
import subprocess
import sys
from pathlib import Path

import pytest
from abi_build import LIBRARY_DIR, SOURCE_DIR

from grainfall import _yade_guard as guard

OTHER_VERSION = dataclasses.replace(guard.VERIFIED, version="2024.02a")
OTHER_BUILD = dataclasses.replace(
    guard.VERIFIED, build_ids={**guard.VERIFIED.build_ids, "libpkg_dem.so": "0123456789abcdef"}
)


def refused_with(monkeypatch, found) -> str:
    monkeypatch.setattr(guard, "running_build", lambda: found)
    monkeypatch.setattr(guard, "verified_build", lambda: guard.VERIFIED)
    with pytest.raises(ImportError) as caught:
        guard.require_verified_yade()
    return str(caught.value)


def is_one_sentence(text: str) -> bool:
    return "\n" not in text and re.findall(r"[.!?](?= [A-Z])", text) == [] and text.endswith(".")


def test_the_running_yade_is_the_verified_one():
    guard.require_verified_yade()
    assert guard.installed_build(Path(LIBRARY_DIR)) == guard.running_build() == guard.VERIFIED


def test_another_version_is_refused_naming_both(monkeypatch):
    text = refused_with(monkeypatch, OTHER_VERSION)
    assert "2024.02a" in text and "2023.02a" in text and is_one_sentence(text)


def test_another_build_of_the_same_version_is_refused_naming_the_library(monkeypatch):
    monkeypatch.delenv(guard.ALLOW_VARIABLE, raising=False)
    text = refused_with(monkeypatch, OTHER_BUILD)
    assert "libpkg_dem.so" in text and guard.ALLOW_VARIABLE in text and is_one_sentence(text)


def test_the_variable_turns_another_build_into_a_warning_but_not_another_version(monkeypatch):
    monkeypatch.setenv(guard.ALLOW_VARIABLE, "1")
    assert "2024.02a" in refused_with(monkeypatch, OTHER_VERSION)
    monkeypatch.setattr(guard, "running_build", lambda: OTHER_BUILD)
    with pytest.warns(RuntimeWarning, match="libpkg_dem.so"):
        guard.require_verified_yade()


def test_a_module_compiled_against_a_source_tree_wants_the_yade_it_was_built_for(monkeypatch):
    import grainfall._build_info as info

    monkeypatch.setattr(info, "HEADERS", "source")
    monkeypatch.setattr(info, "VERSION", "2024.02a")
    monkeypatch.setattr(guard, "running_build", lambda: OTHER_VERSION)
    guard.require_verified_yade()
    monkeypatch.undo()


def test_a_library_without_build_id_or_no_library_has_none(tmp_path):
    (tmp_path / "text.so").write_text("not a library", encoding="utf-8")
    assert guard.build_id(tmp_path / "text.so") == guard.build_id(tmp_path / "absent.so") == ""


@pytest.mark.parametrize(
    "precision, bits", [("longdouble", 80), ("float128", 128), ("mpfr150", 498)]
)
def test_configuration_stops_with_one_sentence_on_another_precision(precision, bits):
    folder = LIBRARY_DIR.replace("yade-double", f"yade-{precision}")
    done = subprocess.run(
        [sys.executable, f"{SOURCE_DIR}/python/grainfall/_yade_guard.py", folder],
        capture_output=True,
        text=True,
    )
    assert done.returncode == 1
    assert f"({bits}-bit" in done.stdout and is_one_sentence(done.stdout)
