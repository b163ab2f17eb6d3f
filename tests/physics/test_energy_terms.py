# SPDX-License-Identifier: GPL-2.0-or-later
"""Each term of the energy balance against its closed form."""
from __future__ import annotations

import math

import contact_scenes as cs
import ledger_scenes as scenes
import pytest
from yade import EnergyLedger, GrainMat, HertzTimeStepper, O, wrapper

G = scenes.GRAVITY
RADIUS = scenes.RADIUS
SOLID = scenes.HARD
MASS = cs.sphere_mass(SOLID.density, RADIUS)
INERTIA = 0.4 * MASS * RADIUS**2
ROUNDING = 1e-12  # relative


def free_sphere(**engines) -> EnergyLedger:
    """One sphere, away from everything; keywords go to set_engines."""
    O.materials.append(SOLID.material(label="sphere"))
    cs.add_sphere((0, 0, 0), RADIUS, "sphere")
    cs.set_engines(cs.grain_law(), **engines)
    O.dt = 1e-4
    return scenes.add_ledger()


def total(ledger: EnergyLedger) -> float:
    """Residual [J]; the table must agree with it."""
    table = ledger.table()
    assert table["residual"] == ledger.residual
    return table["residual"]


def test_free_fall_turns_potential_into_kinetic_energy():
    ledger = free_sphere(gravity=(0, 0, -G))
    O.run(1001, True)
    table = ledger.table()
    # The books stand at the positions that the last forces belong to, one step before the present ones.
    fall = G * (1000 * O.dt) ** 2 / 2
    assert table["potential"] == pytest.approx(-MASS * G * fall, rel=2e-3)  # 1000 steps from rest
    assert table["kineticTranslation"] == pytest.approx(-table["potential"], rel=ROUNDING)
    assert abs(total(ledger)) < ROUNDING * table["kineticTranslation"]


def test_spinning_sphere_keeps_two_fifths_of_its_inertia():
    ledger = free_sphere()
    O.bodies[0].state.angVel = (30, -40, 120)
    O.run(50, True)
    assert ledger.table()["kineticRotation"] == pytest.approx(
        0.5 * INERTIA * 130**2, rel=ROUNDING
    )
    assert ledger.relativeResidual < ROUNDING


def test_permanent_force_and_torque_do_force_times_way_and_torque_times_angle():
    ledger = free_sphere(gravity=(0, 0, -G))
    force, torque = 0.3, 2e-5
    O.bodies[0].state.vel = (0, -1, 0)
    O.forces.setPermF(0, (force, 0, 0))
    O.forces.setPermT(0, (0, torque, 0))
    O.run(400, True)
    state = O.bodies[0].state
    way = state.pos[0] - state.vel[0] * O.dt
    angle = torque / INERTIA * (399 * O.dt) ** 2 / 2
    table = ledger.table()
    assert table["permanentLoad"] == pytest.approx(force * way + torque * angle, rel=5e-3)
    assert table["kineticRotation"] == pytest.approx(
        torque * angle, rel=5e-3
    )  # 400 steps from rest
    assert abs(total(ledger)) < ROUNDING * ledger.energyInPlay


def test_largest_compression_holds_the_kinetic_energy_of_the_impact():
    impact = cs.HertzImpact.on_rigid_plane(SOLID, RADIUS, scenes.SPEED)
    O.materials.append([SOLID.rigid_material(label="plane"), SOLID.material(label="sphere")])
    cs.add_plane("plane")
    cs.add_sphere((0, 0, RADIUS), RADIUS, "sphere", (0, 0, -scenes.SPEED))
    cs.set_engines(cs.grain_law())
    ledger = scenes.add_ledger()
    O.dt = impact.duration / 2000
    cs.run_for(impact.duration / 2)
    table = ledger.table()
    assert table["elasticNormal"] == pytest.approx(0.4 * impact.force * impact.overlap, rel=1e-4)
    assert table["elasticNormal"] == pytest.approx(0.5 * MASS * scenes.SPEED**2, rel=1e-4)
    assert table["kineticTranslation"] < 1e-4 * table["elasticNormal"]
    assert table["elasticShear"] == table["friction"] == table["viscous"] == 0


@pytest.mark.parametrize("restitution", [0.3, 0.7, 0.95])
def test_dashpot_takes_one_less_the_restitution_squared(restitution):
    ledger = scenes.head_on(800, restitution)
    lost = (1 - restitution**2) * 0.5 * MASS * scenes.SPEED**2
    assert ledger.table()["viscous"] == pytest.approx(lost, rel=2e-3)


def pressing(overlap: float) -> tuple[float, float]:
    """Normal force [N] and tangential stiffness [N/m] at this overlap on a rigid plane."""
    normal = 4 / 3 * SOLID.plane_modulus * math.sqrt(RADIUS) * overlap**1.5
    return normal, 8 / SOLID.shear_compliance * math.sqrt(RADIUS * overlap)


def pressed_sphere(mu: float, overlap: float, speed: float) -> EnergyLedger:
    """A sphere that may neither sink nor turn is pressed on a rough rigid plane and pushed in step 1.

    Pushed between the contact forces and the motion: the law would take a velocity that is set before them for
    that of the step just made.
    """
    angle = math.atan(mu)
    O.materials.append(
        [
            SOLID.rigid_material(frictionAngle=angle, label="plane"),
            SOLID.material(frictionAngle=angle, label="sphere"),
        ]
    )
    cs.add_plane("plane")
    cs.add_sphere((0, 0, RADIUS - overlap), RADIUS, "sphere")
    O.bodies[1].state.blockedDOFs = "zXYZ"

    def push() -> None:
        if O.iter == 1:
            O.bodies[1].state.vel = (speed, 0, 0)

    cs.set_engines(cs.grain_law(), push)
    O.dt = 1e-6
    return scenes.add_ledger()


def test_sliding_block_loses_friction_times_way():
    mu, overlap, speed = 0.3, 1e-6, 0.5
    ledger = pressed_sphere(mu, overlap, speed)
    normal, stiffness = pressing(overlap)
    O.run(150, True)
    state = O.bodies[1].state
    assert 0.2 * speed < state.vel[0] < 0.8 * speed
    way = state.pos[0] - state.vel[0] * O.dt
    reach = mu * normal / stiffness  # of the spring, whose way is not slip
    table = ledger.table()
    # The spring is stretched to its limit within one step, with half the force on the mean.
    first = speed * O.dt
    slip = mu * normal * (way - first) + 0.5 * mu * normal * (first - reach)
    assert table["friction"] == pytest.approx(slip, rel=1e-5)
    assert table["elasticShear"] == pytest.approx(0.5 * mu * normal * reach, rel=1e-5)
    lost = 0.5 * MASS * speed**2 - table["kineticTranslation"]
    assert lost == pytest.approx(table["friction"] + table["elasticShear"], rel=1e-5)


def test_elastic_part_of_the_slip_step_is_not_friction():
    """One step stretches the spring to its limit and far beyond: only the way beyond it is slip."""
    mu, overlap = 0.3, 1e-6
    normal, stiffness = pressing(overlap)
    limit = mu * normal
    reach = limit / stiffness
    way = 3 * reach
    ledger = pressed_sphere(mu, overlap, way / 1e-6)
    O.bodies[1].state.blockedDOFs = "xyzXYZ"
    O.run(3, True)
    table = ledger.table()
    # The force grows from nothing to the limit in this step: its mean is half of that.
    assert table["elasticShear"] == pytest.approx(0.5 * limit * reach, rel=1e-5)
    assert table["friction"] == pytest.approx(0.5 * limit * (way - reach), rel=1e-5)
    assert table["imposedMotion"] == pytest.approx(0.5 * limit * way, rel=1e-5)
    O.run(1, True)
    assert ledger.table()["friction"] - table["friction"] == pytest.approx(limit * way, rel=1e-5)


def test_pushed_wall_puts_in_what_the_spring_holds():
    overlap, steps = 2e-5, 2000
    O.materials.append([SOLID.rigid_material(label="plane"), SOLID.material(label="sphere")])
    wall = cs.add_plane("plane")
    cs.add_sphere((0, 0, RADIUS), RADIUS, "sphere", fixed=True)
    cs.set_engines(cs.grain_law())
    O.dt = 1e-6
    O.bodies[wall].state.vel = (0, 0, overlap / steps / O.dt)
    ledger = scenes.add_ledger()
    O.run(steps + 1, True)
    stored = 0.4 * 4 / 3 * SOLID.plane_modulus * math.sqrt(RADIUS) * overlap**2.5
    table = ledger.table()
    assert table["elasticNormal"] == pytest.approx(stored, rel=2e-6)  # the plane is rigid to 1e-6
    # Trapezoid sum of a force that goes with the overlap to the 1.5 over 2000 steps.
    assert table["imposedMotion"] == pytest.approx(stored, rel=2e-6)
    assert table["kineticTranslation"] == table["potential"] == 0


def test_body_lifted_and_let_go_brings_in_its_motion_and_falls_without_a_jump():
    ledger = free_sphere(gravity=(0, 0, -G))
    state = O.bodies[0].state
    state.blockedDOFs, state.vel = "xyzXYZ", (0, 0, 2)
    O.run(100, True)
    assert ledger.table()["potential"] == 0  # who holds it bears its weight
    state.blockedDOFs = ""
    O.run(5000, True)
    table = ledger.table()
    assert table["imposedMotion"] == pytest.approx(0.5 * MASS * 2**2, rel=ROUNDING)
    assert abs(total(ledger)) < 1e-11 * ledger.energyInPlay
    state.blockedDOFs = "xyzXYZ"
    O.run(1, True)
    assert abs(total(ledger)) < 1e-11 * ledger.energyInPlay


def bouncing_ball(damping: float) -> EnergyLedger:
    """A soft ball falls on a plane and bounces a few times."""
    solid = scenes.SOFT
    O.materials.append([solid.rigid_material(label="plane"), solid.material(label="sphere")])
    cs.add_plane("plane")
    cs.add_sphere((0, 0, 1.4 * RADIUS), RADIUS, "sphere", (0.1, 0, 0))
    cs.set_engines(cs.grain_law(), gravity=(0, 0, -G), damping=damping)
    impact = cs.HertzImpact.on_rigid_plane(solid, RADIUS, math.sqrt(2 * G * 0.4 * RADIUS))
    O.dt = impact.duration / 200
    ledger = scenes.add_ledger(iterPeriod=7)
    cs.run_for(0.12)
    return ledger


def test_numerical_damping_of_a_bouncing_ball_is_booked():
    ledger = bouncing_ball(0.2)
    table = ledger.table()
    assert table["numericalDamping"] > 0.2 * ledger.energyInPlay
    # Newton's own book takes the velocity before the step, and agrees to the order of the step.
    assert table["numericalDamping"] == pytest.approx(O.energy["nonviscDamp"], rel=0.02)
    assert abs(total(ledger)) < 1e-4 * ledger.energyInPlay


def test_numerical_damping_in_free_flight_is_booked_to_rounding():
    ledger = free_sphere(gravity=(1.0, 0.5, -G), damping=0.3)
    state = O.bodies[0].state
    state.vel, state.angVel = (-0.03, 0, 0.2), (0, 3, 0)
    O.forces.setPermT(0, (0, -2e-5, 1e-6))
    O.run(1000, True)
    assert ledger.table()["numericalDamping"] > 1e-3 * ledger.energyInPlay
    assert abs(total(ledger)) < 1e-11 * ledger.energyInPlay


def test_change_of_the_step_explains_what_it_makes():
    """Under a constant force the integrator errs by the changes of the step alone."""
    ledger = free_sphere(gravity=(0, 0, -G))
    for i in range(30):
        O.dt = 1e-4 * (1 + i % 3)
        O.run(5, True)
    assert abs(ledger.residual) > 1e-4 * ledger.energyInPlay
    assert ledger.residual == pytest.approx(ledger.stepChangeEnergy, rel=1e-9)


@pytest.mark.parametrize("corrected", [True, False])
def test_change_of_the_step_by_the_stepper_explains_what_it_makes(corrected):
    """So it does with the velocities that HertzTimeStepper corrects; the error then is of second order."""
    ledger = free_sphere(gravity=(0, 0, -G))
    stepper = HertzTimeStepper(
        safety=100,
        timeStepUpdateInterval=1,
        deadBand=0,
        maxGrowth=1e9,
        correctVelocity=corrected,
    )
    O.engines = O.engines[:3] + [stepper] + O.engines[3:]
    O.run(2, True)
    for i in range(30):
        stepper.safety = 100 * (1 + i % 3)
        O.run(5, True)
    assert stepper.changes == 30
    assert ledger.residual == pytest.approx(ledger.stepChangeEnergy, rel=1e-6)
    share = abs(ledger.residual) / ledger.energyInPlay
    assert (share < 1e-4) if corrected else (share > 1e-3)


def test_clump_is_counted_once_and_closes_in_a_collision():
    O.materials.append(
        [SOLID.rigid_material(label="plane"), SOLID.material(label="sphere", restitution=0.8)]
    )
    cs.add_plane("plane")
    clump, members = O.bodies.appendClumped(
        [
            scenes.utils.sphere((0, 0, 2 * RADIUS), RADIUS, material="sphere"),
            scenes.utils.sphere((1.5 * RADIUS, 0, 2.5 * RADIUS), RADIUS, material="sphere"),
        ]
    )
    state = O.bodies[clump].state
    state.vel = (0, 0, -1)
    cs.set_engines(cs.grain_law(), gravity=(0, 0, -G))
    ledger = scenes.add_ledger()
    duration = cs.HertzImpact.on_rigid_plane(SOLID, RADIUS, 1).duration
    O.dt = duration / 400
    O.run(2, True)
    assert ledger.table()["kineticTranslation"] == pytest.approx(0.5 * state.mass, rel=1e-4)
    cs.run_for(6e-3)
    table = ledger.table()
    assert table["kineticRotation"] > 0.01 * ledger.energyInPlay
    assert table["viscous"] > 0
    # Its rotation is integrated to first order.
    assert ledger.relativeResidual < 1e-3


def test_free_top_drifts_to_first_order_and_no_more():
    drifts = []
    for step in (4e-5, 2e-5, 1e-5):
        O.reset()
        O.materials.append(GrainMat(label="m"))
        body = scenes.utils.sphere((0, 0, 0), RADIUS, material="m")
        body.state.inertia = (1e-7, 3e-7, 2e-7)
        body.aspherical = True
        body.state.angMom = (2e-6, -3e-6, 5e-6)
        O.bodies.append(body)
        O.engines = [wrapper.ForceResetter(), wrapper.NewtonIntegrator(damping=0)]
        O.dt = step
        ledger = scenes.add_ledger()
        O.run(round(0.05 / step), True)
        drifts.append(ledger.relativeResidual)
    assert drifts[0] / drifts[1] == pytest.approx(2, rel=0.1)
    assert drifts[1] / drifts[2] == pytest.approx(2, rel=0.1)
