# SPDX-License-Identifier: GPL-2.0-or-later
"""One sphere on a plane: from sliding to rolling, and down a slope.

Closed forms of rigid-body mechanics for a uniform sphere, I = 2/5 m R^2 (any textbook of mechanics). The
contact is elastic, so its overlap (4e-4 of the radius) and the swinging of the tangential spring, which
the dashpot stills, separate the measured from the rigid values.
"""
from __future__ import annotations

import math

import contact_scenes as cs
import numpy as np
import pytest
from yade import O

SOLID = cs.Solid(1e8, 0.2, 2650)
RADIUS, GRAVITY = 0.01, 9.81
MASS = cs.sphere_mass(SOLID.density, RADIUS)
LAWS = ["incremental", "secant", "report"]


def sphere_at_rest(law: str, friction: float, slope: float = 0.0, record=None) -> int:
    """A sphere on a plane that slopes down along +x [rad], pressed in as its weight asks; its id."""
    O.reset()
    contact = dict(frictionAngle=math.atan(friction), restitution=0.5)
    O.materials.append([SOLID.rigid_material(**contact), SOLID.material(**contact)])
    cs.add_plane(0)
    hertz = cs.HertzImpact.on_rigid_plane(SOLID, RADIUS, 1.0)
    overlap = (MASS * GRAVITY * math.cos(slope) / hertz.stiffness) ** (2 / 3)
    body = cs.add_sphere((0, 0, RADIUS - overlap), RADIUS, 1)
    gravity = (GRAVITY * math.sin(slope), 0, -GRAVITY * math.cos(slope))
    cs.set_engines(cs.grain_law(tangentialLaw=law), record, gravity=gravity)
    O.dt = 2e-5  # a thirtieth of 1/sqrt(k_n/m)
    return body


def along_and_spin(body: int) -> tuple[float, float]:
    """Speed along the plane [m/s] and spin times radius [m/s]."""
    state = O.bodies[body].state
    return state.vel[0], state.angVel[1] * RADIUS


@pytest.mark.parametrize("friction", [0.2, 0.6])
@pytest.mark.parametrize("law", LAWS)
def test_a_thrown_sphere_slides_then_rolls_with_five_sevenths_of_its_speed(law, friction):
    speed = 0.8
    end = 2 * speed / (7 * friction * GRAVITY)
    sliding_steps = []

    def note_sliding():
        sliding_steps.append(any(contact.phys.isSliding for contact in O.interactions))

    body = sphere_at_rest(law, friction, record=note_sliding)
    O.bodies[body].state.vel = (speed, 0, 0)
    O.trackEnergy = True
    cs.run_for(end / 2)
    # Constant deceleration. Leapfrog's velocity is half a step old, and the spring takes a few steps up.
    assert along_and_spin(body)[0] == pytest.approx(speed - friction * GRAVITY * end / 2, rel=2e-4)
    cs.run_for(end)
    velocity, surface = along_and_spin(body)
    assert velocity == pytest.approx(5 / 7 * speed, rel=5e-4)
    assert surface == pytest.approx(velocity, rel=1e-6)
    rolling = O.time - end
    distance = 12 * speed**2 / (49 * friction * GRAVITY) + 5 / 7 * speed * rolling
    assert O.bodies[body].state.pos[0] == pytest.approx(distance, rel=5e-4)
    # It slides without a pause until the rolling begins, within what the spring needs to turn round.
    assert np.count_nonzero(sliding_steps) * O.dt == pytest.approx(end, rel=2e-3)
    # Two sevenths of the energy go, all to friction and the dashpot.
    energy = dict(O.energy.items())
    lost = energy["grainFriction"] + energy["grainViscous"]
    assert lost == pytest.approx(2 / 7 * 0.5 * MASS * speed**2, rel=1e-3)


def acceleration_down_slope(law: str, friction: float, slope: float) -> tuple[float, float]:
    """Accelerations of the centre and of the spin times radius [m/s2], the start left out."""
    body = sphere_at_rest(law, friction, slope)
    cs.run_for(0.03)
    start = np.array(along_and_spin(body))
    time = O.time
    cs.run_for(0.06)
    return tuple((np.array(along_and_spin(body)) - start) / (O.time - time))


@pytest.mark.parametrize("degrees", [5, 20, 33, 34.5])
@pytest.mark.parametrize("law", LAWS)
def test_a_sphere_rolls_down_slopes_flatter_than_three_and_a_half_times_friction(law, degrees):
    slope = math.radians(degrees)
    assert math.tan(slope) < 3.5 * 0.2
    along, spin = acceleration_down_slope(law, 0.2, slope)
    assert along == pytest.approx(5 / 7 * GRAVITY * math.sin(slope), rel=5e-4)
    assert spin == pytest.approx(along, rel=1e-6)


@pytest.mark.parametrize("degrees", [35.5, 40, 60])
@pytest.mark.parametrize("law", LAWS)
def test_a_sphere_slides_down_steeper_slopes(law, degrees):
    slope = math.radians(degrees)
    assert math.tan(slope) > 3.5 * 0.2
    along, spin = acceleration_down_slope(law, 0.2, slope)
    friction = 0.2 * GRAVITY * math.cos(slope)
    assert along == pytest.approx(GRAVITY * math.sin(slope) - friction, rel=1e-6)
    assert spin == pytest.approx(2.5 * friction, rel=1e-3)  # the arm is 4e-4 short
