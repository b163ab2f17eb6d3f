// SPDX-License-Identifier: GPL-2.0-or-later
#include <engines/flat/neighbours.hpp>

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace {

using namespace grainfall::flat;

std::vector<Place> random_spheres(int count, double side, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(0, side), radius(0.4, 0.5);
    std::vector<Place> spheres;
    for (int i = 0; i < count; ++i)
        spheres.push_back({{place(random), 0.7 * place(random), 1.6 * place(random)}, radius(random)});
    return spheres;
}

using Pairs = std::set<std::pair<int, int>>;

Pairs by_brute_force(const std::vector<Place>& spheres, double margin) {
    Pairs pairs;
    for (int i = 0; i < static_cast<int>(spheres.size()); ++i)
        for (int j = i + 1; j < static_cast<int>(spheres.size()); ++j)
            if (gap(spheres[static_cast<std::size_t>(i)], spheres[static_cast<std::size_t>(j)]) < margin)
                pairs.emplace(i, j);
    return pairs;
}

Pairs by_cells(const std::vector<Place>& spheres, double margin) {
    const int count = static_cast<int>(spheres.size());
    const CellTable cells(spheres, count, 0.5 + 0.5 * margin);
    Pairs pairs;
    for (int i = 0; i < count; ++i) {
        const Place& sphere = spheres[static_cast<std::size_t>(i)];
        cells.grid.around(sphere.centre, [&](int from, int to) {
            const int end = cells.starts[static_cast<std::size_t>(to)];
            for (int k = cells.starts[static_cast<std::size_t>(from)]; k < end; ++k) {
                const int j = cells.order[static_cast<std::size_t>(k)];
                if (j > i && gap(sphere, spheres[static_cast<std::size_t>(j)]) < margin) {
                    EXPECT_TRUE(pairs.emplace(i, j).second) << "visited twice: " << i << ", " << j;
                }
            }
        });
    }
    return pairs;
}

TEST(NeighboursOfSpheres, are_those_of_brute_force_each_once) {
    for (unsigned seed = 1; seed <= 5; ++seed) {
        const auto spheres = random_spheres(600, 8, seed);
        EXPECT_EQ(by_cells(spheres, 0.1), by_brute_force(spheres, 0.1));
    }
}

TEST(NeighboursOfSpheres, are_found_beyond_the_cells_that_cover_the_bulk) {
    auto spheres = random_spheres(600, 8, 1);
    for (const double far : {1e3, 1e6, -1e6}) {
        spheres.push_back({{far, 1, 1}, 0.5});
        spheres.push_back({{far + 0.9, 1, 1}, 0.5});
    }
    const Pairs pairs = by_cells(spheres, 0.1);
    EXPECT_EQ(pairs, by_brute_force(spheres, 0.1));
    EXPECT_TRUE(pairs.count({600, 601}));
}

TEST(NeighboursOfSpheres, do_not_need_more_than_a_few_cells_per_sphere_in_a_loose_scene) {
    const auto spheres = random_spheres(500, 1000, 1);
    const CellTable cells(spheres, 500, 0.6);
    EXPECT_LE(cells.grid.cells(), 4000);
}

TEST(NeighboursOfSpheres, every_sphere_stands_in_one_cell_only) {
    const auto spheres = random_spheres(300, 5, 2);
    const CellTable cells(spheres, 300, 0.6);
    std::set<int> seen(cells.order.begin(), cells.order.end());
    EXPECT_EQ(seen.size(), 300u);
    EXPECT_EQ(cells.starts.back(), 300);
}

TEST(NeighboursOfABox, hold_every_sphere_that_reaches_into_it) {
    const auto spheres = random_spheres(600, 8, 3);
    const CellTable cells(spheres, 600, 0.55);
    const Vector low(2, 1, 3), high(2.5, 4, 3.1);
    std::set<int> visited;
    cells.grid.inside(low, high, [&](int from, int to) {
        for (int k = cells.starts[static_cast<std::size_t>(from)];
             k < cells.starts[static_cast<std::size_t>(to)]; ++k)
            visited.insert(cells.order[static_cast<std::size_t>(k)]);
    });
    for (int i = 0; i < 600; ++i) {
        const Place& sphere = spheres[static_cast<std::size_t>(i)];
        const Vector reach = Vector::Constant(sphere.radius);
        const bool meets = ((sphere.centre + reach).array() >= low.array()).all() &&
                           ((sphere.centre - reach).array() <= high.array()).all();
        if (meets) {
            EXPECT_TRUE(visited.count(i)) << i;
        }
    }
    EXPECT_LT(visited.size(), 300u);
}

TEST(GapOfSphereAndPlane, is_the_same_from_both_sides) {
    const Place plane{{0, 0, 1}, 1};
    Obstacle wall;
    wall.axis = 2;
    EXPECT_DOUBLE_EQ(gap(wall, plane, {{5, 5, 1.75}, 0.5}, 1), 0.25);
    EXPECT_DOUBLE_EQ(gap(wall, plane, {{5, 5, 0.25}, 0.5}, 1), 0.25);
}

} // namespace
