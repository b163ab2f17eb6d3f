// SPDX-License-Identifier: GPL-2.0-or-later
//
// Volume, areas, centroid and inertia of a solid of revolution from its generating curve C (nose to base):
//     V   = pi   int_C r^2 dz             S   = 2 pi int_C r ds
//     V zc = pi  int_C z r^2 dz
//     int rho^2 dV = pi/2 int_C r^4 dz    (axial inertia / density)
//     int z^2 dV   = pi   int_C z^2 r^2 dz,   transverse inertia / density = int z^2 dV + (axial) / 2
// (Green's theorem in the half plane.) The integrands are polynomials of degree 5 on lines and trigonometric
// polynomials on arcs; eight-point Gauss-Legendre on pieces of at most an eighth of a circle is exact for the
// first and leaves less than 1e-15 for the second. SI units, uniform density, inertia about the centroid.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include <engines/projectile/profile.hpp>

namespace grainfall::geometry {

struct MassProperties {
    double volume = 0;                    // m^3
    double centroid = 0;                  // m, z in the profile's own coordinates
    double axial = 0;                     // m^5, inertia about the axis per unit of density
    double transverse = 0;                // m^5, about a diameter through the centroid, per unit of density
    std::array<double, 3> zone_area = {}; // m^2, of nose, shaft and base
    double frontal_area = 0;              // m^2, seen along the axis
    double lateral_area = 0;              // m^2, shadow seen across the axis

    double surface_area() const { return zone_area[0] + zone_area[1] + zone_area[2]; }
};

inline MassProperties mass_properties(const Profile& profile) {
    constexpr double pi = 3.14159265358979323846;
    constexpr std::array<double, 4> node = {0.1834346424956498049394761, 0.5255324099163289858177390,
                                            0.7966664774136267395915539, 0.9602898564975362316835609};
    constexpr std::array<double, 4> weight = {0.3626837833783619829651504, 0.3137066458778872873379622,
                                              0.2223810344533744705443560, 0.1012285362903762591525314};
    const double origin = 0.5 * (profile.z_min() + profile.z_max()); // near the centroid: no digits cancel
    MassProperties out;
    double first = 0, second = 0;
    const auto add = [&](const Segment& s, double u, double w) {
        const Point2 p = s.point_at(u);
        const double ds = w * s.length();
        const double dz = ds * s.tangent_at(p)[0];
        const double z = p[0] - origin, r = p[1];
        out.zone_area[static_cast<std::size_t>(s.zone())] += 2 * pi * r * ds;
        out.lateral_area += 2 * r * dz;
        out.volume += pi * r * r * dz;
        first += pi * z * r * r * dz;
        second += pi * z * z * r * r * dz;
        out.axial += 0.5 * pi * r * r * r * r * dz;
    };
    for (const Segment& s : profile.segments()) {
        const int pieces = s.is_arc() ? static_cast<int>(std::ceil(s.angle() / (0.25 * pi))) : 1;
        for (int piece = 0; piece < pieces; ++piece)
            for (std::size_t k = 0; k < node.size(); ++k)
                for (const double side : {-1., 1.})
                    add(s, (piece + 0.5 + 0.5 * side * node[k]) / pieces, 0.5 * weight[k] / pieces);
    }
    if (out.volume > 0) {
        const double offset = first / out.volume;
        out.centroid = origin + offset;
        out.transverse = second - out.volume * offset * offset + 0.5 * out.axial;
    }
    out.frontal_area = pi * profile.r_max() * profile.r_max();
    return out;
}

} // namespace grainfall::geometry
