// SPDX-License-Identifier: GPL-2.0-or-later
#include <femlink/yade/Ig2_FemFace_Sphere_ScGeom.hpp>

#include <core/Scene.hpp>

namespace yade {

YADE_PLUGIN((FemGeom)(Ig2_FemFace_Sphere_ScGeom));

namespace {
constexpr Real plane_factor = 1e8; // radius of a plane in radii of the sphere on it
}

bool Ig2_FemFace_Sphere_ScGeom::go(const shared_ptr<Shape>& shape1, const shared_ptr<Shape>& shape2,
                                   const State& state1, const State& state2, const Vector3r& shift2,
                                   const bool&, const shared_ptr<Interaction>& interaction) {
    const FaceTouch* touch = static_cast<const FemFace&>(*shape1).touch_of(interaction->getId2());
    const bool is_new = !interaction->geom;
    if (!touch) {
        if (is_new)
            return false;
        static_cast<ScGeom&>(*interaction->geom).penetrationDepth = -1; // the law lets it go
        return true;
    }
    if (is_new)
        interaction->geom = shared_ptr<FemGeom>(new FemGeom());
    FemGeom& geom = static_cast<FemGeom&>(*interaction->geom);
    const Real radius = static_cast<const Sphere&>(*shape2).radius;
    geom.contactPoint = touch->point;
    geom.penetrationDepth = touch->overlap;
    geom.radius1 = plane_factor * radius;
    geom.radius2 = radius;
    geom.precompute(state1, state2, scene, interaction, touch->normal, is_new, shift2, false);
    geom.wallVelocity = touch->velocity;
    const Vector3r relative = state2.vel - touch->velocity - (radius * state2.angVel).cross(touch->normal);
    geom.shearInc = scene->dt * (relative - touch->normal.dot(relative) * touch->normal);
    return true;
}

// Bodies in the other order: turn the interaction around, as the dispatcher's own swap would.
bool Ig2_FemFace_Sphere_ScGeom::goReverse(const shared_ptr<Shape>& shape1, const shared_ptr<Shape>& shape2,
                                          const State& state1, const State& state2, const Vector3r& shift2,
                                          const bool& force, const shared_ptr<Interaction>& interaction) {
    interaction->swapOrder();
    return go(shape2, shape1, state2, state1, -shift2, force, interaction);
}

} // namespace yade
