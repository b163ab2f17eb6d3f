// SPDX-License-Identifier: GPL-2.0-or-later
#include <engines/projectile/yade/Ig2_SolidOfRevolution_ScGeom.hpp>

#include <core/Scene.hpp>
#include <pkg/dem/ScGeom.hpp>

#include <engines/projectile/closest_point.hpp>
#include <engines/projectile/support.hpp>

#include <cmath>

namespace yade {

namespace geometry = grainfall::geometry;

YADE_PLUGIN((
    Ig2_SolidOfRevolution_Sphere_ScGeom)(Ig2_Wall_SolidOfRevolution_ScGeom)(Ig2_Box_SolidOfRevolution_ScGeom));

namespace {

struct ContactPlace {
    Vector3r point, normal; // normal from body 1 to body 2
    Real overlap, radius1, radius2;
};

void write(const ContactPlace& place, const State& state1, const State& state2, const Scene* scene,
           const Vector3r& shift2, const shared_ptr<Interaction>& interaction) {
    const bool isNew = !interaction->geom;
    if (isNew)
        interaction->geom = shared_ptr<ScGeom>(new ScGeom());
    ScGeom& geom = static_cast<ScGeom&>(*interaction->geom);
    geom.contactPoint = place.point;
    geom.penetrationDepth = place.overlap;
    geom.radius1 = place.radius1;
    geom.radius2 = place.radius2;
    // The correction against ratcheting assumes that both bodies are spheres.
    geom.precompute(state1, state2, scene, interaction, place.normal, isNew, shift2, false);
}

void askForColliderIfTurned(const SolidOfRevolution& solid, const Quaternionr& orientation, Scene* scene) {
    if (!solid.hasTurned(orientation))
        return;
#pragma omp atomic write
    scene->doSort = true;
}

// The solid as body 2 against the half space below the plane through `origin` with normal `up`.
ContactPlace onPlane(const SolidOfRevolution& solid, const State& state, const Vector3r& shift,
                     const Vector3r& origin, const Vector3r& up) {
    const Vector3r lowest = geometry::support_point(solid.body(), state.ori.conjugate() * -up);
    const Vector3r place = state.pos + shift + state.ori * lowest;
    const Real gap = up.dot(place - origin);
    const geometry::SurfacePoint surface = geometry::closest_point(solid.body(), lowest);
    Real radius = geometry::equivalent_radius(surface, solid.edgeRadiusFor(solid.maxRadius()));
    if (std::isinf(radius)) // face to face: no Hertz contact; stiff enough to stop the solid
        radius = solid.maxRadius();
    constexpr Real planeFactor = 1e8;
    return {place - gap * up, up, -gap, planeFactor * radius, radius};
}

} // namespace

bool Ig2_SolidOfRevolution_Sphere_ScGeom::go(const shared_ptr<Shape>& shape1, const shared_ptr<Shape>& shape2,
                                             const State& state1, const State& state2, const Vector3r& shift2,
                                             const bool& force, const shared_ptr<Interaction>& interaction) {
    const SolidOfRevolution& solid = static_cast<const SolidOfRevolution&>(*shape1);
    if (solid.body().empty())
        return false;
    const Real radius = static_cast<const Sphere&>(*shape2).radius;
    askForColliderIfTurned(solid, state1.ori, scene);

    const Vector3r centre = state2.pos + shift2;
    const Vector3r local = state1.ori.conjugate() * (centre - state1.pos);
    const bool mustUpdate = force || interaction->isReal();
    const Real range = interactionDetectionFactor * radius;
    if (!mustUpdate && geometry::distance_bound(solid.body(), local) > range)
        return false;
    const geometry::SurfacePoint surface = geometry::closest_point(solid.body(), local);
    if (!mustUpdate && surface.distance > range)
        return false;

    const Vector3r normal = state1.ori * surface.normal;
    const Real overlap = radius - surface.distance;
    const Real curved = geometry::equivalent_radius(surface, solid.edgeRadiusFor(radius));
    const ContactPlace place = {centre - (radius - 0.5 * overlap) * normal, normal, overlap,
                                std::min(curved, flatRadiusFactor * radius), radius};
    write(place, state1, state2, scene, shift2, interaction);
    return true;
}

bool Ig2_Wall_SolidOfRevolution_ScGeom::go(const shared_ptr<Shape>& shape1, const shared_ptr<Shape>& shape2,
                                           const State& state1, const State& state2, const Vector3r& shift2,
                                           const bool& force, const shared_ptr<Interaction>& interaction) {
    const Wall& wall = static_cast<const Wall&>(*shape1);
    const SolidOfRevolution& solid = static_cast<const SolidOfRevolution&>(*shape2);
    if (solid.body().empty())
        return false;
    askForColliderIfTurned(solid, state2.ori, scene);
    const Real side = state2.pos[wall.axis] + shift2[wall.axis] - state1.pos[wall.axis];
    Vector3r up = Vector3r::Zero();
    up[wall.axis] = wall.sense != 0 ? wall.sense : (side > 0 ? 1 : -1);
    const ContactPlace place = onPlane(solid, state2, shift2, state1.pos, up);
    if (place.overlap < 0 && !force && !interaction->isReal())
        return false;
    write(place, state1, state2, scene, shift2, interaction);
    return true;
}

bool Ig2_Box_SolidOfRevolution_ScGeom::go(const shared_ptr<Shape>& shape1, const shared_ptr<Shape>& shape2,
                                          const State& state1, const State& state2, const Vector3r& shift2,
                                          const bool& force, const shared_ptr<Interaction>& interaction) {
    const Vector3r& extents = static_cast<const Box&>(*shape1).extents;
    const SolidOfRevolution& solid = static_cast<const SolidOfRevolution&>(*shape2);
    if (solid.body().empty())
        return false;
    askForColliderIfTurned(solid, state2.ori, scene);
    // The face that the solid has the least overlap with, among the three that look at its centre.
    const Matrix3r axes = state1.ori.toRotationMatrix();
    const Vector3r centre = axes.transpose() * (state2.pos + shift2 - state1.pos);
    int face = -1;
    ContactPlace best = {};
    for (int axis = 0; axis < 3; ++axis) {
        const Vector3r up = centre[axis] > 0 ? axes.col(axis) : Vector3r(-axes.col(axis));
        const ContactPlace place = onPlane(solid, state2, shift2, state1.pos + extents[axis] * up, up);
        if (face < 0 || place.overlap < best.overlap) {
            best = place;
            face = axis;
        }
    }
    if (!force && !interaction->isReal()) {
        if (best.overlap < 0)
            return false;
        const Vector3r foot = axes.transpose() * (best.point - state1.pos);
        for (int axis = 0; axis < 3; ++axis)
            if (axis != face && std::abs(foot[axis]) > extents[axis])
                return false;
    }
    write(best, state1, state2, scene, shift2, interaction);
    return true;
}

// Bodies in the other order: turn the interaction around, as the dispatcher's own swap would.
bool Ig2_SolidOfRevolution_Sphere_ScGeom::goReverse(const shared_ptr<Shape>& shape1,
                                                    const shared_ptr<Shape>& shape2, const State& state1,
                                                    const State& state2, const Vector3r& shift2,
                                                    const bool& force,
                                                    const shared_ptr<Interaction>& interaction) {
    interaction->swapOrder();
    return go(shape2, shape1, state2, state1, -shift2, force, interaction);
}

bool Ig2_Wall_SolidOfRevolution_ScGeom::goReverse(const shared_ptr<Shape>& shape1,
                                                  const shared_ptr<Shape>& shape2, const State& state1,
                                                  const State& state2, const Vector3r& shift2,
                                                  const bool& force,
                                                  const shared_ptr<Interaction>& interaction) {
    interaction->swapOrder();
    return go(shape2, shape1, state2, state1, -shift2, force, interaction);
}

bool Ig2_Box_SolidOfRevolution_ScGeom::goReverse(const shared_ptr<Shape>& shape1,
                                                 const shared_ptr<Shape>& shape2, const State& state1,
                                                 const State& state2, const Vector3r& shift2,
                                                 const bool& force,
                                                 const shared_ptr<Interaction>& interaction) {
    interaction->swapOrder();
    return go(shape2, shape1, state2, state1, -shift2, force, interaction);
}

} // namespace yade
