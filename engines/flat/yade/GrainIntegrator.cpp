// SPDX-License-Identifier: GPL-2.0-or-later
#include <engines/flat/yade/GrainIntegrator.hpp>

#include <engines/flat/rigid_motion.hpp>
#include <engines/flat/yade/GrainInteractionLoop.hpp>

#include <core/EnergyTracker.hpp>
#include <core/Scene.hpp>
#include <core/State.hpp>

namespace yade {

YADE_PLUGIN((GrainIntegrator));

namespace gf = grainfall::flat;

GrainIntegrator::~GrainIntegrator() = default;

GrainInteractionLoop* GrainIntegrator::loop() const {
    for (const auto& engine : scene->engines)
        if (auto* found = dynamic_cast<GrainInteractionLoop*>(engine.get()))
            return found;
    return nullptr;
}

void GrainIntegrator::action() {
    GrainInteractionLoop* contacts = loop();
    FlatGrains* grains = contacts && !contacts->dead ? contacts->grains() : nullptr;
    if (!grains) {
        NewtonIntegrator::action();
        return;
    }
    const Look& look = contacts->look();
    if (look.changes_between == Changed::anything)
        contacts->take_over_between();
    else if (look.changes_between == Changed::states)
        grains->take_over_states();
    scene->forces.sync();
    const gf::StepRules rules{scene->dt, gravity, damping, dampGravity};
    booked_ = {};
    Real fastest = grains->move(*scene, rules, look.after);
    for (Body* body : grains->others()) {
        move_other(*body, rules);
        fastest = std::max(fastest, body->state->vel.squaredNorm());
    }
    maxVelocitySq = fastest;
    if (scene->trackEnergy)
        settle_books(grains->motion_book());
    if (look.after)
        grains->publish_states();
    contacts->step_done(look.after);
}

/// A body that is no flat sphere: as NewtonIntegrator does it.
void GrainIntegrator::move_other(Body& body, const gf::StepRules& rules) {
    State& state = *body.state;
    const Vector3r& force = scene->forces.getForce(body.id);
    const Vector3r& torque = scene->forces.getTorque(body.id);
    if (scene->trackEnergy)
        book(body, force, torque);
    gf::RigidBody rigid{state.pos,    state.ori,
                        state.vel,    state.angVel,
                        state.angMom, {state.mass, state.inertia, state.blockedDOFs, state.isDamped}};
    gf::advance(rigid, force, torque, rules, exactAsphericalRot && body.isAspherical());
}

/// As NewtonIntegrator books it: before the step, with the velocities of the step before.
void GrainIntegrator::book(const Body& body, const Vector3r& force, const Vector3r& torque) {
    const State& state = *body.state;
    booked_.translation += 0.5 * state.mass * state.vel.squaredNorm();
    const Vector3r spin = body.isAspherical() ? Vector3r(state.ori.conjugate() * state.angVel) : state.angVel;
    booked_.rotation += 0.5 * spin.dot(state.inertia.cwiseProduct(spin));
    booked_.gravity_work -= gravity.dot(state.vel) * state.mass * scene->dt;
    if (damping != 0 && state.isDamped) {
        const Vector3r push = force + state.mass * gravity;
        booked_.damping +=
            (state.vel.cwiseAbs().dot(push.cwiseAbs()) + state.angVel.cwiseAbs().dot(torque.cwiseAbs())) *
            damping * scene->dt;
    }
}

void GrainIntegrator::settle_books(const FlatGrains::MotionBook& grains) {
    booked_ += grains;
    EnergyTracker& energy = *scene->energy;
    if (kinSplit) {
        energy.add(booked_.translation, "kinTrans", kinEnergyTransIx, true);
        energy.add(booked_.rotation, "kinRot", kinEnergyRotIx, true);
    } else {
        energy.add(booked_.translation + booked_.rotation, "kinetic", kinEnergyIx, true);
    }
    energy.add(booked_.gravity_work, "gravWork", fieldWorkIx, false);
    if (damping != 0)
        energy.add(booked_.damping, "nonviscDamp", nonviscDampIx, false);
}

} // namespace yade
