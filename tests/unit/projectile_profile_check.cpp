// SPDX-License-Identifier: GPL-2.0-or-later
//
// A wrong profile is refused with one sentence that names attribute, value and allowed range.
#include <limits>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include <engines/projectile/profile_check.hpp>

#include "projectile_profiles.hpp"

namespace grainfall::geometry::test {
namespace {

std::string complaint(const Vertices& vertices, const std::vector<Zone>& zones = {}) {
    try {
        check_profile(vertices, zones);
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "";
}

void expect_refused(const Vertices& vertices, const std::string& part) {
    const std::string text = complaint(vertices);
    EXPECT_NE(text.find(part), std::string::npos) << "got: '" << text << "'";
    EXPECT_NE(text.find("allowed"), std::string::npos) << "got: '" << text << "'";
}

const double nan = std::numeric_limits<double>::quiet_NaN();

TEST(ProjectileProfileCheck, sound_profiles_pass) {
    std::mt19937 random(1);
    for (const Vertices& v : {sphere(0.5), cylinder(0.4, 1), cone(0.4, 1), ogive_body(0.3, 1.5, 2),
                              Vertices{{-0.7, 0, 1}, {0.7, 0}}, wavy_body(random)})
        EXPECT_EQ(complaint(v), "");
}

TEST(ProjectileProfileCheck, a_profile_typed_with_five_digits_still_passes) {
    // The ogive meets its cylinder at an angle of some 1e-5, which crosses it again right beside the joint.
    EXPECT_EQ(complaint({{0, 0, 0.19098}, {0.11180, 0.05}, {0.3, 0.05}, {0.3, 0}}), "");
    EXPECT_EQ(complaint({{0, 0, 0.21526}, {0.11180, 0.05}, {0.3, 0.05}, {0.3, 0}}), "");
}

TEST(ProjectileProfileCheck, numbers_must_be_finite) {
    expect_refused({{nan, 0}, {0, 1}, {1, 1}, {1, 0}}, "z of vertex 0 is nan");
    expect_refused({{0, 0}, {0, std::numeric_limits<double>::infinity()}, {1, 1}, {1, 0}},
                   "r of vertex 1 is inf");
    expect_refused({{0, 0}, {0, 1, nan}, {1, 1}, {1, 0}}, "bulge of vertex 1 is nan");
}

TEST(ProjectileProfileCheck, fewer_than_two_vertices_make_no_curve) {
    expect_refused({}, "0 vertices");
    expect_refused({{0, 0}}, "1 vertices");
}

TEST(ProjectileProfileCheck, the_radius_is_never_negative) {
    expect_refused({{0, 0}, {0.5, -0.2}, {1, 0}}, "r of vertex 1 is -0.2 m");
}

TEST(ProjectileProfileCheck, an_arc_that_dips_through_the_axis_is_found) {
    expect_refused({{0, 0}, {0, 0.2}, {0.5, 0.05, -0.9}, {1, 0.2}, {1, 0}}, "arc at its lowest point");
}

TEST(ProjectileProfileCheck, the_curve_starts_and_ends_on_the_axis) {
    expect_refused({{0, 0.1}, {1, 1}, {1, 0}}, "r of vertex 0 is 0.1 m");
    expect_refused({{0, 0}, {1, 1}, {2, 1}}, "r of vertex 2 is 1 m");
}

TEST(ProjectileProfileCheck, the_curve_does_not_touch_the_axis_in_between) {
    expect_refused({{0, 0}, {0.5, 0.5}, {1, 0}, {1.5, 0.5}, {2, 0}}, "r of vertex 2 is 0 m");
}

TEST(ProjectileProfileCheck, a_segment_needs_a_length) {
    expect_refused({{0, 0}, {0.5, 0.5}, {0.5, 0.5}, {1, 0}}, "length of segment 1");
}

TEST(ProjectileProfileCheck, a_bulge_must_be_possible) {
    expect_refused({{0, 0, 1e-9}, {0, 1}, {1, 1}, {1, 0}}, "bulge of vertex 0 is 1e-09");
    expect_refused({{0, 0, 40}, {0, 1}, {1, 1}, {1, 0}}, "bulge of vertex 0 is 40");
}

TEST(ProjectileProfileCheck, crossing_lines_and_arcs_are_found) {
    expect_refused({{0, 0}, {1, 1}, {0.2, 1}, {1, 0.2}, {1, 0}}, "segments 0 and 2");
    expect_refused({{0, 0, 0.9}, {1, 1}, {0, 1}, {0, 2}, {2, 2}, {2, 0}}, "the meeting of segments");
    // Two arcs that bulge into each other across a narrow slot.
    expect_refused({{0, 0}, {0, 1}, {0.9, 1, 0.9}, {0.9, 0.3}, {1.1, 0.3, 0.9}, {1.1, 1}, {2, 1}, {2, 0}},
                   "segments 2 and 4");
}

TEST(ProjectileProfileCheck, pieces_that_only_touch_are_found) {
    expect_refused({{0, 0}, {0, 1}, {1, 1}, {1, 0.5}, {0, 0.5}, {2, 0.2}, {2, 0}}, "the meeting of segments");
}

TEST(ProjectileProfileCheck, a_curve_that_folds_back_on_itself_is_found) {
    expect_refused({{0, 0}, {0, 1}, {1, 1}, {0.5, 1}, {0.5, 0}}, "segments 1 and 2");
}

TEST(ProjectileProfileCheck, vertices_run_from_nose_to_base) {
    expect_refused({{1, 0}, {1, 0.4}, {0, 0.4}, {0, 0}}, "the order of the vertices");
}

TEST(ProjectileProfileCheck, zones_are_one_per_segment) {
    const std::string text = complaint(cylinder(0.4, 1), {Zone::nose, Zone::shaft});
    EXPECT_NE(text.find("zones: 2 entries; allowed: one for each of the 3 segments"), std::string::npos)
        << text;
}

TEST(ProjectileProfileCheck, zones_left_out_follow_the_largest_radius) {
    const Profile body(ogive_body(0.3, 1.5, 2));
    EXPECT_EQ(body.segments()[0].zone(), Zone::nose);
    EXPECT_EQ(body.segments()[1].zone(), Zone::shaft);
    EXPECT_EQ(body.segments()[2].zone(), Zone::base);
}

} // namespace
} // namespace grainfall::geometry::test
