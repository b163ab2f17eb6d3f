// SPDX-License-Identifier: GPL-2.0-or-later
#include <laws/friction/any.hpp>
#include <laws/friction/moisture_factor.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace {

using namespace grainfall::laws;
using namespace grainfall::laws::friction;

constexpr double ten_loads[] = {1e-4, 1e-2, 0.1, 0.7, 1.0, 3.0, 8.0, 15.0, 20.0, 300.0};

TEST(FrictionCurve, constant_is_the_same_at_every_load) {
    for (double load : ten_loads)
        EXPECT_EQ(Constant{0.45}.coefficient(load), 0.45);
}

TEST(FrictionCurve, power_law_is_the_power_within_its_caps) {
    const PowerLaw curve{0.5, 2.0, 0.3, 0.1, 0.9};
    for (double load : ten_loads) {
        const double power = 0.5 * std::pow(load / 2.0, -0.3);
        EXPECT_NEAR(curve.coefficient(load), std::min(0.9, std::max(0.1, power)), 1e-12);
    }
}

TEST(FrictionCurve, exponential_goes_from_mu_0_to_mu_inf) {
    const Exponential curve{0.8, 0.2, 4.0};
    for (double load : ten_loads)
        EXPECT_NEAR(curve.coefficient(load), 0.2 + 0.6 * std::exp(-load / 4.0), 1e-12);
    EXPECT_EQ(curve.coefficient(0), 0.8);
    EXPECT_DOUBLE_EQ(curve.coefficient(1e9), 0.2);
}

TEST(FrictionCurve, asperity_is_alpha_plus_C_over_the_cube_root_below_its_cap) {
    const Asperity curve{0.15, 0.3, 1.2};
    for (double load : ten_loads) {
        EXPECT_NEAR(curve.coefficient(load), std::min(1.2, 0.15 + 0.3 * std::pow(load, -1.0 / 3)), 1e-12);
    }
}

TEST(FrictionCurve, table_is_bilinear_between_its_points_and_constant_beyond) {
    const TableGrid grid{{1, 5, 20}, {0, 0.1}, {0.8, 0.6, 0.5, 0.4, 0.2, 0.1}};
    grid.validate();
    const auto mu = [&](double load, double moisture) {
        return grid.at_moisture(moisture).coefficient(load);
    };
    for (std::size_t i : {0u, 1u, 2u}) {
        for (std::size_t j : {0u, 1u})
            EXPECT_EQ(mu(grid.loads[i], grid.moistures[j]), grid.mu[2 * i + j]);
    }
    for (double load : {1.5, 2.0, 3.7, 4.99}) {
        for (double w : {0.01, 0.05, 0.09}) {
            const double x = (load - 1) / 4, y = w / 0.1;
            const double expected =
                (1 - x) * (1 - y) * 0.8 + (1 - x) * y * 0.6 + x * (1 - y) * 0.5 + x * y * 0.4;
            EXPECT_NEAR(mu(load, w), expected, 1e-12);
        }
    }
    EXPECT_EQ(mu(0, 0), 0.8);
    EXPECT_EQ(mu(1e6, 0.5), 0.1);
    EXPECT_DOUBLE_EQ(grid.at_moisture(0.05).lower_bound(), 0.15);
}

TEST(FrictionCurve, a_table_of_one_point_is_a_constant) {
    const Table table = TableGrid{{5}, {0.1}, {0.37}}.at_moisture(0.02);
    for (double load : ten_loads)
        EXPECT_EQ(table.coefficient(load), 0.37);
}

template <class Curve>
void expect_coles_points(const Curve& curve) {
    curve.validate();
    EXPECT_NEAR(curve.coefficient(1), 0.8, 1e-12);
    EXPECT_NEAR(curve.coefficient(20), 0.2, 1e-12);
    double above = curve.coefficient(1);
    for (double load = 1.5; load < 20; load += 0.5) {
        EXPECT_LT(curve.coefficient(load), above) << "falls all the way, at " << load;
        above = curve.coefficient(load);
    }
}

TEST(ColePreset, every_form_passes_through_0_8_at_1_N_and_0_2_at_20_N) {
    expect_coles_points(cole_power_law());
    expect_coles_points(cole_exponential());
    expect_coles_points(cole_asperity());
}

TEST(ColePreset, power_law_and_asperity_say_nothing_beyond_what_was_measured) {
    for (double load : {0.0, 1e-6, 0.5, 0.999}) {
        EXPECT_EQ(cole_power_law().coefficient(load), 0.8);
        EXPECT_EQ(cole_asperity().coefficient(load), 0.8);
    }
    for (double load : {20.1, 100.0, 1e5}) {
        EXPECT_EQ(cole_power_law().coefficient(load), 0.2);
        EXPECT_EQ(cole_asperity().coefficient(load), 0.2);
    }
    EXPECT_LT(cole_exponential().coefficient(0), 0.95);
    EXPECT_GT(cole_exponential().coefficient(1e5), 0.18);
}

// Statements true of every curve, checked on one of each kind.
template <class Check>
void for_each_curve(Check&& check) {
    const TableGrid grid{{1, 5, 20}, {0, 0.1}, {0.8, 0.6, 0.5, 0.4, 0.2, 0.1}};
    check(Constant{0.45});
    check(PowerLaw{0.5, 2.0, 0.3, 0.1, 0.9});
    check(cole_exponential());
    check(Exponential{0.2, 0.7, 3.0});
    check(Asperity{0.15, 0.3, 1.2});
    check(Asperity{0.15, 0.0, 1.2});
    check(cole_asperity());
    check(grid.at_moisture(0.03));
    check(Combined<PowerLaw, Constant>{cole_power_law(), {0.3}, CombinationRule::geometric});
    check(Any(cole_power_law()));
    check(Any::combined(grid.at_moisture(0.03),
                        Any::combined(Constant{0.4}, Asperity{0.1, 0.4, 0.7}, CombinationRule::mean),
                        CombinationRule::maximum));
}

TEST(FrictionCurve, never_lies_below_its_lower_bound) {
    for_each_curve([](const auto& curve) {
        EXPECT_GE(curve.coefficient(0), curve.lower_bound());
        for (double load : ten_loads)
            EXPECT_GE(curve.coefficient(load), curve.lower_bound());
    });
}

TEST(FrictionCurve, is_finite_without_load_and_under_any_load) {
    for_each_curve([](const auto& curve) {
        EXPECT_TRUE(std::isfinite(curve.coefficient(0)));
        EXPECT_TRUE(std::isfinite(curve.coefficient(std::numeric_limits<double>::min())));
        EXPECT_TRUE(std::isfinite(curve.coefficient(1e300)));
        EXPECT_EQ(curve.scaled(0).coefficient(0), 0);
        EXPECT_EQ(curve.scaled(0).coefficient(10), 0);
    });
}

TEST(FrictionCurve, a_moisture_factor_multiplies_every_value_and_the_bound) {
    for_each_curve([](const auto& curve) {
        const auto wet = curve.scaled(0.7);
        for (double load : ten_loads)
            EXPECT_NEAR(wet.coefficient(load), 0.7 * curve.coefficient(load), 1e-14);
        EXPECT_NEAR(wet.lower_bound(), 0.7 * curve.lower_bound(), 1e-15);
    });
}

TEST(FrictionCurve, enlarged_grains_are_read_at_their_load_divided_by_k_squared) {
    for_each_curve([](const auto& curve) {
        const auto enlarged = curve.with_load_scale(36.0);
        for (double load : ten_loads) {
            EXPECT_NEAR(enlarged.coefficient(load), curve.coefficient(load / 36.0), 1e-12);
        }
        EXPECT_NEAR(enlarged.lower_bound(), curve.lower_bound(), 1e-15);
    });
}

TEST(FrictionCurve, of_two_surfaces_follows_the_rule_at_each_load) {
    const PowerLaw sand = cole_power_law();
    const Constant metal{0.3};
    for (double load : ten_loads) {
        for (CombinationRule rule : {CombinationRule::minimum, CombinationRule::maximum,
                                     CombinationRule::mean, CombinationRule::geometric}) {
            const double expected = combine(rule, sand.coefficient(load), 0.3);
            EXPECT_DOUBLE_EQ((Combined<PowerLaw, Constant>{sand, metal, rule}.coefficient(load)), expected);
            EXPECT_DOUBLE_EQ(Any::combined(sand, metal, rule).coefficient(load), expected);
        }
    }
}

TEST(MoistureFactor, is_straight_between_its_points_and_constant_beyond) {
    const MoistureFactor factor{{0, 0.02, 0.1}, {1, 0.9, 0.5}};
    factor.validate();
    EXPECT_EQ(factor.at(0), 1);
    EXPECT_NEAR(factor.at(0.01), 0.95, 1e-14);
    EXPECT_NEAR(factor.at(0.02), 0.9, 1e-14);
    EXPECT_NEAR(factor.at(0.05), 0.9 - 0.4 * 0.03 / 0.08, 1e-14);
    EXPECT_EQ(factor.at(0.3), 0.5);
}

// Each wrong value, and the whole complaint about it.
template <class Input>
std::string complaint(const Input& input) {
    try {
        input.validate();
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "nothing was thrown";
}

const double nan = std::numeric_limits<double>::quiet_NaN();
const double inf = std::numeric_limits<double>::infinity();

TEST(FrictionInput, a_bad_number_is_refused_by_name_value_and_range) {
    EXPECT_EQ(complaint(Constant{-0.1}), "ConstantFriction.mu = -0.1: must be >= 0 and finite");
    EXPECT_EQ(complaint(Constant{nan}), "ConstantFriction.mu = nan: must be >= 0 and finite");
    EXPECT_EQ(complaint(PowerLaw{0, 1, 1, 0, 1}), "PowerLawFriction.muRef = 0: must be > 0 and finite");
    EXPECT_EQ(complaint(PowerLaw{1, -2, 1, 0, 1}), "PowerLawFriction.loadRef = -2: must be > 0 and finite");
    EXPECT_EQ(complaint(PowerLaw{1, 1, -1, 0, 1}), "PowerLawFriction.exponent = -1: must be >= 0 and finite");
    EXPECT_EQ(complaint(PowerLaw{1, 1, 1, -1, 1}), "PowerLawFriction.muMin = -1: must be >= 0 and finite");
    EXPECT_EQ(complaint(PowerLaw{1, 1, 1, 0, inf}), "PowerLawFriction.muMax = inf: must be >= 0 and finite");
    EXPECT_EQ(complaint(PowerLaw{1, 1, 1, 0.5, 0.4}), "PowerLawFriction.muMax = 0.4: must be at least muMin");
    EXPECT_EQ(complaint(Exponential{-1, 0, 1}), "ExponentialFriction.mu0 = -1: must be >= 0 and finite");
    EXPECT_EQ(complaint(Exponential{1, -1, 1}), "ExponentialFriction.muInf = -1: must be >= 0 and finite");
    EXPECT_EQ(complaint(Exponential{1, 1, 0}), "ExponentialFriction.loadScale = 0: must be > 0 and finite");
    EXPECT_EQ(complaint(Asperity{nan, 0, 1}), "AsperityFriction.alpha = nan: must be a finite number");
    EXPECT_EQ(complaint(Asperity{0, -1, 1}), "AsperityFriction.c = -1: must be >= 0 and finite");
    EXPECT_EQ(complaint(Asperity{0, 1, -1}), "AsperityFriction.muMax = -1: must be >= 0 and finite");
    EXPECT_EQ(complaint(Asperity{0, 1, 1, -2}), "AsperityFriction.muMin = -2: must be >= 0 and finite");
    EXPECT_EQ(complaint(Asperity{0, 1, 0.1, 0.2}), "AsperityFriction.muMax = 0.1: must be at least muMin");
}

TEST(FrictionInput, a_bad_list_is_refused_by_the_element_that_is_wrong) {
    EXPECT_EQ(complaint(TableGrid{{}, {0}, {}}),
              "TableFriction.loads = []: must be a list of at least one number");
    EXPECT_EQ(complaint(TableGrid{{1, 1}, {0}, {0, 0}}),
              "TableFriction.loads[1] = 1: must be above the element before it (1)");
    EXPECT_EQ(complaint(TableGrid{{-1, 1}, {0}, {0, 0}}),
              "TableFriction.loads[0] = -1: must be >= 0 and finite");
    EXPECT_EQ(complaint(TableGrid{{1}, {nan}, {0}}),
              "TableFriction.moistures[0] = nan: must be >= 0 and finite");
    EXPECT_EQ(
        complaint(TableGrid{{1, 2}, {0}, {0.5}}),
        "TableFriction.mu = list of length 1: must be of length 2 (one value for each load and moisture)");
    EXPECT_EQ(complaint(TableGrid{{1, 2}, {0}, {0.5, -0.5}}),
              "TableFriction.mu[1] = -0.5: must be >= 0 and finite");
    EXPECT_EQ(complaint(MoistureFactor{{0.1, 0.0}, {1, 1}}),
              "MoistureFactor.moistures[1] = 0: must be above the element before it (0.1)");
    EXPECT_EQ(complaint(MoistureFactor{{0, 0.1}, {1}}),
              "MoistureFactor.factors = list of length 1: must be of length 2 (one for each moisture)");
    EXPECT_EQ(complaint(MoistureFactor{{0}, {-1}}),
              "MoistureFactor.factors[0] = -1: must be >= 0 and finite");
    EXPECT_EQ(complaint(Combined<Constant, Constant>{{0.1}, {-1}, CombinationRule::mean}),
              "ConstantFriction.mu = -1: must be >= 0 and finite");
}

} // namespace
