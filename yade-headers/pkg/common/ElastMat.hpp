// SPDX-License-Identifier: GPL-2.0-or-later
// Facts: ElastMat is 96 bytes: young 80, poisson 88 (1e9, 0.25); FrictMat is 104: frictionAngle 96,
// constructor exported. Verified: tests/abi.
#pragma once

#include <core/Material.hpp>

namespace yade {

class ElastMat : public Material {
public:
    ElastMat() : young(1e9), poisson(.25) { createIndex(); }
    Real young;
    Real poisson;
    YADE_ABI_STOCK_CLASS(ElastMat)
    YADE_ABI_INDEX
};

class FrictMat : public ElastMat {
public:
    FrictMat();
    Real frictionAngle;
    YADE_ABI_STOCK_CLASS(FrictMat)
    YADE_ABI_INDEX
};

} // namespace yade

YADE_ABI_STOCK_SERIALIZERS(ElastMat)
YADE_ABI_STOCK_SERIALIZERS(FrictMat)
