// SPDX-License-Identifier: GPL-2.0-or-later
#include <engines/projectile/yade/Bo1_SolidOfRevolution_Aabb.hpp>

#include <core/Aabb.hpp>
#include <core/Scene.hpp>

#include <engines/projectile/profile_check.hpp>
#include <engines/projectile/support.hpp>

#include <cmath>
#include <stdexcept>

namespace yade {

YADE_PLUGIN((Bo1_SolidOfRevolution_Aabb));

void Bo1_SolidOfRevolution_Aabb::postLoad(Bo1_SolidOfRevolution_Aabb&) {
    if (!(std::isfinite(turnMargin) && turnMargin > 0))
        throw std::invalid_argument(
            "Bo1_SolidOfRevolution_Aabb.turnMargin = " + grainfall::geometry::detail::number(turnMargin) +
            "; allowed: > 0 and finite");
}

void Bo1_SolidOfRevolution_Aabb::go(const shared_ptr<Shape>& shape, shared_ptr<Bound>& bound, const Se3r& se3,
                                    const Body*) {
    SolidOfRevolution& solid = static_cast<SolidOfRevolution&>(*shape);
    if (solid.body().empty())
        return;
    if (!bound)
        bound = shared_ptr<Bound>(new Aabb);
    solid.noteBound(se3.orientation, 0.5 * turnMargin);

    // The collider sorts in coordinates without the periodic cell's shear.
    Matrix3r unshear = Matrix3r::Identity();
    if (scene->isPeriodic && scene->cell->hasShear())
        for (int axis = 0; axis < 3; ++axis)
            unshear.col(axis) = scene->cell->unshearPt(Vector3r::Unit(axis));
    const Vector3r centre = unshear * se3.position;
    const Matrix3r toLocal = se3.orientation.toRotationMatrix().transpose();
    const Real scale = aabbEnlargeFactor > 0 ? aabbEnlargeFactor : 1;
    for (int axis = 0; axis < 3; ++axis) {
        const Vector3r outwards = unshear.row(axis).transpose();
        const Vector3r local = toLocal * outwards;
        const Real margin = turnMargin * solid.boundingRadius() * outwards.norm();
        bound->min[axis] = centre[axis] - scale * grainfall::geometry::support(solid.body(), -local) - margin;
        bound->max[axis] = centre[axis] + scale * grainfall::geometry::support(solid.body(), local) + margin;
    }
}

} // namespace yade
