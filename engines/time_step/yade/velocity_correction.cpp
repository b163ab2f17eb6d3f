// SPDX-License-Identifier: GPL-2.0-or-later
#include <engines/time_step/yade/velocity_correction.hpp>

#include <engines/flat/yade/clumps.hpp>

#include <pkg/dem/NewtonIntegrator.hpp>

namespace yade {

namespace {

const NewtonIntegrator* integrator(const Scene& scene) {
    for (const auto& engine : scene.engines)
        if (const auto* newton = dynamic_cast<const NewtonIntegrator*>(engine.get()))
            return newton;
    return nullptr;
}

// Force and torque on a body, those on the members of a clump included.
void add_loads(Scene& scene, const Body& body, Vector3r& force, Vector3r& torque) {
    force = scene.forces.getForce(body.id);
    torque = scene.forces.getTorque(body.id);
    if (!body.isClump())
        return;
    const grainfall::flat::Load members = load_of_members(scene, body);
    force += members.force;
    torque += members.torque;
}

} // namespace

void correct_velocities(Scene& scene, Real before, Real after) {
    const NewtonIntegrator* newton = integrator(scene);
    if (!newton || newton->damping != 0 || newton->densityScaling)
        return;
    scene.forces.sync();
    const Real missing = (before - after) / 2;
    Vector3r force, torque;
    for (const auto& body : *scene.bodies) {
        if (!body || body->isClumpMember() || !body->isDynamic())
            continue;
        if (newton->mask > 0 && !body->maskCompatible(newton->mask))
            continue;
        State& state = *body->state;
        const unsigned blocked = state.blockedDOFs;
        add_loads(scene, *body, force, torque);
        for (int i = 0; i < 3; ++i)
            if (!(blocked & (State::DOF_X << i)))
                state.vel[i] += missing * (force[i] / state.mass + newton->gravity[i]);
        // Bodies that turn about all their axes keep their angular momentum, the others their spin.
        if (newton->exactAsphericalRot && body->isAspherical() && !(blocked & State::DOF_RXRYRZ)) {
            state.angMom += missing * torque;
            continue;
        }
        for (int i = 0; i < 3; ++i)
            if (!(blocked & (State::DOF_RX << i)))
                state.angVel[i] += missing * torque[i] / state.inertia[i];
    }
}

} // namespace yade
