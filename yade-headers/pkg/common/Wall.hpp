// SPDX-License-Identifier: GPL-2.0-or-later
// Facts: Wall is 104 bytes: sense 92 (in the space that Shape leaves), axis 96. Verified: tests/abi.
#pragma once

#include <core/Shape.hpp>

namespace yade {

class Wall : public Shape {
public:
    Wall() : sense(0), axis(0) { createIndex(); }

    int sense;
    int axis;

    YADE_ABI_STOCK_CLASS(Wall)
    YADE_ABI_INDEX
};

} // namespace yade

YADE_ABI_STOCK_SERIALIZERS(Wall)
