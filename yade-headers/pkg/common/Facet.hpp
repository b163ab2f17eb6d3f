// SPDX-License-Identifier: GPL-2.0-or-later
// Facts: Facet is 328 bytes: edge normals 96, inscribed radius 168, distances 176 and directions 200 of the
// vertices, vertices 272, normal 296, area 320; its constructor is exported. Verified: tests/abi.
#pragma once

#include <core/Shape.hpp>

namespace yade {

class Facet : public Shape {
public:
    Facet();
    void postLoad(Facet&);

    Vector3r ne[3];
    Real icr;
    Real vl[3];
    Vector3r vu[3];
    vector<Vector3r> vertices;
    Vector3r normal;
    Real area;

    YADE_ABI_STOCK_CLASS(Facet)
    YADE_ABI_INDEX
};

} // namespace yade

YADE_ABI_STOCK_SERIALIZERS(Facet)
