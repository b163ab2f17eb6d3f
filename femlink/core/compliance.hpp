// SPDX-License-Identifier: GPL-2.0-or-later
// The wall as its contacts see it. C (m/N) is the compliance condensed to the surface: displacements of the
// loose surface nodes under forces on them, three rows a node, u = C f. Contact i pushes the wall with
// f_i = -Q_i q_i, where q_i = (normal force, two shear forces) acts on the grain, in its axes Q_i = (n, t1,
// t2); B_i spreads it over the nodes of its patch. In its axes the wall then gives way by -sum_j G_ij q_j,
//
//   G_ij = Q_i^T B_i^T C B_j Q_j        (3 x 3 each, G symmetric, positive semi-definite, m/N)
//
// Only rows and columns of C at nodes that carry load are touched; they are gathered once and kept while the
// loaded nodes stay the same.
#pragma once

#include <femlink/core/contact_patch.hpp>

#include <Eigen/Core>

#include <vector>

namespace grainfall::femlink {

// The loose nodes under the patches of some contacts, and C between them.
class LoadedNodes {
public:
    LoadedNodes(const Surface& surface, const Eigen::MatrixXd& compliance)
        : surface_(surface), whole_(compliance), slot_(surface.loose_count(), -1) {}

    // A node that carries no load any more stays until such nodes are the most.
    void gather(const Sites& sites) {
        std::vector<int> needed;
        bool all_there = true;
        wanted_.assign(slot_.size(), 0);
        for (const ContactSite* site : sites) {
            for (const int node : site->patch.nodes) {
                const int loose = surface_.loose[node];
                if (loose == Surface::fixed || wanted_[loose])
                    continue;
                wanted_[loose] = 1;
                needed.push_back(loose);
                all_there = all_there && slot_[loose] >= 0;
            }
        }
        if (all_there && used_.size() <= 2 * needed.size() + 32)
            return;
        forget();
        std::sort(needed.begin(), needed.end());
        used_ = needed;
        const int n = count();
        for (int k = 0; k < n; ++k)
            slot_[used_[k]] = k;
        compliance_.resize(3 * n, 3 * n);
        for (int b = 0; b < n; ++b)
            for (int a = 0; a < n; ++a)
                compliance_.block<3, 3>(3 * a, 3 * b) = whole_.block<3, 3>(3 * used_[a], 3 * used_[b]);
        ++version_;
    }

    void forget() {
        for (const int loose : used_)
            slot_[loose] = -1;
        used_.clear();
    }

    int count() const { return static_cast<int>(used_.size()); }
    // Place of a node of the surface among these; -1 where it is fixed.
    int slot(int node) const {
        const int loose = surface_.loose[node];
        return loose == Surface::fixed ? -1 : slot_[loose];
    }
    const Eigen::MatrixXd& compliance() const { return compliance_; } // m/N, three rows a node
    // Another number whenever the nodes, or their order, have changed.
    long version() const { return version_; }

private:
    const Surface& surface_;
    const Eigen::MatrixXd& whole_;
    std::vector<int> slot_, used_; // place among the loaded nodes by loose node, and the other way round
    std::vector<char> wanted_;
    Eigen::MatrixXd compliance_;
    long version_ = 0;
};

// G of some contacts, from step to step.
class LoadedCompliance {
public:
    LoadedCompliance(const Surface& surface, const Eigen::MatrixXd& compliance)
        : nodes_(surface, compliance) {}

    // G of these contacts. Contacts on fixed nodes, or with an empty patch, get zeros: there the wall is
    // rigid. Only what differs from the call before is computed, contact by contact in their order: a caller
    // that leaves a patch where it is until the contact has moved noticeably, and keeps contacts in their
    // places, pays for the few that moved.
    const Eigen::MatrixXd& condense(const Sites& sites) {
        const std::size_t common = std::min(sites.size(), kept_.size());
        std::vector<char> changed(sites.size(), 1);
        for (std::size_t i = 0; i < common; ++i)
            changed[i] = !(*sites[i] == kept_[i]);
        matrix_.conservativeResize(3 * sites.size(), 3 * sites.size());
        nodes_.gather(sites);
        Eigen::MatrixXd response(3 * nodes_.count(), 3); // displacement of the loaded nodes under contact j
        kept_.resize(sites.size());
        for (std::size_t j = 0; j < sites.size(); ++j) {
            if (!changed[j])
                continue;
            kept_[j] = *sites[j];
            respond(*sites[j], response);
            for (std::size_t i = 0; i < sites.size(); ++i) {
                if (changed[i] && i > j)
                    continue;
                const Eigen::Matrix3d block = sites[i]->axes.transpose() * seen(*sites[i], response);
                matrix_.block<3, 3>(3 * j, 3 * i) = block.transpose();
                matrix_.block<3, 3>(3 * i, 3 * j) = block;
            }
        }
        return matrix_;
    }
    const Eigen::MatrixXd& condense(const std::vector<ContactSite>& sites) { return condense(listed(sites)); }

    // The next matrix is computed as a whole, in the order in which a new one would be.
    void forget() {
        nodes_.forget();
        kept_.clear();
    }

    LoadedNodes& nodes() { return nodes_; }

private:
    // Columns: C B_j Q_j. A flat patch needs its nodes' columns only once for all three axes.
    void respond(const ContactSite& site, Eigen::MatrixXd& response) const {
        response.setZero();
        for (std::size_t b = 0; b < site.patch.nodes.size(); ++b) {
            const int slot = nodes_.slot(site.patch.nodes[b]);
            if (slot < 0)
                continue;
            const auto columns = nodes_.compliance().middleCols<3>(3 * slot);
            if (site.patch.is_flat())
                response += site.patch.weights[b] * columns;
            else
                response.noalias() += columns * site.patch.blocks[b];
        }
        response = response * site.axes;
    }

    // B_i^T times a displacement of the loaded nodes.
    Eigen::Matrix3d seen(const ContactSite& site, const Eigen::MatrixXd& response) const {
        Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
        for (std::size_t a = 0; a < site.patch.nodes.size(); ++a) {
            const int slot = nodes_.slot(site.patch.nodes[a]);
            if (slot < 0)
                continue;
            const auto rows = response.middleRows<3>(3 * slot);
            if (site.patch.is_flat())
                sum += site.patch.weights[a] * rows;
            else
                sum.noalias() += site.patch.blocks[a].transpose() * rows;
        }
        return sum;
    }

    LoadedNodes nodes_;
    Eigen::MatrixXd matrix_;
    std::vector<ContactSite> kept_; // that matrix_ is of
};

// B^T C B of one patch, m/N: how a load on it moves it.
inline Eigen::Matrix3d patch_compliance(const Surface& surface, const Eigen::MatrixXd& compliance,
                                        const ContactPatch& patch) {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    if (compliance.size() == 0) // a wall with inertia: no force moves it at once
        return sum;
    const std::size_t count = patch.nodes.size();
    for (std::size_t b = 0; b < count; ++b) {
        const int column = surface.loose[patch.nodes[b]];
        if (column == Surface::fixed)
            continue;
        Eigen::Matrix3d seen = Eigen::Matrix3d::Zero(); // B^T C, the columns of node b
        for (std::size_t a = 0; a < count; ++a) {
            const int row = surface.loose[patch.nodes[a]];
            if (row == Surface::fixed)
                continue;
            const auto block = compliance.block<3, 3>(3 * row, 3 * column);
            if (patch.is_flat())
                seen += patch.weights[a] * block;
            else
                seen.noalias() += patch.blocks[a].transpose() * block;
        }
        if (patch.is_flat())
            sum += patch.weights[b] * seen;
        else
            sum.noalias() += seen * patch.blocks[b];
    }
    return sum;
}

// G_ii of one contact alone, m/N.
inline Eigen::Matrix3d own_compliance(const Surface& surface, const Eigen::MatrixXd& compliance,
                                      const ContactSite& site) {
    return site.axes.transpose() * patch_compliance(surface, compliance, site.patch) * site.axes;
}

// Forces on the surface's nodes, N, one column a node, from the forces q on the grains.
inline Positions nodal_forces(const Surface& surface, const Sites& sites, const Eigen::VectorXd& forces) {
    Positions out = Positions::Zero(3, surface.node_count());
    for (std::size_t i = 0; i < sites.size(); ++i)
        spread(sites[i]->patch, -sites[i]->axes * forces.segment<3>(3 * i),
               [&](int node, const Point& part) { out.col(node) += part; });
    return out;
}
inline Positions nodal_forces(const Surface& surface, const std::vector<ContactSite>& sites,
                              const Eigen::VectorXd& forces) {
    return nodal_forces(surface, listed(sites), forces);
}

// Displacements of the surface's nodes, m, under forces on them. Fixed nodes stay.
inline Positions displacements(const Surface& surface, const Eigen::MatrixXd& compliance,
                               const Positions& forces) {
    Eigen::VectorXd displacement = Eigen::VectorXd::Zero(compliance.rows());
    for (int node = 0; node < surface.node_count(); ++node) {
        const int loose = surface.loose[node];
        if (loose != Surface::fixed && forces.col(node) != Point::Zero())
            displacement.noalias() += compliance.middleCols<3>(3 * loose) * forces.col(node);
    }
    Positions out = Positions::Zero(3, surface.node_count());
    for (int node = 0; node < surface.node_count(); ++node)
        if (surface.loose[node] != Surface::fixed)
            out.col(node) = displacement.segment<3>(3 * surface.loose[node]);
    return out;
}

} // namespace grainfall::femlink
