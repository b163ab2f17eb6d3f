// SPDX-License-Identifier: GPL-2.0-or-later
// Facts: IGeom has no data of its own (32 bytes, Indexable at 24). Verified: tests/abi.
#pragma once

#include <lib/multimethods/Indexable.hpp>
#include <lib/serialization/Serializable.hpp>

namespace yade {

class IGeom : public Serializable, public Indexable {
public:
    IGeom() {}
    YADE_ABI_STOCK_CLASS(IGeom)
    YADE_ABI_INDEX_FAMILY
};

} // namespace yade

YADE_ABI_STOCK_SERIALIZERS(IGeom)
