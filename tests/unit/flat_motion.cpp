// SPDX-License-Identifier: GPL-2.0-or-later
#include <engines/flat/rigid_motion.hpp>
#include <laws/sphere_kinematics.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace grainfall;
using flat::Vector;

Eigen::Quaterniond exact_turn(const Eigen::Quaterniond& q, const Vector& turn) {
    return Eigen::Quaterniond(Eigen::AngleAxisd(turn.norm(), turn.normalized())) * q;
}

TEST(OrientationOfASphere, turns_by_the_rotation_vector_to_the_last_bits) {
    const Eigen::Quaterniond start = Eigen::Quaterniond(0.3, -0.5, 0.7, 0.2).normalized();
    for (const double angle : {1e-9, 1e-4, 0.03, 0.0999, 0.1001, 1.0, 3.0}) {
        const Vector turn = angle * Vector(0.6, -0.48, 0.64);
        const Eigen::Quaterniond q = flat::turned(start, turn);
        EXPECT_LT((q.coeffs() - exact_turn(start, turn).coeffs()).norm(), 5e-16) << angle;
        EXPECT_NEAR(q.norm(), 1, 5e-16);
    }
}

TEST(OrientationOfASphere, stays_a_unit_quaternion_over_a_million_steps) {
    Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
    for (int i = 0; i < 1'000'000; ++i)
        q = flat::turned(q, Vector(0.01, -0.02, 0.015));
    EXPECT_NEAR(q.norm(), 1, 1e-15);
}

flat::Bodies one_sphere(unsigned blocked = 0) {
    flat::Bodies bodies;
    bodies.places.push_back({Vector(1, 2, 3), 0.5});
    bodies.motions.push_back({Vector(0.1, 0, -0.2), Vector(1, 2, 3)});
    bodies.orientations.push_back(Eigen::Quaterniond::Identity());
    bodies.inertias.push_back({2.0, Vector(0.2, 0.2, 0.2), blocked, true});
    bodies.ids.push_back(0);
    return bodies;
}

TEST(StepOfASphere, is_leapfrogs) {
    flat::Bodies bodies = one_sphere();
    const flat::StepRules rules{0.01, Vector(0, 0, -10), 0, true};
    flat::advance(bodies, 0, Vector(4, 0, 0), Vector(0, 0.4, 0), rules);
    EXPECT_NEAR(bodies.motions[0].velocity[0], 0.1 + 0.02, 1e-15);
    EXPECT_NEAR(bodies.motions[0].velocity[2], -0.2 - 0.1, 1e-15);
    EXPECT_NEAR(bodies.motions[0].spin[1], 2 + 0.02, 1e-15);
    EXPECT_NEAR(bodies.places[0].centre[2], 3 - 0.003, 1e-15);
}

TEST(StepOfASphere, leaves_blocked_axes_at_their_imposed_velocity) {
    flat::Bodies bodies = one_sphere(4u | 16u); // z, rotation about y
    const flat::StepRules rules{0.01, Vector(0, 0, -10), 0, true};
    flat::advance(bodies, 0, Vector(4, 0, 7), Vector(0, 0.4, 0), rules);
    EXPECT_DOUBLE_EQ(bodies.motions[0].velocity[2], -0.2);
    EXPECT_DOUBLE_EQ(bodies.motions[0].spin[1], 2);
    EXPECT_NEAR(bodies.motions[0].velocity[0], 0.12, 1e-15);
    EXPECT_NEAR(bodies.places[0].centre[2], 3 - 0.002, 1e-15);
}

TEST(NumericalDamping, weakens_a_force_along_the_motion_and_strengthens_one_against_it) {
    EXPECT_DOUBLE_EQ(flat::damped(2, 1, 0.3, 1e-6), 2 * 0.7);
    EXPECT_DOUBLE_EQ(flat::damped(-2, 1, 0.3, 1e-6), -2 * 1.3);
    EXPECT_DOUBLE_EQ(flat::damped(0, 1, 0.3, 1e-6), 0);
}

TEST(FreeTumbling, keeps_its_angular_momentum_and_its_energy_to_the_scheme_s_first_order) {
    // A brick with three different moments, spun near the unstable middle axis.
    const auto drift = [](double dt) {
        Vector centre = Vector::Zero(), velocity = Vector::Zero();
        const Vector inertia(1, 2, 3);
        Vector spin(0.1, 5, 0.1), momentum = inertia.cwiseProduct(spin);
        Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
        const Vector momentum_at_start = momentum;
        flat::RigidBody brick{centre, q, velocity, spin, momentum, {1, inertia, 0, false}};
        const auto energy = [&] {
            const Vector own = q.conjugate() * momentum;
            return 0.5 * own.dot(own.cwiseQuotient(inertia));
        };
        const double before = energy();
        double worst = 0;
        for (int i = 0; i < static_cast<int>(3 / dt); ++i) {
            flat::advance(brick, Vector::Zero(), Vector::Zero(), {dt, Vector::Zero(), 0, true}, true);
            worst = std::max(worst, std::abs(energy() / before - 1));
        }
        EXPECT_EQ(momentum, momentum_at_start);
        return worst;
    };
    const double coarse = drift(4e-3), fine = drift(2e-3);
    EXPECT_LT(coarse, 0.03);
    EXPECT_NEAR(std::log2(coarse / fine), 1, 0.1); // measured 1.03; YADE's is the same scheme
}

TEST(ShearOfRollingSpheres, is_none_once_their_overlap_is_none) {
    const laws::Touch touch = laws::touch_of_spheres(Vector(0, 0, 3), 3.0, 1.0, 2.0);
    const Vector spin1(0.2, 0, 0), spin2(-0.1, 0, 0); // R1 w1 = -R2 w2: gears
    EXPECT_NEAR(laws::shear_velocity(touch, Vector::Zero(), spin1, spin2).norm(), 0, 1e-15);
    EXPECT_NEAR(laws::shear_velocity(touch, Vector::Zero(), spin1, -spin2).norm(), 0.4, 1e-15);
}

TEST(ShearOfSpheres, leaves_nothing_behind_after_a_closed_path) {
    // Press, turn, part, turn back (McNamara et al. 2008): with distances to the contact point in place of
    // the radii the two turns would not cancel.
    const Vector no_spin = Vector::Zero(), spin(0, 0.3, 0);
    const laws::Touch light = laws::touch_of_spheres(Vector(0, 0, 2), 2.0, 1.0, 1.0);
    const laws::Touch deep = laws::touch_of_spheres(Vector(0, 0, 1.8), 1.8, 1.0, 1.0);
    const Vector turn_deep = laws::shear_velocity(deep, Vector::Zero(), spin, no_spin);
    const Vector turn_back = laws::shear_velocity(light, Vector::Zero(), -spin, no_spin);
    EXPECT_NEAR((turn_deep + turn_back).norm(), 0, 1e-15);
}

} // namespace
