// SPDX-License-Identifier: GPL-2.0-or-later
// Facts: Aabb adds nothing to Bound; its constructor is exported. Verified: tests/abi.
#pragma once

#include <core/Bound.hpp>

namespace yade {

class Aabb : public Bound {
public:
    Aabb();
    YADE_ABI_STOCK_CLASS(Aabb)
    YADE_ABI_INDEX
};

} // namespace yade

YADE_ABI_STOCK_SERIALIZERS(Aabb)
