// SPDX-License-Identifier: GPL-2.0-or-later
// Time of the closest point on a warped face: femlink's kernel beside deal.II's two ways to find it.
#include <femlink/core/closest_point.hpp>

#include <deal.II/fe/mapping_q1.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>

#include <chrono>
#include <cstdio>
#include <random>
#include <vector>

namespace {

using namespace grainfall::femlink;
using Face = dealii::Triangulation<2, 3>::active_cell_iterator;

constexpr int count = 20000;

template <class Action>
double nanoseconds(const std::vector<Point>& centres, Action&& action) {
    const auto start = std::chrono::steady_clock::now();
    for (const Point& centre : centres)
        action(centre);
    return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count() / count;
}

void measure(double warp) {
    FaceNodes<1> nodes;
    nodes << 0, 1, 0, 1, 0, 0, 1, 1, 0.5 * warp, -0.5 * warp, -0.5 * warp, 0.5 * warp;
    std::vector<dealii::Point<3>> vertices;
    for (int k = 0; k < 4; ++k)
        vertices.emplace_back(nodes(0, k), nodes(1, k), nodes(2, k));
    std::vector<dealii::CellData<2>> cells(1);
    cells[0].vertices = {0, 1, 2, 3};
    dealii::Triangulation<2, 3> surface;
    surface.create_triangulation(vertices, cells, {});
    const Face face = surface.begin_active();

    std::mt19937 random(5);
    std::uniform_real_distribution<double> place(0, 1), height(-0.5, 0.5);
    std::vector<Point> centres;
    for (int i = 0; i < count; ++i)
        centres.emplace_back(place(random), place(random), height(random));

    double sum = 0; // keeps the calls from being left out
    int iterations = 0, failures = 0, thrown = 0;
    const double own = nanoseconds(centres, [&](const Point& p) {
        const ClosestPoint found = closest_point<1>(nodes, p);
        sum += found.distance;
        iterations += found.iterations;
        failures += !found.converged;
    });
    const dealii::MappingQ1<2, 3> mapping;
    const double mapped = nanoseconds(centres, [&](const Point& p) {
        try {
            sum += mapping.transform_real_to_unit_cell(face, dealii::Point<3>(p[0], p[1], p[2]))[0];
        } catch (const std::exception&) {
            ++thrown;
        }
    });
    const double projected = nanoseconds(centres, [&](const Point& p) {
        sum += dealii::GridTools::project_to_object(face, dealii::Point<3>(p[0], p[1], p[2]))[0];
    });
    std::printf("%5.1f %12.0f %10.2f %9d %14.0f %8d %14.0f%s\n", warp, own, double(iterations) / count,
                failures, mapped, thrown, projected, sum == 0 ? " " : "");
}

} // namespace

int main() {
    std::printf("%5s %12s %10s %9s %14s %8s %14s\n", "warp", "femlink, ns", "iterations", "failures",
                "MappingQ1, ns", "thrown", "project, ns");
    for (const double warp : {0.0, 0.2, 0.5, 1.0})
        measure(warp);
}
