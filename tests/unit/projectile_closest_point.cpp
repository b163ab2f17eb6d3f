// SPDX-License-Identifier: GPL-2.0-or-later
//
// Signed distance, normal and curvature of solids of revolution beside closed forms and brute force.
// Tolerance 1e-12 (bodies of size 1): a few tens of roundings.
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <engines/projectile/closest_point.hpp>
#include <engines/projectile/profile_check.hpp>
#include <engines/projectile/support.hpp>

#include "projectile_profiles.hpp"

namespace grainfall::geometry::test {
namespace {

constexpr double tolerance = 1e-12;

Eigen::Vector3d random_point(std::mt19937& random, double size) {
    std::uniform_real_distribution<double> u(-size, size);
    return {u(random), u(random), u(random)};
}

double cylinder_distance(double radius, double length, const Eigen::Vector3d& p) {
    const double radial = std::hypot(p[0], p[1]) - radius;
    const double axial = std::abs(p[2] - 0.5 * length) - 0.5 * length;
    return std::min(std::max(radial, axial), 0.) + std::hypot(std::max(radial, 0.), std::max(axial, 0.));
}

TEST(ProjectileClosestPoint, distance_to_two_arcs_is_the_distance_to_a_sphere) {
    const Profile ball(sphere(0.7));
    std::mt19937 random(1);
    for (int i = 0; i < 10000; ++i) {
        const Eigen::Vector3d p = random_point(random, 1.5);
        const SurfacePoint s = closest_point(ball, p);
        EXPECT_NEAR(s.distance, p.norm() - 0.7, tolerance);
        EXPECT_NEAR((s.normal - p.normalized()).norm(), 0, 10 * tolerance);
        EXPECT_NEAR((s.position - 0.7 * p.normalized()).norm(), 0, 10 * tolerance);
        EXPECT_NEAR(equivalent_radius(s, 0.1), 0.7, 1e-9);
    }
}

TEST(ProjectileClosestPoint, distance_to_a_flat_cylinder_is_that_of_the_product_of_disc_and_interval) {
    const Profile body(cylinder(0.4, 1.3));
    std::mt19937 random(2);
    for (int i = 0; i < 10000; ++i) {
        const Eigen::Vector3d p = random_point(random, 2);
        EXPECT_NEAR(closest_point(body, p).distance, cylinder_distance(0.4, 1.3, p), tolerance);
    }
}

TEST(ProjectileClosestPoint, distance_to_a_cone_grows_with_the_cosine_of_its_half_angle_beside_the_flank) {
    const double half_angle = 0.3, length = 1;
    const Profile body(cone(length * std::tan(half_angle), length));
    std::mt19937 random(3);
    std::uniform_real_distribution<double> along(0.1, 0.9), off(-0.02, 0.5), around(0, 2 * pi);
    for (int i = 0; i < 10000; ++i) {
        const double slant = along(random), gap = off(random), angle = around(random);
        const double r = slant * std::sin(half_angle) + gap * std::cos(half_angle);
        const double z = slant * std::cos(half_angle) - gap * std::sin(half_angle);
        if (r < 0)
            continue; // beyond the axis another meridian is nearer
        const SurfacePoint s = closest_point(body, {r * std::cos(angle), r * std::sin(angle), z});
        EXPECT_NEAR(s.distance, gap, tolerance);
        EXPECT_NEAR(s.normal[2], -std::sin(half_angle), tolerance);
        EXPECT_NEAR(s.hoop_curvature, std::cos(half_angle) / (slant * std::sin(half_angle)), 1e-9);
        EXPECT_EQ(s.zone, Zone::nose);
    }
}

TEST(ProjectileClosestPoint, before_the_tip_of_a_cone_the_normal_points_from_the_tip_to_the_grain) {
    const Profile body(cone(0.5, 1));
    const Eigen::Vector3d p(0.05, -0.02, -0.4);
    const SurfacePoint s = closest_point(body, p);
    EXPECT_NEAR(s.distance, p.norm(), tolerance);
    EXPECT_NEAR((s.normal - p.normalized()).norm(), 0, tolerance);
    const SurfacePoint on_axis = closest_point(body, {0, 0, -0.4});
    EXPECT_NEAR((on_axis.normal - Eigen::Vector3d(0, 0, -1)).norm(), 0, tolerance);
    const SurfacePoint at_tip = closest_point(body, {0, 0, 0});
    EXPECT_NEAR(at_tip.distance, 0, tolerance);
    EXPECT_NEAR((at_tip.normal - Eigen::Vector3d(0, 0, -1)).norm(), 0, tolerance);
    EXPECT_NEAR(equivalent_radius(at_tip, 0.02), 0.02, tolerance) << "a tip is as blunt as it is told to be";
}

TEST(ProjectileClosestPoint,
     around_the_edge_of_a_flat_cylinder_the_normal_turns_through_the_cone_of_normals) {
    const double radius = 0.4;
    const Profile body(cylinder(radius, 1.3));
    double last = -1;
    for (int i = 0; i <= 100; ++i) {
        const double angle = 0.5 * pi * i / 100; // from the face to the side
        const double gap = 0.1;
        const Eigen::Vector3d p(radius + gap * std::sin(angle), 0, -gap * std::cos(angle));
        const SurfacePoint s = closest_point(body, p);
        EXPECT_NEAR(s.distance, gap, tolerance);
        EXPECT_NEAR(s.normal[0], std::sin(angle), tolerance);
        EXPECT_NEAR(s.normal[2], -std::cos(angle), tolerance);
        EXPECT_GT(s.normal[0], last) << "no jump and no way back";
        last = s.normal[0];
    }
}

TEST(ProjectileClosestPoint, on_the_axis_and_on_the_surface_normals_stay_unit_and_point_outwards) {
    for (const Vertices& v : {sphere(0.5), cylinder(0.4, 1), cone(0.4, 1), ogive_body(0.3, 1.5, 2)}) {
        const Profile body(v);
        for (int i = -20; i <= 60; ++i) {
            const double z = 0.05 * i;
            const SurfacePoint s = closest_point(body, {0, 0, z});
            EXPECT_NEAR(s.normal.norm(), 1, tolerance);
            const double step = 1e-4; // along the normal the signed distance grows one to one
            const SurfacePoint further = closest_point(body, s.position + step * s.normal);
            EXPECT_NEAR(further.distance, step, tolerance);
        }
    }
}

TEST(ProjectileClosestPoint, no_sample_of_the_surface_is_nearer_than_the_closest_point) {
    std::mt19937 random(5);
    for (int body_number = 0; body_number < 40; ++body_number) {
        const Vertices vertices = wavy_body(random);
        ASSERT_NO_THROW(check_profile(vertices));
        const Profile body(vertices);
        std::vector<Point2> samples;
        double spacing = 0;
        for (const Segment& s : body.segments())
            for (int i = 0; i <= 2000; ++i) {
                samples.push_back(s.point_at(i / 2000.));
                spacing = std::max(spacing, s.length() / 2000);
            }
        for (int i = 0; i < 50; ++i) {
            Eigen::Vector3d p = random_point(random, 1.5);
            p[2] += 2.5;
            const SurfacePoint s = closest_point(body, p);
            const Point2 q(p[2], std::hypot(p[0], p[1]));
            double brute = 1e300;
            for (const Point2& sample : samples)
                brute = std::min(brute, (sample - q).norm());
            EXPECT_LE(std::abs(s.distance), brute + tolerance);
            EXPECT_GE(std::abs(s.distance), brute - spacing);
            // The foot is on the surface, at that distance, in the direction of the normal.
            EXPECT_NEAR((s.position + s.distance * s.normal - p).norm(), 0, 1e-11);
            EXPECT_NEAR(closest_point(body, s.position).distance, 0, tolerance);
        }
    }
}

TEST(ProjectileClosestPoint, the_sign_agrees_with_counting_how_often_a_ray_leaves_the_solid) {
    std::mt19937 random(6);
    for (int body_number = 0; body_number < 40; ++body_number) {
        const Profile body(wavy_body(random));
        for (int i = 0; i < 100; ++i) {
            Eigen::Vector3d p = random_point(random, 1.2);
            p[2] += 2.5;
            const double rho = std::hypot(p[0], p[1]);
            int crossings = 0; // of the ray that goes away from the axis; each piece is a graph over z here
            for (const Segment& s : body.segments()) {
                if ((s.start()[0] > p[2]) == (s.end()[0] > p[2]))
                    continue;
                double low = 0, high = 1;
                const bool rising = s.end()[0] > s.start()[0];
                for (int k = 0; k < 60; ++k) {
                    const double middle = 0.5 * (low + high);
                    ((s.point_at(middle)[0] < p[2]) == rising ? low : high) = middle;
                }
                crossings += s.point_at(low)[1] > rho;
            }
            const double distance = closest_point(body, p).distance;
            if (std::abs(distance) > 1e-9) {
                EXPECT_EQ(distance < 0, crossings % 2 == 1);
            }
        }
    }
}

TEST(ProjectileClosestPoint, distance_is_one_lipschitz_so_that_contacts_never_jump) {
    std::mt19937 random(7);
    for (int body_number = 0; body_number < 20; ++body_number) {
        const Profile body(wavy_body(random));
        for (int i = 0; i < 200; ++i) {
            Eigen::Vector3d p = random_point(random, 1.2);
            p[2] += 2.5;
            const Eigen::Vector3d q = p + random_point(random, 0.05);
            EXPECT_LE(std::abs(closest_point(body, p).distance - closest_point(body, q).distance),
                      (p - q).norm() + tolerance);
        }
    }
}

TEST(ProjectileClosestPoint, curvature_of_an_ogive_is_that_of_its_arc_and_of_its_normal_section) {
    const double radius = 0.5, head = 1.5; // calibre radius head 1.5: the arc's radius is 1.5 calibres
    const Profile body(ogive_body(radius, head, 3));
    const Segment& arc = body.segments().front();
    EXPECT_NEAR(arc.radius(), 2 * radius * head, tolerance);
    EXPECT_FALSE(body.is_sharp(1)) << "a tangent ogive joins its cylinder smoothly";
    const Point2 p = arc.point_at(0.5);
    const SurfacePoint s = closest_point(body, {p[1], 0, p[0]});
    EXPECT_NEAR(s.meridian_curvature, 1 / (2 * radius * head), tolerance);
    // Meusnier: the parallel of radius r is an oblique section, its normal section is flatter by n_r.
    EXPECT_NEAR(s.hoop_curvature, arc.normal_at(p)[1] / p[1], tolerance);
    const SurfacePoint shaft = closest_point(body, {radius, 0, 2});
    EXPECT_NEAR(equivalent_radius(shaft, 0.1), 2 * radius, tolerance);
    const SurfacePoint flat = closest_point(body, {0.1, 0, 3});
    EXPECT_TRUE(std::isinf(equivalent_radius(flat, 0.1)));
}

TEST(ProjectileClosestPoint, the_enclosing_cylinder_never_claims_more_than_the_true_distance) {
    std::mt19937 random(8);
    const Profile body(wavy_body(random));
    for (int i = 0; i < 5000; ++i) {
        const Eigen::Vector3d p = random_point(random, 8);
        EXPECT_LE(distance_bound(body, p), std::max(closest_point(body, p).distance, 0.) + tolerance);
    }
}

TEST(ProjectileSupport, the_farthest_point_along_a_direction_is_farther_than_every_sample) {
    std::mt19937 random(9);
    for (int body_number = 0; body_number < 20; ++body_number) {
        const Profile body(wavy_body(random));
        for (int i = 0; i < 50; ++i) {
            const Eigen::Vector3d d = random_point(random, 1).normalized();
            const double h = support(body, d);
            EXPECT_NEAR(support_point(body, d).dot(d), h, 1e-8) << "ties within 1e-9 share their middle";
            double sampled = -1e300;
            for (const Segment& s : body.segments())
                for (int k = 0; k <= 500; ++k) {
                    const Point2 p = s.point_at(k / 500.);
                    sampled = std::max(sampled, p[0] * d[2] + p[1] * std::hypot(d[0], d[1]));
                }
            EXPECT_GE(h, sampled - tolerance);
            EXPECT_LE(h, sampled + 1e-4);
        }
    }
}

TEST(ProjectileSupport, a_flat_end_rests_on_its_middle_and_a_lying_cylinder_on_half_its_length) {
    const Profile body(cylinder(0.4, 1.2));
    EXPECT_NEAR((support_point(body, {0, 0, -1}) - Eigen::Vector3d(0, 0, 0)).norm(), 0, tolerance);
    EXPECT_NEAR((support_point(body, {0, 0, 1}) - Eigen::Vector3d(0, 0, 1.2)).norm(), 0, tolerance);
    EXPECT_NEAR((support_point(body, {0, -1, 0}) - Eigen::Vector3d(0, -0.4, 0.6)).norm(), 0, tolerance);
}

} // namespace
} // namespace grainfall::geometry::test
