// SPDX-License-Identifier: GPL-2.0-or-later
// The report's exchange: forces from the wall's last position, the wall's position from those forces, and
// again. A fixed-point iteration q <- F(o - G q) that converges only where its gain, the largest eigenvalue
// of
//
//   K^(1/2) G K^(1/2),   K: each contact's stiffness,
//
// is below one. A wall without inertia follows at once, so taking smaller time steps changes nothing. The
// stiffness is taken at the overlap on the wall that has not yet given way, an upper bound for a contact that
// hardens.
#pragma once

#include <femlink/core/contact_solver.hpp>
#include <laws/validation.hpp>

#include <Eigen/Eigenvalues>

#include <sstream>

namespace grainfall::femlink {

template <class Contact>
double staggered_gain(const Eigen::MatrixXd& wall, const std::vector<Contact>& contacts) {
    if (contacts.empty())
        return 0;
    Eigen::VectorXd root = Eigen::VectorXd::Zero(3 * contacts.size());
    for (std::size_t i = 0; i < contacts.size(); ++i) {
        if (!(contacts[i].free_overlap > 0))
            continue;
        root[3 * i] = std::sqrt(contacts[i].relation.stiffness(contacts[i].free_overlap));
        if (contacts[i].shear_limit(1) > 0) {
            const ShearSpring spring = contacts[i].shear_spring(contacts[i].free_overlap);
            root.segment<2>(3 * i + 1).setConstant(std::sqrt(spring.stiffness));
        }
    }
    // Power iteration: G is positive semi-definite and its largest mode, all contacts together, stands apart.
    Eigen::VectorXd mode = root.array() + root.maxCoeff();
    double gain = 0;
    for (int i = 0; i < 500; ++i) {
        if (mode.norm() == 0)
            return 0;
        mode.normalize();
        const Eigen::VectorXd next = root.cwiseProduct(wall * root.cwiseProduct(mode));
        const double estimate = next.norm();
        mode = next;
        if (std::abs(estimate - gain) <= 1e-12 * estimate)
            return estimate;
        gain = estimate;
    }
    return gain;
}

// Refuses (std::invalid_argument) where the exchange must diverge.
template <class Relation>
SolverReport solve_staggered(const Eigen::MatrixXd& wall, const std::vector<WallContact<Relation>>& contacts,
                             Eigen::VectorXd& forces, const SolverOptions& options = {}) {
    const double gain = staggered_gain(wall, contacts);
    if (gain >= 1) {
        std::ostringstream text;
        text << "'implicit' here: particle stiffness times wall compliance is " << gain
             << ", and exchanging forces step by step diverges from 1 on, whatever the time step";
        laws::reject("coupling", "'staggered'", text.str());
    }
    const int count = static_cast<int>(contacts.size());
    if (forces.size() != 3 * count)
        forces = Eigen::VectorXd::Zero(3 * count);
    SolverReport report;
    while (report.sweeps < options.max_sweeps && !report.converged) {
        const Eigen::VectorXd yielded = wall * forces;
        Eigen::VectorXd next(3 * count);
        for (int i = 0; i < count; ++i) {
            const WallContact<Relation>& contact = contacts[i];
            const double overlap = contact.free_overlap - yielded[3 * i];
            next[3 * i] = overlap > 0 ? contact.relation.force(overlap) : 0;
            next.segment<2>(3 * i + 1) = capped_shear(Eigen::Matrix2d::Zero(), contact.shear_stiffness,
                                                      contact.free_shear - yielded.segment<2>(3 * i + 1),
                                                      contact.friction * next[3 * i]);
        }
        const double change = (next - forces).cwiseAbs().maxCoeff(), largest = next.cwiseAbs().maxCoeff();
        forces = next;
        ++report.sweeps;
        report.change = largest > 0 ? change / largest : change;
        report.converged = change <= options.tolerance * largest;
    }
    return report;
}

} // namespace grainfall::femlink
