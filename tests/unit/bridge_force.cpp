// SPDX-License-Identifier: GPL-2.0-or-later
#include <laws/bridge/lubrication.hpp>
#include <laws/bridge/water.hpp>
#include <laws/bridge/willett.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace {

using namespace grainfall::laws::bridge;
using grainfall::laws::infinite;
using grainfall::laws::detail::pi;

struct Exact {
    double volume, angle, fraction, separation, force, longest; // over powers of R; F/(2 pi R gamma)
};

// Own numerical solution of the Young-Laplace equation, see the first line of the file.
std::vector<Exact> exact_solutions() {
    std::ifstream file(GRAINFALL_TEST_DATA "/young_laplace/force.csv");
    std::string line;
    std::getline(file, line);
    std::getline(file, line);
    std::vector<Exact> rows;
    while (std::getline(file, line)) {
        Exact row{};
        char comma = 0;
        double degrees = 0;
        std::istringstream(line) >> row.volume >> comma >> degrees >> comma >> row.fraction >> comma >>
            row.separation >> comma >> row.force >> comma >> row.longest;
        row.angle = degrees * pi / 180;
        rows.push_back(row);
    }
    return rows;
}

// F/(2 pi R gamma) for R = 1, gamma = 1/(2 pi).
template <class Form>
double relative_force(const Exact& at) {
    const ForceCurve curve = Form::curve(1, at.volume, 1 / (2 * pi), at.angle);
    return Form::force(curve, at.separation);
}

TEST(BridgeForce, fit_follows_the_young_laplace_equation_within_the_error_of_the_fit) {
    const auto rows = exact_solutions();
    ASSERT_GT(rows.size(), 80u);
    for (const Exact& row : rows) {
        const double error = relative_force<WillettNumeric>(row) / row.force - 1;
        const double near = row.angle > 0 ? 0.04 : 0.025, far = row.angle > 0 ? 0.14 : 0.10;
        const double allowed = row.fraction < 0.8 ? near : far;
        EXPECT_LT(std::abs(error), allowed)
            << "V* " << row.volume << ", theta " << row.angle << ", at " << row.fraction;
    }
}

TEST(BridgeForce, closed_form_is_high_at_contact_and_low_when_stretched) {
    for (const Exact& row : exact_solutions()) {
        if (row.angle > 0)
            continue;
        const double error = relative_force<WillettClosed>(row) / row.force - 1;
        if (row.fraction == 0) {
            EXPECT_GT(error, 0.03) << row.volume;
            EXPECT_LT(error, 0.26) << row.volume;
        } else if (row.fraction >= 0.75) {
            EXPECT_LT(error, -0.05) << row.volume;
            EXPECT_GT(error, -0.30) << row.volume;
        }
    }
}

TEST(BridgeForce, longest_bridge_is_that_of_the_rupture_distance) {
    for (const Exact& row : exact_solutions())
        EXPECT_NEAR(rupture_distance(1, row.volume, row.angle) / row.longest, 1, 0.06)
            << row.volume << ", " << row.angle;
}

// YADE's scripts/checks-and-tests/checks/checkCapillaryModels.py, its own tolerance of 1e-4: spheres drawn
// apart at 1 mm/s for 249 steps of 1 us from an overlap of 1e-5 (R1 + R2).
TEST(BridgeForce, agrees_with_the_regression_values_of_yade) {
    const double angle = 10 * pi / 180, small = 19e-6;
    const auto pulled = [](double sum) { return 249e-9 - 1e-5 * sum; };
    {
        const double radius = equal_sphere_radius(small, 35e-6);
        const ForceCurve curve = WillettNumeric::curve(radius, 2e-19, 0.027, angle);
        EXPECT_NEAR(WillettNumeric::force(curve, pulled(54e-6)) / 2.07328148666e-7, 1, 1e-4);
    }
    {
        const double radius = equal_sphere_radius(small, 32.5e-6);
        const ForceCurve curve = WillettClosed::curve(radius, 12e-19, 0.024, angle);
        EXPECT_NEAR(WillettClosed::force(curve, pulled(51.5e-6)) / 6.78192074e-7, 1, 1e-4);
    }
}

template <class Form>
void falls_steadily_from_contact() {
    for (double log_volume = -6; log_volume <= 0; log_volume += 0.25) {
        for (double angle : {0.0, 0.2, 0.5, largest_contact_angle}) {
            const double volume = std::pow(10, log_volume);
            const ForceCurve curve = Form::curve(1, volume, 0.07, angle);
            EXPECT_GT(curve.contact_force, 0);
            EXPECT_EQ(Form::force(curve, -1e-3), curve.contact_force);
            EXPECT_EQ(Form::force(curve, 0), curve.contact_force);
            // Continuous: a bridge is stretched by atoms without noticing.
            EXPECT_NEAR(Form::force(curve, 1e-12) / curve.contact_force, 1, 1e-3) << volume << " " << angle;
            double before = curve.contact_force;
            const double end = rupture_distance(1, volume, angle);
            for (int i = 1; i <= 100; ++i) {
                const double force = Form::force(curve, end * i / 100);
                EXPECT_LT(force, before) << volume << " " << angle << " " << i;
                EXPECT_GT(force, 0);
                before = force;
            }
        }
    }
}

TEST(BridgeForce, falls_steadily_from_its_value_at_contact_over_the_whole_range) {
    falls_steadily_from_contact<WillettNumeric>();
    falls_steadily_from_contact<WillettClosed>();
}

TEST(BridgeForce, scales_with_size_and_surface_tension) {
    const double k = 12.5, volume = 3e-11, radius = 1e-3;
    const ForceCurve real = WillettNumeric::curve(radius, volume, 0.07, 0.3);
    const ForceCurve coarse = WillettNumeric::curve(k * radius, k * k * k * volume, k * 0.07, 0.3);
    for (double separation : {0.0, 1e-5, 1e-4}) {
        EXPECT_NEAR(WillettNumeric::force(coarse, k * separation) / WillettNumeric::force(real, separation) /
                        (k * k),
                    1, 1e-12);
    }
}

TEST(BridgeForce, holds_a_grain_on_a_flat_wall_with_twice_the_radius) {
    const double grain = 4e-4;
    EXPECT_DOUBLE_EQ(equal_sphere_radius(grain, infinite), 2 * grain);
    EXPECT_DOUBLE_EQ(equal_sphere_radius(infinite, grain), 2 * grain);
    EXPECT_DOUBLE_EQ(equal_sphere_radius(grain, grain), grain);
    // Perfect wetting and little liquid: 4 pi R1 gamma, the classical value for a sphere on a plane.
    const ForceCurve curve = WillettNumeric::curve(2 * grain, 1e-6 * std::pow(grain, 3), 0.07, 0);
    EXPECT_NEAR(curve.contact_force / (4 * pi * grain * 0.07), 1, 0.03);
}

TEST(SqueezeFilm, is_reynolds_film_while_the_gap_is_small) {
    const double radius = 3.6e-4, viscosity = 1e-3, gap = 1e-6;
    const FilmParameters film = SqueezeFilm::parameters(radius, 1e-12, viscosity, 1e-9, infinite);
    const double reynolds = 1.5 * pi * viscosity * radius * radius / gap; // equal spheres
    const double x = 1 - gap / std::sqrt(gap * gap + 2e-12 / (pi * radius));
    EXPECT_NEAR(SqueezeFilm::damping(film, gap, 1e-9) / (reynolds * x * x), 1, 1e-12);
    EXPECT_NEAR(SqueezeFilm::damping(film, gap, 1e-9) / reynolds, 1, 0.06);
    EXPECT_NEAR(reynolds, 6.1e-4, 0.05e-4); // N at 1 m/s
}

TEST(SqueezeFilm, is_finite_at_contact_and_falls_with_the_gap) {
    const FilmParameters film = SqueezeFilm::parameters(3.6e-4, 1e-12, 1e-3, 1e-6, infinite);
    const double contact = SqueezeFilm::damping(film, 0, 1e-9);
    EXPECT_TRUE(std::isfinite(contact));
    EXPECT_EQ(SqueezeFilm::damping(film, -1e-6, 1e-9), contact);
    double before = SqueezeFilm::damping(film, 1e-6, 1e-9);
    EXPECT_EQ(before, contact);
    for (double gap = 2e-6; gap < 1e-3; gap *= 1.5) {
        const double now = SqueezeFilm::damping(film, gap, 1e-9);
        EXPECT_LT(now, before);
        EXPECT_GE(now, 0);
        before = now;
    }
}

TEST(SqueezeFilm, of_a_thick_liquid_never_stops_more_than_a_quarter_of_the_approach_in_a_step) {
    const double mass = 2.6e-7, time_step = 1e-6;
    const FilmParameters film = SqueezeFilm::parameters(3.6e-4, 1e-12, 10, 1e-6, mass);
    EXPECT_DOUBLE_EQ(SqueezeFilm::damping(film, 0, time_step) * time_step / mass, 0.25);
    EXPECT_LT(SqueezeFilm::damping(film, 0, 1e-9) * 1e-9 / mass, 0.25);
}

WaterSource grain_source(double share, double tension = 0.07) {
    return {std::nan(""), share, tension, 1e-3, 0.2};
}

TEST(BridgeWater, is_what_both_grains_share) {
    const BridgeWater water = bridge_water(grain_source(2e-12), grain_source(1e-12));
    EXPECT_DOUBLE_EQ(water.volume(), 3e-12);
    EXPECT_DOUBLE_EQ(water.from_first, 2e-12);
}

TEST(BridgeWater, at_the_moisture_of_the_report_fills_bridges_of_equal_grains_to_0_085) {
    const double radius = 3.6e-4, mass = 4.0 / 3 * pi * std::pow(radius, 3) * 2650;
    const double share = carried_water(0.023, mass) / 6;
    const BridgeWater water = bridge_water(grain_source(share), grain_source(share));
    EXPECT_NEAR(water.volume() / std::pow(radius, 3), 0.0851, 0.0001);
    EXPECT_NEAR(relative_volume_of_equal_grains(0.023, 2650, 6), water.volume() / std::pow(radius, 3), 1e-12);
}

TEST(BridgeWater, stated_on_both_sides_comes_in_halves_and_on_one_side_from_there) {
    const WaterSource stated{5e-12, 0, 0.07, 0, 0}, other{3e-12, 0, 0.07, 0, 0};
    EXPECT_DOUBLE_EQ(bridge_water(stated, stated).volume(), 5e-12);
    EXPECT_DOUBLE_EQ(bridge_water(stated, other).volume(), 4e-12);
    const BridgeWater one_sided = bridge_water(grain_source(9e-12), stated);
    EXPECT_DOUBLE_EQ(one_sided.volume(), 5e-12);
    EXPECT_DOUBLE_EQ(one_sided.from_first, 0);
    const WaterSource none{0, 0, 0.07, 0, 0};
    EXPECT_EQ(bridge_water(none, grain_source(9e-12)).volume(), 0);
}

TEST(BridgeWater, has_the_properties_of_the_liquid_that_is_there_and_the_mean_contact_angle) {
    WaterSource dry_wall = grain_source(0, 0.03);
    dry_wall.contact_angle = 0.6;
    const BridgeWater water = bridge_water(grain_source(2e-12, 0.07), dry_wall);
    EXPECT_DOUBLE_EQ(water.surface_tension, 0.07);
    EXPECT_DOUBLE_EQ(water.contact_angle, 0.4);
}

} // namespace
