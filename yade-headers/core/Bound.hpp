// SPDX-License-Identifier: GPL-2.0-or-later
// Facts: Bound is 144 bytes: lastUpdateIter 32, refPos 40, sweepLength 64, color 72, min 96, max 120; min and
// max are NaN until set. Verified: tests/abi.
#pragma once

#include <lib/multimethods/Indexable.hpp>
#include <lib/serialization/Serializable.hpp>

namespace yade {

class Bound : public Serializable, public Indexable {
public:
    Bound()
        : lastUpdateIter(0), refPos(NaN, NaN, NaN), sweepLength(0), color(1, 1, 1), min(refPos), max(refPos) {
    }

    int lastUpdateIter;
    Vector3r refPos;
    Real sweepLength;
    Vector3r color;
    Vector3r min;
    Vector3r max;

    YADE_ABI_STOCK_CLASS(Bound)
    YADE_ABI_INDEX_FAMILY
};

} // namespace yade

YADE_ABI_STOCK_SERIALIZERS(Bound)
