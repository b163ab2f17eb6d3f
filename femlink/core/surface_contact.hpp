// SPDX-License-Identifier: GPL-2.0-or-later
// Where a sphere touches the surface; found by surface_contacts.hpp.
#pragma once

#include <femlink/core/surface.hpp>

namespace grainfall::femlink {

struct SurfaceContact {
    int face = -1;
    Reference at = Reference::Zero();
    Point foot = Point::Zero();   // m, on the surface as given
    Point normal = Point::Zero(); // unit vector, from the surface to the sphere
    double distance = 0;          // m, of the centre; negative behind the face
    bool inside_face = true;      // else on an edge or corner
};

// A face that held a contact of the sphere, and where.
struct HeldFace {
    int face;
    Reference at;
};

} // namespace grainfall::femlink
