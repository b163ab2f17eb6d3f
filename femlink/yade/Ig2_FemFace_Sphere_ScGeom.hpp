// SPDX-License-Identifier: GPL-2.0-or-later
// Contact of a sphere with the deformable wall, as ScGeom: every law for spheres works.
#pragma once

#include <lib/base/Math.hpp>
#include <core/Dispatching.hpp>
#include <pkg/common/Sphere.hpp>
#include <pkg/dem/ScGeom.hpp>

#include <femlink/yade/FemFace.hpp>

namespace yade {

class FemGeom : public ScGeom {
public:
    virtual ~FemGeom() = default;
    // clang-format off
    YADE_CLASS_BASE_DOC_ATTRS_CTOR(FemGeom, ScGeom,
        "Contact of a sphere with a :yref:`FemFace`. refR1 is 1e8 radii of the sphere, as of a plane.",
        ((Vector3r, wallVelocity, Vector3r::Zero(), , "Velocity [m/s] of the wall at the contact; the body of the face itself stands still."))
        ,
        createIndex();
    );
    // clang-format on
    REGISTER_CLASS_INDEX(FemGeom, ScGeom);
};
REGISTER_SERIALIZABLE(FemGeom);

class Ig2_FemFace_Sphere_ScGeom : public IGeomFunctor {
public:
    bool go(const shared_ptr<Shape>& shape1, const shared_ptr<Shape>& shape2, const State& state1,
            const State& state2, const Vector3r& shift2, const bool& force,
            const shared_ptr<Interaction>& interaction) override;
    bool goReverse(const shared_ptr<Shape>& shape1, const shared_ptr<Shape>& shape2, const State& state1,
                   const State& state2, const Vector3r& shift2, const bool& force,
                   const shared_ptr<Interaction>& interaction) override;
    FUNCTOR2D(FemFace, Sphere);
    DEFINE_FUNCTOR_ORDER_2D(FemFace, Sphere);
    // clang-format off
    YADE_CLASS_BASE_DOC(Ig2_FemFace_Sphere_ScGeom, IGeomFunctor,
        "Writes the contact that :yref:`FemWall` found for a :yref:`Sphere` on a :yref:`FemFace` in this step as :yref:`FemGeom`. Which face owns a "
        "contact, where and how deep it is, is the wall's to say, because it follows from all contacts together. Shear counts the sphere's undeformed "
        "radius, as YADE's correction against ratcheting does.");
    // clang-format on
};
REGISTER_SERIALIZABLE(Ig2_FemFace_Sphere_ScGeom);

} // namespace yade
