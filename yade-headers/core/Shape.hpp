// SPDX-License-Identifier: GPL-2.0-or-later
// Facts: Shape is 96 bytes: Indexable at 24, two functor caches (32, 48), color 64, wire 88, highlight 89;
// defaults white, false, false. The index functions come in this order. Verified: tests/abi.
#pragma once

#include <lib/multimethods/Indexable.hpp>
#include <lib/serialization/Serializable.hpp>

namespace yade {

class BoundFunctor;
class InternalForceFunctor;

class Shape : public Serializable, public Indexable {
public:
    Shape() : color(1, 1, 1), wire(false), highlight(false) {}

    shared_ptr<BoundFunctor> boundFunctor;
    shared_ptr<InternalForceFunctor> internalforcefunctor;
    Vector3r color;
    bool wire;
    bool highlight;

    YADE_ABI_STOCK_CLASS(Shape)
    YADE_ABI_INDEX_FAMILY
};

} // namespace yade

YADE_ABI_STOCK_SERIALIZERS(Shape)
