// SPDX-License-Identifier: GPL-2.0-or-later
#include "femlink_flat_wall.hpp"

#include <femlink/core/staggered.hpp>

#include <gtest/gtest.h>

#include <random>
#include <stdexcept>
#include <string>

namespace {

using namespace grainfall::femlink;

constexpr double h = 0.01; // m, face
constexpr double overlap = 1e-5;

template <class Relation>
std::vector<WallContact<Relation>> pressed(int count, const Relation& relation, double depth = overlap) {
    std::vector<WallContact<Relation>> contacts(count, WallContact<Relation>{relation});
    for (auto& contact : contacts)
        contact.free_overlap = depth;
    return contacts;
}

Eigen::MatrixXd one_contact(double compliance) {
    Eigen::MatrixXd wall = Eigen::Matrix3d::Identity();
    return compliance * wall;
}

// Series of two springs: p = o / (1/K + C).
TEST(ContactSolver, one_linear_contact_is_exact_for_any_stiffness_ratio) {
    for (double ratio = 1e-3; ratio < 2e6; ratio *= 10) {
        constexpr double compliance = 1e-6;
        Eigen::VectorXd forces;
        const SolverReport report =
            solve_contacts(one_contact(compliance), pressed(1, LinearContact{ratio / compliance}), forces);
        EXPECT_TRUE(report.converged);
        EXPECT_LE(report.sweeps, 2);
        EXPECT_NEAR(forces[0] / (overlap / (compliance / ratio + compliance)), 1, 1e-12) << ratio;
    }
}

// p = k d^(3/2) with d + C p = o, checked by putting it in: no formula for p is used.
TEST(ContactSolver, one_hertz_contact_satisfies_its_law_on_the_wall_that_gave_way) {
    for (double coefficient = 1e3; coefficient < 1e16; coefficient *= 10) {
        constexpr double compliance = 1e-6;
        Eigen::VectorXd forces;
        solve_contacts(one_contact(compliance), pressed(1, HertzContact{coefficient}), forces);
        const double left = std::pow(forces[0] / coefficient, 2. / 3);
        EXPECT_NEAR((left + compliance * forces[0]) / overlap, 1, 1e-13) << coefficient;
    }
}

TEST(ContactSolver, a_separated_contact_carries_nothing) {
    Eigen::VectorXd forces = Eigen::VectorXd::Constant(3, 5.0);
    auto contacts = pressed(1, LinearContact{1e6}, -overlap);
    contacts[0].friction = 0.5;
    contacts[0].shear_stiffness = 1e6;
    solve_contacts(one_contact(1e-6), contacts, forces);
    EXPECT_EQ(forces.norm(), 0);
}

TEST(ContactSolver, a_contact_on_fixed_nodes_is_a_contact_with_a_rigid_wall) {
    Eigen::VectorXd forces;
    solve_contacts(one_contact(0), pressed(1, HertzContact{1e9}), forces);
    EXPECT_NEAR(forces[0], 1e9 * std::pow(overlap, 1.5), 1e-12);
}

std::vector<ContactSite> scattered(const FlatWall& wall, int count, double half) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> place(-half, half);
    std::vector<ContactSite> sites;
    for (int i = 0; i < count; ++i)
        sites.push_back(wall.site(place(random), place(random), 1.25 * h));
    return sites;
}

// The law evaluated on the wall that the forces themselves produce gives these forces.
template <class Relation>
double mismatch(const Eigen::MatrixXd& wall, const std::vector<WallContact<Relation>>& contacts,
                const Eigen::VectorXd& forces) {
    const Eigen::VectorXd yielded = wall * forces;
    double worst = 0;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
        const double left = contacts[i].free_overlap - yielded[3 * i];
        const double force = left > 0 ? contacts[i].relation.force(left) : 0;
        worst = std::max(worst, std::abs(force - forces[3 * i]));
    }
    return worst / forces.cwiseAbs().maxCoeff();
}

TEST(ContactSolver, many_contacts_agree_with_the_dense_solution_from_stiffness_ratio_1e_minus_3_to_1e3) {
    const FlatWall wall(12, h);
    LoadedCompliance loaded(wall.surface, wall.compliance);
    const Eigen::MatrixXd compliance = loaded.condense(scattered(wall, 40, 0.04));
    for (const double ratio : {1e-3, 1., 1e3}) {
        const double stiffness = ratio / compliance(0, 0);
        auto contacts = pressed(40, LinearContact{stiffness});
        // Overlaps of a rigid stamp that all contacts can hold: none comes loose, so the problem is linear.
        Eigen::VectorXd given = Eigen::VectorXd::Zero(120);
        for (int i = 0; i < 40; ++i)
            given[3 * i] = 1 + 0.1 * std::sin(i);
        const Eigen::VectorXd depths = compliance * given + given / stiffness;
        for (int i = 0; i < 40; ++i)
            contacts[i].free_overlap = depths[3 * i];
        Eigen::VectorXd forces;
        const SolverReport report = solve_contacts(compliance, contacts, forces, {1e-12, 100000});
        EXPECT_TRUE(report.converged) << ratio;
        EXPECT_LT((forces - given).norm() / given.norm(), 1e-6)
            << ratio << ": " << report.sweeps << " sweeps";
    }
}

TEST(ContactSolver, converges_with_more_contacts_than_the_surface_has_degrees_of_freedom) {
    const FlatWall wall(4, h); // 75 degrees of freedom
    LoadedCompliance loaded(wall.surface, wall.compliance);
    const Eigen::MatrixXd compliance = loaded.condense(scattered(wall, 120, 0.019));
    for (const double ratio : {1e-3, 1., 1e3, 1e6}) {
        auto contacts = pressed(120, HertzContact{ratio / compliance(0, 0) / std::sqrt(overlap)});
        for (int i = 0; i < 120; ++i)
            contacts[i].free_overlap = overlap * (1 + 0.3 * std::cos(1.7 * i));
        Eigen::VectorXd forces;
        const SolverReport report = solve_contacts(compliance, contacts, forces);
        EXPECT_TRUE(report.converged) << ratio << ": " << report.change;
        // At 1e6 the overlap left over is a millionth of the free one, and its rounding multiplies in the
        // law.
        EXPECT_LT(mismatch(compliance, contacts, forces), ratio < 1e5 ? 1e-6 : 1e-3) << ratio;
        EXPECT_GE(forces.minCoeff(), 0);
    }
}

TEST(ContactSolver, does_not_depend_on_the_forces_it_starts_from) {
    const FlatWall wall(8, h);
    LoadedCompliance loaded(wall.surface, wall.compliance);
    const Eigen::MatrixXd compliance = loaded.condense(scattered(wall, 20, 0.03));
    auto contacts = pressed(20, HertzContact{3e8});
    for (auto& contact : contacts) {
        contact.friction = 0.3;
        contact.shear_stiffness = 1e6;
        contact.free_shear = {3e-6, -1e-6};
    }
    Eigen::VectorXd cold, warm = Eigen::VectorXd::Constant(60, 10.0);
    solve_contacts(compliance, contacts, cold, {1e-13, 10000});
    const SolverReport report = solve_contacts(compliance, contacts, warm, {1e-13, 10000});
    EXPECT_TRUE(report.converged);
    EXPECT_LT((cold - warm).norm(), 1e-10 * cold.norm());
    EXPECT_LE(solve_contacts(compliance, contacts, warm, {1e-10, 10000}).sweeps, 2);
}

// Shear: two springs in series until friction cuts the force.
TEST(ContactFriction, sticks_as_springs_in_series_and_slides_at_mu_times_the_normal_force) {
    constexpr double compliance = 1e-6, stiffness = 2e6, mu = 0.4;
    for (const double stretch : {1e-7, 1e-6, 1e-4}) {
        auto contacts = pressed(1, LinearContact{1e6});
        contacts[0].friction = mu;
        contacts[0].shear_stiffness = stiffness;
        contacts[0].free_shear = {0.6 * stretch, 0.8 * stretch};
        Eigen::VectorXd forces;
        solve_contacts(one_contact(compliance), contacts, forces);
        const double sticking = stretch / (1 / stiffness + compliance);
        const Eigen::Vector2d shear = forces.tail<2>();
        EXPECT_NEAR(shear.norm(), std::min(sticking, mu * forces[0]), 1e-12);
        EXPECT_NEAR(shear[0] / shear.norm(), 0.6, 1e-12);
    }
}

// On a wall that gives way differently along its two tangents the slip, not the stretch, is along the force.
TEST(ContactFriction, sliding_slips_along_the_shear_force) {
    Eigen::Matrix2d wall;
    wall << 3e-6, 1e-6, 1e-6, 8e-7;
    constexpr double stiffness = 2e6, limit = 1.5;
    const Eigen::Vector2d stretch(4e-5, -3e-5);
    const Eigen::Vector2d shear = capped_shear(wall, stiffness, stretch, limit);
    EXPECT_NEAR(shear.norm(), limit, 1e-13);
    const Eigen::Vector2d slip = stretch - wall * shear - shear / stiffness;
    EXPECT_NEAR(slip[0] * shear[1] - slip[1] * shear[0], 0, 1e-12 * slip.norm() * limit);
    EXPECT_GT(slip.dot(shear), 0);
}

// Cattaneo's and Mindlin's result for any elastic bodies whose shear response is proportional to their normal
// one does not hold for discrete grains; what must hold is that total shear is bounded and reached when all
// slide.
TEST(ContactFriction, of_many_contacts_reaches_mu_times_the_load_when_all_slide) {
    const FlatWall wall(10, h);
    LoadedCompliance loaded(wall.surface, wall.compliance);
    const Eigen::MatrixXd compliance = loaded.condense(scattered(wall, 30, 0.04));
    auto contacts = pressed(30, HertzContact{3e8});
    for (auto& contact : contacts) {
        contact.friction = 0.5;
        contact.shear_stiffness = 1e6;
        contact.free_shear = {1e-3, 0};
    }
    Eigen::VectorXd forces;
    const SolverReport report = solve_contacts(compliance, contacts, forces, {1e-12, 10000});
    EXPECT_TRUE(report.converged);
    double normal = 0;
    Eigen::Vector2d shear = Eigen::Vector2d::Zero();
    for (int i = 0; i < 30; ++i) {
        normal += forces[3 * i];
        shear += forces.segment<2>(3 * i + 1);
        EXPECT_LE(forces.segment<2>(3 * i + 1).norm(), 0.5 * forces[3 * i] * (1 + 1e-12));
    }
    EXPECT_NEAR(shear.norm() / normal, 0.5, 1e-5); // directions differ by what the wall's own shear adds
}

TEST(Staggered, has_the_gain_stiffness_times_compliance_for_one_contact) {
    for (const double ratio : {0.5, 0.99, 7.0})
        EXPECT_NEAR(staggered_gain(one_contact(2e-7), pressed(1, LinearContact{ratio / 2e-7})), ratio, 1e-9);
}

TEST(Staggered, agrees_with_the_implicit_solution_below_its_limit_in_ever_more_exchanges) {
    int before = 0;
    for (const double ratio : {0.1, 0.5, 0.9, 0.99}) {
        auto contacts = pressed(1, LinearContact{ratio / 1e-6});
        Eigen::VectorXd exchanged, implicit;
        const SolverReport report = solve_staggered(one_contact(1e-6), contacts, exchanged);
        solve_contacts(one_contact(1e-6), contacts, implicit);
        EXPECT_TRUE(report.converged);
        EXPECT_NEAR(exchanged[0] / implicit[0], 1, 1e-7);
        EXPECT_GT(report.sweeps, before);
        before = report.sweeps;
    }
}

TEST(Staggered, refuses_in_one_sentence_where_it_would_diverge) {
    const auto contacts = pressed(1, LinearContact{2e6});
    Eigen::VectorXd forces;
    try {
        solve_staggered(one_contact(1e-6), contacts, forces);
        FAIL() << "nothing was thrown";
    } catch (const std::invalid_argument& error) {
        EXPECT_EQ(std::string(error.what()),
                  "coupling = 'staggered': must be 'implicit' here: particle stiffness times wall compliance "
                  "is 2, and "
                  "exchanging forces step by step diverges from 1 on, whatever the time step");
    }
    // What it refuses does diverge: each exchange is farther off than the one before.
    double force = 0, distance = 0;
    for (int i = 0; i < 8; ++i) {
        force = 2e6 * (overlap - 1e-6 * force);
        const double now = std::abs(force - 2e6 * overlap / 3);
        EXPECT_GT(now, distance);
        distance = now;
    }
}

// Together contacts load the wall more: the limit falls with their number.
TEST(Staggered, limit_falls_with_the_number_of_contacts) {
    const FlatWall wall(12, h);
    double before = 0;
    for (const int count : {1, 10, 100}) {
        LoadedCompliance loaded(wall.surface, wall.compliance);
        const Eigen::MatrixXd compliance = loaded.condense(scattered(wall, count, 0.05));
        const double gain = staggered_gain(compliance, pressed(count, LinearContact{1 / compliance(0, 0)}));
        EXPECT_GT(gain, 1.5 * before);
        before = gain;
    }
}

} // namespace
