// SPDX-License-Identifier: GPL-2.0-or-later
// Contacts of a wall from step to step, by the method that is cheaper for them: contact by contact
// (contact_solver.hpp) where they are fewer than the nodes under them, on the nodes (node_solver.hpp) where
// they are more.
#pragma once

#include <femlink/core/node_solver.hpp>

namespace grainfall::femlink {

class WallSolver {
public:
    WallSolver(const Surface& surface, const Eigen::MatrixXd& compliance)
        : loaded_(surface, compliance), on_nodes_(loaded_.nodes()) {}
    WallSolver(const WallSolver&) = delete; // on_nodes_ refers to loaded_

    // `own`: own_compliance of each site.
    template <class Contact>
    SolverReport solve(const Sites& sites, const std::vector<Eigen::Matrix3d>& own,
                       const std::vector<Contact>& contacts, Eigen::VectorXd& forces,
                       const SolverOptions& options) {
        if (forces.size() != 3 * static_cast<Eigen::Index>(sites.size()))
            forces = Eigen::VectorXd::Zero(3 * sites.size());
        loaded_.nodes().gather(sites);
        if (2 * sites.size() > static_cast<std::size_t>(loaded_.nodes().count())) {
            Eigen::VectorXd found = forces;
            const SolverReport report = on_nodes_.solve(sites, own, contacts, found, options);
            if (report.converged) {
                forces = found;
                return report;
            }
        }
        return solve_contacts(loaded_.condense(sites), contacts, forces, options);
    }

    const Eigen::MatrixXd& condense(const Sites& sites) { return loaded_.condense(sites); }

    // The next solution starts as the first would: on_nodes_ sees that the nodes have been gathered anew.
    void forget() { loaded_.forget(); }

private:
    LoadedCompliance loaded_;
    NodeSolver on_nodes_;
};

} // namespace grainfall::femlink
