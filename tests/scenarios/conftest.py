# SPDX-License-Identifier: GPL-2.0-or-later
"""Small runs in the process of the tests."""
from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from scenario_script import SMALL, TINY

from grainfall.drop import drop_test
from grainfall.options import OptionError
from grainfall.triaxial import triaxial_test


@pytest.fixture
def refuses(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[..., None]:
    """Check that a scenario refuses options with this message before anything has been run or written."""

    def began(*arguments: Any) -> None:
        raise AssertionError("a bad value got through and the run began")

    monkeypatch.setattr("grainfall.drop.run.obtain_bed", began)
    monkeypatch.setattr("grainfall.triaxial.run.obtain_sample", began)

    def check(scenario: Callable[..., Any], message: str, **options: Any) -> None:
        output = tmp_path / "refused"
        with pytest.raises(OptionError, match=message):
            scenario(output=str(output), **options)
        assert not output.exists()

    return check


@pytest.fixture(scope="session")
def bed_cache(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """One store of beds for all tests, so that each bed is settled once."""
    return tmp_path_factory.mktemp("beds")


@pytest.fixture
def small_drop(bed_cache: Path, tmp_path: Path) -> Callable[..., tuple[dict[str, Any], Path]]:
    """Run a small drop in this process: summary and results folder."""

    def run(folder: str = "drop", **changes: Any) -> tuple[dict[str, Any], Path]:
        output = tmp_path / folder
        options = {**SMALL, "no_plots": True, "bed_cache": str(bed_cache), **changes}
        return drop_test(output=str(output), quiet=True, **options), output

    return run


@pytest.fixture(scope="session")
def sample_cache(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """One store of triaxial samples for all tests, so that each sample is prepared once."""
    return tmp_path_factory.mktemp("samples")


@pytest.fixture(scope="session")
def tiny_test(
    sample_cache: Path, tmp_path_factory: pytest.TempPathFactory
) -> Callable[..., tuple[dict[str, Any], Path]]:
    """Run a tiny triaxial test in this process: summary and results folder."""

    def run(**changes: Any) -> tuple[dict[str, Any], Path]:
        output = tmp_path_factory.mktemp("triaxial")
        options = {**TINY, "sample_cache": str(sample_cache), **changes}
        return triaxial_test(output=str(output), quiet=True, **options), output

    return run


@pytest.fixture(scope="session")
def finished_test(
    tiny_test: Callable[..., tuple[dict[str, Any], Path]]
) -> tuple[dict[str, Any], Path]:
    """A finished tiny test at two frequencies, with its pictures; not to be changed."""
    return tiny_test(frequencies="150,100", no_plots=False)
