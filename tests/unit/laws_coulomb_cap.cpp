// SPDX-License-Identifier: GPL-2.0-or-later
#include <laws/friction/constant.hpp>
#include <laws/friction/power_law.hpp>
#include <laws/friction/table.hpp>
#include <laws/hertz_mindlin.hpp>
#include <laws/pair_rules.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace {

using namespace grainfall::laws;
using friction::Constant;

ContactParameters contact(double zeta) {
    return contact_parameters(5e10, 3e10, 1e-3, 1e-5, zeta);
}

ContactGeometry pressed(double overlap, const Vector& shear_increment = Vector::Zero()) {
    ContactGeometry geometry;
    geometry.overlap = overlap;
    geometry.shear_increment = shear_increment;
    geometry.time_step = 1e-8;
    return geometry;
}

template <class Law, class Friction>
ContactForce drag(const Friction& friction, double zeta, double overlap, const Vector& increment, int steps,
                  ContactMemory& memory) {
    NoEnergy none;
    ContactForce force;
    for (int i = 0; i < steps; ++i)
        force = Law::step(pressed(overlap, increment), contact(zeta), friction, memory, none);
    return force;
}

template <class Friction = Constant>
using Dry = HertzMindlin<Hertz, IncrementalTangential, NoDamping, Friction>;
template <class Friction = Constant>
using Damped = HertzMindlin<Hertz, IncrementalTangential, RepulsiveDashpot, Friction>;

TEST(CoulombCap, a_sliding_contact_carries_exactly_mu_times_the_normal_force_against_the_motion) {
    ContactMemory memory;
    const ContactForce force = drag<Dry<>>(Constant{0.3}, 0, 1e-6, Vector(0, 3e-9, 4e-9), 2000, memory);
    EXPECT_TRUE(force.sliding);
    EXPECT_LT((force.shear + 0.3 * force.normal * Vector(0, 0.6, 0.8)).norm(), 1e-14 * force.normal);
}

TEST(CoulombCap, holds_for_spring_and_dashpot_together_whatever_the_motion) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(-1, 1);
    ContactMemory memory;
    NoEnergy none;
    int slid = 0, stuck = 0;
    for (int i = 0; i < 20000; ++i) {
        ContactGeometry geometry =
            pressed(1e-6 * (1 + 0.9 * uniform(random)), 1e-9 * Vector(0, uniform(random), uniform(random)));
        geometry.normal_velocity = 2 * uniform(random);
        const ContactForce force = Damped<>::step(geometry, contact(0.3), Constant{0.4}, memory, none);
        EXPECT_LE(force.shear.norm(), 0.4 * force.normal * (1 + 1e-14) + 1e-300);
        EXPECT_LE(memory.shear_force.norm(), 0.4 * force.normal * (1 + 1e-14) + 1e-300);
        ++(force.sliding ? slid : stuck);
    }
    EXPECT_GT(slid, 1000);
    EXPECT_GT(stuck, 1000);
}

TEST(CoulombCap, on_the_spring_alone_would_let_the_total_exceed_mu_F_n) {
    // One fast step from rest: the spring is far below the limit, the dashpot far above.
    ContactMemory memory;
    const Vector increment(0, 2e-9, 0);
    const ContactForce force = drag<Damped<>>(Constant{0.1}, 0.5, 1e-6, increment, 1, memory);
    const double dashpot = contact(0.5).shear_damping * std::sqrt(std::sqrt(1e-6)) * increment.y() / 1e-8;
    EXPECT_LT(memory.shear_force.norm(), 0.1 * force.normal);
    EXPECT_GT(dashpot, 0.1 * force.normal);
    EXPECT_TRUE(force.sliding);
    EXPECT_NEAR(force.shear.norm(), 0.1 * force.normal, 1e-14 * force.normal);
}

TEST(CoulombCap, what_the_dashpot_keeps_when_the_total_slides_never_feeds_the_motion) {
    std::mt19937 random(2);
    std::normal_distribution<double> normal(0, 1);
    for (int i = 0; i < 100000; ++i) {
        Vector elastic(0, normal(random), normal(random));
        const Vector velocity(0, normal(random), normal(random));
        const Vector viscous = -std::abs(normal(random)) * velocity;
        Vector total;
        cap_shear(Constant{1.0}, 0.8, viscous, elastic, total);
        EXPECT_LE((total - elastic).dot(velocity), 1e-14);
    }
}

TEST(CoulombCap, holds_for_the_spring_even_where_the_dashpot_brings_the_total_below_the_limit) {
    // Unloaded while sheared, and moving back: spring 1.0 against a limit of 0.8, dashpot -0.5.
    Vector elastic(0, 1.0, 0), total;
    EXPECT_TRUE(cap_shear(Constant{0.5}, 1.6, Vector(0, -0.5, 0), elastic, total));
    EXPECT_DOUBLE_EQ(elastic.y(), 0.8);
    EXPECT_DOUBLE_EQ(total.y(), 0.3);
}

TEST(CoulombCap, without_friction_nothing_is_transmitted) {
    ContactMemory memory;
    const ContactForce force = drag<Damped<>>(Constant{0}, 0.3, 1e-6, Vector(0, 1e-9, 0), 10, memory);
    EXPECT_EQ(force.shear, Vector::Zero());
    EXPECT_EQ(memory.shear_force, Vector::Zero());
}

TEST(CoulombCap, of_a_huge_coefficient_never_slides) {
    ContactMemory memory;
    const ContactForce force = drag<Damped<>>(Constant{1e12}, 0.3, 1e-6, Vector(0, 1e-9, 0), 1000, memory);
    EXPECT_FALSE(force.sliding);
    EXPECT_NEAR(memory.shear_force.y() / (-1e-6 * force.shear_stiffness), 1, 1e-12);
}

TEST(CoulombCap, vanishes_with_the_normal_force_when_the_dashpot_cancels_it) {
    ContactMemory memory;
    drag<Damped<>>(Constant{0.5}, 0.5, 1e-6, Vector(0, 1e-9, 0), 100, memory);
    EXPECT_GT(memory.shear_force.norm(), 0);
    ContactGeometry leaving = pressed(1e-6, Vector(0, 1e-9, 0));
    leaving.normal_velocity = 1e3;
    NoEnergy none;
    const ContactForce force = Damped<>::step(leaving, contact(0.5), Constant{0.5}, memory, none);
    EXPECT_EQ(force.normal, 0);
    EXPECT_EQ(force.shear, Vector::Zero());
}

TEST(CoulombCap, is_zero_while_an_attractive_dashpot_pulls) {
    using Law = HertzMindlin<Hertz, IncrementalTangential, AttractiveDashpot, Constant>;
    ContactGeometry leaving = pressed(1e-6, Vector(0, 1e-9, 0));
    leaving.normal_velocity = 1e3;
    ContactMemory memory;
    NoEnergy none;
    const ContactForce force = Law::step(leaving, contact(0.5), Constant{0.5}, memory, none);
    EXPECT_LT(force.normal, 0);
    EXPECT_EQ(force.shear, Vector::Zero());
}

TEST(CoulombCap, follows_a_curve_that_drops_steeply_with_the_load) {
    // From 0.8 to 0.01 within 1 mN: pressing harder makes the stuck contact slide at the lower limit.
    const friction::Table cliff({0.1, 0.101}, {0.8, 0.01});
    using Law = Dry<friction::Table>;
    const double gentle = std::pow(0.099 / contact(0).normal_coefficient, 2.0 / 3);
    const double firm = std::pow(0.102 / contact(0).normal_coefficient, 2.0 / 3);
    ContactMemory memory;
    ContactForce force = drag<Law>(cliff, 0, gentle, Vector(0, 1e-12, 0), 1000, memory);
    EXPECT_FALSE(force.sliding);
    EXPECT_GT(force.shear.norm(), 0.01 * force.normal);
    force = drag<Law>(cliff, 0, firm, Vector::Zero(), 1, memory);
    EXPECT_TRUE(force.sliding);
    EXPECT_NEAR(force.shear.norm() / force.normal, 0.01, 1e-14);
}

TEST(CoulombCap, of_a_sliding_contact_measures_each_point_of_the_friction_curve) {
    const friction::PowerLaw curve = friction::cole_power_law();
    for (double load : {0.1, 0.5, 1.0, 1.5, 2.0, 4.0, 8.0, 16.0, 20.0, 40.0}) {
        const double overlap = std::pow(load / contact(0).normal_coefficient, 2.0 / 3);
        ContactMemory memory;
        const ContactForce force =
            drag<Damped<friction::PowerLaw>>(curve, 0.1, overlap, Vector(0, 0, 1e-8), 2000, memory);
        EXPECT_NEAR(force.shear.norm() / force.normal, curve.coefficient(load), 1e-12) << load;
    }
}

// Counts how often the law asks for the curve.
struct Counting {
    mutable int asked = 0;
    double coefficient(double) const { return ++asked, 0.5; }
    double lower_bound() const { return 0.4; }
};

TEST(CoulombCap, does_not_evaluate_a_curve_below_its_lower_bound) {
    Counting curve;
    Vector elastic(0, 0.39, 0), total;
    EXPECT_FALSE(cap_shear(curve, 1.0, elastic));
    EXPECT_FALSE(cap_shear(curve, 1.0, Vector::Zero(), elastic, total));
    EXPECT_EQ(total, elastic);
    EXPECT_EQ(curve.asked, 0);
    elastic.y() = 0.45;
    EXPECT_FALSE(cap_shear(curve, 1.0, elastic));
    EXPECT_EQ(curve.asked, 1);
    EXPECT_EQ(elastic.y(), 0.45);
}

} // namespace
