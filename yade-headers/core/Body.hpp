// SPDX-License-Identifier: GPL-2.0-or-later
// Facts: Body is 176 bytes; a clump's id equals its clumpId; bits of flags; a body is dynamic unless all its
// degrees of freedom are blocked. byId is exported. One virtual function beyond Serializable's. Verified:
// tests/abi.
#pragma once

#include <core/Bound.hpp>
#include <core/Material.hpp>
#include <core/Shape.hpp>
#include <core/State.hpp>

namespace yade {

class Scene;
class Interaction;

class Body : public Serializable {
public:
    using id_t = int;
    using MapId2IntrT = std::map<id_t, shared_ptr<Interaction>>;

    enum { FLAG_BOUNDED = 1, FLAG_ASPHERICAL = 2, FLAG_SUBDOMAIN = 4, FLAG_FLUIDDOMAINBBOX = 8 };
    static const id_t ID_NONE;

    Body();
    static const shared_ptr<Body>& byId(id_t id, Scene* scene = nullptr);
    virtual void userForcedDisplacementRedrawHook();

    id_t id;
    mask_t groupMask;
    int flags;
    int subdomain;
    shared_ptr<Material> material;
    shared_ptr<State> state;
    shared_ptr<Shape> shape;
    shared_ptr<Bound> bound;
    MapId2IntrT intrs;
    id_t clumpId;
    long iterBorn;
    Real timeBorn;

    id_t getId() const { return id; }
    bool isStandalone() const { return clumpId == ID_NONE; }
    bool isClump() const { return !isStandalone() && clumpId == id; }
    bool isClumpMember() const { return !isStandalone() && clumpId != id; }
    bool isDynamic() const { return state->blockedDOFs != State::DOF_ALL; }
    bool isBounded() const { return flags & FLAG_BOUNDED; }
    bool isAspherical() const { return flags & FLAG_ASPHERICAL; }
    bool maskOk(int mask) const;
    bool maskCompatible(int mask) const;

    YADE_ABI_STOCK_CLASS(Body)
};

} // namespace yade

YADE_ABI_STOCK_SERIALIZERS(Body)
