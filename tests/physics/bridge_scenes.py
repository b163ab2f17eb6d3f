# SPDX-License-Identifier: GPL-2.0-or-later
"""For the tests of liquid bridges: Willett's formulas written out again, and scenes of two bodies."""
from __future__ import annotations

import math
from dataclasses import dataclass

import contact_scenes as cs
import numpy as np
from yade import Bo1_SolidOfRevolution_Aabb, Ig2_SolidOfRevolution_Sphere_ScGeom, O

# Quartz grain of 2 mm, softened so that a step may be long; water.
SOLID = cs.Solid(1e9, 0.2, 2650)
RADIUS = 1e-3
TENSION = 0.0728


def willett_fit(separation, relative_volume: float, angle: float = 0.0) -> np.ndarray:
    """F/(2 pi R gamma) at a separation over R; appendix of Willett et al. 2000."""
    x = math.log(relative_volume) ** np.arange(4)
    t = np.array([1, angle, angle**2])
    f1 = t @ [
        [-0.44507, -0.1119, -0.012101, -0.0005],
        [0.050832, -0.000411, -0.0036456, -0.0003505],
        [-1.1466, -0.1490, -0.01255, -0.00029076],
    ]
    f2 = t @ [
        [1.9222, -0.0668, -0.0013375, 0],
        [-0.57473, -0.1201, -0.0068988, 0],
        [-1.2918, -0.22574, -0.01137, 0],
    ]
    f3 = t @ [
        [1.268, 0.198, 0.02232, 0.0008585],
        [-0.01396, 0.092, 0.02238, 0.001318],
        [-0.23566, -0.06418, -0.009853, -0.00053],
    ]
    f4 = t @ [
        [-0.010703, 0.03345, 0.0018574, 0],
        [0.073776, 0.04543, 0.004456, 0],
        [-0.34742, -0.09056, -0.006257, 0],
    ]
    log_s = np.log(np.maximum(separation, 1e-30) / 2 / math.sqrt(relative_volume))
    return np.exp(f1 @ x - (f2 @ x) * np.exp((f3 @ x) * log_s + (f4 @ x) * log_s**2))


def willett_closed(separation, relative_volume: float, angle: float = 0.0) -> np.ndarray:
    """F/(2 pi R gamma) at a separation over R; Eq 12 of Willett et al. 2000."""
    s = np.maximum(separation, 0) / 2 / math.sqrt(relative_volume)
    return math.cos(angle) / (1 + 2.1 * s + 10 * s**2)


@dataclass(frozen=True)
class Expected:
    """Bridge by the formulas: radius R [m], volume [m3], surface tension [N/m], angle [rad]."""

    radius: float
    volume: float
    tension: float = TENSION
    angle: float = 0.0
    form: str = "willett"

    @property
    def relative_volume(self) -> float:
        """V/R^3."""
        return self.volume / self.radius**3

    @property
    def rupture(self) -> float:
        """Rupture distance [m]: Eq 15."""
        root = self.relative_volume ** (1 / 3)
        return self.radius * (1 + self.angle / 2) * (root + 0.1 * root**2)

    def force(self, separation) -> np.ndarray:
        """Attraction [N]."""
        formula = willett_closed if self.form == "willett-closed" else willett_fit
        relative = formula(np.asarray(separation) / self.radius, self.relative_volume, self.angle)
        return 2 * math.pi * self.radius * self.tension * relative


def moist(moisture: float = 0.01, **attributes):
    """GrainMat of the moist grain."""
    return SOLID.material(gravimetricMoisture=moisture, **attributes)


def grain_share(moisture: float, radius: float = RADIUS, bridges: float = 6) -> float:
    """Water [m3] that a grain gives to a bridge."""
    return moisture * cs.sphere_mass(SOLID.density, radius) / 1000 / bridges


def set_engines(gravity: float = 0.0, record=None, factor: float = 1.0, **law) -> object:
    """Engines for all shapes; returns the law. `factor`: interactionDetectionFactor of spheres."""
    functors = cs.grain_law(**law)
    cs.set_engines(functors, record, (0, 0, -gravity))
    collider, loop = O.engines[1:3]
    collider.verletDist = 0
    collider.boundDispatcher.functors[0].aabbEnlargeFactor = factor
    collider.boundDispatcher.functors += [Bo1_SolidOfRevolution_Aabb()]
    loop.geomDispatcher.functors[0].interactionDetectionFactor = factor
    loop.geomDispatcher.functors += [Ig2_SolidOfRevolution_Sphere_ScGeom()]
    O.dt = 1e-6
    return functors[1][0]


def kinetic_energy() -> float:
    """Of all movable spheres [J]."""
    states = [b.state for b in O.bodies if b.dynamic]
    return sum(
        0.5 * s.mass * s.vel.squaredNorm() + 0.5 * s.inertia[0] * s.angVel.squaredNorm()
        for s in states
    )


def booked() -> float:
    """Energy [J] that the law has booked."""
    return sum(value for name, value in O.energy.items() if name.startswith("grain"))
