// SPDX-License-Identifier: GPL-2.0-or-later
// Where a sphere touches the surface: which of the faces near it owns a contact (MR-2629, Eq 22-25).
//
// A sphere has one contact on a smooth piece of surface, at the point nearest to its centre. Two faces may
// offer the same point (it lies on their common edge) or points of which one is no minimum over the surface
// (it lies on the edge of a face whose neighbour comes nearer): the nearest face owns the contact, of equals
// the one that had it before. Two faces that meet at an edge sharper than the patch of a contact runs over
// hold two contacts where both are touched inside: the sphere in the corner of floor and wall.
#pragma once

#include <femlink/core/closest_point.hpp>
#include <femlink/core/contact_patch.hpp>
#include <femlink/core/surface_contact.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace grainfall::femlink {

namespace detail {

template <int degree>
bool may_touch(const FaceNodes<degree>& nodes, const Point& centre, double reach) {
    const Point low = nodes.rowwise().minCoeff(), high = nodes.rowwise().maxCoeff();
    // Nine nodes may bulge beyond their own box, but by no more than an eighth of it.
    const double room = degree == 1 ? 0 : 0.125 * (high - low).maxCoeff();
    const Point outside = (low - centre).cwiseMax(centre - high).cwiseMax(0.0);
    return outside.norm() <= reach + room;
}

inline bool share_a_node(const Surface& surface, int a, int b) {
    for (int i = 0; i < surface.faces.rows(); ++i)
        for (int j = 0; j < surface.faces.rows(); ++j)
            if (surface.faces(i, a) == surface.faces(j, b))
                return true;
    return false;
}

template <int degree>
bool nearest_on_face(const Surface& surface, const Positions& positions, int face, const Point& centre,
                     const Reference& start, double reach, SurfaceContact& out) {
    const FaceNodes<degree> nodes = surface.template face<degree>(face, positions);
    if (!may_touch<degree>(nodes, centre, reach))
        return false;
    const ClosestPoint found = closest_point<degree>(nodes, centre, start);
    if (std::abs(found.distance) > reach)
        return false;
    out = {face,           found.reference,
           found.position, found.push_direction(centre),
           found.distance, found.feature == Feature::interior};
    return true;
}

} // namespace detail

// Contacts of a sphere among `faces`, at most `reach` (m) from its centre, nearest first, into `found`.
inline void find_surface_contacts(const Surface& surface, const Positions& positions,
                                  const std::vector<int>& faces, const std::vector<HeldFace>& before,
                                  const Point& centre, double reach, std::vector<SurfaceContact>& found) {
    const auto held = [&](int face) {
        return std::find_if(before.begin(), before.end(), [&](const HeldFace& h) { return h.face == face; });
    };
    const double equal = 1e-9 * reach;
    const auto rank = [&](const SurfaceContact& c) {
        return std::abs(c.distance) - (held(c.face) != before.end() ? equal : 0);
    };
    found.clear();
    SurfaceContact one;
    for (const int face : faces) {
        const auto known = held(face);
        const Reference start = known != before.end() ? known->at : Reference::Zero();
        const bool near =
            surface.degree == 1
                ? detail::nearest_on_face<1>(surface, positions, face, centre, start, reach, one)
                : detail::nearest_on_face<2>(surface, positions, face, centre, start, reach, one);
        if (!near)
            continue;
        const auto farther = std::find_if(
            found.begin(), found.end(), [&](const SurfaceContact& other) { return rank(one) < rank(other); });
        found.insert(farther, one);
    }
    auto owned = found.begin(); // end of those that are accepted
    for (auto candidate = found.begin(); candidate != found.end(); ++candidate) {
        const bool stands_alone = std::all_of(found.begin(), owned, [&](const SurfaceContact& accepted) {
            if (candidate->normal.dot(accepted.normal) >= smooth_cosine)
                return false;
            return candidate->inside_face || !detail::share_a_node(surface, candidate->face, accepted.face);
        });
        if (stands_alone)
            *owned++ = *candidate;
    }
    found.erase(owned, found.end());
}

} // namespace grainfall::femlink
