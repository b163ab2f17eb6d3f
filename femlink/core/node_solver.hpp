// SPDX-License-Identifier: GPL-2.0-or-later
// The contacts of contact_solver.hpp where there are many on few nodes. With S the inverse of the compliance
// C of the loaded nodes, B_i and Q_i the patch and axes of contact i, K_i its stiffness (3 x 3) and D_i its
// own compliance, one iteration is
//
//   r_i = what the contact answers to the wall's yielding (contact_force) less q_i        each by itself
//   t = (1 + K D) r,   (S + sum_i B_i Q_i K_i Q_i^T B_i^T) x = B Q t,   q += t - K Q^T B^T x
//
// which is Newton's step of r = 0: t is what the forces would change by if each contact alone made the wall
// yield, x by how much more it yields, the rest follows from Woodbury's identity. The matrix has the size of
// the nodes, not of the contacts, and K may be that of some steps ago: a contact that is soft or stiff beside
// the wall (K D << 1 or >> 1) answers nearly alike whatever its K. So one factor serves many steps, while
// Anderson's mixing (mixing.hpp) makes up for what has changed since. It is computed anew when a solution, or
// what solutions took more than the first with it, has cost as much.
#pragma once

#include <femlink/core/compliance.hpp>
#include <femlink/core/contact_solver.hpp>
#include <femlink/core/dense.hpp>
#include <femlink/core/mixing.hpp>

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace grainfall::femlink {

// K of a contact in its axes, N/m: of `force`, which it answered to `yielded` and `before` (contact_force).
template <class Contact>
Eigen::Matrix3d contact_stiffness(const Contact& contact, const Eigen::Matrix3d& own,
                                  const Eigen::Vector3d& yielded, const Eigen::Vector3d& before,
                                  const Eigen::Vector3d& force) {
    Eigen::Matrix3d stiffness = Eigen::Matrix3d::Zero();
    const Eigen::Vector3d there = yielded + own * (force - before);
    const double overlap = contact.free_overlap - there[0];
    if (!(force[0] > 0) || !(overlap > 0) || !(own(0, 0) > 0))
        return stiffness;
    // Infinite where a dashpot starts. Beyond this it no longer matters, even of many contacts on one node,
    // and single precision would lose the wall beside it.
    const double enough = 1e6 / own(0, 0);
    stiffness(0, 0) = std::clamp(contact.relation.stiffness(overlap), 0.0, enough);
    const double limit = contact.shear_limit(force[0]);
    if (!(limit > 0))
        return stiffness;
    constexpr double little = 1e-6; // for differences
    const ShearSpring spring = contact.shear_spring(overlap);
    const Eigen::Vector2d stretch = spring.stretch - there.tail<2>(), shear = force.tail<2>();
    if (shear.norm() < limit * (1 - 1e-12)) {
        stiffness(1, 1) = stiffness(2, 2) = std::min(spring.stiffness, enough);
        const ShearSpring deeper = contact.shear_spring((1 + little) * overlap);
        const Eigen::Vector2d there_deeper = deeper.stiffness * (deeper.stretch - there.tail<2>());
        stiffness.block<2, 1>(1, 0) = (there_deeper - spring.stiffness * stretch) / (little * overlap);
        return stiffness;
    }
    const Eigen::Vector2d slip = shear.normalized();
    const double across = std::min(limit / stretch.norm(), spring.stiffness);
    stiffness.bottomRightCorner<2, 2>() = across * (Eigen::Matrix2d::Identity() - slip * slip.transpose());
    const double mu = (contact.shear_limit((1 + little) * force[0]) - limit) / (little * force[0]);
    stiffness.block<2, 1>(1, 0) = mu * stiffness(0, 0) * slip;
    return stiffness;
}

class NodeSolver {
public:
    explicit NodeSolver(const LoadedNodes& nodes) : nodes_(nodes) {}

    // The nodes are those gathered for these sites. `own`: D of each contact, m/N. `forces` as in
    // solve_contacts. Not converged: `forces` are of no use.
    template <class Contact>
    SolverReport solve(const Sites& sites, const std::vector<Eigen::Matrix3d>& own,
                       const std::vector<Contact>& contacts, Eigen::VectorXd& forces,
                       const SolverOptions& options) {
        lay_out(sites);
        is_yielded_ = false;
        SolverReport report;
        if (rigidity_.rows() != nodes_.compliance().rows())
            return report; // C is singular
        const int count = static_cast<int>(sites.size());
        const int patience = static_cast<int>(std::clamp(price_of_factor(), 1.0, 20.0));
        Eigen::VectorXd answers(3 * count), before;
        double off_before = std::numeric_limits<double>::infinity();
        int halvings = 0;
        mixing_.forget();
        for (int since_factor = 0; report.sweeps <= std::min(options.max_sweeps, most_iterations);) {
            yield(forces, options.tolerance);
            for (int i = 0; i < count; ++i)
                answers.segment<3>(3 * i) =
                    contact_force<Contact>(contacts[i], own[i], seen(i, yielded_), forces.segment<3>(3 * i));
            if (report.converged) { // what is left between them and the forces goes to the contacts' side
                forces = answers;
                break;
            }
            const double off = (answers - forces).norm();
            ++report.sweeps;
            // Forces that are no better than none are a worse start than none.
            const bool is_lost = report.sweeps == 1 ? off > 0.5 * forces.norm() : report.sweeps == lost_after;
            if (is_lost && !forces.isZero(0)) {
                forces.setZero();
                off_before = std::numeric_limits<double>::infinity();
                since_factor = halvings = 0;
                is_stale_ = true;
                mixing_.forget();
                continue;
            }
            if (!(off < 2 * off_before) && halvings < 5) {
                ++halvings;
                changes_ *= 0.5;
                forces = before + changes_;
                mixing_.forget(); // contacts have opened or closed
                since_factor = 1;
                continue;
            }
            halvings = 0;
            if (is_stale_ || (report.sweeps > patience && since_factor > 0)) {
                for (int i = 0; i < count; ++i)
                    stiffness_[i] =
                        contact_stiffness<Contact>(contacts[i], own[i], seen(i, yielded_),
                                                   forces.segment<3>(3 * i), answers.segment<3>(3 * i));
                factorise();
                mixing_.forget();
                since_factor = 0;
            }
            ++since_factor;
            off_before = off;
            before = forces;
            find_changes(own, answers - forces);
            mixing_.improve(forces, changes_);
            forces += changes_;
            double largest = 0;
            for (int i = 0; i < count; ++i)
                largest = std::max(largest, forces[3 * i]);
            const double change = changes_.cwiseAbs().maxCoeff();
            report.change = largest > 0 ? change / largest : change;
            report.converged = change <= options.tolerance * largest;
            if (!std::isfinite(change))
                break;
        }
        keep_or_not(report);
        return report;
    }

private:
    // Iterations until a new start, and in all.
    static constexpr int lost_after = 40, most_iterations = 100;

    // A contact's part of the weights, as arrays.
    struct Span {
        int begin, end;
        const ContactSite* site;
    };

    void lay_out(const Sites& sites) {
        spans_.clear();
        slots_.clear();
        which_.clear();
        weights_.clear();
        for (const ContactSite* site : sites) {
            const int begin = static_cast<int>(slots_.size());
            for (std::size_t a = 0; a < site->patch.nodes.size(); ++a) {
                const int slot = nodes_.slot(site->patch.nodes[a]);
                if (slot < 0)
                    continue;
                slots_.push_back(slot);
                weights_.push_back(site->patch.weights[a]);
                which_.push_back(static_cast<int>(a));
            }
            spans_.push_back({begin, static_cast<int>(slots_.size()), site});
        }
        if (version_ != nodes_.version()) {
            version_ = nodes_.version();
            rigidity_ = dense::inverse(nodes_.compliance());
            single_compliance_ = nodes_.compliance().cast<float>();
            is_stale_ = true;
        }
        // A contact in the place of another has no part in the factor.
        first_nodes_.resize(sites.size());
        stiffness_.resize(sites.size(), Eigen::Matrix3d::Zero());
        for (std::size_t i = 0; i < sites.size(); ++i) {
            const int first = sites[i]->patch.nodes.empty() ? -1 : sites[i]->patch.nodes.front();
            if (first != first_nodes_[i])
                stiffness_[i].setZero();
            first_nodes_[i] = first;
        }
    }

    // Q^T B^T of a displacement of the loaded nodes.
    Eigen::Vector3d seen(int i, const Eigen::VectorXd& displacement) const {
        const Span& span = spans_[i];
        Point sum = Point::Zero();
        if (span.site->patch.is_flat())
            for (int k = span.begin; k < span.end; ++k)
                sum += weights_[k] * displacement.segment<3>(3 * slots_[k]);
        else
            for (int k = span.begin; k < span.end; ++k)
                sum +=
                    span.site->patch.blocks[which_[k]].transpose() * displacement.segment<3>(3 * slots_[k]);
        return span.site->axes.transpose() * sum;
    }

    // B Q q, added.
    void press(int i, const Eigen::Vector3d& force, Eigen::VectorXd& nodes) const {
        const Span& span = spans_[i];
        const Point push = span.site->axes * force;
        if (span.site->patch.is_flat())
            for (int k = span.begin; k < span.end; ++k)
                nodes.segment<3>(3 * slots_[k]) += weights_[k] * push;
        else
            for (int k = span.begin; k < span.end; ++k)
                nodes.segment<3>(3 * slots_[k]) += span.site->patch.blocks[which_[k]] * push;
    }

    // C B Q q. What has changed little since the last time is added in single precision.
    void yield(const Eigen::VectorXd& forces, double tolerance) {
        constexpr double rounding = 1e-7, negligible = 1e-4; // of single precision; of the tolerance
        const Eigen::Index size = nodes_.compliance().rows();
        load_.setZero(size);
        if (is_yielded_) {
            moves_ = forces - yielded_to_;
            is_yielded_ = rounding * moves_.norm() <= negligible * tolerance * forces.norm();
        }
        const Eigen::VectorXd& by = is_yielded_ ? moves_ : forces;
        for (std::size_t i = 0; i < spans_.size(); ++i)
            press(static_cast<int>(i), by.segment<3>(3 * i), load_);
        if (is_yielded_) {
            const double scale = load_.lpNorm<Eigen::Infinity>();
            if (scale > 0) {
                single_load_ = (load_ / scale).cast<float>();
                dense::multiply(single_compliance_, single_load_, single_yielded_);
                yielded_ += scale * single_yielded_.cast<double>();
            }
        } else {
            dense::multiply(nodes_.compliance(), load_, yielded_);
        }
        yielded_to_ = forces;
        is_yielded_ = true;
    }

    void factorise() {
        Eigen::MatrixXd stiffness = rigidity_;
        for (std::size_t i = 0; i < spans_.size(); ++i) {
            const Span& span = spans_[i];
            const Eigen::Matrix3d turned = span.site->axes * stiffness_[i] * span.site->axes.transpose();
            if (turned.isZero(0))
                continue;
            // On a patch that is not flat B has couples besides the weights, which matter little here.
            for (int b = span.begin; b < span.end; ++b) {
                const Eigen::Matrix3d weighed = weights_[b] * turned;
                for (int a = span.begin; a < span.end; ++a)
                    stiffness.block<3, 3>(3 * slots_[a], 3 * slots_[b]) += weights_[a] * weighed;
            }
        }
        factor_.compute(stiffness);
        is_stale_ = false;
        fewest_ = std::numeric_limits<int>::max();
        wasted_ = 0;
    }

    // Of the forces, N, where the contacts' answers are `off` from them.
    void find_changes(const std::vector<Eigen::Matrix3d>& own, const Eigen::VectorXd& off) {
        changes_.resize(off.size());
        load_.setZero();
        for (std::size_t i = 0; i < spans_.size(); ++i) {
            const Eigen::Vector3d by = off.segment<3>(3 * i);
            Eigen::Vector3d yields = own[i] * by;
            yields[0] = own[i](0, 0) * by[0]; // contact_force takes shear as it was when it finds p
            changes_.segment<3>(3 * i) = by + stiffness_[i] * yields;
            press(static_cast<int>(i), changes_.segment<3>(3 * i), load_);
        }
        factor_.solve_in_place(load_); // now by how much more the nodes yield
        for (std::size_t i = 0; i < spans_.size(); ++i)
            changes_.segment<3>(3 * i) -= stiffness_[i] * seen(static_cast<int>(i), load_);
    }

    // What a factor costs, in iterations, as measured.
    double price_of_factor() const {
        const double size = static_cast<double>(rigidity_.rows()),
                     entries = static_cast<double>(slots_.size());
        double pairs = 0;
        for (const Span& span : spans_)
            pairs += static_cast<double>(span.end - span.begin) * (span.end - span.begin);
        return (size * size * size / 4 + 3 * pairs) / (2 * size * size + 40 * entries);
    }

    void keep_or_not(const SolverReport& report) {
        fewest_ = std::min(fewest_, report.sweeps);
        wasted_ += report.sweeps - fewest_;
        is_stale_ = !report.converged || wasted_ > price_of_factor();
    }

    const LoadedNodes& nodes_;
    std::vector<Span> spans_;
    std::vector<int> slots_, which_; // of each weight: place among the loaded nodes, place in the patch
    std::vector<double> weights_;
    std::vector<int> first_nodes_; // of each contact's patch
    std::vector<Eigen::Matrix3d> stiffness_;
    Eigen::MatrixXd rigidity_; // S
    dense::Factor factor_;
    Mixing mixing_;
    Eigen::VectorXd load_, changes_;
    Eigen::VectorXd yielded_, yielded_to_, moves_; // of the nodes; forces that that is of; their changes
    bool is_yielded_ = false;                      // do these two hold for the contacts as they are?
    Eigen::MatrixXf single_compliance_;
    Eigen::VectorXf single_load_, single_yielded_;
    long version_ = -1; // of the nodes that S is of
    bool is_stale_ = true;
    int fewest_ = 0, wasted_ = 0; // iterations since the factor is what it is
};

} // namespace grainfall::femlink
