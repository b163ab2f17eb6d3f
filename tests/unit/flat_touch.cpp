// SPDX-License-Identifier: GPL-2.0-or-later
#include <engines/flat/neighbours.hpp>

#include <gtest/gtest.h>

#include <random>

namespace {

using namespace grainfall;
using namespace grainfall::flat;

std::mt19937 generator(11);

double any(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator);
}
Vector any_vector(double size) {
    return {any(-size, size), any(-size, size), any(-size, size)};
}
Eigen::Quaterniond any_turn(double angle) {
    return Eigen::Quaterniond(Eigen::AngleAxisd(angle, any_vector(1).normalized()));
}

Obstacle brick() {
    Obstacle box;
    box.kind = Partner::box;
    box.half_edges = {3, 2, 1};
    box.axes = any_turn(any(-3, 3)).toRotationMatrix();
    return box;
}

Vector on_surface(const Obstacle& box) {
    Vector local = box.half_edges.cwiseProduct(any_vector(1));
    const int axis = static_cast<int>(any(0, 3));
    local[axis] = any(-1, 1) > 0 ? box.half_edges[axis] : -box.half_edges[axis];
    return box.axes * local;
}

// A ball of radius 2 about the origin, as a solid of revolution.
const geometry::Profile ball({{-2, 0, 1}, {2, 0}});

Obstacle solid(const geometry::Profile& profile) {
    Obstacle result;
    result.kind = Partner::solid;
    result.profile = &profile;
    return result;
}

TEST(NearestPointOfABox, lies_on_its_surface_and_no_other_is_nearer_from_without_and_within) {
    int within = 0;
    for (int i = 0; i < 300; ++i) {
        const Obstacle box = brick();
        const Vector centre = any_vector(5), point = centre + box.axes * any_vector(4);
        const Nearest nearest = nearest_of_box(box, centre, point);
        const Vector foot = point - nearest.distance * nearest.normal - centre;
        const Vector reduced = (box.axes.transpose() * foot).cwiseAbs().cwiseQuotient(box.half_edges);
        EXPECT_NEAR(reduced.maxCoeff(), 1, 1e-14);
        EXPECT_NEAR(nearest.normal.norm(), 1, 1e-14);
        const bool inside =
            ((box.axes.transpose() * (point - centre)).cwiseAbs().array() < box.half_edges.array()).all();
        EXPECT_EQ(inside, nearest.distance < 0);
        within += inside;
        for (int k = 0; k < 100; ++k)
            EXPECT_LE(std::abs(nearest.distance), (point - centre - on_surface(box)).norm() + 1e-14);
    }
    EXPECT_GT(within, 10);
}

TEST(TouchOfASolidOfRevolution, that_is_a_ball_is_the_touch_of_two_spheres) {
    Obstacle round = solid(ball);
    round.axes = any_turn(1).toRotationMatrix();
    for (int i = 0; i < 100; ++i) {
        const Place at{any_vector(3), 0}, sphere{at.centre + any_vector(2), any(0.2, 1)};
        const TouchAt<double> touch = touch_of_solid(round, at, sphere);
        const Vector branch = sphere.centre - at.centre;
        const auto expected = laws::touch_of_spheres(branch, branch.norm(), 2.0, sphere.radius);
        EXPECT_LT((touch.touch.normal - expected.normal).norm(), 1e-13);
        EXPECT_NEAR(touch.touch.overlap, expected.overlap, 1e-14);
        EXPECT_NEAR(touch.touch.radius1, 2, 1e-13);
        // The middle of the overlap, from either side.
        const Vector point = sphere.centre - touch.arm2 * touch.touch.normal;
        const Vector from_ball = at.centre + (2 - 0.5 * expected.overlap) * expected.normal;
        EXPECT_LT((point - from_ball).norm(), 1e-13);
    }
}

TEST(GapOfASphereAndASolid, is_exact_near_it_and_never_too_large_far_away) {
    const Obstacle round = solid(ball);
    const Place at{{0, 0, 0}, 0};
    for (int i = 0; i < 200; ++i) {
        const Place sphere{any_vector(6), 0.5};
        const double exact = sphere.centre.norm() - 2.5, enough = 1;
        const double found = gap(round, at, sphere, enough);
        EXPECT_LE(found, exact + 1e-14);
        if (exact <= enough) {
            EXPECT_NEAR(found, exact, 1e-14);
        } else {
            EXPECT_GT(found, enough);
        }
    }
}

TEST(TurningObstacle, moves_no_point_of_its_surface_farther_than_it_says) {
    const geometry::Profile cone({{-2, 0}, {1, 0.5}, {1, 0}});
    for (int i = 0; i < 200; ++i) {
        const Eigen::Quaterniond before = any_turn(any(-3, 3)), now = any_turn(any(-2, 2)) * before;
        Obstacle box = brick();
        box.axes = before.toRotationMatrix();
        const Obstacle pointed = solid(cone);
        const Vector spin = any_vector(1);
        for (int k = 0; k < 20; ++k) {
            const Vector corner = on_surface(box), local = box.axes.transpose() * corner;
            EXPECT_LE((now * local - corner).norm(), turned_by(box, before, now) + 1e-14);
            EXPECT_LE(spin.cross(corner).norm(), turning_speed(box, spin) + 1e-14);
        }
        // Of a solid its axis goes farthest.
        const Vector tip(0, 0, -2);
        EXPECT_LE((now * tip - before * tip).norm(), turned_by(pointed, before, now) + 1e-14);
    }
}

TEST(TurningSolidOfRevolution, does_not_move_by_spinning_about_its_axis) {
    Obstacle round = solid(ball);
    const Eigen::Quaterniond before = any_turn(0.7);
    round.axes = before.toRotationMatrix();
    const Vector axis = before * Vector::UnitZ();
    EXPECT_NEAR(turning_speed(round, 1000 * axis), 0, 1e-12);
    EXPECT_NEAR(turned_by(round, before, Eigen::Quaterniond(Eigen::AngleAxisd(2, axis)) * before), 0, 1e-14);
}

} // namespace
