// SPDX-License-Identifier: GPL-2.0-or-later
#include <femlink/yade/Bo1_FemFace_Aabb.hpp>

#include <core/Aabb.hpp>
#include <laws/validation.hpp>

namespace yade {

YADE_PLUGIN((Bo1_FemFace_Aabb));

void Bo1_FemFace_Aabb::postLoad(Bo1_FemFace_Aabb&) {
    grainfall::laws::require_positive("Bo1_FemFace_Aabb.margin", margin);
}

void Bo1_FemFace_Aabb::go(const shared_ptr<Shape>& shape, shared_ptr<Bound>& bound, const Se3r&,
                          const Body*) {
    FemFace& face = static_cast<FemFace&>(*shape);
    if (face.nodes.empty())
        return;
    if (!bound)
        bound = shared_ptr<Bound>(new Aabb);
    Vector3r low = face.nodes[0], high = face.nodes[0];
    for (const auto* nodes : {&face.nodes, &face.unloaded})
        for (const Vector3r& node : *nodes) {
            low = low.cwiseMin(node);
            high = high.cwiseMax(node);
        }
    // A curved face may bulge beyond its nodes.
    const Real bulge = face.nodes.size() == 9 ? 0.125 : 0;
    const Vector3r room = Vector3r::Constant((margin + bulge) * (high - low).maxCoeff());
    bound->min = low - room;
    bound->max = high + room;
    const Vector3r allowed = Vector3r::Constant(margin * (high - low).maxCoeff());
    face.note_bound(low - allowed, high + allowed);
}

} // namespace yade
