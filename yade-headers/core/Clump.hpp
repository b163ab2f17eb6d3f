// SPDX-License-Identifier: GPL-2.0-or-later
// Facts: Clump is 168 bytes: members (id to pose in the clump's frame) at 96, their ids at 144. Verified:
// tests/abi.
#pragma once

#include <core/Body.hpp>

namespace yade {

class Clump : public Shape {
public:
    using MemberMap = std::map<Body::id_t, Se3r>;
    MemberMap members;
    vector<int> ids;

    Clump() { createIndex(); }
    YADE_ABI_STOCK_CLASS(Clump)
    YADE_ABI_INDEX
};

} // namespace yade

YADE_ABI_STOCK_SERIALIZERS(Clump)
