// SPDX-License-Identifier: GPL-2.0-or-later
// Facts: the four functor families, their argument lists and the slots they add (IGeomFunctor: preStep); 88
// bytes each. A law gets no periodic shift: it asks scene->cell. Verified: vtable relocations, tests/abi.
#pragma once

#include <core/Aabb.hpp>
#include <core/Functor.hpp>
#include <core/IGeom.hpp>
#include <core/IPhys.hpp>
#include <core/Interaction.hpp>
#include <core/Scene.hpp>
#include <core/Shape.hpp>
#include <core/State.hpp>

namespace yade {

class BoundFunctor
    : public Functor1D<Shape, void, const shared_ptr<Shape>&, shared_ptr<Bound>&, const Se3r&, const Body*> {
public:
    BoundFunctor() {}
    YADE_ABI_STOCK_CLASS(BoundFunctor)
};

class IGeomFunctor
    : public Functor2D<Shape, Shape, bool, const shared_ptr<Shape>&, const shared_ptr<Shape>&, const State&,
                       const State&, const Vector3r&, const bool&, const shared_ptr<Interaction>&> {
public:
    IGeomFunctor() {}
    /// Called once before each step.
    virtual void preStep();
    YADE_ABI_STOCK_CLASS(IGeomFunctor)
};

class IPhysFunctor : public Functor2D<Material, Material, void, const shared_ptr<Material>&,
                                      const shared_ptr<Material>&, const shared_ptr<Interaction>&> {
public:
    IPhysFunctor() {}
    YADE_ABI_STOCK_CLASS(IPhysFunctor)
};

class LawFunctor
    : public Functor2D<IGeom, IPhys, bool, shared_ptr<IGeom>&, shared_ptr<IPhys>&, Interaction*> {
public:
    LawFunctor() {}
    void addForce(Body::id_t id, const Vector3r& force, Scene* where) { where->forces.addForce(id, force); }
    void addTorque(Body::id_t id, const Vector3r& torque, Scene* where) {
        where->forces.addTorque(id, torque);
    }
    /// Force on body 1 and its opposite on body 2, both acting at the contact point.
    void applyForceAtContactPoint(const Vector3r& force, const Vector3r& contactPoint, Body::id_t id1,
                                  const Vector3r& position1, Body::id_t id2, const Vector3r& position2) {
        addForce(id1, force, scene);
        addTorque(id1, (contactPoint - position1).cross(force), scene);
        addForce(id2, -force, scene);
        addTorque(id2, -(contactPoint - position2).cross(force), scene);
    }
    YADE_ABI_STOCK_CLASS(LawFunctor)
};

} // namespace yade

YADE_ABI_STOCK_SERIALIZERS(BoundFunctor)
YADE_ABI_STOCK_SERIALIZERS(IGeomFunctor)
YADE_ABI_STOCK_SERIALIZERS(IPhysFunctor)
YADE_ABI_STOCK_SERIALIZERS(LawFunctor)
