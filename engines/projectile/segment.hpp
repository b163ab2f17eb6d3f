// SPDX-License-Identifier: GPL-2.0-or-later
//
// One piece of the generating curve of a solid of revolution: a straight line or a circular arc in the half
// plane (z along the axis of revolution, r >= 0 the distance from it), all lengths in metres.
//
// The curve is walked from the nose to the base, so the outside is on the left of the walker and the outward
// normal of a tangent (t_z, t_r) is (-t_r, t_z). An arc is given by its bulge
//     b = sagitta / half chord = tan(included angle / 4),
// positive when it stands out of its chord (convex), negative when it is hollow; b = 1 is half a circle.
// Curvature is positive where the surface is convex.
#pragma once

#include <cmath>

#include <Eigen/Core>

namespace grainfall::geometry {

using Point2 = Eigen::Vector2d; // (z, r)

enum class Zone { nose, shaft, base };

inline double cross(const Point2& a, const Point2& b) {
    return a[0] * b[1] - a[1] * b[0];
}
inline Point2 left_of(const Point2& tangent) {
    return {-tangent[1], tangent[0]};
}

class Segment {
public:
    enum class Feature { interior, start, end };
    struct Nearest {
        double squared_distance;
        Feature feature;
    };

    Segment(const Point2& start, const Point2& end, double bulge, Zone zone)
        : start_(start), end_(end), zone_(zone) {
        const Point2 chord = end - start;
        length_ = chord.norm();
        normal_ = left_of(chord) / length_;
        if (bulge == 0)
            return;
        const double half = 0.5 * length_;
        side_ = bulge > 0 ? 1 : -1;
        radius_ = half * (1 + bulge * bulge) / (2 * std::abs(bulge));
        angle_ = 4 * std::atan(std::abs(bulge));
        centre_ = 0.5 * (start + end) + (bulge * half - side_ * radius_) * normal_;
        length_ = radius_ * angle_;
    }

    const Point2& start() const { return start_; }
    const Point2& end() const { return end_; }
    Zone zone() const { return zone_; }
    bool is_arc() const { return side_ != 0; }
    double length() const { return length_; }
    double angle() const { return angle_; }
    double radius() const { return radius_; }
    const Point2& centre() const { return centre_; }
    double curvature() const { return is_arc() ? side_ / radius_ : 0; }

    // Point at the fraction u of the length.
    Point2 point_at(double u) const {
        if (!is_arc())
            return start_ + u * (end_ - start_);
        const double turn = -side_ * u * angle_; // a convex arc is walked clockwise
        const Point2 arm = start_ - centre_;
        return centre_ + std::cos(turn) * arm + std::sin(turn) * left_of(arm);
    }

    // Outward normal at a point of this segment, or at the foot of a point near it.
    Point2 normal_at(const Point2& p) const {
        if (!is_arc())
            return normal_;
        const Point2 arm = p - centre_;
        const double distance = arm.norm();
        // Every point of the arc is a foot of its centre; the middle one is taken.
        return distance > 0 ? Point2(side_ / distance * arm) : normal_;
    }
    Point2 tangent_at(const Point2& p) const {
        const Point2 n = normal_at(p);
        return {n[1], -n[0]};
    }

    Nearest nearest(const Point2& p) const {
        if (is_arc()) {
            const Point2 arm = p - centre_;
            if (in_sector(arm)) {
                const double gap = arm.norm() - radius_;
                return {gap * gap, Feature::interior};
            }
            const double to_start = (p - start_).squaredNorm();
            const double to_end = (p - end_).squaredNorm();
            return to_start <= to_end ? Nearest{to_start, Feature::start} : Nearest{to_end, Feature::end};
        }
        const Point2 from_start = p - start_;
        const double along = cross(from_start, normal_);
        if (along <= 0)
            return {from_start.squaredNorm(), Feature::start};
        if (along >= length_)
            return {(p - end_).squaredNorm(), Feature::end};
        const double gap = from_start.dot(normal_);
        return {gap * gap, Feature::interior};
    }
    double distance(const Point2& p) const { return std::sqrt(nearest(p).squared_distance); }

    // Signed distance (positive outside) of a point whose foot is inside this segment.
    double signed_distance(const Point2& p) const {
        return is_arc() ? side_ * ((p - centre_).norm() - radius_) : (p - start_).dot(normal_);
    }
    Point2 foot(const Point2& p) const {
        return is_arc() ? Point2(centre_ + side_ * radius_ * normal_at(p))
                        : Point2(p - signed_distance(p) * normal_);
    }

    // The point farthest along a direction (of any length).
    Point2 extreme(const Point2& direction) const {
        if (is_arc() && direction.squaredNorm() > 0) {
            const Point2 arm = direction.normalized() * radius_;
            if (in_sector(arm))
                return centre_ + arm;
        }
        return direction.dot(start_) >= direction.dot(end_) ? start_ : end_;
    }

private:
    // Is a vector from the centre within the angle spanned by the arc?
    bool in_sector(const Point2& arm) const {
        // Turned so that the arc runs counter-clockwise.
        const double from_start = -side_ * cross(start_ - centre_, arm);
        const double to_end = -side_ * cross(arm, end_ - centre_);
        constexpr double half_circle = 3.14159265358979323846;
        return angle_ <= half_circle ? from_start >= 0 && to_end >= 0 : !(from_start < 0 && to_end < 0);
    }

    Point2 start_, end_;
    Point2 normal_ = Point2::Zero(); // of the chord
    Point2 centre_ = Point2::Zero();
    double length_ = 0;
    double radius_ = 0;
    double angle_ = 0;
    int side_ = 0; // +1 convex arc, -1 hollow arc, 0 straight
    Zone zone_;
};

} // namespace grainfall::geometry
