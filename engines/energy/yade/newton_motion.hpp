// SPDX-License-Identifier: GPL-2.0-or-later
// What NewtonIntegrator did with one body in the step just made, as the kernels of engines/energy/ want it.
#pragma once

#include <engines/energy/aspherical.hpp>
#include <engines/energy/leapfrog.hpp>

#include <core/Body.hpp>
#include <core/Scene.hpp>
#include <pkg/dem/NewtonIntegrator.hpp>

namespace yade {

/// What a body did in the step before; `blocked` < 0 where that is not known.
struct EarlierMotion {
    Vector3r velocity, spin;
    int blocked;
};

/// The rules of the step, the same for all bodies.
struct NewtonStep {
    Vector3r gravity;
    Real damping;
    bool damps_gravity, exact_aspherical, has_loads;
    grainfall::energy::StepWidths dt;

    NewtonStep(const NewtonIntegrator& newton, const ForceContainer& forces,
               grainfall::energy::StepWidths widths)
        : gravity(newton.gravity), damping(newton.damping), damps_gravity(newton.dampGravity),
          exact_aspherical(newton.exactAsphericalRot), has_loads(forces.getPermForceUsed()), dt(widths) {}

    bool rotates_aspherically(const Body& body) const {
        return exact_aspherical && body.isAspherical() && !(body.state->blockedDOFs & State::DOF_RXRYRZ);
    }
};

/// Adds the step of one body to the sums.
inline void add_body(const Body& body, const EarlierMotion& earlier, ForceContainer& forces,
                     const NewtonStep& step, grainfall::energy::StepSums& sums) {
    namespace ge = grainfall::energy;
    const State& state = *body.state;
    const int blocked = static_cast<int>(state.blockedDOFs);
    const int was_blocked = earlier.blocked < 0 ? blocked : earlier.blocked;
    const Real damping = state.isDamped ? step.damping : 0;
    // A body that was not there before has not seen the step change.
    const ge::StepWidths dt{step.dt.now, earlier.blocked < 0 ? step.dt.now : step.dt.before};
    const Vector3r& force = forces.getForce(body.id);
    const Vector3r& torque = forces.getTorque(body.id);
    Vector3r load = Vector3r::Zero(), load_torque = Vector3r::Zero();
    if (step.has_loads) {
        load = forces.getPermForce(body.id);
        load_torque = forces.getPermTorque(body.id);
    }

    ge::DegreeOfFreedom dof;
    dof.damping = damping;
    for (int axis = 0; axis < 3; ++axis) {
        dof.inertia = state.mass;
        dof.velocity = state.vel[axis];
        dof.earlier = earlier.velocity[axis];
        dof.position = state.pos[axis];
        dof.force = force[axis];
        dof.load = load[axis];
        dof.field = step.gravity[axis];
        dof.damps_field = step.damps_gravity;
        dof.imposed = blocked & (State::DOF_X << axis);
        dof.was_imposed = was_blocked & (State::DOF_X << axis);
        sums.kinetic_translation += ge::add(dof, dt, sums);
    }
    if (step.rotates_aspherically(body)) {
        Vector3r applied = torque;
        for (int axis = 0; axis < 3; ++axis)
            applied[axis] *= ge::cundall_factor(torque[axis], earlier.spin[axis], damping);
        for (int axis = 0; axis < 3; ++axis) {
            const Real before = earlier.spin[axis] * dt.before, after = state.angVel[axis] * dt.now;
            sums.load.add(load_torque[axis], before, after);
            sums.damping.add(applied[axis] - torque[axis], before, after);
        }
        sums.kinetic_rotation +=
            ge::kinetic_energy({state.ori, state.angMom, applied, state.inertia, dt.now});
        return;
    }
    dof.field = 0;
    for (int axis = 0; axis < 3; ++axis) {
        dof.inertia = state.inertia[axis];
        dof.velocity = state.angVel[axis];
        dof.earlier = earlier.spin[axis];
        dof.force = torque[axis];
        dof.load = load_torque[axis];
        dof.imposed = blocked & (State::DOF_RX << axis);
        dof.was_imposed = was_blocked & (State::DOF_RX << axis);
        sums.kinetic_rotation += ge::add(dof, dt, sums);
    }
}

} // namespace yade
