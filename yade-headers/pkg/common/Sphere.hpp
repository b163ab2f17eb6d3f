// SPDX-License-Identifier: GPL-2.0-or-later
// Facts: Sphere is 104 bytes, radius at 96; its constructor is exported. Verified: tests/abi.
#pragma once

#include <core/Shape.hpp>

namespace yade {

class Sphere : public Shape {
public:
    Sphere();

    Real radius;

    YADE_ABI_STOCK_CLASS(Sphere)
    YADE_ABI_INDEX
};

} // namespace yade

YADE_ABI_STOCK_SERIALIZERS(Sphere)
