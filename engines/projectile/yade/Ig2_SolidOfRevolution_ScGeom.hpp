// SPDX-License-Identifier: GPL-2.0-or-later
// Contact geometry between a solid of revolution and spheres, walls and boxes, as ScGeom: every law for
// spheres works.
#pragma once

#include <lib/base/Math.hpp>
#include <core/Dispatching.hpp>
#include <pkg/common/Box.hpp>
#include <pkg/common/Sphere.hpp>
#include <pkg/common/Wall.hpp>

#include <engines/projectile/yade/SolidOfRevolution.hpp>

namespace yade {

class Ig2_SolidOfRevolution_Sphere_ScGeom : public IGeomFunctor {
public:
    bool go(const shared_ptr<Shape>& shape1, const shared_ptr<Shape>& shape2, const State& state1,
            const State& state2, const Vector3r& shift2, const bool& force,
            const shared_ptr<Interaction>& interaction) override;
    bool goReverse(const shared_ptr<Shape>& shape1, const shared_ptr<Shape>& shape2, const State& state1,
                   const State& state2, const Vector3r& shift2, const bool& force,
                   const shared_ptr<Interaction>& interaction) override;
    FUNCTOR2D(SolidOfRevolution, Sphere);
    DEFINE_FUNCTOR_ORDER_2D(SolidOfRevolution, Sphere);
    // clang-format off
    YADE_CLASS_BASE_DOC_ATTRS(Ig2_SolidOfRevolution_Sphere_ScGeom, IGeomFunctor,
        "One contact between a :yref:`SolidOfRevolution` and a :yref:`Sphere`, at the point of the exact surface nearest to "
        "the sphere's centre; the normal points from there to the centre. It stays the same contact, with its history, while "
        "the sphere slides over edges and from zone to zone. refR1 is the radius of the sphere with the surface's mean "
        "curvature there, refR2 the sphere's radius.",
        ((Real, interactionDetectionFactor, 1, ,
          "A contact is made when the sphere, enlarged by this factor, reaches the surface (liquid bridges need > 1). See "
          ":yref:`Ig2_Sphere_Sphere_ScGeom.interactionDetectionFactor`."))
        ((Real, flatRadiusFactor, 1e8, ,
          "refR1 of flat and hollow places, in radii of the sphere: 1e8 gives the full Hertz stiffness of a plane, 1e3 lacks "
          "0.05 %. :yref:`GlobalStiffnessTimeStepper` takes refR1 for a lever arm and would stop a solid with flat places; "
          "with it use 100 or less (softer by 0.5 %)."))
    );
    // clang-format on
};
REGISTER_SERIALIZABLE(Ig2_SolidOfRevolution_Sphere_ScGeom);

class Ig2_Wall_SolidOfRevolution_ScGeom : public IGeomFunctor {
public:
    bool go(const shared_ptr<Shape>& shape1, const shared_ptr<Shape>& shape2, const State& state1,
            const State& state2, const Vector3r& shift2, const bool& force,
            const shared_ptr<Interaction>& interaction) override;
    bool goReverse(const shared_ptr<Shape>& shape1, const shared_ptr<Shape>& shape2, const State& state1,
                   const State& state2, const Vector3r& shift2, const bool& force,
                   const shared_ptr<Interaction>& interaction) override;
    FUNCTOR2D(Wall, SolidOfRevolution);
    DEFINE_FUNCTOR_ORDER_2D(Wall, SolidOfRevolution);
    // clang-format off
    YADE_CLASS_BASE_DOC(Ig2_Wall_SolidOfRevolution_ScGeom, IGeomFunctor,
        "One contact between a :yref:`Wall` and a :yref:`SolidOfRevolution`, at the solid's point that is deepest in the wall "
        "(the middle of a face or line that lies flat on it), with the full Hertz stiffness of a plane (refR1 = 1e8 refR2). "
        "Meant for a projectile that reaches the floor.");
    // clang-format on
};
REGISTER_SERIALIZABLE(Ig2_Wall_SolidOfRevolution_ScGeom);

class Ig2_Box_SolidOfRevolution_ScGeom : public IGeomFunctor {
public:
    bool go(const shared_ptr<Shape>& shape1, const shared_ptr<Shape>& shape2, const State& state1,
            const State& state2, const Vector3r& shift2, const bool& force,
            const shared_ptr<Interaction>& interaction) override;
    bool goReverse(const shared_ptr<Shape>& shape1, const shared_ptr<Shape>& shape2, const State& state1,
                   const State& state2, const Vector3r& shift2, const bool& force,
                   const shared_ptr<Interaction>& interaction) override;
    FUNCTOR2D(Box, SolidOfRevolution);
    DEFINE_FUNCTOR_ORDER_2D(Box, SolidOfRevolution);
    // clang-format off
    YADE_CLASS_BASE_DOC(Ig2_Box_SolidOfRevolution_ScGeom, IGeomFunctor,
        "Contact of a :yref:`SolidOfRevolution` with a face of a :yref:`Box` that serves as floor or wall, like "
        ":yref:`Ig2_Wall_SolidOfRevolution_ScGeom`. The solid's deepest point must lie over the face: the edges and corners "
        "of a box do not touch.");
    // clang-format on
};
REGISTER_SERIALIZABLE(Ig2_Box_SolidOfRevolution_ScGeom);

} // namespace yade
