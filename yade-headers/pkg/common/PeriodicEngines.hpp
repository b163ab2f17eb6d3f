// SPDX-License-Identifier: GPL-2.0-or-later
// Facts: PeriodicEngine is 184 bytes with these members and defaults; its isActivated is exported, its
// constructor is not; realLast starts as the wall clock in seconds. Verified: tests/abi.
#pragma once

#include <core/GlobalEngine.hpp>
#include <core/Omega.hpp>
#include <core/Scene.hpp>

#include <chrono>

namespace yade {

class PeriodicEngine : public GlobalEngine {
public:
    PeriodicEngine() : realLast(getClock()) {}
    static Real getClock() {
        return std::chrono::duration<Real>(std::chrono::system_clock::now().time_since_epoch()).count();
    }
    bool isActivated() override;

    Real virtPeriod = 0;
    Real realPeriod = 0;
    long iterPeriod = 0;
    long nDo = -1;
    bool initRun = false;
    long firstIterRun = 0;
    Real virtLast = 0;
    Real realLast;
    long iterLast = 0;
    long nDone = 0;

    YADE_ABI_STOCK_CLASS(PeriodicEngine)
};

} // namespace yade

YADE_ABI_STOCK_SERIALIZERS(PeriodicEngine)
