// SPDX-License-Identifier: GPL-2.0-or-later
// Facts: IPhys has no data of its own (32 bytes, Indexable at 24). Verified: tests/abi.
#pragma once

#include <lib/multimethods/Indexable.hpp>
#include <lib/serialization/Serializable.hpp>

namespace yade {

class IPhys : public Serializable, public Indexable {
public:
    IPhys() {}
    YADE_ABI_STOCK_CLASS(IPhys)
    YADE_ABI_INDEX_FAMILY
};

} // namespace yade

YADE_ABI_STOCK_SERIALIZERS(IPhys)
