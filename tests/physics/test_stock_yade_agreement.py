# SPDX-License-Identifier: GPL-2.0-or-later
"""Where the formulas coincide, stock YADE's Hertz-Mindlin law and ours give the same trajectories.

The tolerance is 1e-9. The formulas coincide without dashpots: head on, in gross sliding, in shear
while the normal force grows, and in packs without friction. They part when the normal force falls
on a sheared contact that does not slide, where ours shrinks the shear force with the stiffness;
test_tangential_energy.py and test_coulomb_cap.py show why.

Both laws run the same scene of GrainMat, with planes as full as Hertz's (hertzian=True for the
stock functors). The operations differ in order, so the two differ by rounding, which a pack
multiplies with every collision.
"""
from __future__ import annotations

import math
from collections.abc import Callable

import contact_scenes as cs
import numpy as np
import pytest
from yade import O

TOLERANCE = 1e-9
LAWS = {"stock": cs.stock_law, "ours": cs.grain_law}
STEEL = cs.Solid(2.0e11, 0.30, 7800)
GLASS = cs.Solid(5.0e10, 0.20, 2500)
SOFT = cs.Solid(1.0e8, 0.25, 2500)


class Trajectory:
    """Positions, velocities and spins of all movable bodies, one row a call; the engines call it.

    With `watch_release`, `released_at` becomes the number of steps before the first in which the
    normal force on a sheared contact falls.
    """

    def __init__(self, watch_release: bool = False) -> None:
        self.position: list[np.ndarray] = []
        self.velocity: list[np.ndarray] = []
        self.spin: list[np.ndarray] = []
        self.released_at: int | None = None
        self._watch = watch_release
        self._stiffness: dict[tuple[int, int], float] = {}

    def __call__(self) -> None:
        states = [b.state for b in O.bodies if b.dynamic]
        self.position.append(np.array([s.pos for s in states]))
        self.velocity.append(np.array([s.vel for s in states]))
        self.spin.append(np.array([s.angVel for s in states]))
        if self._watch and self.released_at is None and self._some_sheared_contact_is_released():
            self.released_at = len(self.position) - 1

    def _some_sheared_contact_is_released(self) -> bool:
        found = False
        for i in O.interactions:
            if not i.isReal:
                continue
            key, kn = (i.id1, i.id2), i.phys.kn
            sheared = i.phys.shearForce.norm() > 1e-9 * i.phys.normalForce.norm()
            found = found or (kn < self._stiffness.get(key, 0) and sheared)
            self._stiffness[key] = kn
        return found


def run_both(
    build: Callable[[], float], steps: int, watch_release: bool = False, **engines
) -> dict[str, Trajectory]:
    """Run the same scene with each law. `build` makes the bodies and returns the time step [s]."""
    results = {}
    for name, law in LAWS.items():
        O.reset()
        O.dt = build()
        results[name] = Trajectory(watch_release)
        cs.set_engines(law(), results[name], **engines)
        O.run(steps, True)
    return results


def largest_difference(results: dict[str, Trajectory], rows: int | None = None) -> float:
    """Largest difference of displacements, relative to the largest displacement, and of velocities
    and surface speeds, relative to the largest speed, over the first `rows` rows."""
    stock, ours = results["stock"], results["ours"]

    def difference(quantity: str) -> float:
        pair = (np.array(getattr(law, quantity)[:rows]) for law in (stock, ours))
        return float(np.max(np.abs(np.subtract(*pair))))

    travel = np.max(np.abs(np.array(ours.position[:rows]) - ours.position[0]))
    speed = np.max(np.abs(ours.velocity[:rows]))
    radius = max(b.shape.radius for b in O.bodies if b.dynamic)
    return max(
        difference("position") / travel,
        difference("velocity") / speed,
        difference("spin") * radius / speed,
    )


def head_on() -> float:
    """Unequal spheres of unlike solids."""
    O.materials.append([STEEL.material(label="steel"), GLASS.material(label="glass")])
    cs.add_sphere((-0.003, 0, 0), 0.003, "steel", velocity=(2, 0, 0))
    cs.add_sphere((0.005, 0, 0), 0.005, "glass", velocity=(-1, 0, 0))
    modulus = 1 / (1 / STEEL.plane_modulus + 1 / GLASS.plane_modulus)
    masses = cs.sphere_mass(STEEL.density, 0.003), cs.sphere_mass(GLASS.density, 0.005)
    mass = masses[0] * masses[1] / sum(masses)
    return cs.HertzImpact(modulus, 0.003 * 0.005 / 0.008, mass, 3.0).duration / 400


def test_head_on_impact_of_unlike_spheres_is_the_same():
    results = run_both(head_on, 500)
    assert O.interactions.countReal() == 0
    assert largest_difference(results) < TOLERANCE


def oblique(
    degrees: float, friction: float, spin: tuple[float, float, float]
) -> Callable[[], float]:
    """A spinning sphere meets a held one of unlike solid at an angle from the normal.

    The held sphere is a hundred times larger and stands for a plane: a plane of the stock functors
    is 1e8 radii large, ours is flat, and that alone makes 5e-9 of stiffness.
    """

    def build() -> float:
        radius, speed, angle = 0.004, 3.0, math.radians(degrees)
        values = dict(frictionAngle=math.atan(friction))
        O.materials.append(
            [GLASS.material(label="glass", **values), STEEL.material(label="steel", **values)]
        )
        cs.add_sphere((0, 0, -100 * radius), 100 * radius, "steel", fixed=True)
        velocity = (speed * math.sin(angle), 0, -speed * math.cos(angle))
        sphere = cs.add_sphere((0, 0, radius), radius, "glass", velocity)
        O.bodies[sphere].state.angVel = spin
        modulus = 1 / (1 / STEEL.plane_modulus + 1 / GLASS.plane_modulus)
        mass = cs.sphere_mass(GLASS.density, radius)
        return cs.HertzImpact(modulus, radius / 1.01, mass, -velocity[2]).duration / 400

    return build


@pytest.mark.parametrize("degrees", [45, 60, 75, 85])
def test_impact_in_gross_sliding_is_the_same(degrees):
    results = run_both(oblique(degrees, friction=0.1, spin=(0, -30, 0)), 500)
    assert O.interactions.countReal() == 0
    assert largest_difference(results) < TOLERANCE


@pytest.mark.parametrize("friction", [0.1, 5.0], ids=["slips first", "sticks"])
@pytest.mark.parametrize("degrees", [5, 15, 30])
def test_oblique_impact_is_the_same_while_the_normal_force_grows_and_not_after(degrees, friction):
    results = run_both(oblique(degrees, friction, spin=(20, -30, 10)), 500, watch_release=True)
    loading = results["ours"].released_at
    assert 190 < loading < 210  # half of a collision of 400 steps
    assert largest_difference(results, loading) < TOLERANCE
    if friction > 1:
        assert largest_difference(results) > 1e-4


def lattice(columns: int, layers: int, pitch: float) -> np.ndarray:
    """Sites of hexagonal layers of columns x columns, shape (n, 3) [m]; layer by layer, row by row."""
    sites = []
    for layer in range(layers):
        for row in range(columns):
            for column in range(columns):
                x = column + 0.5 * (row % 2)
                y = math.sqrt(3) / 2 * row + layer % 2 / math.sqrt(3)
                sites.append((pitch * x, pitch * y, pitch * math.sqrt(2 / 3) * layer))
    return np.array(sites)


def settling_pack() -> float:
    """A hundred frictionless grains, a little out of order, fall into pockets between held ones."""
    radius, columns, layers = 0.005, 7, 5
    O.materials.append(SOFT.material(label="grain"))
    random = np.random.default_rng(3)
    for n, site in enumerate(lattice(columns, layers, 2.02 * radius)):
        layer, row, column = n // columns**2, n // columns % columns, n % columns
        held = layer == 0 or {row, column} & {0, columns - 1}
        shift = 0 if held else random.uniform(-0.002, 0.002, 3) * radius
        cs.add_sphere(site + shift, radius, "grain", fixed=bool(held))
    return 1e-5


def test_pack_settling_without_friction_is_the_same():
    """Compared until grains move at a tenth of their largest speed: collisions multiply rounding by
    ten in each 10 ms, so that no two laws could agree to 1e-9 for ever."""
    results = run_both(settling_pack, 5000, gravity=(0, 0, -9.81), damping=0.3, period=100)
    speed = np.max(np.linalg.norm(results["ours"].velocity, axis=2), axis=1)
    assert speed[-1] < 0.1 * np.max(speed)
    assert O.interactions.countReal() > 200
    assert largest_difference(results) < TOLERANCE


def crushed_pack() -> float:
    """Grains in touch rush together, sheared, spinning: all contacts are loaded at once."""
    radius = 0.005
    O.materials.append(SOFT.material(frictionAngle=math.atan(0.5), label="grain"))
    sites = lattice(5, 4, 2 * radius)
    random = np.random.default_rng(4)
    for site in sites:
        body = O.bodies[cs.add_sphere(site, radius, "grain")]
        x, y, z = site - sites.mean(axis=0)
        body.state.vel = (-20 * x + 5 * z, -20 * y, -20 * z)
        body.state.angVel = tuple(random.uniform(-5, 5, 3))
    return 2.5e-7


def test_pack_with_friction_is_the_same_until_a_sheared_contact_is_released():
    results = run_both(crushed_pack, 1600, watch_release=True, period=4)
    loading = results["ours"].released_at
    assert loading > 200  # of 400 rows: the stiffest contacts reach their peak after 0.24 ms
    assert O.interactions.countReal() > 400
    assert largest_difference(results, loading) < TOLERANCE
    assert largest_difference(results) > 1e-4
