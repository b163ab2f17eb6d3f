# SPDX-License-Identifier: GPL-2.0-or-later
"""Closed forms of the head-on elastic impact after Hertz. SI units."""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class Solid:
    """Elastic solid: Young's modulus [Pa], Poisson's ratio [-], density [kg/m3]."""

    young: float
    poisson: float
    density: float

    @property
    def plane_modulus(self) -> float:
        """E/(1 - nu^2) [Pa]: E* against a rigid plane."""
        return self.young / (1 - self.poisson**2)

    @property
    def shear_compliance(self) -> float:
        """(2 - nu)/G [1/Pa], this solid's part of 1/G*."""
        return (2 - self.poisson) * 2 * (1 + self.poisson) / self.young


@dataclass(frozen=True)
class HertzImpact:
    """Head-on elastic impact after Hertz (Johnson 1985, section 11.4).

    effective_modulus E* [Pa], effective_radius R* [m], effective_mass m* [kg], speed v (closing)
    [m/s].
    """

    effective_modulus: float
    effective_radius: float
    effective_mass: float
    speed: float

    @property
    def stiffness(self) -> float:
        """4/3 E* sqrt(R*) [N/m^1.5]: force over overlap^1.5."""
        return 4 / 3 * self.effective_modulus * math.sqrt(self.effective_radius)

    @property
    def overlap(self) -> float:
        """Largest overlap [m]: kinetic energy 1/2 m* v^2 equals 2/5 F overlap."""
        return (5 * self.effective_mass * self.speed**2 / (4 * self.stiffness)) ** 0.4

    @property
    def force(self) -> float:
        """Largest force [N]."""
        return self.stiffness * self.overlap**1.5

    @property
    def duration(self) -> float:
        """Time in contact [s]: 4/5 sqrt(pi) Gamma(2/5)/Gamma(9/10) overlap/v = 2.9433 overlap/v."""
        factor = 4 * math.sqrt(math.pi) / 5 * math.gamma(0.4) / math.gamma(0.9)
        return factor * self.overlap / self.speed

    @classmethod
    def on_rigid_plane(cls, solid: Solid, radius: float, speed: float) -> HertzImpact:
        """Sphere of `radius` [m] meeting a rigid plane at `speed` [m/s]."""
        return cls(solid.plane_modulus, radius, sphere_mass(solid.density, radius), speed)

    @classmethod
    def of_equal_spheres(cls, solid: Solid, radius: float, closing_speed: float) -> HertzImpact:
        """Two equal spheres of `radius` [m] meeting at `closing_speed` [m/s]."""
        mass = sphere_mass(solid.density, radius)
        return cls(solid.plane_modulus / 2, radius / 2, mass / 2, closing_speed)


def sphere_mass(density: float, radius: float) -> float:
    """Mass [kg] of a sphere."""
    return 4 / 3 * math.pi * radius**3 * density
