// SPDX-License-Identifier: GPL-2.0-or-later
#include <laws/friction/constant.hpp>
#include <laws/hertz_mindlin.hpp>
#include <laws/pair_rules.hpp>

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>

namespace {

using namespace grainfall::laws;
using friction::Constant;

constexpr double pi = detail::pi;
const ElasticMaterial quartz{70e9, 0.2};

ContactParameters quartz_pair(double radius = 1e-3) {
    return contact_parameters(effective_modulus(quartz, quartz), effective_shear_modulus(quartz, quartz),
                              effective_radius(radius, radius), 1e-5, 0);
}

TEST(ShearStiffness, with_hertz_is_mindlins_8_G_a) {
    const double overlap = 2e-7, root = std::sqrt(overlap);
    const double contact_radius = std::sqrt(0.5e-3 * overlap);
    const double mindlin = 8 * effective_shear_modulus(quartz, quartz) * contact_radius;
    const double stiffness =
        shear_stiffness<Hertz, IncrementalTangential>(quartz_pair().shear_coefficient, root);
    EXPECT_NEAR(stiffness / mindlin, 1, 1e-14);
    // Mindlin's ratio for spheres of one material.
    EXPECT_NEAR(stiffness / Hertz::stiffness(quartz_pair().normal_coefficient, root),
                2 * (1 - 0.2) / (2 - 0.2), 1e-14);
}

TEST(ShearStiffness, follows_the_force_of_the_law_in_use) {
    const double overlap = 2e-7, root = std::sqrt(overlap);
    const ContactParameters p = quartz_pair();
    const double force = ReportNormal::force(p.normal_coefficient, overlap, root);
    const double contact_radius = std::cbrt(0.75 * force * 0.5e-3 / effective_modulus(quartz, quartz));
    const double expected = 8 * effective_shear_modulus(quartz, quartz) * contact_radius;
    EXPECT_NEAR((shear_stiffness<ReportNormal, IncrementalTangential>(p.shear_coefficient, root)) / expected,
                1, 1e-14);
}

TEST(ShearStiffness, the_printed_equation_5_is_what_the_report_law_computes) {
    const double overlap = 2e-7, root = std::sqrt(overlap), r_e = 0.5e-3, g = shear_modulus(quartz), nu = 0.2;
    const ContactParameters p = quartz_pair();
    const auto printed = [&](double force) {
        return 2 * std::cbrt(3 * g * g * (1 - nu) * force * r_e) / (2 - nu);
    };
    const double hertz = Hertz::force(p.normal_coefficient, overlap, root);
    const double report = ReportNormal::force(p.normal_coefficient, overlap, root);
    EXPECT_NEAR((shear_stiffness<Hertz, ReportTangential>(p.shear_coefficient, root)) / printed(hertz), 1,
                1e-14);
    EXPECT_NEAR((shear_stiffness<ReportNormal, ReportTangential>(p.shear_coefficient, root)) /
                    printed(report),
                1, 1e-14);
}

TEST(ShearStiffness, of_the_report_is_0_7937_of_mindlins_at_the_same_normal_force) {
    const double mindlin = shear_stiffness<Hertz, IncrementalTangential>(1e9, 1e-3);
    EXPECT_NEAR((shear_stiffness<Hertz, ReportTangential>(1e9, 1e-3)) / mindlin, std::pow(2, -1.0 / 3),
                1e-15);
    EXPECT_DOUBLE_EQ(ReportTangential::square_root_of_factor, std::sqrt(ReportTangential::factor));
}

// One turn of the contact about a fixed axis, in equal steps, while it may also spin about its own normal.
struct Turn {
    Vector first, last;
    double largest_length_error = 0, largest_normal_part = 0;
};

Turn turn_once(const Vector& axis, const Vector& start_normal, const Vector& force, int steps,
               double spin_turns = 0) {
    Turn result{force, force};
    ContactGeometry geometry;
    geometry.normal = start_normal;
    for (int i = 1; i <= steps; ++i) {
        const Vector normal = Eigen::AngleAxisd(2 * pi * i / steps, axis) * start_normal;
        geometry.tilt = geometry.normal.cross(normal);
        geometry.twist = spin_turns * 2 * pi / steps * geometry.normal;
        geometry.normal = normal;
        result.last = rotated_with_contact(result.last, geometry);
        result.largest_length_error =
            std::max(result.largest_length_error, std::abs(result.last.norm() / force.norm() - 1));
        result.largest_normal_part = std::max(result.largest_normal_part, std::abs(result.last.dot(normal)));
    }
    return result;
}

TEST(Rotation, of_the_contact_through_a_full_turn_keeps_the_force_length_to_1e_12) {
    for (int steps : {12, 100, 10000}) {
        const Turn turn =
            turn_once(Vector(1, 2, 2) / 3, Vector(2, -2, 1) / 3, Vector(0.2, 0.5, 0.6), steps, 0.3);
        EXPECT_LT(turn.largest_length_error, 1e-12) << steps;
        EXPECT_LT(turn.largest_normal_part, 1e-15) << steps;
    }
}

TEST(Rotation, through_a_full_turn_about_an_axis_in_the_contact_plane_brings_the_force_back) {
    for (int steps : {50, 1000}) {
        const Turn turn = turn_once(Vector::UnitX(), Vector::UnitZ(), Vector(0.6, 0.8, 0), steps);
        // A step of angle s stretches one component by s^6/32: 6e-6 of it over 50 steps, rounding over 1000.
        EXPECT_LT((turn.last - turn.first).norm(), steps == 50 ? 5e-6 : 1e-12) << steps;
    }
}

TEST(Rotation, twist_turns_the_force_about_the_normal) {
    const Turn turn = turn_once(Vector::UnitZ(), Vector::UnitZ(), Vector(0.6, 0.8, 0), 1000, 0.25);
    // A Cayley step turns by 2 atan(w/2) for w: w^3/12 a step, here 4e-7 in all.
    EXPECT_LT((turn.last - Vector(-0.8, 0.6, 0)).norm(), 1e-6);
}

TEST(Rotation, with_tilt_and_twist_together_converges_with_the_step_to_second_order) {
    // Carried around a cone of half-angle 60 degrees, a direction comes back turned by 2 pi (1 - cos 60) =
    // pi about the normal.
    const Vector axis = Vector::UnitZ(), normal(std::sin(pi / 3), 0, std::cos(pi / 3)), across(0, 1, 0);
    double error[2];
    for (int i : {0, 1}) {
        // Minimal rotation from step to step, plus half a turn of spin, brings it back to where it started.
        const Turn turn = turn_once(axis, normal, across, i == 0 ? 500 : 1000, 0.5);
        error[i] = (turn.last - across).norm();
    }
    EXPECT_LT(error[1], 1e-4);
    EXPECT_NEAR(error[0] / error[1], 4, 0.1);
}

TEST(Rotation, leaves_a_contact_that_does_not_turn_bit_for_bit_alone) {
    ContactGeometry geometry;
    geometry.normal = Vector::UnitZ();
    const Vector force(0.1, -0.7, 0);
    EXPECT_EQ(rotated_with_contact(force, geometry), force);
    EXPECT_EQ(rotated_with_contact(Vector::Zero(), geometry), Vector::Zero());
}

TEST(Rotation, keeps_the_length_when_the_normal_jumps_without_notice) {
    ContactGeometry geometry; // as at an edge, where no tilt is reported
    geometry.normal = Vector(0, 0.6, 0.8);
    const Vector turned = rotated_with_contact(Vector(0.3, 0.4, 0), geometry);
    EXPECT_NEAR(turned.norm(), 0.5, 1e-15);
    EXPECT_NEAR(turned.dot(geometry.normal), 0, 1e-15);
}

// Work done on a contact that is sheared at one overlap, unloaded to another, sheared back and loaded again.
template <class Tangential>
double work_of_a_shear_cycle(double deep, double shallow, double shear) {
    using Law = HertzMindlin<Hertz, Tangential, NoDamping, Constant>;
    const ContactParameters parameters = quartz_pair();
    const Constant sticky{1e9};
    ContactMemory memory;
    NoEnergy none;
    ContactGeometry geometry;
    double work = 0;
    Vector before = Vector::Zero();
    const int steps = 200;
    const auto leg = [&](double overlap_from, double overlap_to, double displacement) {
        for (int i = 1; i <= steps; ++i) {
            geometry.overlap = overlap_from + (overlap_to - overlap_from) * i / steps;
            geometry.shear_increment = Vector(0, displacement / steps, 0);
            const ContactForce force = Law::step(geometry, parameters, sticky, memory, none);
            work -= 0.5 * (before + force.shear).dot(geometry.shear_increment);
            before = force.shear;
        }
    };
    leg(deep, deep, shear);
    leg(deep, shallow, 0);
    leg(shallow, shallow, -shear);
    leg(shallow, deep, 0);
    return work;
}

TEST(ShearSpring, unloaded_while_sheared_gives_back_no_more_than_was_put_in) {
    const double deep = 1e-6, shallow = 1e-7, shear = 1e-8;
    // The displacement is kept, so shearing back releases k2 s^2/2 of the k1 s^2/2.
    const double k1 =
        shear_stiffness<Hertz, IncrementalTangential>(quartz_pair().shear_coefficient, std::sqrt(deep));
    const double k2 =
        shear_stiffness<Hertz, IncrementalTangential>(quartz_pair().shear_coefficient, std::sqrt(shallow));
    const double work = work_of_a_shear_cycle<IncrementalTangential>(deep, shallow, shear);
    EXPECT_GE(work, 0);
    EXPECT_NEAR(work, 0.5 * (k1 - k2) * shear * shear, 1e-9 * k1 * shear * shear);
}

TEST(ShearSpring, as_printed_in_equation_4_makes_the_energy_that_rescaling_is_there_to_prevent) {
    const double deep = 1e-6, shallow = 1e-7, shear = 1e-8;
    const double k1 =
        shear_stiffness<Hertz, ReportTangential>(quartz_pair().shear_coefficient, std::sqrt(deep));
    const double k2 =
        shear_stiffness<Hertz, ReportTangential>(quartz_pair().shear_coefficient, std::sqrt(shallow));
    const double work = work_of_a_shear_cycle<ReportTangential>(deep, shallow, shear);
    // k1 s is the force kept down to k2: shearing back returns k1 s^2 - k2 s^2/2 for the k1 s^2/2 put in.
    EXPECT_NEAR(work, -0.5 * (k1 - k2) * shear * shear, 1e-9 * k1 * shear * shear);
    EXPECT_LT(work, 0);
}

TEST(ShearSpring, of_the_secant_law_makes_energy_when_a_sheared_contact_is_pressed_harder) {
    const double deep = 1e-6, shallow = 1e-7, shear = 1e-8;
    const double k1 =
        shear_stiffness<Hertz, SecantTangential>(quartz_pair().shear_coefficient, std::sqrt(shallow));
    const double k2 =
        shear_stiffness<Hertz, SecantTangential>(quartz_pair().shear_coefficient, std::sqrt(deep));
    const double work = work_of_a_shear_cycle<SecantTangential>(shallow, deep, shear);
    EXPECT_NEAR(work, -0.5 * (k2 - k1) * shear * shear, 1e-9 * k2 * shear * shear);
    // The default keeps the force as it stiffens, which costs exactly as much.
    EXPECT_NEAR(work_of_a_shear_cycle<IncrementalTangential>(shallow, deep, shear),
                0.5 * (k2 - k1) * shear * shear, 1e-9 * k2 * shear * shear);
}

TEST(ShearSpring, of_the_secant_law_is_the_stiffness_of_the_moment_times_the_whole_displacement) {
    using Law = HertzMindlin<Hertz, SecantTangential, NoDamping, Constant>;
    ContactGeometry geometry;
    ContactMemory memory;
    NoEnergy none;
    double displacement = 0;
    for (double overlap : {1e-8, 1e-7, 1e-6, 4e-7, 1e-9}) {
        geometry.overlap = overlap;
        geometry.shear_increment = Vector(0, 1e-9, 0);
        displacement += 1e-9;
        const ContactForce force = Law::step(geometry, quartz_pair(), Constant{1e9}, memory, none);
        EXPECT_NEAR(-force.shear.y() / (force.shear_stiffness * displacement), 1, 1e-14);
    }
}

TEST(ShearSpring, adds_up_increments_as_equation_4_does) {
    using Law = HertzMindlin<Hertz, IncrementalTangential, NoDamping, Constant>;
    ContactGeometry geometry;
    geometry.overlap = 1e-6;
    ContactMemory memory;
    NoEnergy none;
    Vector total = Vector::Zero();
    ContactForce force;
    for (int i = 0; i < 50; ++i) {
        geometry.shear_increment = 1e-10 * Vector(0, std::sin(0.1 * i), std::cos(0.3 * i));
        total += geometry.shear_increment;
        force = Law::step(geometry, quartz_pair(), Constant{1e9}, memory, none);
    }
    EXPECT_LT((force.shear + force.shear_stiffness * total).norm(), 1e-13 * force.shear.norm());
    EXPECT_FALSE(force.sliding);
}

TEST(NoTangential, means_no_shear_force_and_nothing_remembered) {
    using Law = HertzMindlin<Hertz, NoTangential, RepulsiveDashpot, Constant>;
    ContactGeometry geometry;
    geometry.overlap = 1e-6;
    geometry.shear_increment = Vector(0, 1e-7, 0);
    geometry.time_step = 1e-7;
    ContactMemory memory;
    NoEnergy none;
    const ContactForce force = Law::step(geometry, quartz_pair(), Constant{0.5}, memory, none);
    EXPECT_GT(force.normal, 0);
    EXPECT_EQ(force.shear, Vector::Zero());
    EXPECT_EQ(memory.shear_force, Vector::Zero());
}

} // namespace
