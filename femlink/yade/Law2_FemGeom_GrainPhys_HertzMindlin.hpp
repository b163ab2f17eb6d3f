// SPDX-License-Identifier: GPL-2.0-or-later
// The contact law of grains on the deformable wall.
#pragma once

#include <lib/base/Math.hpp>
#include <core/Dispatching.hpp>

#include <femlink/yade/Ig2_FemFace_Sphere_ScGeom.hpp>
#include <laws/yade/GrainPhys.hpp>

#include <atomic>

namespace yade {

class Law2_ScGeom_GrainPhys_HertzMindlin;

class Law2_FemGeom_GrainPhys_HertzMindlin : public LawFunctor {
public:
    bool go(shared_ptr<IGeom>& geometry, shared_ptr<IPhys>& physics, Interaction* interaction) override;
    FUNCTOR2D(FemGeom, GrainPhys);
    // clang-format off
    YADE_CLASS_BASE_DOC(Law2_FemGeom_GrainPhys_HertzMindlin, LawFunctor,
        "Calls the scene's :yref:`Law2_ScGeom_GrainPhys_HertzMindlin` for a contact on a :yref:`FemWall`, with the wall's own velocity at the contact "
        "as that of body 1: a face of the wall moves differently at each of its contacts, and the body that stands for it does not move at all. Without "
        "this functor the dashpots would take the wall for one at rest.");
    // clang-format on

private:
    std::atomic<Law2_ScGeom_GrainPhys_HertzMindlin*> law_{nullptr};
    std::atomic<long> found_in_step_{-1};
};
REGISTER_SERIALIZABLE(Law2_FemGeom_GrainPhys_HertzMindlin);

} // namespace yade
