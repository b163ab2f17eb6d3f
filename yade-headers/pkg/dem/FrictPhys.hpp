// SPDX-License-Identifier: GPL-2.0-or-later
// Facts: FrictPhys is 104 bytes, tangensOfFrictionAngle at 96; constructor exported. Verified: tests/abi.
#pragma once

#include <core/Dispatching.hpp>
#include <pkg/common/ElastMat.hpp>
#include <pkg/common/NormShearPhys.hpp>

namespace yade {

class FrictPhys : public NormShearPhys {
public:
    FrictPhys();
    Real tangensOfFrictionAngle;
    YADE_ABI_STOCK_CLASS(FrictPhys)
    YADE_ABI_INDEX
};

} // namespace yade

YADE_ABI_STOCK_SERIALIZERS(FrictPhys)
