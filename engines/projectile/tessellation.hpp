// SPDX-License-Identifier: GPL-2.0-or-later
//
// Triangles over the surface of a solid of revolution, for pictures and files (STL, VTK); contacts never use
// them. Vertices lie on the true surface, so the mesh is inscribed and its volume converges from below with
// the square of the angle between meridians on a convex solid. Triangles turn counter-clockwise seen from
// outside.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <engines/projectile/profile.hpp>

namespace grainfall::geometry {

struct SurfaceMesh {
    std::vector<Eigen::Vector3d> vertices; // m
    std::vector<std::array<int, 3>> triangles;
    std::vector<Zone> zones; // of each triangle
};

// meridians: number of half planes around the axis, at least 3; arcs are cut by the same angle.
inline SurfaceMesh tessellate(const Profile& profile, int meridians) {
    if (meridians < 3)
        throw std::invalid_argument("meridians: " + std::to_string(meridians) + "; allowed: 3 or more");
    constexpr double pi = 3.14159265358979323846;
    std::vector<Point2> curve;
    std::vector<Zone> band; // between curve[i] and curve[i + 1]
    for (const Segment& s : profile.segments()) {
        const double step = 2 * pi / meridians;
        const int pieces = s.is_arc() ? std::max(2, static_cast<int>(std::ceil(s.angle() / step))) : 1;
        for (int i = 0; i < pieces; ++i) {
            curve.push_back(s.point_at(static_cast<double>(i) / pieces));
            band.push_back(s.zone());
        }
    }
    SurfaceMesh mesh;
    if (curve.empty())
        return mesh;
    curve.push_back(profile.segments().back().end());

    const int rings = static_cast<int>(curve.size()) - 2;
    mesh.vertices.emplace_back(0, 0, curve.front()[0]);
    for (int ring = 1; ring <= rings; ++ring)
        for (int m = 0; m < meridians; ++m) {
            const Point2& p = curve[static_cast<std::size_t>(ring)];
            const double angle = 2 * pi * m / meridians;
            mesh.vertices.emplace_back(p[1] * std::cos(angle), p[1] * std::sin(angle), p[0]);
        }
    mesh.vertices.emplace_back(0, 0, curve.back()[0]);

    const int last = static_cast<int>(mesh.vertices.size()) - 1;
    const auto at = [&](int ring, int m) { return 1 + (ring - 1) * meridians + m % meridians; };
    const auto add = [&](int a, int b, int c, int ring) {
        mesh.triangles.push_back({a, b, c});
        mesh.zones.push_back(band[static_cast<std::size_t>(ring)]);
    };
    for (int m = 0; m < meridians; ++m) {
        add(0, at(1, m + 1), at(1, m), 0);
        for (int ring = 1; ring < rings; ++ring) {
            add(at(ring, m), at(ring, m + 1), at(ring + 1, m + 1), ring);
            add(at(ring, m), at(ring + 1, m + 1), at(ring + 1, m), ring);
        }
        add(at(rings, m), at(rings, m + 1), last, rings);
    }
    return mesh;
}

} // namespace grainfall::geometry
