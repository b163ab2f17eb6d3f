// SPDX-License-Identifier: GPL-2.0-or-later
// Facts: GlobalEngine adds nothing to Engine. Verified: tests/abi.
#pragma once

#include <core/Engine.hpp>

namespace yade {

class GlobalEngine : public Engine {
public:
    GlobalEngine() {}
    YADE_ABI_STOCK_CLASS(GlobalEngine)
};

} // namespace yade

YADE_ABI_STOCK_SERIALIZERS(GlobalEngine)
