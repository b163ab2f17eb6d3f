// SPDX-License-Identifier: GPL-2.0-or-later
// Bounding box of a face of the deformable wall.
#pragma once

#include <lib/base/Math.hpp>
#include <core/Dispatching.hpp>

#include <femlink/yade/FemFace.hpp>

namespace yade {

class Bo1_FemFace_Aabb : public BoundFunctor {
public:
    void go(const shared_ptr<Shape>& shape, shared_ptr<Bound>& bound, const Se3r&, const Body*) override;
    void postLoad(Bo1_FemFace_Aabb&);
    FUNCTOR1D(FemFace);
    // clang-format off
    YADE_CLASS_BASE_DOC_ATTRS(Bo1_FemFace_Aabb, BoundFunctor,
        "Creates/updates an :yref:`Aabb` of a :yref:`FemFace`.",
        ((Real, margin, 0.02, Attr::triggerPostLoad,
          "Room around the face over its longest edge, > 0 [-]. When a node has moved further, the collider runs anew."))
    );
    // clang-format on
};
REGISTER_SERIALIZABLE(Bo1_FemFace_Aabb);

} // namespace yade
