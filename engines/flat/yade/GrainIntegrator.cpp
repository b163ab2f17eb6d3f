// SPDX-License-Identifier: GPL-2.0-or-later
#include <engines/flat/yade/GrainIntegrator.hpp>

#include <engines/flat/rigid_motion.hpp>
#include <engines/flat/yade/GrainInteractionLoop.hpp>
#include <engines/flat/yade/clumps.hpp>

#include <core/EnergyTracker.hpp>
#include <core/Scene.hpp>
#include <core/State.hpp>

namespace yade {

YADE_PLUGIN((GrainIntegrator));

namespace gf = grainfall::flat;

GrainIntegrator::~GrainIntegrator() = default;

void GrainIntegrator::action() {
    FlatGrains* grains = flat_grains(*scene);
    if (!grains) {
        NewtonIntegrator::action();
        return;
    }
    auto* contacts = engine_of<GrainInteractionLoop>(*scene);
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
    contacts->step_done();
}

/// A body that is no flat sphere: as NewtonIntegrator does it. Members go with their clump.
void GrainIntegrator::move_other(Body& body, const gf::StepRules& rules) {
    if (body.isClumpMember())
        return;
    State& state = *body.state;
    if (body.isClump()) {
        const gf::Load members = load_of_members(*scene, body);
        scene->forces.addForceUnsynced(body.id, members.force);
        scene->forces.addTorqueUnsynced(body.id, members.torque);
    }
    const Vector3r& force = scene->forces.getForce(body.id);
    const Vector3r& torque = scene->forces.getTorque(body.id);
    const bool aspherical = body.isAspherical();
    const gf::Inertia inertia{state.mass, state.inertia, state.blockedDOFs, state.isDamped};
    if (scene->trackEnergy) {
        const Vector3r own_spin = aspherical ? Vector3r(state.ori.conjugate() * state.angVel) : state.angVel;
        booked_.add(inertia, {state.vel, state.angVel}, own_spin, force, torque, rules);
    }
    gf::RigidBody rigid{state.pos, state.ori, state.vel, state.angVel, state.angMom, inertia};
    gf::advance(rigid, force, torque, rules, exactAsphericalRot && aspherical);
    if (body.isClump())
        carry_members(*scene, body);
}

void GrainIntegrator::settle_books(const gf::MotionBook& grains) {
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
