// SPDX-License-Identifier: GPL-2.0-or-later
// Facts: FieldApplier adds fieldWorkIx (104) to GlobalEngine, -1 until its work is booked; its action throws.
// Verified: tests/abi.
#pragma once

#include <core/GlobalEngine.hpp>

namespace yade {

class FieldApplier : public GlobalEngine {
public:
    void action() override;

    int fieldWorkIx;

    YADE_ABI_STOCK_CLASS(FieldApplier)
};

} // namespace yade

YADE_ABI_STOCK_SERIALIZERS(FieldApplier)
