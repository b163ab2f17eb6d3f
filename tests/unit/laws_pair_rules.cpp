// SPDX-License-Identifier: GPL-2.0-or-later
#include <laws/pair_rules.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

namespace {

using namespace grainfall::laws;

const ElasticMaterial quartz{70e9, 0.2}, steel{208e9, 0.3};

TEST(PairRules, effective_moduli_are_those_of_hertz_and_mindlin) {
    EXPECT_NEAR(effective_modulus(quartz, steel), 1 / (0.96 / 70e9 + 0.91 / 208e9), 1e-3);
    const double g_quartz = 70e9 / 2.4, g_steel = 208e9 / 2.6;
    EXPECT_NEAR(effective_shear_modulus(quartz, steel), 1 / (1.8 / g_quartz + 1.7 / g_steel), 1e-3);
    EXPECT_EQ(effective_modulus(quartz, steel), effective_modulus(steel, quartz));
    EXPECT_EQ(effective_shear_modulus(quartz, steel), effective_shear_modulus(steel, quartz));
}

TEST(PairRules, for_one_material_the_moduli_are_G_over_1_minus_nu_and_G_over_4_minus_2_nu) {
    EXPECT_NEAR(effective_modulus(quartz, quartz) / (shear_modulus(quartz) / 0.8), 1, 1e-14);
    EXPECT_NEAR(effective_shear_modulus(quartz, quartz) / (shear_modulus(quartz) / 3.6), 1, 1e-14);
}

TEST(PairRules, a_wall_is_infinitely_large_and_a_held_body_infinitely_heavy) {
    EXPECT_DOUBLE_EQ(effective_radius(2e-3, 3e-3), 1.2e-3);
    EXPECT_EQ(effective_radius(2e-3, infinite), 2e-3);
    EXPECT_EQ(effective_radius(infinite, 2e-3), 2e-3);
    EXPECT_EQ(effective_mass(infinite, 1e-5), 1e-5);
    EXPECT_DOUBLE_EQ(effective_mass(1e-5, 1e-5), 5e-6);
}

TEST(PairRules, combine_as_their_names_say) {
    EXPECT_EQ(combine(CombinationRule::minimum, 0.2, 0.8), 0.2);
    EXPECT_EQ(combine(CombinationRule::maximum, 0.2, 0.8), 0.8);
    EXPECT_DOUBLE_EQ(combine(CombinationRule::mean, 0.2, 0.8), 0.5);
    EXPECT_DOUBLE_EQ(combine(CombinationRule::geometric, 0.2, 0.8), 0.4);
    EXPECT_EQ(combination_rule_from_name("frictionRule", "min"), CombinationRule::minimum);
    EXPECT_EQ(combination_rule_from_name("frictionRule", "max"), CombinationRule::maximum);
    EXPECT_EQ(combination_rule_from_name("frictionRule", "mean"), CombinationRule::mean);
    EXPECT_EQ(combination_rule_from_name("frictionRule", "geometric"), CombinationRule::geometric);
}

TEST(LoadScale, of_grains_made_k_times_larger_is_k_squared) {
    EXPECT_DOUBLE_EQ(load_scale(5e-3, 0.5e-3, 5e-3, 0.5e-3), 100);
    EXPECT_DOUBLE_EQ(load_scale(4e-3, 0.5e-3, 2e-3, 0.25e-3), 64);
}

TEST(LoadScale, of_an_enlarged_grain_on_a_flat_wall_is_the_same_from_either_side) {
    EXPECT_DOUBLE_EQ(load_scale(3e-3, 1e-3, infinite, 0), 9);
    EXPECT_DOUBLE_EQ(load_scale(infinite, 0, 3e-3, 1e-3), 9);
    // A reference radius has no meaning for a plane.
    EXPECT_DOUBLE_EQ(load_scale(infinite, 1e-3, 3e-3, 1e-3), 9);
}

TEST(LoadScale, without_a_reference_radius_is_one) {
    EXPECT_EQ(load_scale(3e-3, 0, 2e-3, 0), 1);
    EXPECT_EQ(load_scale(infinite, 0, infinite, 0), 1);
}

TEST(LoadScale, of_an_enlarged_grain_on_a_round_body_of_true_size_uses_the_reduced_radii) {
    // R* = 3 * 6 / 9 = 2 mm stands for 1 * 6 / 7 = 6/7 mm.
    EXPECT_NEAR(load_scale(3e-3, 1e-3, 6e-3, 0), std::pow(7.0 / 3, 2), 1e-12);
}

TEST(ContactParameters, between_two_held_bodies_have_no_dashpot) {
    const ContactParameters parameters = contact_parameters(1e10, 1e9, 1e-3, infinite, 0.3);
    EXPECT_EQ(parameters.normal_damping, 0);
    EXPECT_EQ(parameters.shear_damping, 0);
    EXPECT_GT(parameters.normal_coefficient, 0);
}

template <class Action>
std::string complaint(Action&& action) {
    try {
        action();
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "nothing was thrown";
}

TEST(PairRules, a_bad_value_is_refused_by_name_value_and_range) {
    const auto material = [](double young, double poisson) {
        return complaint([=] { validate(ElasticMaterial{young, poisson}, "GrainMat"); });
    };
    EXPECT_EQ(material(-1, 0.2), "GrainMat.young = -1: must be > 0 and finite");
    EXPECT_EQ(material(0, 0.2), "GrainMat.young = 0: must be > 0 and finite");
    EXPECT_EQ(material(infinite, 0.2), "GrainMat.young = inf: must be > 0 and finite");
    EXPECT_EQ(material(1e9, 0.6), "GrainMat.poisson = 0.6: must be in (-1, 0.5]");
    EXPECT_EQ(material(1e9, -1), "GrainMat.poisson = -1: must be in (-1, 0.5]");
    EXPECT_EQ(material(1e9, std::nan("")), "GrainMat.poisson = nan: must be in (-1, 0.5]");
    EXPECT_EQ(complaint([] { combination_rule_from_name("frictionRule", "median"); }),
              "frictionRule = 'median': must be 'min', 'max', 'mean' or 'geometric'");
    EXPECT_EQ(complaint([] { damping_ratio_from_restitution(1.1, false); }),
              "restitution = 1.1: must be in [0.01, 1]");
    EXPECT_EQ(complaint([] { damping_ratio_from_restitution(0, true); }),
              "restitution = 0: must be in [0.01, 1]");
    EXPECT_EQ(complaint([] { damping_ratio_from_restitution(std::nan(""), true); }),
              "restitution = nan: must be in [0.01, 1]");
    EXPECT_EQ(complaint([] { restitution_from_damping_ratio(-0.1, true); }),
              "dampingRatio = -0.1: must be >= 0 and finite");
}

} // namespace
