// SPDX-License-Identifier: GPL-2.0-or-later
#include <femlink/yade/Law2_FemGeom_GrainPhys_HertzMindlin.hpp>

#include <laws/yade/Law2_ScGeom_GrainPhys_HertzMindlin.hpp>

#include <core/Body.hpp>
#include <core/Scene.hpp>

namespace yade {

YADE_PLUGIN((Law2_FemGeom_GrainPhys_HertzMindlin));

bool Law2_FemGeom_GrainPhys_HertzMindlin::go(shared_ptr<IGeom>& geometry, shared_ptr<IPhys>& physics,
                                             Interaction* interaction) {
    if (found_in_step_.load(std::memory_order_acquire) != scene->iter) {
        law_ = const_cast<Law2_ScGeom_GrainPhys_HertzMindlin*>(
            Law2_ScGeom_GrainPhys_HertzMindlin::acting_in(*scene));
        found_in_step_.store(scene->iter, std::memory_order_release);
    }
    State& wall = *Body::byId(interaction->getId1(), scene)->state;
    // Threads may meet at a face with several contacts.
    const std::lock_guard<std::mutex> lock(wall.updateMutex);
    const Vector3r kept = wall.vel;
    wall.vel = static_cast<const FemGeom&>(*geometry).wallVelocity;
    const bool lives = law_.load()->go(geometry, physics, interaction);
    wall.vel = kept;
    return lives;
}

} // namespace yade
