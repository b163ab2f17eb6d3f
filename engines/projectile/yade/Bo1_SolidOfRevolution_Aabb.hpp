// SPDX-License-Identifier: GPL-2.0-or-later
// Bounding box of a solid of revolution, exact for its orientation up to a margin for turning.
#pragma once

#include <lib/base/Math.hpp>
#include <core/Dispatching.hpp>

#include <engines/projectile/yade/SolidOfRevolution.hpp>

namespace yade {

class Bo1_SolidOfRevolution_Aabb : public BoundFunctor {
public:
    void go(const shared_ptr<Shape>& shape, shared_ptr<Bound>& bound, const Se3r& se3, const Body*) override;
    void postLoad(Bo1_SolidOfRevolution_Aabb&);
    FUNCTOR1D(SolidOfRevolution);
    // clang-format off
    YADE_CLASS_BASE_DOC_ATTRS(Bo1_SolidOfRevolution_Aabb, BoundFunctor,
        "Creates/updates an :yref:`Aabb` of a :yref:`SolidOfRevolution`.",
        ((Real, aabbEnlargeFactor, -1, ,
          "Relative enlargement of the box, as in :yref:`Bo1_Sphere_Aabb`; not used if negative. For contacts at a distance the "
          "one of the spheres suffices."))
        ((Real, turnMargin, 0.02, Attr::triggerPostLoad,
          "Margin around the box relative to the solid's :yref:`SolidOfRevolution.boundingRadius`, > 0 [-]. A collider "
          "follows how far bodies move, not how far they turn; after half this angle (rad) the collider is asked to run again, by "
          ":yref:`ProjectileLoad` in every step, by the geometry functors while anything is near. So a scene whose projectile may "
          "turn far from everything needs a :yref:`ProjectileLoad`. Larger: fewer runs, more grains looked at."))
    );
    // clang-format on
};
REGISTER_SERIALIZABLE(Bo1_SolidOfRevolution_Aabb);

} // namespace yade
