# SPDX-License-Identifier: GPL-2.0-or-later
"""normalLaw='report' and tangentialLaw='report' are Eq 3 and Eq 5 of MR-2629 as printed.

Eq 3: F_n = 2G/(3(1 - nu)) sqrt(R_e) overlap^1.5, one half of Hertz's force; Eq 5: k_t = 2 [3 G^2 (1
- nu) F_n R_e]^(1/3)/(2 - nu), 2^(-1/3) of Mindlin's stiffness at the same force; R_e = R1 R2/(R1 +
R2). The equations are written out here, with the report's Table 1 constants, and compared with
forces measured on spheres.
"""
from __future__ import annotations

import contact_scenes as cs
import numpy as np
import pytest
from yade import O

SHEAR_MODULUS, POISSON = 1.0e9, 0.4  # the report's Table 1
SOLID = cs.Solid(2 * SHEAR_MODULUS * (1 + POISSON), POISSON, 2650)
RADII = (0.0025, 0.004)
EFFECTIVE_RADIUS = RADII[0] * RADII[1] / sum(RADII)
OVERLAPS = (1e-7, 1e-6, 1e-5)
SHEAR = 1e-10  # m a step, far below what makes a contact of friction 10 slide


def force_eq_3(overlap: float) -> float:
    """Normal force [N]."""
    return 2 * SHEAR_MODULUS / (3 * (1 - POISSON)) * EFFECTIVE_RADIUS**0.5 * overlap**1.5


def stiffness_eq_5(force: float) -> float:
    """Tangential stiffness [N/m] at a normal force [N]."""
    cube = 3 * SHEAR_MODULUS**2 * (1 - POISSON) * force * EFFECTIVE_RADIUS
    return 2 * cube ** (1 / 3) / (2 - POISSON)


def force_and_stiffness(overlap: float, **law) -> tuple[float, float]:
    """Normal force [N] and tangential stiffness [N/m] measured on two spheres of RADII."""
    O.reset()
    O.materials.append(SOLID.material(frictionAngle=np.arctan(10.0)))
    cs.add_sphere((0, 0, 0), RADII[0], 0, fixed=True)
    upper = cs.add_sphere((0, 0, sum(RADII) - overlap), RADII[1], 0, fixed=True)
    cs.set_engines(cs.grain_law(**law))
    O.dt = 1e-7
    O.run(1, True)
    before = cs.force_on(upper)
    O.bodies[upper].state.vel = (SHEAR / O.dt, 0, 0)
    O.run(1, True)  # YADE takes the velocity it meets for that of the step before
    return before[2], (before[0] - cs.force_on(upper)[0]) / SHEAR


@pytest.mark.parametrize("overlap", OVERLAPS)
def test_normal_force_is_eq_3(overlap):
    force, _ = force_and_stiffness(overlap, normalLaw="report")
    # The overlap is a difference of millimetres: 1e-18 m of rounding in 1e-7 m, and half as much
    # again.
    assert force == pytest.approx(force_eq_3(overlap), rel=1e-9)


@pytest.mark.parametrize("overlap", OVERLAPS)
@pytest.mark.parametrize("normal_law", ["hertz", "report"])
def test_tangential_stiffness_is_eq_5_at_the_normal_force_that_acts(normal_law, overlap):
    force, stiffness = force_and_stiffness(overlap, normalLaw=normal_law, tangentialLaw="report")
    # YADE's remedy against ratcheting lengthens the increment by overlap/(R1 + R2), 1.5e-3 at most.
    longer = sum(RADII) / (sum(RADII) - overlap)
    assert stiffness == pytest.approx(longer * stiffness_eq_5(force), rel=1e-6)


@pytest.mark.parametrize("overlap", OVERLAPS)
def test_defaults_are_twice_eq_3_and_the_cube_root_of_two_times_eq_5(overlap):
    force, stiffness = force_and_stiffness(overlap)
    longer = sum(RADII) / (sum(RADII) - overlap)
    assert force == pytest.approx(2 * force_eq_3(overlap), rel=1e-9)
    assert stiffness == pytest.approx(longer * 2 ** (1 / 3) * stiffness_eq_5(force), rel=1e-6)


def test_frictionless_law_has_no_tangential_force():
    _, stiffness = force_and_stiffness(1e-6, tangentialLaw="none")
    assert stiffness == pytest.approx(0.0, abs=1e-9)
