// SPDX-License-Identifier: GPL-2.0-or-later
//
// Volume, areas, centroid and inertia beside textbook formulas (relative tolerance 1e-12: quadrature is exact
// on these profiles but for rounding), and the display mesh beside both.
#include <cmath>
#include <map>
#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <engines/projectile/mass_properties.hpp>
#include <engines/projectile/tessellation.hpp>

#include "projectile_profiles.hpp"

namespace grainfall::geometry::test {
namespace {

void expect_close(double value, double expected) {
    EXPECT_NEAR(value / expected, 1, 1e-12);
}

TEST(ProjectileMass, sphere_has_textbook_volume_area_and_inertia) {
    const double a = 0.7, volume = 4. / 3 * pi * a * a * a;
    const MassProperties m = mass_properties(Profile(sphere(a)));
    expect_close(m.volume, volume);
    expect_close(m.surface_area(), 4 * pi * a * a);
    expect_close(m.axial, 0.4 * volume * a * a);
    expect_close(m.transverse, 0.4 * volume * a * a);
    expect_close(m.lateral_area, pi * a * a);
    EXPECT_NEAR(m.centroid, 0, 1e-14);
}

TEST(ProjectileMass, one_half_circle_is_the_same_sphere_as_two_quarters) {
    const MassProperties one = mass_properties(Profile({{-0.7, 0, 1}, {0.7, 0}}));
    const MassProperties two = mass_properties(Profile(sphere(0.7)));
    expect_close(one.volume, two.volume);
    expect_close(one.transverse, two.transverse);
}

TEST(ProjectileMass, cylinder_has_textbook_volume_areas_and_inertia) {
    const double a = 0.4, length = 1.3, volume = pi * a * a * length;
    const MassProperties m = mass_properties(Profile(cylinder(a, length)));
    expect_close(m.volume, volume);
    expect_close(m.zone_area[0], pi * a * a);
    expect_close(m.zone_area[1], 2 * pi * a * length);
    expect_close(m.zone_area[2], pi * a * a);
    expect_close(m.frontal_area, pi * a * a);
    expect_close(m.lateral_area, 2 * a * length);
    expect_close(m.axial, 0.5 * volume * a * a);
    expect_close(m.transverse, volume * (3 * a * a + length * length) / 12);
    expect_close(m.centroid, 0.5 * length);
}

TEST(ProjectileMass, cone_has_its_centroid_at_three_quarters_and_textbook_inertia) {
    const double a = 0.5, h = 1.7, volume = pi * a * a * h / 3;
    const MassProperties m = mass_properties(Profile(cone(a, h)));
    expect_close(m.volume, volume);
    expect_close(m.centroid, 0.75 * h);
    expect_close(m.axial, 0.3 * volume * a * a);
    expect_close(m.transverse, 3. / 80 * volume * (4 * a * a + h * h));
    expect_close(m.zone_area[0], pi * a * std::hypot(a, h));
}

TEST(ProjectileMass, torus_shaped_rim_follows_pappus) {
    // A disc of radius a with a half-round rim of radius c: the rim is half of a torus tube.
    const double a = 1, c = 0.25;
    const MassProperties m = mass_properties(Profile({{0, 0}, {0, a, 1}, {2 * c, a}, {2 * c, 0}}));
    const double half_disc = 0.5 * pi * c * c, its_centroid = a + 4 * c / (3 * pi);
    expect_close(m.volume, 2 * c * pi * a * a + 2 * pi * its_centroid * half_disc);
    const double half_circle = pi * c, arc_centroid = a + 2 * c / pi;
    expect_close(m.surface_area(), 2 * pi * a * a + 2 * pi * arc_centroid * half_circle);
}

TEST(ProjectileMass, tangent_ogive_follows_its_closed_form_volume) {
    // V = pi int (sqrt(R^2 - x^2) - d)^2 dx over 0 < x < L, x counted from the cylinder, R the arc's radius.
    const double a = 0.5, head = 2.3;
    const double big = 2 * a * head, d = big - a, length = 2 * a * std::sqrt(head - 0.25);
    const double root = std::sqrt(big * big - length * length);
    const double integral_of_root = 0.5 * (length * root + big * big * std::asin(length / big));
    const double volume =
        pi * ((big * big + d * d) * length - length * length * length / 3 - 2 * d * integral_of_root);
    const Vertices nose = {ogive_body(a, head, 9)[0], {length, a}, {length, 0}};
    expect_close(mass_properties(Profile(nose)).volume, volume);
}

TEST(ProjectileMass, moving_the_drawing_along_the_axis_moves_the_centroid_and_nothing_else) {
    std::mt19937 random(4);
    Vertices vertices = wavy_body(random);
    const MassProperties here = mass_properties(Profile(vertices));
    for (ProfileVertex& v : vertices)
        v.z += 100;
    const MassProperties there = mass_properties(Profile(vertices));
    EXPECT_NEAR(there.centroid - here.centroid, 100, 1e-11);
    EXPECT_NEAR(there.volume / here.volume, 1, 1e-11) << "coordinates a hundred times larger cost two digits";
    EXPECT_NEAR(there.transverse / here.transverse, 1, 1e-11);
}

TEST(ProjectileMass, doubling_all_lengths_multiplies_volume_by_8_and_inertia_by_32) {
    std::mt19937 random(5);
    Vertices vertices = wavy_body(random);
    const MassProperties small = mass_properties(Profile(vertices));
    for (ProfileVertex& v : vertices) {
        v.z *= 2;
        v.r *= 2;
    }
    const MassProperties large = mass_properties(Profile(vertices));
    expect_close(large.volume / small.volume, 8);
    expect_close(large.axial / small.axial, 32);
    expect_close(large.transverse / small.transverse, 32);
    expect_close(large.surface_area() / small.surface_area(), 4);
}

double mesh_volume(const SurfaceMesh& mesh) {
    double volume = 0;
    for (const auto& t : mesh.triangles)
        volume += mesh.vertices[t[0]].dot(mesh.vertices[t[1]].cross(mesh.vertices[t[2]])) / 6;
    return volume;
}

TEST(ProjectileMesh, every_edge_is_used_once_in_each_direction) {
    std::mt19937 random(6);
    for (const Vertices& v : {sphere(0.5), cylinder(0.4, 1), cone(0.4, 1), wavy_body(random)}) {
        const SurfaceMesh mesh = tessellate(Profile(v), 17);
        std::map<std::pair<int, int>, int> uses;
        for (const auto& t : mesh.triangles)
            for (int k = 0; k < 3; ++k)
                ++uses[{t[k], t[(k + 1) % 3]}];
        for (const auto& [edge, count] : uses) {
            EXPECT_EQ(count, 1);
            EXPECT_EQ(uses.count({edge.second, edge.first}), 1u) << "no hole, one orientation";
        }
        EXPECT_EQ(mesh.zones.size(), mesh.triangles.size());
        const int edges = static_cast<int>(uses.size()) / 2;
        const int vertices = static_cast<int>(mesh.vertices.size());
        EXPECT_EQ(vertices - edges + static_cast<int>(mesh.triangles.size()), 2) << "Euler: a ball";
    }
}

TEST(ProjectileMesh, volume_converges_from_below_with_the_square_of_the_angle) {
    const Profile body(ogive_body(0.5, 1.5, 3));
    const double exact = mass_properties(body).volume;
    const double coarse = exact - mesh_volume(tessellate(body, 64));
    const double fine = exact - mesh_volume(tessellate(body, 128));
    EXPECT_GT(fine, 0);
    EXPECT_NEAR(coarse / fine, 4, 0.1) << "second order";
    EXPECT_LT(fine / exact, 1e-3);
}

} // namespace
} // namespace grainfall::geometry::test
