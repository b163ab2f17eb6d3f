// SPDX-License-Identifier: GPL-2.0-or-later
// Many contacts on few nodes: the same forces as contact by contact, in far fewer iterations.
#include "femlink_flat_wall.hpp"

#include <femlink/core/law_contact.hpp>
#include <femlink/core/wall_solver.hpp>

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace {

using namespace grainfall::femlink;

constexpr double h = 0.01, depth = 1e-5; // m

// Grains scattered over a wall, some pressed in ten times deeper than others, the most of them sliding.
struct Bed {
    FlatWall wall;
    std::vector<ContactSite> sites;
    std::vector<Eigen::Matrix3d> own;
    std::vector<LawContact> contacts;
    std::mt19937 random{5};

    double between_ones() { return std::uniform_real_distribution<double>(-1, 1)(random); }

    // `ratio`: stiffness of a contact times its own compliance.
    Bed(int cells, int count, double ratio) : wall(cells, h) {
        const double half = 0.5 * cells * h;
        for (int i = 0; i < count; ++i) {
            const double x = half * between_ones(), y = half * between_ones();
            sites.push_back(wall.site(x, y, 1.25 * h));
            own.push_back(own_compliance(wall.surface, wall.compliance, sites.back()));
            LawContact contact;
            contact.relation.coefficient = ratio / own[0](0, 0) / std::sqrt(depth);
            contact.free_overlap = depth * (1 + 0.9 * between_ones());
            contact.shear_coefficient = 0.8 * contact.relation.coefficient;
            contact.friction = 0.5;
            contact.shift = {depth * between_ones(), depth * between_ones()};
            contacts.push_back(contact);
        }
    }

    // As grains that move on: overlaps by a percent, shear by as much.
    void move() {
        for (LawContact& contact : contacts) {
            contact.free_overlap += 0.01 * depth * between_ones();
            contact.shift[0] += 0.01 * depth * between_ones();
        }
    }
};

constexpr double ratios[] = {1e-3, 1., 1e3, 1e6};

// How far each contact's own answer to the wall under all forces is from its force, over the forces.
double unrest(const Bed& bed, const Eigen::VectorXd& forces) {
    const Positions moved = displacements(bed.wall.surface, bed.wall.compliance,
                                          nodal_forces(bed.wall.surface, bed.sites, forces));
    double sum = 0;
    for (std::size_t i = 0; i < bed.sites.size(); ++i) {
        const Eigen::Vector3d force = forces.segment<3>(3 * static_cast<Eigen::Index>(i));
        const Eigen::Vector3d yielded = -seen_displacement(bed.sites[i], moved);
        sum += (contact_force(bed.contacts[i], bed.own[i], yielded, force) - force).squaredNorm();
    }
    return std::sqrt(sum) / forces.norm();
}

TEST(NodeSolver, finds_the_forces_that_contact_by_contact_finds_for_any_stiffness) {
    for (const double ratio : ratios) {
        Bed bed(4, 20, ratio); // on 25 nodes
        LoadedCompliance loaded(bed.wall.surface, bed.wall.compliance);
        loaded.nodes().gather(listed(bed.sites));
        NodeSolver solver(loaded.nodes());
        Eigen::VectorXd together = Eigen::VectorXd::Zero(60), one_by_one = together;
        EXPECT_TRUE(solver.solve(listed(bed.sites), bed.own, bed.contacts, together, {1e-10, 1000}).converged)
            << ratio;
        solve_contacts(loaded.condense(bed.sites), bed.contacts, one_by_one, {1e-11, 50000});
        // Sweeps that hardly change anything may be a hundred changes from the end.
        EXPECT_LT((together - one_by_one).norm(), 1e-8 * one_by_one.norm()) << ratio;
    }
}

TEST(NodeSolver, with_any_number_of_contacts_each_answers_with_its_force) {
    for (const int count : {30, 80}) { // on 25 nodes
        for (const double ratio : ratios) {
            Bed bed(4, count, ratio);
            LoadedCompliance loaded(bed.wall.surface, bed.wall.compliance);
            loaded.nodes().gather(listed(bed.sites));
            NodeSolver solver(loaded.nodes());
            Eigen::VectorXd forces = Eigen::VectorXd::Zero(3 * count);
            EXPECT_TRUE(
                solver.solve(listed(bed.sites), bed.own, bed.contacts, forces, {1e-10, 1000}).converged)
                << count << " contacts, K C " << ratio;
            EXPECT_LT(unrest(bed, forces), 1e-8) << count << " contacts, K C " << ratio;
        }
    }
}

TEST(NodeSolver, follows_moving_grains_in_a_tenth_of_the_sweeps_where_contacts_outnumber_nodes) {
    Bed bed(4, 100, 1e3);
    LoadedCompliance loaded(bed.wall.surface, bed.wall.compliance);
    loaded.nodes().gather(listed(bed.sites));
    NodeSolver solver(loaded.nodes());
    const Eigen::MatrixXd compliance = loaded.condense(bed.sites);
    Eigen::VectorXd forces = Eigen::VectorXd::Zero(300);
    solver.solve(listed(bed.sites), bed.own, bed.contacts, forces, {1e-10, 1000});
    int iterations = 0, sweeps = 0;
    for (int step = 0; step < 6; ++step) {
        bed.move();
        Eigen::VectorXd one_by_one = forces;
        sweeps += solve_contacts(compliance, bed.contacts, one_by_one, {1e-6, 20000}).sweeps;
        const SolverReport report =
            solver.solve(listed(bed.sites), bed.own, bed.contacts, forces, {1e-6, 1000});
        EXPECT_TRUE(report.converged);
        iterations += report.sweeps;
    }
    EXPECT_LT(10 * iterations, sweeps);
}

TEST(NodeSolver, all_contacts_may_be_lost_and_come_back) {
    Bed bed(4, 120, 1e3);
    LoadedCompliance loaded(bed.wall.surface, bed.wall.compliance);
    loaded.nodes().gather(listed(bed.sites));
    NodeSolver solver(loaded.nodes());
    Eigen::VectorXd pressed = Eigen::VectorXd::Zero(360);
    solver.solve(listed(bed.sites), bed.own, bed.contacts, pressed, {1e-10, 1000});
    std::vector<LawContact> lifted = bed.contacts;
    for (LawContact& contact : lifted)
        contact.free_overlap -= 3 * depth;
    Eigen::VectorXd forces = pressed;
    EXPECT_TRUE(solver.solve(listed(bed.sites), bed.own, lifted, forces, {1e-10, 1000}).converged);
    EXPECT_LT(forces.norm(), 1e-12 * pressed.norm()); // rounding of forces that go to zero
    EXPECT_TRUE(solver.solve(listed(bed.sites), bed.own, bed.contacts, forces, {1e-10, 1000}).converged);
    EXPECT_LT((forces - pressed).norm(), 1e-8 * pressed.norm());
}

// A contact's place is taken by another at the other end of the wall; the factor still has the old one.
TEST(NodeSolver, contacts_may_change_places_between_solutions) {
    Bed bed(4, 40, 10), other(4, 40, 10);
    std::swap(bed.sites.front(), bed.sites.back());
    std::swap(bed.own.front(), bed.own.back());
    LoadedCompliance loaded(bed.wall.surface, bed.wall.compliance);
    loaded.nodes().gather(listed(bed.sites));
    NodeSolver solver(loaded.nodes());
    Eigen::VectorXd forces = Eigen::VectorXd::Zero(120), expected;
    solver.solve(listed(other.sites), other.own, other.contacts, forces, {1e-10, 1000});
    EXPECT_TRUE(solver.solve(listed(bed.sites), bed.own, bed.contacts, forces, {1e-10, 1000}).converged);
    solve_contacts(loaded.condense(bed.sites), bed.contacts, expected, {1e-11, 50000});
    EXPECT_LT((forces - expected).norm(), 1e-8 * expected.norm());
}

TEST(NodeSolver, contacts_on_fixed_nodes_meet_a_rigid_wall) {
    Bed bed(4, 120, 10);
    for (int node = 0; node < 5; ++node) // one edge; the compliance keeps its rows, which no contact sees
        bed.wall.surface.loose[static_cast<std::size_t>(node)] = Surface::fixed;
    for (std::size_t i = 0; i < bed.sites.size(); ++i)
        bed.own[i] = own_compliance(bed.wall.surface, bed.wall.compliance, bed.sites[i]);
    const FaceNodes<1> corner = bed.wall.surface.face<1>(0, bed.wall.surface.nodes);
    bed.sites[0] = bed.wall.site(0.5 * (corner(0, 0) + corner(0, 1)), corner(1, 0), 0);
    bed.own[0] = own_compliance(bed.wall.surface, bed.wall.compliance, bed.sites[0]);
    ASSERT_EQ(bed.own[0].norm(), 0);
    bed.contacts[0].free_overlap = depth;
    LoadedCompliance loaded(bed.wall.surface, bed.wall.compliance);
    loaded.nodes().gather(listed(bed.sites));
    NodeSolver solver(loaded.nodes());
    Eigen::VectorXd forces = Eigen::VectorXd::Zero(360);
    EXPECT_TRUE(solver.solve(listed(bed.sites), bed.own, bed.contacts, forces, {1e-10, 1000}).converged);
    EXPECT_NEAR(forces[0] / bed.contacts[0].relation.force(depth), 1, 1e-12);
}

} // namespace
