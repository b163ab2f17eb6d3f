// SPDX-License-Identifier: GPL-2.0-or-later
#include <femlink/core/closest_point.hpp>

#include <gtest/gtest.h>

#include <random>

namespace {

using namespace grainfall::femlink;

FaceNodes<1> unit_square() {
    FaceNodes<1> nodes;
    nodes << 0, 1, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0;
    return nodes;
}

// Corners of a unit square, two opposite ones raised by half the warp, two lowered.
FaceNodes<1> warped(double warp) {
    FaceNodes<1> nodes = unit_square();
    nodes.row(2) << 0.5 * warp, -0.5 * warp, -0.5 * warp, 0.5 * warp;
    return nodes;
}

// The same, with the nodes of a quadratic face, their edges bulging out of the plane.
FaceNodes<2> bulging(double height) {
    FaceNodes<2> nodes;
    for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i)
            nodes.col(i + 3 * j) << 0.5 * i, 0.5 * j,
                height * (1 - (i - 1.0) * (i - 1)) * (1 - 0.5 * (j - 1.0) * (j - 1));
    return nodes;
}

// Nearest of a fine grid of points: no Newton, no bounds.
template <int degree>
double distance_by_search(const FaceNodes<degree>& nodes, const Point& p, int cells = 120) {
    double best = std::numeric_limits<double>::infinity();
    for (int j = 0; j <= cells; ++j)
        for (int i = 0; i <= cells; ++i)
            best = std::min(
                best, (face_point<degree>(nodes, {2.0 * i / cells - 1, 2.0 * j / cells - 1}) - p).norm());
    return best;
}

TEST(ClosestPoint, of_a_flat_face_is_the_foot_of_the_perpendicular) {
    const ClosestPoint found = closest_point<1>(unit_square(), {0.3, 0.8, 0.2});
    EXPECT_NEAR((found.position - Point(0.3, 0.8, 0)).norm(), 0, 1e-15);
    EXPECT_NEAR(found.distance, 0.2, 1e-15);
    EXPECT_EQ(found.feature, Feature::interior);
    EXPECT_TRUE(found.converged);
    EXPECT_LE(found.iterations, 2);
    EXPECT_NEAR((found.normal - Point::UnitZ()).norm(), 0, 1e-15);
}

TEST(ClosestPoint, beyond_an_edge_or_a_corner_lies_on_it) {
    const ClosestPoint edge = closest_point<1>(unit_square(), {1.4, 0.25, 0.3});
    EXPECT_EQ(edge.feature, Feature::edge);
    EXPECT_NEAR((edge.position - Point(1, 0.25, 0)).norm(), 0, 1e-15);
    EXPECT_NEAR(edge.distance, 0.5, 1e-15);
    EXPECT_NEAR((edge.push_direction({1.4, 0.25, 0.3}) - Point(0.8, 0, 0.6)).norm(), 0, 1e-14);
    const ClosestPoint corner = closest_point<1>(unit_square(), {-0.3, 1.4, 0});
    EXPECT_EQ(corner.feature, Feature::corner);
    EXPECT_NEAR((corner.position - Point(0, 1, 0)).norm(), 0, 1e-15);
    EXPECT_NEAR(corner.distance, 0.5, 1e-15);
}

TEST(ClosestPoint, behind_the_surface_has_a_negative_distance_and_pushes_outwards) {
    const Point below(0.4, 0.4, -0.1);
    const ClosestPoint found = closest_point<1>(unit_square(), below);
    EXPECT_NEAR(found.distance, -0.1, 1e-15);
    EXPECT_NEAR((found.push_direction(below) - Point::UnitZ()).norm(), 0, 1e-15);
    const Point below_edge(1.003, 0.4, -0.1);
    EXPECT_GT(closest_point<1>(unit_square(), below_edge).push_direction(below_edge)[2], 0.99);
}

// A skewed face for which unbounded Newton with snapping afterwards lands on the wrong edge point.
TEST(ClosestPoint, of_a_skewed_face_minimises_along_the_edge_instead_of_cutting_coordinates_off) {
    FaceNodes<1> nodes;
    nodes << 0, 1, 1.5, 2.5, 0, 0, 1, 1, 0, 0, 0, 0;
    const Point p(2.2, 0.2, 0); // beyond the slanting edge from (1, 0) to (2.5, 1)
    const ClosestPoint found = closest_point<1>(nodes, p);
    const Point a(1, 0, 0), along = Point(1.5, 1, 0).normalized();
    EXPECT_NEAR((found.position - (a + (p - a).dot(along) * along)).norm(), 0, 1e-14);
    EXPECT_EQ(found.feature, Feature::edge);
}

template <int degree>
void agrees_with_search(const FaceNodes<degree>& nodes, double spread, int count) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(-spread, spread);
    for (int i = 0; i < count; ++i) {
        const Point p(0.5 + place(random), 0.5 + place(random), place(random));
        const ClosestPoint found = closest_point<degree>(nodes, p);
        const double searched = distance_by_search<degree>(nodes, p, 60);
        EXPECT_TRUE(found.converged) << p.transpose();
        // The grid can only be farther; by less than half a cell's diagonal where it meets the surface.
        EXPECT_LE(std::abs(found.distance), searched + 1e-12) << p.transpose();
        EXPECT_GE(std::abs(found.distance), searched - 0.02) << p.transpose();
    }
}

TEST(ClosestPoint, is_never_farther_than_any_point_of_a_grid_on_warped_faces) {
    for (const double warp : {0.05, 0.3, 1.0, 2.0})
        agrees_with_search<1>(warped(warp), 0.9, 30);
}

TEST(ClosestPoint, is_never_farther_than_any_point_of_a_grid_on_quadratic_faces) {
    for (const double height : {0.05, 0.3, -0.6})
        agrees_with_search<2>(bulging(height), 0.9, 30);
}

TEST(ClosestPoint, takes_the_nearer_of_two_minima) {
    // Above the middle of a saddle both raised corners are near; a little towards one of them, that one is
    // nearest.
    const FaceNodes<1> saddle = warped(2.0);
    for (const double shift : {-0.02, 0.02}) {
        const Point p(0.5 + shift, 0.5 + shift, 3.0);
        const ClosestPoint found = closest_point<1>(saddle, p, Reference(-shift, -shift) * 40);
        EXPECT_EQ(found.position[0] > 0.5, shift > 0);
        EXPECT_LE(std::abs(found.distance), distance_by_search<1>(saddle, p) + 1e-12);
    }
}

TEST(ClosestPoint, far_away_is_as_exact_as_near) {
    const ClosestPoint found = closest_point<1>(warped(0.2), {1e3, 0.5, 2e3});
    EXPECT_TRUE(found.converged);
    EXPECT_LE(std::abs(found.distance), distance_by_search<1>(warped(0.2), {1e3, 0.5, 2e3}) + 1e-9);
}

TEST(ClosestPoint, does_not_depend_on_where_the_face_lies_or_how_large_it_is) {
    for (const double scale : {1e-4, 1e3}) {
        const Point shift = 50 * scale * Point(1, -2, 3);
        FaceNodes<1> nodes = scale * warped(0.4);
        nodes.colwise() += shift;
        const Point p(0.3, 0.6, 0.4);
        const ClosestPoint here = closest_point<1>(warped(0.4), p),
                           there = closest_point<1>(nodes, scale * p + shift);
        EXPECT_TRUE(there.converged);
        EXPECT_NEAR(there.distance / scale, here.distance, 1e-11);
        EXPECT_NEAR((there.reference - here.reference).norm(), 0, 1e-9);
    }
}

TEST(ClosestPoint, of_a_face_folded_to_a_triangle_still_has_a_normal) {
    FaceNodes<1> nodes = unit_square();
    nodes.col(3) = nodes.col(1);
    const Point p(1.2, -0.1, 0.1);
    const ClosestPoint found = closest_point<1>(nodes, p);
    EXPECT_NEAR((found.position - Point(1, 0, 0)).norm(), 0, 1e-9);
    EXPECT_NEAR(found.normal[2], 1, 1e-12);
    EXPECT_TRUE(std::isfinite(found.distance));
}

// Newton: the number of right digits doubles. Near a face of moderate warp the start does not matter.
TEST(ClosestPoint, near_a_face_takes_few_iterations) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> place(0.05, 0.95), height(-0.2, 0.2);
    int iterations = 0;
    constexpr int count = 200;
    for (int i = 0; i < count; ++i)
        iterations +=
            closest_point<1>(warped(0.2), {place(random), place(random), height(random)}).iterations;
    EXPECT_LT(iterations, 6 * count);
}

} // namespace
