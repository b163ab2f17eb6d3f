// SPDX-License-Identifier: GPL-2.0-or-later
//
// Exact signed distance from a point to the surface of a solid of revolution.
//
// The point of the surface nearest to p = (x, y, z) lies in the meridian half plane through p, so the problem
// is the distance from (z, rho), rho = sqrt(x^2 + y^2), to the generating curve, which is a minimum over
// straight and circular pieces, each in closed form. No iteration, no tolerance; the error is a few
// roundings. Distances are positive outside. Principal curvatures: the profile's own along the meridian, n_r
// / r around the axis (Meusnier). Lengths in metres, curvatures in 1/m, the axis is z.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include <Eigen/Core>

#include <engines/projectile/profile.hpp>

namespace grainfall::geometry {

struct SurfacePoint {
    double distance;          // m, positive outside
    Eigen::Vector3d position; // m, nearest point of the surface
    Eigen::Vector3d normal;   // unit, out of the solid; at an edge, along the line to the given point
    Zone zone;
    double meridian_curvature; // 1/m; infinite at a sharp edge or tip that stands out
    double hoop_curvature;     // 1/m; infinite at the tip of a cone
    std::size_t segment;       // index of the piece of the profile
};

// Distance from the axis. Plain square root: std::hypot guards against overflow, at three times the cost.
inline double radial(const Eigen::Vector3d& x) {
    return std::sqrt(x[0] * x[0] + x[1] * x[1]);
}

namespace detail {

struct Foot {
    Point2 position, normal;
    double distance, meridian_curvature;
};

inline Foot foot_on_vertex(const Profile& profile, std::size_t segment, std::size_t vertex, const Point2& p) {
    const Segment& s = profile.segments()[segment];
    const Point2& v = vertex == segment ? s.start() : s.end();
    const Point2& outward = profile.vertex_normal(vertex);
    const Point2 line = p - v;
    const double distance = line.norm();
    const bool outside = line.dot(outward) >= 0;
    Foot foot{v, outward.normalized(), outside ? distance : -distance, s.curvature()};
    // Closer than rounding, the line from the vertex has no direction left; the bisector has.
    if (distance > 1e-12 * profile.reach())
        foot.normal = line / foot.distance;
    if (profile.is_sharp(vertex))
        foot.meridian_curvature = std::copysign(std::numeric_limits<double>::infinity(), outside ? 1 : -1);
    return foot;
}

} // namespace detail

inline SurfacePoint closest_point(const Profile& profile, const Eigen::Vector3d& x) {
    const Point2 p(x[2], radial(x));
    const auto& segments = profile.segments();
    std::size_t best = 0;
    Segment::Nearest nearest{std::numeric_limits<double>::infinity(), Segment::Feature::interior};
    for (std::size_t i = 0; i < segments.size(); ++i) {
        const Segment::Nearest candidate = segments[i].nearest(p);
        if (candidate.squared_distance < nearest.squared_distance) {
            nearest = candidate;
            best = i;
        }
    }
    const Segment& s = segments[best];
    const detail::Foot foot =
        nearest.feature == Segment::Feature::interior
            ? detail::Foot{s.foot(p), s.normal_at(p), s.signed_distance(p), s.curvature()}
            : detail::foot_on_vertex(profile, best,
                                     nearest.feature == Segment::Feature::start ? best : best + 1, p);
    // On the axis every meridian is as near as any other; one is taken.
    const double cosine = p[1] > 0 ? x[0] / p[1] : 1;
    const double sine = p[1] > 0 ? x[1] / p[1] : 0;
    const double r = std::max(foot.position[1], 0.);
    double hoop = foot.meridian_curvature; // on the axis of a smooth or flat end, all directions are alike
    if (r > 0)
        hoop = foot.normal[1] / r;
    return {foot.distance,
            {r * cosine, r * sine, foot.position[0]},
            {foot.normal[1] * cosine, foot.normal[1] * sine, foot.normal[0]},
            s.zone(),
            foot.meridian_curvature,
            hoop,
            best};
}

// Lower bound of the distance, from the enclosing cylinder: tells in a few operations that a grain is far.
inline double distance_bound(const Profile& profile, const Eigen::Vector3d& x) {
    const double axial = std::max({profile.z_min() - x[2], x[2] - profile.z_max(), 0.});
    const double beside = std::max(radial(x) - profile.r_max(), 0.);
    return std::sqrt(axial * axial + beside * beside);
}

// Radius of the sphere that has the mean curvature H = (k1 + k2) / 2 of the surface, for Hertz' law between a
// grain and the solid. Infinite where the surface is flat or hollow on average.
// Edges and tips have no radius of their own: edge_radius (> 0, m) is the bluntness they are given, and no
// hoop curvature exceeds 1 / edge_radius unless the profile itself is that curved. On a cylinder of radius a
// this gives 2 a; against Hertz' elliptic contact the force is low by 0.08 % for a grain of radius a / 10, by
// 0.4 % for a / 4, by 1.4 % for a / 2.
inline double equivalent_radius(const SurfacePoint& at, double edge_radius) {
    const double limit = 1 / edge_radius;
    const double meridian = std::isinf(at.meridian_curvature) ? std::copysign(limit, at.meridian_curvature)
                                                              : at.meridian_curvature;
    const double hoop = std::min(at.hoop_curvature, std::max(limit, meridian));
    const double mean = 0.5 * (meridian + hoop);
    return mean > 0 ? 1 / mean : std::numeric_limits<double>::infinity();
}

} // namespace grainfall::geometry
