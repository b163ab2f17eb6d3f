// SPDX-License-Identifier: GPL-2.0-or-later
#include "laws_impact.hpp"

#include <laws/damping.hpp>
#include <laws/friction/constant.hpp>
#include <laws/pair_rules.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

namespace {

using namespace grainfall::laws;
using grainfall::testing::HeadOn;
using Without = friction::Constant;

template <class Damping, class Normal = Hertz>
HeadOn damped_impact(double restitution, double speed, double steps) {
    const double mass = 3e-4;
    const double zeta = damping_ratio_from_restitution(restitution, Damping::attracts);
    const ContactParameters parameters = contact_parameters(6e10, 0, 1.25e-3, mass, zeta);
    return grainfall::testing::head_on_impact<HertzMindlin<Normal, NoTangential, Damping, Without>>(
        parameters, Without{0}, mass, speed, steps);
}

// Restitution of m x'' + c x' + F = 0 by Runge-Kutta in dimensionless form, to check the closed form
// without using it.
double restitution_by_integration(double zeta) {
    const double damping = 2 * zeta * std::sqrt(1.5);
    const auto acceleration = [damping](double x, double v) {
        const double root = std::sqrt(std::max(x, 0.0));
        return -x * root - damping * std::sqrt(root) * v;
    };
    double x = 0, v = 1;
    const double h = 2e-5;
    for (;;) {
        const double a1 = acceleration(x, v);
        const double v2 = v + h / 2 * a1, a2 = acceleration(x + h / 2 * v, v2);
        const double v3 = v + h / 2 * a2, a3 = acceleration(x + h / 2 * v2, v3);
        const double v4 = v + h * a3, a4 = acceleration(x + h * v3, v4);
        x += h / 6 * (v + 2 * v2 + 2 * v3 + v4);
        v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
        if (v < 0 && acceleration(x, v) >= 0)
            return -v;
    }
}

TEST(DampingRatio, without_attraction_the_restitution_is_that_of_the_integrated_equation_of_motion) {
    for (double zeta : {0.01, 0.1, 0.5, 0.9, 1.0, 2.0}) {
        // The speed is stationary where the force vanishes, so stopping a step late costs h^2 only; the
        // root at first touch lowers the order and leaves 1e-6.
        EXPECT_NEAR(restitution_from_damping_ratio(zeta, false), restitution_by_integration(zeta), 2e-6)
            << zeta;
    }
}

TEST(DampingRatio, tabulated_values_of_both_endings_are_met_to_their_last_digit) {
    const double table[][3] = {{.01, .966169, .966401}, {.02, .933471, .934368}, {.05, .841701, .846776},
                               {.10, .707351, .724674}, {.20, .493898, .545402}, {.30, .335159, .423113},
                               {.40, .216228, .336479}, {.50, .127881, .273152}, {.70, .023445, .189155}};
    for (const auto& row : table) {
        EXPECT_NEAR(restitution_from_damping_ratio(row[0], true), row[1], 1e-6);
        EXPECT_NEAR(restitution_from_damping_ratio(row[0], false), row[2], 1e-6);
    }
}

TEST(DampingRatio, inverting_gives_back_every_restitution_to_1e_12) {
    for (bool attraction : {false, true}) {
        for (double e = 0.01; e <= 1.0; e += 0.0045) {
            const double zeta = damping_ratio_from_restitution(e, attraction);
            EXPECT_NEAR(restitution_from_damping_ratio(zeta, attraction) / e, 1, 1e-12) << e << attraction;
        }
        EXPECT_EQ(damping_ratio_from_restitution(1.0, attraction), 0);
    }
}

TEST(DampingRatio, with_attraction_it_is_the_formula_of_antypov_and_elliott) {
    const double e = 0.7, log_e = std::log(e);
    const double beta = -log_e / std::sqrt(detail::pi * detail::pi + log_e * log_e);
    EXPECT_NEAR(damping_ratio_from_restitution(e, true), std::sqrt(5.0 / 6) * beta, 1e-15);
}

TEST(DampingRatio, the_closed_form_is_smooth_through_critical_damping) {
    for (double b : {1 - 1.0001e-3, 1 - 0.9999e-3, 1.0, 1 + 0.9999e-3, 1 + 1.0001e-3}) {
        const double exact = b == 1  ? 1
                             : b < 1 ? std::acos(b) / std::sqrt(1 - b * b)
                                     : std::acosh(b) / std::sqrt(b * b - 1);
        EXPECT_NEAR(detail::arc_ratio(b), exact, 1e-12);
    }
    EXPECT_NEAR(restitution_from_damping_ratio(std::sqrt(5.0 / 6), false), std::exp(-2), 1e-12);
}

TEST(DampingRatio, an_attractive_dashpot_beyond_critical_never_lets_go) {
    EXPECT_EQ(restitution_from_damping_ratio(0.92, true), 0);
}

class Restitution : public ::testing::TestWithParam<std::tuple<double, double>> {};

// Leapfrog sees the dashpot's speed half a step late, so the error is first order: 4e-4 (e = 0.2) to 1e-6
// (e = 0.98) at 2000 steps a contact, 5e-3 to 2e-4 at 50.
TEST_P(Restitution, is_the_one_asked_for_at_every_speed) {
    const auto [e, speed] = GetParam();
    EXPECT_NEAR(damped_impact<RepulsiveDashpot>(e, speed, 2000).restitution / e, 1, 5e-4);
    EXPECT_NEAR((damped_impact<RepulsiveDashpot, ReportNormal>(e, speed, 2000).restitution) / e, 1, 5e-4);
    EXPECT_NEAR(damped_impact<AttractiveDashpot>(e, speed, 2000).restitution / e, 1, 5e-4);
}

TEST_P(Restitution, is_within_half_a_percent_with_fifty_steps_a_contact) {
    const auto [e, speed] = GetParam();
    EXPECT_NEAR(damped_impact<RepulsiveDashpot>(e, speed, 50).restitution / e, 1, 5e-3);
}

INSTANTIATE_TEST_SUITE_P(targets_and_speeds, Restitution,
                         ::testing::Combine(::testing::Values(0.2, 0.4, 0.6, 0.8, 0.9, 0.98),
                                            ::testing::Values(1e-3, 0.1, 1.0, 3.9, 100.0)));

TEST(Dashpot, never_pulls_unless_asked) {
    for (double e : {0.2, 0.5, 0.9}) {
        EXPECT_EQ(damped_impact<RepulsiveDashpot>(e, 1, 500).lowest_force, 0);
        EXPECT_LT(damped_impact<AttractiveDashpot>(e, 1, 500).lowest_force, 0);
    }
}

TEST(Dashpot, of_restitution_1_leaves_the_elastic_force_untouched) {
    const HeadOn elastic = damped_impact<NoDamping>(1, 1, 200),
                 damped = damped_impact<RepulsiveDashpot>(1, 1, 200);
    EXPECT_EQ(elastic.peak_force, damped.peak_force);
    EXPECT_EQ(elastic.restitution, damped.restitution);
}

TEST(Dashpot, gives_no_force_at_first_touch_however_fast_the_approach) {
    ContactGeometry geometry;
    geometry.normal_velocity = -1000;
    geometry.shear_increment = Vector(0, 1e-3, 0);
    geometry.time_step = 1e-6;
    ContactMemory memory;
    NoEnergy none;
    using Law = HertzMindlin<Hertz, IncrementalTangential, RepulsiveDashpot, Without>;
    const ContactForce force =
        Law::step(geometry, contact_parameters(1e10, 1e9, 1e-3, 1e-5, 0.5), Without{0.5}, memory, none);
    EXPECT_EQ(force.normal, 0);
    EXPECT_EQ(force.shear, Vector::Zero());
    EXPECT_EQ(memory.shear_force, Vector::Zero());
}

TEST(Dashpot, coefficients_are_twice_zeta_times_the_root_of_mass_and_tangent_stiffness) {
    const double zeta = 0.3, mass = 2e-5, overlap = 1e-6;
    const ContactParameters p = contact_parameters(5e10, 3e10, 1e-3, mass, zeta);
    const double root = std::sqrt(overlap), quarter = std::sqrt(root);
    EXPECT_DOUBLE_EQ(p.normal_damping * quarter,
                     2 * zeta * std::sqrt(mass * Hertz::stiffness(p.normal_coefficient, root)));
    EXPECT_DOUBLE_EQ(
        p.shear_damping * quarter,
        2 * zeta *
            std::sqrt(mass * (shear_stiffness<Hertz, IncrementalTangential>(p.shear_coefficient, root))));
}

template <class Normal, class Tangential>
void expect_shear_dashpot_of_the_law() {
    const double zeta = 0.3, mass = 2e-5, overlap = 1e-6, root = std::sqrt(overlap);
    const ContactParameters parameters = contact_parameters(5e10, 3e10, 1e-3, mass, zeta);
    ContactGeometry geometry;
    geometry.overlap = overlap;
    geometry.time_step = 1e-7;
    geometry.shear_increment = Vector(0, 0, 1e-9);
    ContactMemory memory;
    NoEnergy none;
    using Law = HertzMindlin<Normal, Tangential, RepulsiveDashpot, Without>;
    const ContactForce force = Law::step(geometry, parameters, Without{1e9}, memory, none);
    const double stiffness = shear_stiffness<Normal, Tangential>(parameters.shear_coefficient, root);
    const double coefficient = -(force.shear - memory.shear_force).z() / (1e-9 / 1e-7);
    EXPECT_NEAR(coefficient / (2 * zeta * std::sqrt(mass * stiffness)), 1, 1e-13);
}

TEST(Dashpot, of_the_shear_force_follows_the_shear_stiffness_of_the_law_in_use) {
    expect_shear_dashpot_of_the_law<Hertz, IncrementalTangential>();
    expect_shear_dashpot_of_the_law<Hertz, ReportTangential>();
    expect_shear_dashpot_of_the_law<ReportNormal, IncrementalTangential>();
    expect_shear_dashpot_of_the_law<ReportNormal, ReportTangential>();
}

} // namespace
