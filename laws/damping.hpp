// SPDX-License-Identifier: GPL-2.0-or-later
// Viscous damping whose coefficient of restitution does not depend on the impact speed.
//
//   c_n = 2 zeta sqrt(m* k_n),  c_t = 2 zeta sqrt(m* k_t),  both proportional to overlap^(1/4)
//
// (Tsuji, Tanaka & Ishida 1992, Powder Technol. 71:239; Antypov & Elliott 2011, EPL 94:50004.) c in N s/m,
// m* effective mass in kg, k tangent stiffness in N/m, zeta the damping ratio. With y ~ overlap^(5/4) the
// equation of a head-on impact, m* d'' + c_n d' + F(d) = 0, becomes the linear oscillator y'' + 2 b y' + y
// = 0 with b = zeta sqrt(6/5); the speed drops out, and so does any constant factor in F. Then
//
//   contact until d = 0 (dashpot may attract):   e = exp(-pi b/sqrt(1 - b^2)),          b < 1
//   contact until F = 0 (it may not):            e = exp(-2 b acos(b)/sqrt(1 - b^2)),   any b >= 0
//
// the second from y'' = 0 at the angle 2 acos(b); beyond b = 1 acosh(b)/sqrt(b^2 - 1) continues it. Valid for
// two bodies; a grain held by several contacts is damped by each.
#pragma once

#include <laws/lanes.hpp>
#include <laws/validation.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace grainfall::laws {

struct NoDamping {
    static constexpr bool active = false;
    static constexpr bool attracts = false;
};

// The normal force, spring and dashpot together, is never attractive.
struct RepulsiveDashpot {
    static constexpr bool active = true;
    static constexpr bool attracts = false;
    template <class Scalar>
    [[gnu::always_inline]] static Scalar total(const Scalar& elastic, const Scalar& viscous) {
        return larger(Scalar(0), elastic + viscous);
    }
};

struct AttractiveDashpot {
    static constexpr bool active = true;
    static constexpr bool attracts = true;
    template <class Scalar>
    [[gnu::always_inline]] static Scalar total(const Scalar& elastic, const Scalar& viscous) {
        return elastic + viscous;
    }
};

namespace detail {

inline constexpr double pi = 3.14159265358979323846;
inline constexpr double damping_ratio_per_b = 0.91287092917527685576; // sqrt(5/6)

// acos(b)/sqrt(1 - b^2), continued through b = 1.
inline double arc_ratio(double b) {
    const double x = 1.0 - b;
    if (std::abs(x) < 1e-3)
        return 1.0 + x * (1.0 / 3 + x * (2.0 / 15 + x * (2.0 / 35 + x * 8.0 / 315)));
    return b < 1 ? std::acos(b) / std::sqrt((1 - b) * (1 + b)) : std::acosh(b) / std::sqrt((b - 1) * (b + 1));
}

// Solves 2 b arc_ratio(b) = -ln e. The left side rises from 0 without bound, with slope between 0 and pi.
inline double repulsive_b(double minus_log_e) {
    double low = 0, high = 1;
    while (2 * high * arc_ratio(high) < minus_log_e)
        high *= 2;
    while (high - low > 4 * std::numeric_limits<double>::epsilon() * high) {
        const double middle = 0.5 * (low + high);
        (2 * middle * arc_ratio(middle) < minus_log_e ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

} // namespace detail

// Coefficient of restitution of a head-on impact for a damping ratio zeta >= 0. With attraction the contact
// creeps and never opens for zeta >= sqrt(5/6): 0.
inline double restitution_from_damping_ratio(double damping_ratio, bool attraction) {
    require_not_negative("dampingRatio", damping_ratio);
    const double b = damping_ratio / detail::damping_ratio_per_b;
    if (!attraction)
        return std::exp(-2 * b * detail::arc_ratio(b));
    return b < 1 ? std::exp(-detail::pi * b / std::sqrt((1 - b) * (1 + b))) : 0.0;
}

inline constexpr double smallest_restitution = 0.01;

// Damping ratio zeta that gives the restitution e in [0.01, 1]; meant for when a contact is made, not for
// the loop.
inline double damping_ratio_from_restitution(double restitution, bool attraction) {
    require_between("restitution", restitution, smallest_restitution, 1.0);
    if (restitution == 1.0)
        return 0.0;
    const double minus_log_e = -std::log(restitution);
    const double b = attraction ? minus_log_e / std::sqrt(detail::pi * detail::pi + minus_log_e * minus_log_e)
                                : detail::repulsive_b(minus_log_e);
    return b * detail::damping_ratio_per_b;
}

// N s/m^1.25: what overlap^(1/4) multiplies in c_n and c_t.
inline double normal_damping_coefficient(double damping_ratio, double mass, double normal_coefficient) {
    return 2 * damping_ratio * std::sqrt(mass * 1.5 * normal_coefficient);
}
inline double shear_damping_coefficient(double damping_ratio, double mass, double shear_coefficient) {
    return 2 * damping_ratio * std::sqrt(mass * shear_coefficient);
}

} // namespace grainfall::laws
