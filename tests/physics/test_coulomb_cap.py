# SPDX-License-Identifier: GPL-2.0-or-later
"""Friction never exceeds mu F_n (the report's Eq 6), spring and dashpot taken together.

Stock YADE tests the spring against the limit and adds the dashpot afterwards. The forces here are
those that reach the bodies, not attributes of the contact, so the same measurement serves both
laws.
"""
from __future__ import annotations

import math

import contact_scenes as cs
import numpy as np
import pytest
from yade import O

SOLID = cs.Solid(1.0e9, 0.25, 2500)
RADIUS = 0.005
SPEED = 2.0
FRICTION = 0.3
DEGREES = (2, 5, 10, 15, 20, 25, 30, 40, 50, 60, 70, 80)


def largest_force_ratio(law, restitution: float) -> np.ndarray:
    """Largest |F_t|/(mu F_n) met in oblique impacts on a rigid plane, for each of DEGREES."""
    O.reset()
    values = dict(frictionAngle=math.atan(FRICTION), restitution=restitution)
    O.materials.append(
        [SOLID.rigid_material(label="plane", **values), SOLID.material(label="sphere", **values)]
    )
    cs.add_plane("plane")
    ids = []
    for i, a in enumerate(np.radians(DEGREES)):
        velocity = (SPEED * math.sin(a), 0, -SPEED * math.cos(a))
        ids.append(cs.add_sphere((0, 4 * RADIUS * i, RADIUS), RADIUS, "sphere", velocity))
    ratios = np.zeros(len(ids))

    def record() -> None:
        force = np.array([cs.force_on(i) for i in ids])
        tangential = np.hypot(force[:, 0], force[:, 1])
        limit = FRICTION * np.maximum(force[:, 2], 0)
        with np.errstate(divide="ignore", invalid="ignore"):
            ratio = np.where(tangential > 0, tangential / limit, 0.0)
        np.maximum(ratios, ratio, out=ratios)

    cs.set_engines(law, record)
    fast = cs.HertzImpact.on_rigid_plane(SOLID, RADIUS, SPEED)
    slow = cs.HertzImpact.on_rigid_plane(
        SOLID, RADIUS, SPEED * math.cos(math.radians(max(DEGREES)))
    )
    O.dt = fast.duration / 400
    cs.run_for(2 * slow.duration)
    assert O.interactions.countReal() == 0
    return ratios


@pytest.mark.parametrize("restitution", [0.3, 0.6, 0.9, 1.0])
@pytest.mark.parametrize(
    "tangential_law", ["incremental", "mindlin-deresiewicz", "report", "secant"]
)
def test_spring_and_dashpot_together_stay_below_friction_times_normal_force(
    tangential_law, restitution
):
    law = cs.grain_law(tangentialLaw=tangential_law)
    ratios = largest_force_ratio(law, restitution)
    # Equality is reached while sliding; the bodies' forces are sums, good to a few units of the
    # last place.
    assert np.all(ratios <= 1 + 1e-12)
    assert np.max(ratios) == pytest.approx(1, rel=1e-12)


def test_attractive_dashpot_gives_no_friction_while_it_pulls():
    law = cs.grain_law({"dashpotAttraction": True})
    assert np.all(largest_force_ratio(law, 0.3) <= 1 + 1e-12)


def test_stock_law_exceeds_the_limit_as_soon_as_it_is_damped():
    """The control: what the cap on the total is for."""
    assert np.max(largest_force_ratio(cs.stock_law(), 1.0)) <= 1 + 1e-12
    assert np.max(largest_force_ratio(cs.stock_law(en=0.6, es=0.6), 0.6)) > 5
