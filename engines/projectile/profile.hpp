// SPDX-License-Identifier: GPL-2.0-or-later
//
// Generating curve of a solid of revolution (see segment.hpp): vertices (z, r) in metres from the nose to the
// base, the first and the last on the axis, joined by lines or arcs. The curve must be simple; check_profile
// (profile_check.hpp) says in one sentence what is wrong with a curve that is not.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <engines/projectile/segment.hpp>

namespace grainfall::geometry {

struct ProfileVertex {
    double z;         // m, along the axis, growing from nose to base
    double r;         // m, distance from the axis
    double bulge = 0; // of the segment from this vertex to the next, see segment.hpp
};

class Profile {
public:
    // A sharp vertex turns by more than this angle (rad); a smaller turn is a smooth joint typed with few
    // digits.
    static constexpr double sharp_turn = 1e-3;

    Profile() = default;

    // Zones, one per segment; left out, they are found from the largest radius: see default_zones.
    explicit Profile(const std::vector<ProfileVertex>& vertices, std::vector<Zone> zones = {}) {
        if (vertices.size() < 2)
            throw std::invalid_argument("profile: " + std::to_string(vertices.size()) +
                                        " vertices; allowed: at least 2");
        if (zones.empty())
            zones = default_zones(vertices);
        if (zones.size() + 1 != vertices.size())
            throw std::invalid_argument("zones: " + std::to_string(zones.size()) +
                                        " entries; allowed: one for each of the " +
                                        std::to_string(vertices.size() - 1) + " segments, or none");
        segments_.reserve(zones.size());
        for (std::size_t i = 0; i < zones.size(); ++i)
            segments_.emplace_back(Point2(vertices[i].z, vertices[i].r),
                                   Point2(vertices[i + 1].z, vertices[i + 1].r), vertices[i].bulge, zones[i]);
        measure();
    }

    bool empty() const { return segments_.empty(); }
    const std::vector<Segment>& segments() const { return segments_; }
    double z_min() const { return z_min_; }
    double z_max() const { return z_max_; }
    double r_max() const { return r_max_; }
    double length() const { return z_max_ - z_min_; }
    // Radius of the smallest ball around the origin that holds the solid.
    double reach() const { return reach_; }

    // Sum of the outward normals on both sides of vertex i (0 .. segment count). Its sign decides on which
    // side of the surface a point lies whose nearest feature is that vertex; on the axis the neighbour is the
    // mirror image of the same segment.
    const Point2& vertex_normal(std::size_t i) const { return vertex_normals_[i]; }
    bool is_sharp(std::size_t i) const { return sharp_[i] != 0; }

private:
    // Nose up to the first point of the largest radius, base behind the last one, shaft between them.
    static std::vector<Zone> default_zones(const std::vector<ProfileVertex>& vertices) {
        double largest = 0;
        for (const ProfileVertex& v : vertices)
            largest = std::max(largest, v.r);
        std::vector<Zone> zones(vertices.size() - 1, Zone::nose);
        if (largest == 0) // a single arc from axis to axis
            return zones;
        std::size_t first = vertices.size(), last = 0;
        for (std::size_t i = 0; i < vertices.size(); ++i)
            if (vertices[i].r >= largest * (1 - 1e-9)) {
                first = std::min(first, i);
                last = i;
            }
        for (std::size_t i = first; i < zones.size(); ++i)
            zones[i] = i < last ? Zone::shaft : Zone::base;
        return zones;
    }

    void measure() {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        z_min_ = infinity;
        z_max_ = -infinity;
        for (const Segment& s : segments_) {
            z_min_ = std::min(z_min_, s.extreme({-1, 0})[0]);
            z_max_ = std::max(z_max_, s.extreme({1, 0})[0]);
            r_max_ = std::max(r_max_, s.extreme({0, 1})[1]);
            reach_ = std::max({reach_, s.start().norm(), s.end().norm()});
            if (s.is_arc()) // an arc is farthest from the origin on the ray through its centre
                reach_ = std::max(reach_, s.extreme(s.centre()).norm());
        }
        const std::size_t count = segments_.size();
        vertex_normals_.resize(count + 1);
        sharp_.resize(count + 1);
        for (std::size_t i = 0; i <= count; ++i) {
            Point2 before = Point2::Zero(), behind = Point2::Zero();
            if (i > 0)
                before = segments_[i - 1].normal_at(segments_[i - 1].end());
            if (i < count)
                behind = segments_[i].normal_at(segments_[i].start());
            if (i == 0)
                before = Point2(behind[0], -behind[1]);
            if (i == count)
                behind = Point2(before[0], -before[1]);
            vertex_normals_[i] = before + behind;
            sharp_[i] = std::abs(std::atan2(cross(before, behind), before.dot(behind))) > sharp_turn;
        }
    }

    std::vector<Segment> segments_;
    std::vector<Point2> vertex_normals_;
    std::vector<char> sharp_;
    double z_min_ = 0, z_max_ = 0, r_max_ = 0, reach_ = 0;
};

} // namespace grainfall::geometry
