// SPDX-License-Identifier: GPL-2.0-or-later
// Facts: Box is 120 bytes, half-lengths of its edges at 96. Verified: tests/abi.
#pragma once

#include <core/Shape.hpp>

namespace yade {

class Box : public Shape {
public:
    Box() : extents(Vector3r::Zero()) { createIndex(); }

    Vector3r extents;

    YADE_ABI_STOCK_CLASS(Box)
    YADE_ABI_INDEX
};

} // namespace yade

YADE_ABI_STOCK_SERIALIZERS(Box)
