// SPDX-License-Identifier: GPL-2.0-or-later
// Rigid clumps: bodies whose members are pushed and do not move by themselves.
#pragma once

#include <engines/flat/bodies.hpp>

#include <core/Body.hpp>
#include <core/Clump.hpp>
#include <core/Scene.hpp>

namespace yade {

/// Of the members, about the clump's centre; `scene.forces` are in sync.
inline grainfall::flat::Load load_of_members(Scene& scene, const Body& clump) {
    grainfall::flat::Load sum;
    for (const auto& [id, pose] : static_cast<const Clump&>(*clump.shape).members) {
        const Vector3r& force = scene.forces.getForce(id);
        const Vector3r lever = (*scene.bodies)[id]->state->pos - clump.state->pos;
        sum.force += force;
        sum.torque += scene.forces.getTorque(id) + lever.cross(force);
    }
    return sum;
}

/// Puts the members where the clump now has them, with its motion there.
inline void carry_members(Scene& scene, const Body& clump) {
    const State& whole = *clump.state;
    for (const auto& [id, pose] : static_cast<const Clump&>(*clump.shape).members) {
        State& part = *(*scene.bodies)[id]->state;
        const Vector3r lever = whole.ori * pose.position;
        part.pos = whole.pos + lever;
        part.ori = whole.ori * pose.orientation;
        part.vel = whole.vel + whole.angVel.cross(lever);
        part.angVel = whole.angVel;
    }
}

} // namespace yade
