# SPDX-License-Identifier: GPL-2.0-or-later
"""A pile at rest for a million steps neither creeps nor heats."""
from __future__ import annotations

import math

import hard_scenes as hs
import numpy as np
import pytest
from yade import O, utils

GRAVITY = 9.81
# A million for the default law, a tenth for the others: a million steps of these piles take most of a minute.
STEPS = {law: 100_000 for law in hs.TANGENTIAL_LAWS} | {"incremental": 1_000_000}


def add_pile(curve: str, y: float) -> list[int]:
    """Two grains between two walls, one on top of them, all in a plane: stands without friction. Ids of the grains."""
    r = hs.RADIUS
    label = hs.material(curve, curve, restitution=0.5)
    apart = 1.2 * r  # half the distance of the lower two
    low = hs.sphere((-apart, y, r), r, label), hs.sphere((apart, y, r), r, label)
    top = hs.sphere((0, y, r + math.sqrt(4 * r**2 - apart**2)), r, label)
    for side in (-1, 1):
        centre = (side * (apart + 2 * r), y, r)
        O.bodies.append(utils.box(centre, (r, r, r), fixed=True, material=label))
    O.bodies.append(utils.box((0, y, -r), (4 * r, r, r), fixed=True, material=label))
    for i in (*low, top):
        O.bodies[i].state.blockedDOFs = "yXZ"
    return [*low, top]


@pytest.mark.parametrize("law", hs.TANGENTIAL_LAWS)
def test_a_pile_at_rest_neither_creeps_nor_heats(law):
    grains = []
    for number, curve in enumerate(hs.CURVES):
        grains += add_pile(curve, 6 * hs.RADIUS * number)
    hs.set_engines(law, gravity=GRAVITY)
    # Overlaps here are 1e-10 m: a collision at the speed of falling through one overlap is the time scale.
    O.dt = hs.impact_duration(math.sqrt(2 * GRAVITY * 1e-9)) / 40
    O.run(20_000, True)

    weight = hs.states(grains)[0].mass * GRAVITY
    lift = weight * hs.RADIUS  # J, lifting a grain by its radius
    before = np.array([s.pos for s in hs.states(grains)])
    books = hs.booked()
    assert hs.kinetic_energy(grains) < 1e-12 * lift
    O.run(STEPS[law], True)
    after = np.array([s.pos for s in hs.states(grains)])
    # Not a thousandth of an overlap, in as many steps as would let the grains fall a metre.
    assert np.abs(after - before).max() < 1e-9 * hs.RADIUS
    assert hs.kinetic_energy(grains) < 1e-12 * lift
    heat = {name: value - books.get(name, 0.0) for name, value in hs.booked().items()}
    assert np.abs(list(heat.values())).max() < 1e-9 * lift
    # Still carried: the forces on the floors add up to the weight.
    floors = [b.id for b in O.bodies if b.state.mass > 0 and b.id not in grains]
    carried = -sum(O.forces.f(i)[2] for i in floors)
    assert carried == pytest.approx(len(grains) * weight, rel=1e-6)
