// SPDX-License-Identifier: GPL-2.0-or-later
// All contacts of a wall at once, implicit in the wall's compliance G (compliance.hpp). Unknown: q_i = (p, s)
// on grain i, normal and shear. With the overlap o_i and the shear spring's stretch e_i (two components, m)
// that the contact would have on the wall without contact loads,
//
//   p = F(o - (G q)_n),  p >= 0                  F: normal_relation.hpp
//   s = k_t (e - (G q)_t),  cut to |s| <= mu p   (sliding: the wall and the spring give way along s)
//
// Solved by projected nonlinear Gauss-Seidel: contact by contact, first p with s held, then s with p held,
// each exactly. It needs no stiffness limit: the exchange of forces step by step diverges once K C > 1, this
// is a descent for any K C, also where more contacts than degrees of freedom make G singular.
#pragma once

#include <femlink/core/normal_relation.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Core>

namespace grainfall::femlink {

// Of a contact at some overlap.
struct ShearSpring {
    double stiffness;        // k_t, N/m
    Eigen::Vector2d stretch; // e, m
};

template <class Relation>
struct WallContact {
    Relation relation;
    double free_overlap = 0;                              // o, m
    Eigen::Vector2d free_shear = Eigen::Vector2d::Zero(); // e, m
    double shear_stiffness = 0;                           // k_t, N/m; 0: no shear force
    double friction = 0;                                  // mu

    // N, largest shear force under this normal force.
    double shear_limit(double normal) const { return friction * normal; }
    ShearSpring shear_spring(double) const { return {shear_stiffness, free_shear}; }
};

struct SolverOptions {
    double tolerance = 1e-10; // change of any force in one sweep, over the largest force
    int max_sweeps = 10000;
};

struct SolverReport {
    int sweeps = 0;
    bool converged = false;
    double change = 0; // of the last sweep, over the largest force
};

// s of one contact with p held: (1/k_t + S + lambda) s = e, lambda >= 0 where |s| would exceed the limit. S:
// the wall's shear compliance at the contact, 2 x 2.
inline Eigen::Vector2d capped_shear(const Eigen::Matrix2d& compliance, double shear_stiffness,
                                    const Eigen::Vector2d& stretch, double limit) {
    if (!(limit > 0) || !(shear_stiffness > 0))
        return Eigen::Vector2d::Zero();
    const double own = 1 / shear_stiffness;
    const double a = compliance(0, 0) + own, b = compliance(0, 1), c = compliance(1, 1) + own;
    const auto solved = [&](double lambda) {
        const double p = a + lambda, r = c + lambda, determinant = p * r - b * b;
        return Eigen::Vector2d((r * stretch[0] - b * stretch[1]) / determinant,
                               (p * stretch[1] - b * stretch[0]) / determinant);
    };
    Eigen::Vector2d shear = solved(0);
    double size = shear.norm();
    if (size <= limit)
        return shear;
    // 1/|s| is nearly linear in lambda (More and Sorensen), and Newton on it rises to the root from below.
    double lambda = 0;
    for (int i = 0; i < 30 && std::abs(size - limit) > 1e-15 * limit; ++i) {
        const double p = a + lambda, r = c + lambda, determinant = p * r - b * b;
        const Eigen::Vector2d slope((r * shear[0] - b * shear[1]) / determinant,
                                    (p * shear[1] - b * shear[0]) / determinant);
        const double next = lambda + (size - limit) / limit * size * size / shear.dot(slope);
        if (!(next > lambda))
            break;
        lambda = next;
        shear = solved(lambda);
        size = shear.norm();
    }
    return shear * (limit / size);
}

// `forces`: three per contact; the values found in it are where the iteration starts (those of the step
// before). Contact: WallContact, or what has `relation`, `free_overlap`, `shear_limit` and `shear_spring` as
// that does.
template <class Contact>
SolverReport solve_contacts(const Eigen::MatrixXd& wall, const std::vector<Contact>& contacts,
                            Eigen::VectorXd& forces, const SolverOptions& options = {}) {
    const int count = static_cast<int>(contacts.size());
    if (forces.size() != 3 * count)
        forces = Eigen::VectorXd::Zero(3 * count);
    Eigen::VectorXd yielded = wall * forces;
    SolverReport report;
    if (count == 0) {
        report.converged = true;
        return report;
    }
    // What has all but settled is left as it is: applying a change costs a column of G.
    constexpr double settled = 0.1; // of the tolerance
    double negligible = 0;
    for (int i = 0; i < count; ++i)
        negligible = std::max(negligible, settled * options.tolerance * forces[3 * i]);
    for (; report.sweeps < options.max_sweeps && !report.converged;) {
        double change = 0, largest = 0;
        for (int i = 0; i < count; ++i) {
            const Contact& contact = contacts[i];
            const int n = 3 * i;
            const double own = wall(n, n);
            const double overlap = contact.free_overlap - (yielded[n] - own * forces[n]);
            const double found = in_series(contact.relation, own, overlap);
            const bool moves = std::abs(found - forces[n]) > negligible;
            const double normal = moves ? found : forces[n];
            const double normal_change = normal - forces[n];
            if (normal_change != 0) {
                forces[n] = normal;
                yielded += normal_change * wall.col(n);
            }
            const Eigen::Vector2d before = forces.segment<2>(n + 1);
            const double limit = contact.shear_limit(normal);
            Eigen::Vector2d shear = Eigen::Vector2d::Zero();
            if (limit > 0) {
                const ShearSpring spring = contact.shear_spring(contact.free_overlap - yielded[n]);
                const Eigen::Matrix2d own_shear = wall.block<2, 2>(n + 1, n + 1);
                const Eigen::Vector2d stretch =
                    spring.stretch - (yielded.segment<2>(n + 1) - own_shear * before);
                shear = capped_shear(own_shear, spring.stiffness, stretch, limit);
            }
            if (!moves && (shear - before).cwiseAbs().maxCoeff() <= negligible)
                shear = before;
            const Eigen::Vector2d shear_change = shear - before;
            if (shear_change[0] != 0 || shear_change[1] != 0) {
                forces.segment<2>(n + 1) = shear;
                yielded.noalias() += wall.middleCols<2>(n + 1) * shear_change;
            }
            change = std::max(
                {change, std::abs(normal_change), std::abs(shear_change[0]), std::abs(shear_change[1])});
            largest = std::max(largest, normal);
        }
        negligible = settled * options.tolerance * largest;
        ++report.sweeps;
        report.change = largest > 0 ? change / largest : change;
        report.converged = change <= options.tolerance * largest;
    }
    return report;
}

} // namespace grainfall::femlink
