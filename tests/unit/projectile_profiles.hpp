// SPDX-License-Identifier: GPL-2.0-or-later
//
// Profiles shared by the unit tests of the projectile, each with a closed-form counterpart.
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include <engines/projectile/profile.hpp>

namespace grainfall::geometry::test {

inline const double pi = std::acos(-1.);
inline const double quarter_circle = std::tan(pi / 8);

using Vertices = std::vector<ProfileVertex>;

// Centre at the origin; two arcs, so that the equator is a joint.
inline Vertices sphere(double radius) {
    return {{-radius, 0, quarter_circle}, {0, radius, quarter_circle}, {radius, 0}};
}
// Axis from z = 0 to z = length.
inline Vertices cylinder(double radius, double length) {
    return {{0, 0}, {0, radius}, {length, radius}, {length, 0}};
}
// Tip at the origin, base at z = length.
inline Vertices cone(double radius, double length) {
    return {{0, 0}, {length, radius}, {length, 0}};
}
// Tangent ogive of the given calibre radius head, then a cylinder; tip at the origin.
inline Vertices ogive_body(double radius, double calibre_radius_head, double length) {
    const double nose = 2 * radius * std::sqrt(calibre_radius_head - 0.25);
    const double arc = 2 * radius * calibre_radius_head;
    return {{0, 0, std::tan(0.25 * std::asin(nose / arc))}, {nose, radius}, {length, radius}, {length, 0}};
}

// A wavy body with hollow and bulging arcs, corners and straight pieces.
inline Vertices wavy_body(std::mt19937& random) {
    std::uniform_real_distribution<double> radius(0.3, 1), step(0.6, 1), bulge(-0.12, 0.12);
    Vertices vertices = {{0, 0, 0}};
    double z = 0;
    for (int i = 0; i < 6; ++i) {
        z += step(random);
        vertices.push_back({z, radius(random), i % 3 == 0 ? 0 : bulge(random)});
    }
    vertices.push_back({z, 0});
    vertices[6].bulge = 0;
    return vertices;
}

} // namespace grainfall::geometry::test
