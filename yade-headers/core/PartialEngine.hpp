// SPDX-License-Identifier: GPL-2.0-or-later
// Facts: PartialEngine adds the ids of its bodies at 104 (128 bytes). Verified: tests/abi.
#pragma once

#include <core/Body.hpp>
#include <core/Engine.hpp>

namespace yade {

class PartialEngine : public Engine {
public:
    PartialEngine() {}
    vector<int> ids;
    YADE_ABI_STOCK_CLASS(PartialEngine)
};

} // namespace yade

YADE_ABI_STOCK_SERIALIZERS(PartialEngine)
