// SPDX-License-Identifier: GPL-2.0-or-later
// A contact for the solver (contact_solver.hpp) whose forces are those that the contact law will find in this
// step on the wall as it then lies: Hertz or a linear spring, the dashpots, the incremental shear spring with
// its loss on unloading, any friction curve.
//
//   normal   F = k d^(3/2) + c d^(1/4) (d - d0)/dt      d0: overlap at which the two surfaces do not approach
//            F = k d                                    in a linear law
//   shear    s = s0 + (k_t + c_t/dt) (m - (G q)_t)      s0: of the last step, less what unloading loses
//
// m is the displacement of the wall's last position seen from the sphere's surface.
#pragma once

#include <femlink/core/contact_solver.hpp>

#include <laws/friction/any.hpp>

#include <algorithm>
#include <cmath>

namespace grainfall::femlink {

struct LawRelation {
    double coefficient = 0; // N/m^(3/2), or N/m where `linear`
    bool linear = false;
    double damping = 0;      // N s/m^(5/4)
    double idle_overlap = 0; // d0, m
    double rate = 0;         // 1/dt, 1/s
    bool attracts = false;   // a dashpot that may pull

    double force(double overlap) const { return response(overlap).force; }
    double stiffness(double overlap) const { return response(overlap).stiffness; }
    Response response(double overlap) const {
        if (linear)
            return {coefficient * overlap, coefficient};
        if (!(overlap > 0))
            return {0, 0};
        const double root = std::sqrt(overlap);
        const double spring = coefficient * root;
        if (damping == 0)
            return {spring * overlap, 1.5 * spring};
        const double dashpot = damping * rate * std::sqrt(root);
        const double force = spring * overlap + dashpot * (overlap - idle_overlap);
        if (force <= 0 && !attracts)
            return {0, 0};
        return {force, 1.5 * spring + dashpot * (1.25 - 0.25 * idle_overlap / overlap)};
    }
};

struct LawContact {
    LawRelation relation;
    double free_overlap = 0;      // m
    double shear_coefficient = 0; // k_t = that times sqrt(d), N/m^(3/2), or k_t itself where linear
    double shear_damping = 0;     // N s/m^(5/4)
    bool loses_on_unloading = false;
    double stiffness_before = 0;                            // k_t of the last step, N/m
    Eigen::Vector2d shear_before = Eigen::Vector2d::Zero(); // s of the last step, elastic, N
    Eigen::Vector2d shift = Eigen::Vector2d::Zero();        // m
    double friction = 0;                                    // where it is constant
    const laws::friction::Any* curve = nullptr;             // elsewhere

    double shear_limit(double normal) const {
        if (!(normal > 0))
            return 0;
        return (curve ? curve->coefficient(normal) : friction) * normal;
    }
    ShearSpring shear_spring(double overlap) const {
        if (!(overlap > 0))
            return {0, Eigen::Vector2d::Zero()};
        const double root = std::sqrt(overlap);
        const double spring = relation.linear ? shear_coefficient : shear_coefficient * root;
        const double total = spring + shear_damping * std::sqrt(root) * relation.rate;
        if (!(total > 0))
            return {0, Eigen::Vector2d::Zero()};
        const double kept = loses_on_unloading && spring < stiffness_before ? spring / stiffness_before : 1;
        return {total, kept / total * shear_before + shift};
    }
};

} // namespace grainfall::femlink
