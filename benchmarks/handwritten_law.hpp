// SPDX-License-Identifier: GPL-2.0-or-later
// The plain contact written out by hand, the yardstick of what effects that are off may cost: Hertz, and if
// wanted Mindlin's tangential force rescaled on unloading and the dashpot, constant friction, dry. Nothing
// else exists here: no header of any effect is included, no policy, no branch for one.
#pragma once

#include <laws/contact.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace grainfall::benchmarks {

template <bool sheared, bool damped>
[[gnu::always_inline]] inline laws::ContactForce handwritten_step(const laws::ContactGeometry& g,
                                                                  const laws::ContactParameters& p, double mu,
                                                                  laws::ContactMemory& memory) {
    using laws::Vector;
    const double root = std::sqrt(g.overlap);
    laws::ContactForce out;
    out.normal_stiffness = 1.5 * p.normal_coefficient * root;
    out.normal = p.normal_coefficient * (g.overlap * root);
    double quarter = 0;
    if constexpr (damped) {
        quarter = std::sqrt(root);
        out.normal = std::max(0.0, out.normal - p.normal_damping * quarter * g.normal_velocity);
    }
    if constexpr (!sheared)
        return out;
    const double ks = p.shear_coefficient * root;
    out.shear_stiffness = ks;

    const Vector half = 0.5 * (g.tilt + g.twist);
    const Vector turned = half.cross(memory.shear_force);
    Vector shear = memory.shear_force + (2 / (1 + half.squaredNorm())) * (turned + half.cross(turned));
    const double normal_part = shear.dot(g.normal), length2 = shear.squaredNorm();
    shear -= normal_part * g.normal;
    const double lost = normal_part * normal_part;
    if (lost > 1e-20 * length2 && lost < length2)
        shear *= std::sqrt(length2 / (length2 - lost));
    if (ks < memory.shear_stiffness)
        shear *= ks / memory.shear_stiffness;
    shear -= ks * g.shear_increment;

    const double limit = mu * out.normal, limit2 = limit * limit;
    Vector viscous = Vector::Zero();
    if constexpr (damped)
        viscous = (-p.shear_damping * quarter / g.time_step) * g.shear_increment;
    Vector total = shear + viscous;
    const double shear2 = shear.squaredNorm();
    if (shear2 > limit2) {
        shear *= limit / std::sqrt(shear2);
        total = shear + viscous;
        out.sliding = true;
    }
    if constexpr (damped) {
        const double total2 = total.squaredNorm();
        if (total2 > limit2) {
            total *= limit / std::sqrt(total2);
            out.sliding = true;
        }
    }
    out.shear = total;
    memory.shear_force = shear;
    memory.shear_stiffness = ks;
    return out;
}

} // namespace grainfall::benchmarks
