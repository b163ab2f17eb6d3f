// SPDX-License-Identifier: GPL-2.0-or-later
// Facts: TimingInfo is a count and a number of nanoseconds (16 bytes). Verified: Engine.execCount and
// execTime written from Python land there (tests/abi).
#pragma once

namespace yade {

struct TimingInfo {
    using delta = unsigned long long;
    long nExec{0};
    delta nsec{0};
    static bool enabled;
};

class TimingDeltas;

} // namespace yade
