// SPDX-License-Identifier: GPL-2.0-or-later
//
// Which generating curves are allowed: finite numbers, r >= 0, from axis to axis, from nose to base, no
// segment without length, arcs of a possible bulge, and no point met twice. Each wrong curve gets one
// sentence with attribute, value and allowed range.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <engines/projectile/profile.hpp>

namespace grainfall::geometry {

// Flatter arcs lose digits in their huge radius, fuller ones are closed circles for all purposes.
constexpr double smallest_bulge = 1e-5;
constexpr double largest_bulge = 10;

namespace detail {

inline std::string number(double value) {
    std::ostringstream text;
    text.precision(9);
    text << value;
    return text.str();
}

[[noreturn]] inline void refuse(const std::string& where, const std::string& value,
                                const std::string& allowed) {
    throw std::invalid_argument("profile: " + where + " is " + value + "; allowed: " + allowed);
}

inline void check_vertices(const std::vector<ProfileVertex>& vertices, double tolerance) {
    const std::size_t last = vertices.size() - 1;
    for (std::size_t i = 0; i <= last; ++i) {
        const std::string at = " of vertex " + std::to_string(i);
        const ProfileVertex& v = vertices[i];
        if (v.r < 0)
            refuse("r" + at, number(v.r) + " m", "r >= 0");
        const bool is_end = i == 0 || i == last;
        if (is_end && v.r > 0)
            refuse("r" + at, number(v.r) + " m", "0, since the curve starts and ends on the axis");
        if (!is_end && v.r <= tolerance)
            refuse("r" + at, number(v.r) + " m", "r > 0 between the two ends of the curve");
        const double fullness = std::abs(v.bulge);
        if (i < last && fullness != 0 && !(fullness >= smallest_bulge && fullness <= largest_bulge))
            refuse("bulge" + at, number(v.bulge),
                   "0 (straight) or " + number(smallest_bulge) + " to " + number(largest_bulge) +
                       " in magnitude");
        if (i < last) {
            const double length = std::hypot(vertices[i + 1].z - v.z, vertices[i + 1].r - v.r);
            if (length <= tolerance)
                refuse("length of segment " + std::to_string(i), number(length) + " m",
                       "more than a billionth of the profile's size");
        }
    }
}

// Points that may belong to both segments: where their lines or circles meet. A near touch counts as one
// point.
inline std::vector<Point2> meeting_points(const Segment& a, const Segment& b, double tolerance) {
    if (!a.is_arc() && !b.is_arc()) {
        const Point2 da = a.end() - a.start(), db = b.end() - b.start();
        const double parallel = cross(da, db);
        if (parallel == 0)
            return {};
        return {a.start() + cross(b.start() - a.start(), db) / parallel * da};
    }
    if (!a.is_arc())
        return meeting_points(b, a, tolerance);
    Point2 base, across;  // chord shared by the two curves: base + t * across
    double reach_squared; // t^2
    if (!b.is_arc()) {
        across = (b.end() - b.start()).normalized();
        base = b.start() + (a.centre() - b.start()).dot(across) * across;
        reach_squared = a.radius() * a.radius() - (base - a.centre()).squaredNorm();
    } else {
        const Point2 between = b.centre() - a.centre();
        const double distance = between.norm();
        if (distance <= tolerance)
            return {};
        const double along =
            (distance * distance + a.radius() * a.radius() - b.radius() * b.radius()) / (2 * distance);
        base = a.centre() + along / distance * between;
        across = left_of(between) / distance;
        reach_squared = a.radius() * a.radius() - along * along;
    }
    if (reach_squared <= 2 * a.radius() * tolerance)
        return {base};
    const Point2 offset = std::sqrt(reach_squared) * across;
    return {base - offset, base + offset};
}

inline void check_crossings(const std::vector<Segment>& segments, double tolerance) {
    for (std::size_t i = 0; i < segments.size(); ++i)
        for (std::size_t j = i + 1; j < segments.size(); ++j) {
            const Segment &a = segments[i], &b = segments[j];
            std::vector<Point2> candidates = meeting_points(a, b, tolerance);
            for (const Point2& p : {a.start(), a.end(), b.start(), b.end()})
                candidates.push_back(p);
            // Rounded digits let neighbours that should only touch cross again close by; that does no harm.
            const double beside = j == i + 1 ? 1e-3 * std::min(a.length(), b.length()) : -1;
            for (const Point2& p : candidates)
                if (a.distance(p) <= tolerance && b.distance(p) <= tolerance &&
                    !((p - b.start()).norm() <= beside))
                    refuse("the meeting of segments " + std::to_string(i) + " and " + std::to_string(j),
                           "at z = " + number(p[0]) + " m, r = " + number(p[1]) + " m",
                           "only neighbours meet, at the vertex they share");
            if (j == i + 1 && a.tangent_at(a.end()).dot(b.tangent_at(b.start())) < -1 + 1e-12)
                refuse("the turn at vertex " + std::to_string(j), "a fold of 180 degrees", "less than 180");
        }
}

} // namespace detail

// Throws std::invalid_argument with one sentence; returns when the profile is sound.
inline void check_profile(const std::vector<ProfileVertex>& vertices, const std::vector<Zone>& zones = {}) {
    double size = 0;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const std::array<double, 3> values = {vertices[i].z, vertices[i].r, vertices[i].bulge};
        const std::array<const char*, 3> names = {"z", "r", "bulge"};
        for (std::size_t k = 0; k < 3; ++k)
            if (!std::isfinite(values[k]))
                detail::refuse(names[k] + std::string(" of vertex ") + std::to_string(i),
                               detail::number(values[k]), "a finite number");
        size = std::max({size, std::abs(vertices[i].z - vertices[0].z), vertices[i].r});
    }
    const double tolerance = 1e-9 * size;
    if (vertices.size() >= 2)
        detail::check_vertices(vertices, tolerance);
    const Profile profile(vertices, zones);
    double area = 0; // above the axis; negative when the curve runs from base to nose
    for (const Segment& s : profile.segments()) {
        const double lowest = s.extreme({0, -1})[1];
        if (lowest < -tolerance)
            detail::refuse("r of an arc at its lowest point", detail::number(lowest) + " m", "r >= 0");
        area += 0.5 * cross(s.end(), s.start()) + 0.5 * s.curvature() * s.radius() * s.radius() * s.radius() *
                                                      (s.angle() - std::sin(s.angle()));
    }
    detail::check_crossings(profile.segments(), tolerance);
    if (!(area > 0))
        detail::refuse("the order of the vertices", "from base to nose",
                       "from nose to base, z growing along the shaft");
}

} // namespace grainfall::geometry
