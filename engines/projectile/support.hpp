// SPDX-License-Identifier: GPL-2.0-or-later
//
// Support function of a solid of revolution: h(d) = max over the solid of d . x, which for a direction d with
// axial part d_z and radial part d_rho >= 0 is the maximum of z d_z + r d_rho over the generating curve. It
// gives the exact bounding box of the rotated solid and the point that reaches deepest into a half space.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Core>

#include <engines/projectile/profile.hpp>

namespace grainfall::geometry {

// h(d), in metres times the length of d. Zero for an empty profile.
inline double support(const Profile& profile, const Eigen::Vector3d& direction) {
    const Point2 d(direction[2], std::hypot(direction[0], direction[1]));
    double best = profile.empty() ? 0 : -std::numeric_limits<double>::infinity();
    for (const Segment& s : profile.segments())
        best = std::max(best, d.dot(s.extreme(d)));
    return best;
}

// The point of the solid farthest along a unit direction; where a face or a line lies across the direction,
// its middle.
inline Eigen::Vector3d support_point(const Profile& profile, const Eigen::Vector3d& direction) {
    const Point2 d(direction[2], std::hypot(direction[0], direction[1]));
    constexpr double level = 1e-9; // relative: rotations carry rounding errors of this kind
    const double lowest = support(profile, direction) - level * profile.reach();
    double z_low = profile.z_max(), z_high = profile.z_min(), r_high = 0;
    for (const Segment& s : profile.segments())
        for (const Point2& p : {s.start(), s.end(), s.extreme(d)})
            if (d.dot(p) >= lowest) {
                z_low = std::min(z_low, p[0]);
                z_high = std::max(z_high, p[0]);
                r_high = std::max(r_high, p[1]);
            }
    const double z = 0.5 * (z_low + z_high);
    if (d[1] <= level)
        return {0, 0, z};
    return {r_high * direction[0] / d[1], r_high * direction[1] / d[1], z};
}

} // namespace grainfall::geometry
