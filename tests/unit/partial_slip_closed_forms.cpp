// SPDX-License-Identifier: GPL-2.0-or-later
#include "partial_slip_contact.hpp"

#include <gtest/gtest.h>

namespace {

using namespace partial_slip;

// The same after turning at a force.
double unloading_displacement(double force, double turned_at, double limit, double stiffness) {
    return 1.5 * limit / stiffness *
           (2 * std::pow(1 - (turned_at - force) / (2 * limit), 2.0 / 3) -
            std::pow(1 - turned_at / limit, 2.0 / 3) - 1);
}
double loop_energy(double share, double limit, double stiffness) {
    return 0.9 * limit * limit * 8 / stiffness *
           (1 - std::pow(1 - share, 5.0 / 3) - 5 * share / 6 * (1 + std::pow(1 - share, 2.0 / 3)));
}

TEST(PartialSlip, of_a_contact_that_cannot_slip_is_mindlins_spring) {
    Contact<> contact(overlap);
    for (int i = 1; i <= 10; ++i) {
        contact.move(0, 1e-9 * contact.tangent(), 1e15);
        EXPECT_NEAR(contact.force.norm() / (stuck_stiffness() * 1e-9 * i), 1, 1e-12);
    }
}

TEST(PartialSlip, loads_and_unloads_along_the_curves_of_mindlin_and_deresiewicz) {
    const double limit = mu * normal_force(), stiffness = stuck_stiffness();
    Contact<> contact(overlap);
    const double turned_at = 0.8 * limit, furthest = loading_displacement(turned_at, limit, stiffness);
    const int steps = 40;
    double displacement = 0;
    for (int i = 1; i <= steps; ++i) {
        contact.shear(furthest / steps, 1);
        displacement += furthest / steps;
        const double force = contact.force.dot(contact.tangent());
        EXPECT_NEAR(loading_displacement(force, limit, stiffness), displacement, 1e-12 * furthest);
        EXPECT_FALSE(contact.sliding);
    }
    // Down to where the unloading curve meets the loading curve of the other side.
    for (int i = 1; i < 2 * steps; ++i) {
        contact.shear(-furthest / steps, 1);
        displacement -= furthest / steps;
        const double force = contact.force.dot(contact.tangent());
        EXPECT_NEAR(unloading_displacement(force, turned_at, limit, stiffness), displacement,
                    1e-12 * furthest);
    }
}

TEST(PartialSlip, slides_as_a_whole_at_the_displacement_that_mindlin_gives) {
    const double limit = mu * normal_force(), onset = 1.5 * limit / stuck_stiffness();
    Contact<> contact(overlap);
    contact.shear(0.999 * onset, 10);
    EXPECT_FALSE(contact.sliding);
    contact.shear(0.002 * onset, 1);
    EXPECT_TRUE(contact.sliding);
    EXPECT_NEAR(contact.force.norm() / limit, 1, 1e-12);
    // However the last digit falls.
    for (int i = 0; i < 100; ++i) {
        contact.shear(0.01 * onset, 1, 0.02 * i);
        EXPECT_TRUE(contact.sliding) << i;
    }
}

TEST(PartialSlip, loses_in_a_cycle_what_mindlin_and_deresiewicz_give) {
    const double limit = mu * normal_force(), stiffness = stuck_stiffness();
    for (double share : {0.1, 0.2, 0.3, 0.5, 0.7, 0.9}) {
        const double amplitude = loading_displacement(share * limit, limit, stiffness);
        const auto cycle = [&](int steps) {
            Contact<DissipationBook> contact(overlap);
            contact.shear(amplitude, steps);
            for (int i = 0; i < 2; ++i) {
                contact.shear(-2 * amplitude, 2 * steps);
                contact.shear(2 * amplitude, 2 * steps);
            }
            const double before = contact.energy.friction, work_before = contact.work;
            contact.shear(-2 * amplitude, 2 * steps);
            contact.shear(2 * amplitude, 2 * steps);
            // What the books call friction is the work that does not come back.
            EXPECT_NEAR(contact.energy.friction - before, contact.work - work_before,
                        1e-10 * limit * amplitude);
            return contact.energy.friction - before;
        };
        const double expected = loop_energy(share, limit, stiffness);
        // Work is the mean of two forces times a step, second order in the step: what is left at step zero.
        const double coarse = cycle(200), fine = cycle(400);
        EXPECT_NEAR((4 * fine - coarse) / 3 / expected, 1, 1e-6) << share;
    }
}

TEST(PartialSlip, at_constant_normal_force_does_not_depend_on_the_step) {
    const double reach = 1.5 * mu * normal_force() / stuck_stiffness();
    Contact<> coarse(overlap), fine(overlap);
    for (double leg : {0.7, -0.9, 0.5, -0.3, 0.2, -1.1, 1.6}) {
        coarse.shear(leg * reach, 1);
        fine.shear(leg * reach, 997);
        EXPECT_LT((coarse.force - fine.force).norm(), 1e-9 * mu * normal_force());
    }
}

TEST(PartialSlip, pressed_and_sheared_in_a_fixed_ratio_below_friction_does_not_slip) {
    // Mindlin & Deresiewicz's case of loading with dT/dN constant: force per displacement 2/3 of 8 G* a.
    const double kappa = 1.5 * mu * quartz_pair().normal_coefficient / quartz_pair().shear_coefficient;
    Contact<DissipationBook> contact(0);
    const double ratio = 0.9 * kappa;
    const int steps = 300;
    for (int i = 0; i < steps; ++i)
        contact.move(overlap / steps, ratio * overlap / steps * contact.tangent());
    const double expected = 2.0 / 3 * stuck_stiffness() * ratio * overlap;
    EXPECT_NEAR(contact.force.norm() / expected, 1, 1e-10);
    EXPECT_EQ(contact.memory.history.pieces.count, 1);
    // Released the same way, it gives everything back.
    for (int i = 0; i < steps - 1; ++i)
        contact.move(-overlap / steps, -ratio * overlap / steps * contact.tangent());
    EXPECT_LT(contact.energy.friction, 1e-3 * expected * ratio * overlap);
}

} // namespace
