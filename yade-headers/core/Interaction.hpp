// SPDX-License-Identifier: GPL-2.0-or-later
// Facts: Interaction is 168 bytes; real means that it has both geometry and physics; functors found once are
// kept in it until it is reset. isFresh, reset, swapOrder are exported. Verified: tests/abi.
#pragma once

#include <lib/serialization/Serializable.hpp>
#include <core/Body.hpp>
#include <core/IGeom.hpp>
#include <core/IPhys.hpp>

namespace yade {

class IGeomFunctor;
class IPhysFunctor;
class LawFunctor;
class Scene;

class Interaction : public Serializable {
public:
    Interaction(Body::id_t first, Body::id_t second);
    bool isReal() const { return geom && phys; }
    /// True while the step in which the interaction became real is being computed.
    bool isFresh(Scene*);
    void reset();
    void swapOrder();
    const Body::id_t& getId1() const { return id1; }
    const Body::id_t& getId2() const { return id2; }
    boost::python::dict pyDictCustom() const override;

    bool isActive;
    struct FunctorCache {
        bool geomExists;
        shared_ptr<IGeomFunctor> geom;
        shared_ptr<IPhysFunctor> phys;
        shared_ptr<LawFunctor> constLaw;
    } functorCache;
    Body::id_t id1;
    Body::id_t id2;
    long iterMadeReal;
    long iterLastSeen;
    shared_ptr<IGeom> geom;
    shared_ptr<IPhys> phys;
    Vector3i cellDist;
    int linIx;
    long iterBorn;

    YADE_ABI_STOCK_CLASS(Interaction)
};

} // namespace yade

YADE_ABI_STOCK_SERIALIZERS(Interaction)
