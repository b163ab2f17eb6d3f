// SPDX-License-Identifier: GPL-2.0-or-later
#include <engines/time_step/step_control.hpp>
#include <engines/time_step/step_limits.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace grainfall::time_step;

// A sphere of quartz of 0.72 mm: R [m], density [kg/m3], Young's modulus [Pa], Poisson's ratio.
constexpr double radius = 0.36e-3, density = 2650, young = 7e10, poisson = 0.2;
const double mass = 4 * pi / 3 * radius * radius * radius * density;
const double coefficient = 4.0 / 3 * young / (2 * (1 - poisson * poisson)) * std::sqrt(radius / 2);

TEST(StepLimits, impact_limit_is_the_duration_of_hertz_s_impact_over_2_015) {
    for (double speed : {0.01, 1.0, 300.0}) {
        const double overlap = std::pow(1.25 * mass / 2 * speed * speed / coefficient, 0.4);
        const double duration = 2.9432752 * overlap / speed;
        EXPECT_NEAR(impact_limit(coefficient, mass / 2, speed) / (duration / 2.0151), 1, 1e-4);
    }
    EXPECT_EQ(impact_limit(coefficient, mass / 2, 0), no_limit);
}

TEST(StepLimits, overlap_reached_conserves_the_energy_of_the_pair) {
    const double m = mass / 2, now = 2e-7, speed = 0.3;
    const double reached = overlap_reached(coefficient, now, m, speed);
    const auto elastic = [](double d) { return 0.4 * coefficient * std::pow(d, 2.5); };
    EXPECT_NEAR(elastic(reached) / (elastic(now) + 0.5 * m * speed * speed), 1, 1e-12);
    EXPECT_EQ(overlap_reached(coefficient, now, m, -speed), now); // parting
    EXPECT_EQ(overlap_reached(coefficient, now, m, 0), now);
}

TEST(StepLimits, rayleigh_step_of_quartz_sand_is_the_published_one) {
    // G = 29 GPa, nu = 0.31, R = 0.36 mm: 3.69e-7 s.
    EXPECT_NEAR(rayleigh_step(radius, density, 2 * 29e9 * 1.31, 0.31), 3.69e-7, 1e-9);
}

TEST(StepLimits, report_step_of_an_equal_pair_is_eq_7_with_eq_8_as_printed) {
    const double shear_modulus = young / (2 * (1 + poisson)), overlap = 5e-8;
    const double stiffness =
        2 * std::sqrt(2.0) * shear_modulus / (3 * (1 - poisson)) * std::sqrt(radius / 2) * std::sqrt(overlap);
    EXPECT_NEAR(report_step(mass, coefficient, overlap) / (pi / 10 * std::sqrt(mass / stiffness)), 1, 1e-12);
    EXPECT_EQ(report_step(mass, coefficient, 0), no_limit);
}

TEST(StepControl, shrinks_at_once_and_grows_by_no_more_than_it_may) {
    const StepControl control{0, 1.1, 0, no_limit};
    EXPECT_DOUBLE_EQ(control.next(1e-5, 1e-7), 1e-7);
    EXPECT_DOUBLE_EQ(control.next(1e-7, 1e-5), 1.1e-7);
    EXPECT_DOUBLE_EQ(control.next(1e-7, 1.05e-7), 1.05e-7);
}

TEST(StepControl, keeps_a_step_that_is_near_enough_and_never_exceeds_what_is_allowed) {
    const StepControl control{0.05, 1.5, 0, no_limit};
    EXPECT_EQ(control.next(1e-6, 1e-6), 1e-6);
    EXPECT_EQ(control.next(1e-6, 1.1e-6), 1e-6);
    EXPECT_GT(control.next(1e-6, 1.2e-6), 1e-6);
    for (double allowed = 1e-8; allowed < 1e-4; allowed *= 1.07)
        EXPECT_LE(control.next(1e-6, allowed), allowed);
}

TEST(StepControl, stays_within_its_bounds_and_without_a_limit_where_it_is) {
    const StepControl bounded{0.05, 1.1, 1e-7, 1e-6};
    EXPECT_DOUBLE_EQ(bounded.next(5e-7, 1e-12), 1e-7);
    EXPECT_LE(bounded.next(9.9e-7, no_limit), 1e-6);
    EXPECT_DOUBLE_EQ(bounded.first(1e-8, no_limit), 1e-6);
    const StepControl free{0.05, 1.1, 0, no_limit};
    EXPECT_EQ(free.next(3e-7, no_limit), 3e-7);
    EXPECT_EQ(free.first(3e-7, no_limit), 3e-7);
    EXPECT_EQ(free.first(3e-7, 2e-6), 2e-6);
}

// Relative energy error of one elastic Hertz impact, m = K = v = 1, with the step that Eq 8's form gives:
// s * 2/omega(overlap), at most s * 2. `consistent`: with both steps in the velocity's update.
double energy_error(double s, bool consistent) {
    double x = -0.3 * s, v = 1, before = 0;
    while (!(x < 0 && v < 0)) {
        const double root = std::sqrt(std::max(x, 0.0));
        const double step = s * std::min(2.0, leapfrog_limit(1.5 * root));
        const double acceleration = -x * root * (x > 0);
        if (before == 0)
            before = step;
        if (consistent)
            v += acceleration * (before - step) / 2;
        v += acceleration * step;
        x += v * step;
        before = step;
    }
    return std::abs(v * v - 1);
}

TEST(VariableStep, naive_leapfrog_is_first_order_and_the_corrected_one_second) {
    // The order is that between 40 and 640 steps, where the jump in force at the end has averaged out.
    const double naive = std::log2(energy_error(0.05, false) / energy_error(0.003125, false)) / 4;
    EXPECT_NEAR(naive, 1, 0.15);
    for (double s : {0.2, 0.1, 0.05, 0.025, 0.0125})
        EXPECT_LT(energy_error(s, true), 1.0 * s * s) << s;
    EXPECT_GT(energy_error(0.05, false), 100 * energy_error(0.05, true));
}

} // namespace
