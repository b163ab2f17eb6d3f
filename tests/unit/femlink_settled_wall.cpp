// SPDX-License-Identifier: GPL-2.0-or-later
// A wall that grains were settled on, and its contacts between two solutions for all of them.
#include "femlink_flat_wall.hpp"

#include <femlink/core/surface_contacts.hpp>
#include <femlink/core/wall_contacts.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace {

using namespace grainfall::femlink;

constexpr double h = 0.01, radius = 0.004, overlap = 1e-5; // m
constexpr double coefficient = 1e9;                        // N/m^1.5
constexpr double patch = 1.25;                             // faces
const SolverOptions exactly{1e-12, 10000};

QuasiStaticWall made_wall() {
    FlatWall flat(8, h);
    WallModel model;
    model.surface = flat.surface;
    model.compliance = flat.compliance;
    model.preload = Positions::Zero(3, flat.surface.node_count());
    return QuasiStaticWall(std::move(model));
}

// Spheres on a row along x, all pressed in by `depth`.
struct Row {
    std::vector<WallTouch> touches;
    std::vector<Point> centres;

    Row(QuasiStaticWall& wall, double depth) {
        std::vector<int> faces(wall.surface().face_count());
        for (std::size_t i = 0; i < faces.size(); ++i)
            faces[i] = static_cast<int>(i);
        for (int i = 0; i < 5; ++i) {
            centres.emplace_back(0.012 * (i - 2) + 0.001, 0.003, radius - depth);
            WallTouch touch;
            touch.sphere = i;
            std::vector<SurfaceContact> found;
            find_surface_contacts(wall.surface(), wall.positions(), faces, {}, centres.back(), radius, found);
            touch.place = found.front();
            wall.follow(touch, patch, 0);
            touches.push_back(touch);
        }
        look(wall);
    }

    void look(const QuasiStaticWall& wall) {
        for (std::size_t i = 0; i < touches.size(); ++i)
            touches[i].free_overlap =
                wall.free_overlap(touches[i].place, touches[i].site, centres[i], radius);
    }

    std::vector<LawContact> contacts() const {
        std::vector<LawContact> out(touches.size());
        for (std::size_t i = 0; i < touches.size(); ++i) {
            out[i].relation.coefficient = coefficient;
            out[i].free_overlap = touches[i].free_overlap;
        }
        return out;
    }

    // The forces on a wall that does not give way.
    void press_rigid() {
        for (WallTouch& touch : touches)
            touch.force << coefficient * std::pow(touch.free_overlap, 1.5), 0, 0;
    }
};

TEST(SettledWall, it_lies_where_it_was_and_its_contacts_keep_their_forces) {
    QuasiStaticWall wall = made_wall();
    Row row(wall, overlap);
    row.press_rigid();
    const double force = row.touches[0].force[0];
    wall.settle_under(row.touches);
    EXPECT_GT(wall.datum().norm(), 0.1 * overlap); // it does give way under them
    EXPECT_NEAR((wall.positions() - wall.surface().nodes).norm(), 0, 1e-15);
    row.look(wall);
    wall.solve(row.touches, row.contacts(), exactly);
    for (const WallTouch& touch : row.touches)
        EXPECT_NEAR(touch.force[0] / force, 1, 1e-9);
}

// Let the spheres go: the wall comes up by what their forces had pressed it in.
TEST(SettledWall, it_comes_up_when_the_forces_that_it_settled_under_are_gone) {
    QuasiStaticWall wall = made_wall();
    Row row(wall, overlap);
    row.press_rigid();
    wall.settle_under(row.touches);
    const Positions datum = wall.datum();
    for (Point& centre : row.centres)
        centre[2] += 0.1;
    row.look(wall);
    wall.solve(row.touches, row.contacts(), exactly);
    EXPECT_NEAR((wall.positions() - wall.surface().nodes + datum).norm(), 0, 1e-15);
    EXPECT_LT(datum.row(2).minCoeff(), -0.1 * overlap);
}

// Spheres that are pressed in and then held: after as many steps as were announced each contact, solved
// alone, has the force of the solution for all, and on the way its wall never moves by more than its share in
// a step.
TEST(BetweenSolutions, contacts_go_evenly_to_the_solution_for_all) {
    QuasiStaticWall wall = made_wall();
    Row row(wall, overlap);
    const std::vector<WallTouch> before = row.touches;
    const std::vector<LawContact> contacts = row.contacts();
    wall.solve(row.touches, contacts, exactly);
    const std::vector<WallTouch> solution = row.touches;
    constexpr int steps = 20;
    for (std::size_t i = 0; i < row.touches.size(); ++i)
        wall.approach(row.touches[i], before[i], steps);
    for (int step = 0; step < steps; ++step) {
        for (std::size_t i = 0; i < row.touches.size(); ++i)
            wall.solve_alone(row.touches[i], contacts[i], exactly);
        if (step + 1 < steps) {
            EXPECT_GT(row.touches[2].force[0], solution[2].force[0]);
        }
    }
    for (std::size_t i = 0; i < row.touches.size(); ++i) {
        EXPECT_NEAR(row.touches[i].force[0] / solution[i].force[0], 1, 1e-9);
        EXPECT_NEAR(row.touches[i].seen[2] / wall.seen(solution[i].site)[2], 1, 1e-9);
    }
}

// A load that is moved to another place of a wall which does not move: nothing moves at the contact.
TEST(BetweenSolutions, a_load_that_follows_its_contact_makes_no_velocity) {
    QuasiStaticWall wall = made_wall();
    Row row(wall, overlap);
    wall.solve(row.touches, row.contacts(), exactly);
    WallTouch touch = row.touches[1];
    touch.seen = touch.seen_before = wall.seen(touch.site);
    touch.place.at[0] += 0.3;
    touch.place.foot[0] += 0.15 * h;
    ASSERT_TRUE(wall.follow(touch, patch, 0.005));
    EXPECT_NEAR((touch.seen - touch.seen_before).norm(), 0, 1e-18);
    EXPECT_NEAR((touch.seen - wall.seen(touch.site)).norm(), 0, 1e-18);
}

// A contact that only turns takes its load along: the patch stays, the axes turn, and the wall gives way to
// the load as a new patch's at that place would.
TEST(BetweenSolutions, a_load_that_turns_with_its_contact_stays_on_its_patch) {
    QuasiStaticWall wall = made_wall();
    Row row(wall, overlap);
    wall.solve(row.touches, row.contacts(), exactly);
    WallTouch touch = row.touches[1];
    touch.force = {2, 0.3, -0.1};
    const Point push = touch.site.axes * touch.force;
    const ContactPatch before = touch.site.patch;
    touch.place.normal = Point(0.01, 0.02, 1).normalized();
    EXPECT_FALSE(wall.follow(touch, patch, 0.005));
    EXPECT_EQ(touch.site.patch.nodes, before.nodes);
    EXPECT_EQ(touch.site.patch.weights, before.weights);
    EXPECT_NEAR((touch.site.axes.col(0) - touch.place.normal).norm(), 0, 1e-15);
    // Until the next solution the force is what it was, in other axes.
    EXPECT_NEAR((touch.site.axes * touch.force - push).norm(), 0, 1e-14 * push.norm());
    WallTouch anew = touch;
    wall.put_site(anew, patch);
    EXPECT_EQ(anew.own, touch.own);
    EXPECT_EQ(anew.site.axes, touch.site.axes);
}

// Liquid that holds a sphere which no longer touches.
TEST(DrawnWall, a_pull_alone_draws_the_wall_out_by_its_compliance) {
    QuasiStaticWall wall = made_wall();
    Row row(wall, overlap);
    for (Point& centre : row.centres)
        centre[2] += 2 * overlap;
    row.look(wall);
    constexpr double pull = 1e-3; // N
    row.touches[3].pull = pull;
    wall.solve(row.touches, row.contacts(), exactly);
    for (const WallTouch& touch : row.touches)
        EXPECT_EQ(touch.force, Point::Zero());
    EXPECT_NEAR(wall.seen(row.touches[3].site)[2] / (row.touches[3].own(0, 0) * pull), 1, 1e-12);
    EXPECT_NEAR(wall.nodal_forces().row(2).sum() / pull, 1, 1e-12);
}

TEST(DrawnWall, contacts_press_it_with_what_their_overlap_with_the_drawn_wall_asks_for) {
    QuasiStaticWall wall = made_wall();
    Row row(wall, overlap);
    double total = 0;
    for (WallTouch& touch : row.touches)
        touch.pull = 5 * (touch.sphere + 1); // N, as much as the contacts
    wall.solve(row.touches, row.contacts(), exactly);
    for (WallTouch& touch : row.touches) {
        touch.seen = wall.seen(touch.site);
        EXPECT_NEAR(touch.force[0] / (coefficient * std::pow(touch.overlap(), 1.5)), 1, 1e-9);
        total += touch.pull - touch.force[0];
    }
    EXPECT_NEAR(wall.nodal_forces().row(2).sum(), total, 1e-12 * std::abs(total));
}

} // namespace
