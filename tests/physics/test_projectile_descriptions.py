# SPDX-License-Identifier: GPL-2.0-or-later
"""Projectiles described by a text or a file, as the drop test's --profile takes them."""

from __future__ import annotations

import math

import pytest

from grainfall.projectiles import projectile

R, L = 0.0285, 0.17  # m

# Closed forms; rounding is all that may differ.
ROUNDING = 1e-12


@pytest.mark.parametrize(
    "text, volume",
    [
        ("flat-cylinder:diameter=0.057,length=0.17", math.pi * R**2 * L),
        ("sphere:diameter=0.057", 4 / 3 * math.pi * R**3),
        (
            "hemisphere:diameter=0.057,length=0.17",
            math.pi * R**2 * (L - R) + 2 / 3 * math.pi * R**3,
        ),
        (
            "cone:diameter=0.057,length=0.17,nose_length=0.06",
            math.pi * R**2 * (L - 0.06) + math.pi / 3 * R**2 * 0.06,
        ),
    ],
)
def test_an_outline_written_as_text_has_the_volume_of_its_solid(text, volume):
    assert projectile(text).shape().volume == pytest.approx(volume, rel=ROUNDING)


def test_a_preset_is_found_with_underscores_and_with_dashes():
    assert projectile("m70_full") == projectile("m70-full")


def test_vertices_from_a_file_make_the_solid_they_describe(tmp_path):
    path = tmp_path / "blunt.csv"
    path.write_text("# z, r, bulge\n0,0\n0.03,0.02,0\n0.1,0.02\n0.1,0\n")
    volume = math.pi * 0.02**2 * 0.07 + math.pi / 3 * 0.02**2 * 0.03
    assert projectile(str(path)).shape().volume == pytest.approx(volume, rel=ROUNDING)


@pytest.mark.parametrize(
    "text, named",
    [
        ("nosuch", "nosuch"),
        ("cone:diameter=0.057", "nose_length"),
        ("cone:caliber=1", "caliber"),
        ("sphere:diameter=wide", "wide"),
        ("sphere:diameter=-1", "diameter"),
        ("nosuch.csv", "nosuch.csv"),
    ],
)
def test_a_bad_description_is_refused_with_its_name(text, named):
    with pytest.raises(ValueError, match=named):
        projectile(text)
