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
// is a descent for any K C, also where more contacts than degrees of freedom make G singular. There it is a
// slow one, and node_solver.hpp takes its place.
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
    // 1/|s| is nearly linear in lambda (More and Sorensen), and Newton on it rises to the root from below:
    // from where it would lie if the wall gave way in all directions as in its softest.
    const double softest = 0.5 * (a + c) + std::sqrt(0.25 * (a - c) * (a - c) + b * b);
    double lambda = std::max(0.0, stretch.norm() / limit - softest);
    shear = solved(lambda);
    size = shear.norm();
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

// N, what a contact answers to the wall's yielding: p first, then s. `yielded` (m, in the contact's axes): G
// q there, of which its own compliance (3 x 3) times `before`, its force until now, is its own doing.
template <class Contact>
Eigen::Vector3d contact_force(const Contact& contact, const Eigen::Matrix3d& own,
                              const Eigen::Vector3d& yielded, const Eigen::Vector3d& before) {
    const double free_here = contact.free_overlap - (yielded[0] - own(0, 0) * before[0]);
    Eigen::Vector3d force = Eigen::Vector3d::Zero();
    force[0] = in_series(contact.relation, own(0, 0), free_here, free_here - own(0, 0) * before[0]);
    const double limit = contact.shear_limit(force[0]);
    if (!(limit > 0))
        return force;
    const double change = force[0] - before[0];
    const ShearSpring spring = contact.shear_spring(contact.free_overlap - (yielded[0] + own(0, 0) * change));
    const Eigen::Matrix2d own_shear = own.bottomRightCorner<2, 2>();
    const Eigen::Vector2d others =
        yielded.tail<2>() + own.block<2, 1>(1, 0) * change - own_shear * before.tail<2>();
    force.tail<2>() = capped_shear(own_shear, spring.stiffness, spring.stretch - others, limit);
    return force;
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
    // What has all but settled is left as it is: applying a change costs three columns of G.
    constexpr double settled = 0.1; // of the tolerance
    double negligible = 0;
    for (int i = 0; i < count; ++i)
        negligible = std::max(negligible, settled * options.tolerance * forces[3 * i]);
    for (; report.sweeps < options.max_sweeps && !report.converged;) {
        double change = 0, largest = 0;
        for (int i = 0; i < count; ++i) {
            const int n = 3 * i;
            const Eigen::Matrix3d own = wall.block<3, 3>(n, n);
            const Eigen::Vector3d found =
                contact_force<Contact>(contacts[i], own, yielded.segment<3>(n), forces.segment<3>(n));
            const Eigen::Vector3d step = found - forces.segment<3>(n);
            const double size = step.cwiseAbs().maxCoeff();
            if (size > negligible) {
                forces.segment<3>(n) = found;
                yielded.noalias() += wall.middleCols<3>(n) * step;
                change = std::max(change, size);
            }
            largest = std::max(largest, forces[n]);
        }
        negligible = settled * options.tolerance * largest;
        ++report.sweeps;
        report.change = largest > 0 ? change / largest : change;
        report.converged = change <= options.tolerance * largest;
    }
    return report;
}

} // namespace grainfall::femlink
