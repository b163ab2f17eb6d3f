// SPDX-License-Identifier: GPL-2.0-or-later
#include "laws_impact.hpp"

#include <laws/friction/constant.hpp>
#include <laws/normal_force.hpp>
#include <laws/pair_rules.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace grainfall::laws;
using grainfall::testing::closed_form_duration;
using grainfall::testing::closed_form_overlap;
using grainfall::testing::HeadOn;

template <class Normal>
double force(double coefficient, double overlap) {
    return Normal::force(coefficient, overlap, std::sqrt(overlap));
}

TEST(NormalForce, hertz_equals_the_closed_form_over_ten_decades_of_overlap) {
    const ElasticMaterial quartz{70e9, 0.2}, steel{208e9, 0.3};
    const double modulus = effective_modulus(quartz, steel), radius = effective_radius(0.36e-3, 5e-3);
    const double coefficient = contact_parameters(modulus, 1, radius, 1, 0).normal_coefficient;
    for (double overlap = 1e-14; overlap < 1e-3; overlap *= 10) {
        const double expected = 4.0 / 3 * modulus * std::sqrt(radius) * std::pow(overlap, 1.5);
        EXPECT_NEAR(force<Hertz>(coefficient, overlap), expected, 1e-14 * expected);
    }
}

TEST(NormalForce, the_printed_equation_3_is_what_the_report_law_computes) {
    const double shear_modulus = 1e9, poisson = 0.4, r1 = 2.5e-3, r2 = 4e-3, overlap = 3e-6;
    const ElasticMaterial grain{2 * shear_modulus * (1 + poisson), poisson};
    const double r_e = r1 * r2 / (r1 + r2);
    const double printed = 2 * shear_modulus / (3 * (1 - poisson)) * std::sqrt(r_e) * std::pow(overlap, 1.5);
    const double coefficient =
        contact_parameters(effective_modulus(grain, grain), 1, r_e, 1, 0).normal_coefficient;
    EXPECT_NEAR(force<ReportNormal>(coefficient, overlap), printed, 1e-14 * printed);
}

TEST(NormalForce, the_report_law_is_exactly_half_of_hertz_in_force_stiffness_and_energy) {
    for (double overlap : {1e-12, 3.7e-8, 2e-5}) {
        const double root = std::sqrt(overlap);
        EXPECT_EQ(ReportNormal::force(1.7e8, overlap, root), 0.5 * Hertz::force(1.7e8, overlap, root));
        EXPECT_EQ(ReportNormal::stiffness(1.7e8, root), 0.5 * Hertz::stiffness(1.7e8, root));
        EXPECT_EQ(ReportNormal::elastic_energy(1.7e8, overlap, root),
                  0.5 * Hertz::elastic_energy(1.7e8, overlap, root));
    }
}

template <class Normal>
void expect_roots_of_factor() {
    EXPECT_DOUBLE_EQ(Normal::square_root_of_factor, std::sqrt(Normal::factor));
    EXPECT_DOUBLE_EQ(Normal::cube_root_of_factor, std::cbrt(Normal::factor));
    EXPECT_DOUBLE_EQ(Normal::sixth_root_of_factor, std::sqrt(std::cbrt(Normal::factor)));
}

TEST(NormalForce, the_written_out_roots_are_those_of_the_factor) {
    expect_roots_of_factor<Hertz>();
    expect_roots_of_factor<ReportNormal>();
}

TEST(NormalForce, the_stiffness_is_the_derivative_and_the_energy_the_integral_of_the_force) {
    const double coefficient = 2.3e8, overlap = 4e-6, h = 1e-3 * overlap;
    // Central difference: relative error h^2/24 of the third derivative, here 1e-7.
    const double slope =
        (force<Hertz>(coefficient, overlap + h) - force<Hertz>(coefficient, overlap - h)) / (2 * h);
    EXPECT_NEAR(Hertz::stiffness(coefficient, std::sqrt(overlap)) / slope, 1, 1e-6);

    double work = 0;
    const int n = 2000;
    for (int i = 0; i < n; ++i)
        work += force<Hertz>(coefficient, (i + 0.5) * overlap / n) * overlap / n;
    EXPECT_NEAR(Hertz::elastic_energy(coefficient, overlap, std::sqrt(overlap)) / work, 1, 1e-6);
}

TEST(NormalForce, nothing_acts_at_first_touch) {
    EXPECT_EQ(force<Hertz>(1e9, 0), 0);
    EXPECT_EQ(Hertz::stiffness(1e9, 0.0), 0);
    EXPECT_EQ(Hertz::elastic_energy(1e9, 0, 0), 0);
}

// Chung & Ooi (2011), Granular Matter 13:643, tests 1 and 2; expected values are Hertz's closed form for
// their materials.
struct ElasticImpact {
    const char* name;
    double radius; // m
    ElasticMaterial material;
    double density;        // kg/m3
    bool on_plane;         // a rigid plane instead of a second sphere
    double approach_speed; // m/s
    double overlap;        // m
    double force;          // N
    double duration;       // s
};

class ChungOoi : public ::testing::TestWithParam<ElasticImpact> {};

TEST_P(ChungOoi, elastic_impact_has_the_peak_force_overlap_and_duration_of_the_closed_form) {
    const ElasticImpact& test = GetParam();
    const double ball_mass = 4.0 / 3 * detail::pi * std::pow(test.radius, 3) * test.density;
    const ElasticMaterial rigid{infinite, 0.3};
    const double modulus = effective_modulus(test.material, test.on_plane ? rigid : test.material);
    const double radius = effective_radius(test.radius, test.on_plane ? infinite : test.radius);
    const double mass = effective_mass(ball_mass, test.on_plane ? infinite : ball_mass);
    const ContactParameters parameters = contact_parameters(modulus, 0, radius, mass, 0);
    using Law = HertzMindlin<Hertz, NoTangential, NoDamping, friction::Constant>;
    const HeadOn result = grainfall::testing::head_on_impact<Law>(parameters, friction::Constant{0}, mass,
                                                                  test.approach_speed, 500);
    // 500 steps a contact: the integrator is good to 1e-5; the published numbers carry five to six digits.
    EXPECT_NEAR(result.peak_overlap / test.overlap, 1, 5e-5);
    EXPECT_NEAR(result.peak_force / test.force, 1, 5e-5);
    EXPECT_NEAR(result.duration / test.duration, 1, 5e-5);
    EXPECT_NEAR(result.restitution, 1, 1e-5);
}

INSTANTIATE_TEST_SUITE_P(
    tests_1_and_2, ChungOoi,
    ::testing::Values(
        ElasticImpact{
            "glass_spheres", 0.01, {4.8e10, 0.20}, 2800, false, 20, 274.113e-6, 10.6969e3, 40.339e-6},
        ElasticImpact{
            "limestone_spheres", 0.01, {2.0e10, 0.25}, 2500, false, 20, 368.304e-6, 7.10824e3, 54.201e-6},
        ElasticImpact{
            "aluminium_on_plane", 0.1, {7.0e10, 0.30}, 2699, true, 0.2, 49.717e-6, 11.3699e3, 731.66e-6},
        ElasticImpact{
            "magnesium_on_plane", 0.1, {4.0e10, 0.35}, 1800, true, 0.2, 52.123e-6, 7.23268e3, 767.07e-6}),
    [](const auto& parameter) { return std::string(parameter.param.name); });

TEST(NormalForce, an_impact_under_the_report_law_takes_1_32_times_as_long_as_under_hertz) {
    const ContactParameters parameters = contact_parameters(1e10, 0, 1e-3, 1e-5, 0);
    using Law = HertzMindlin<ReportNormal, NoTangential, NoDamping, friction::Constant>;
    const HeadOn report =
        grainfall::testing::head_on_impact<Law>(parameters, friction::Constant{0}, 1e-5, 0.5, 500);
    const double overlap = closed_form_overlap(parameters.normal_coefficient, 1e-5, 0.5);
    EXPECT_NEAR(report.duration / closed_form_duration(overlap, 0.5), std::pow(0.5, -0.4), 1e-4);
    EXPECT_NEAR(report.peak_overlap / overlap, std::pow(0.5, -0.4), 1e-4);
}

} // namespace
