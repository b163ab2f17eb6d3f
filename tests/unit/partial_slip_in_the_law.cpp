// SPDX-License-Identifier: GPL-2.0-or-later
#include "partial_slip_contact.hpp"

#include <laws/friction/power_law.hpp>

#include <gtest/gtest.h>

#include <random>

namespace {

using namespace partial_slip;

TEST(PartialSlip, force_stays_below_friction_with_any_dashpot) {
    using Law = HertzMindlin<Hertz, PartialSlipTangential, RepulsiveDashpot, friction::PowerLaw>;
    const friction::PowerLaw curve = friction::cole_power_law();
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(-1, 1);
    ContactParameters parameters = quartz_pair();
    parameters.normal_damping = normal_damping_coefficient(0.3, 1e-5, parameters.normal_coefficient);
    parameters.shear_damping = shear_damping_coefficient(0.3, 1e-5, parameters.shear_coefficient);
    ContactGeometry geometry;
    geometry.normal = Vector::UnitZ();
    geometry.time_step = 1e-7;
    PartialSlipMemory memory;
    NoEnergy none;
    int slides = 0;
    for (int i = 0; i < 20000; ++i) {
        geometry.overlap = overlap * (1 + std::sin(0.02 * i));
        geometry.normal_velocity = 0.1 * uniform(random);
        geometry.shear_increment = 1e-9 * Vector(uniform(random) + std::sin(0.003 * i), uniform(random), 0);
        const ContactForce force = Law::step(geometry, parameters, curve, memory, none);
        const double limit = curve.coefficient(force.normal) * force.normal;
        ASSERT_LE(force.shear.norm(), limit * (1 + 1e-12));
        ASSERT_LE(memory.shear_force.norm(), limit * (1 + 1e-12));
        slides += force.sliding;
    }
    EXPECT_GT(slides, 1000);
    EXPECT_LT(slides, 19000);
}

TEST(PartialSlip, turns_with_its_contact) {
    Contact<> still(overlap), turned(overlap);
    const double reach = 1.5 * mu * normal_force() / stuck_stiffness();
    for (auto* contact : {&still, &turned}) {
        contact->shear(0.8 * reach, 10, 0.5);
        contact->shear(-0.5 * reach, 10, 0.5);
    }
    // Half a turn about the normal in small steps, then the same shear in the turned frame.
    const int steps = 1000;
    turned.geometry.twist = detail::pi / steps * turned.geometry.normal;
    for (int i = 0; i < steps; ++i)
        turned.move(0, Vector::Zero());
    turned.geometry.twist.setZero();
    for (double leg : {0.3, -0.6, 0.4}) {
        still.shear(leg * reach, 20, 0.5);
        turned.shear(leg * reach, 20, 0.5 + detail::pi);
        // A Cayley step of angle w turns by w^3/12 less: 3e-6 over the half turn.
        EXPECT_LT((still.force + turned.force).norm(), 1e-5 * mu * normal_force());
    }
}

TEST(PartialSlip, takes_over_the_force_that_another_law_has_left) {
    for (double share : {0.0, 0.3, 0.95, 1.0}) {
        ContactGeometry geometry;
        geometry.overlap = overlap;
        geometry.normal = Vector::UnitZ();
        PartialSlipMemory memory;
        NoEnergy none;
        memory.shear_stiffness = stuck_stiffness();
        memory.shear_force = share * mu * normal_force() * Vector(0.6, 0.8, 0);
        const Vector left = memory.shear_force;
        const ContactForce force = Slip<>::step(geometry, quartz_pair(), Constant{mu}, memory, none);
        EXPECT_LT((force.shear - left).norm(), 1e-12 * mu * normal_force()) << share;
        // As if just sheared so far: on, it follows Mindlin's curve.
        const double limit = mu * normal_force();
        const double from = loading_displacement(share * limit, limit, stuck_stiffness());
        geometry.shear_increment = -1e-3 * limit / stuck_stiffness() * Vector(0.6, 0.8, 0);
        const ContactForce next = Slip<>::step(geometry, quartz_pair(), Constant{mu}, memory, none);
        if (share < 1) {
            EXPECT_NEAR(loading_displacement(next.shear.norm(), limit, stuck_stiffness()) - from,
                        1e-3 * limit / stuck_stiffness(), 1e-9 * limit / stuck_stiffness());
        }
        // Another law acts meanwhile and leaves another force.
        memory.shear_force = 0.5 * left;
        geometry.shear_increment.setZero();
        const ContactForce later = Slip<>::step(geometry, quartz_pair(), Constant{mu}, memory, none);
        EXPECT_LT((later.shear - 0.5 * left).norm(), 1e-12 * mu * normal_force()) << share;
    }
}

TEST(PartialSlip, scales_with_the_printed_normal_force) {
    using Law = HertzMindlin<ReportNormal, PartialSlipTangential, NoDamping, Constant>;
    ContactGeometry geometry;
    geometry.overlap = overlap;
    geometry.normal = Vector::UnitZ();
    PartialSlipMemory memory;
    NoEnergy none;
    Law::step(geometry, quartz_pair(), Constant{mu}, memory, none);
    const double limit = 0.5 * mu * normal_force();
    const double stiffness = ReportNormal::cube_root_of_factor * stuck_stiffness();
    const double shear = loading_displacement(0.6 * limit, limit, stiffness);
    geometry.shear_increment = Vector(shear, 0, 0);
    const ContactForce force = Law::step(geometry, quartz_pair(), Constant{mu}, memory, none);
    EXPECT_NEAR(force.shear.norm() / (0.6 * limit), 1, 1e-12);
    EXPECT_NEAR(force.shear_stiffness / stiffness, 1, 1e-14);
}

TEST(PartialSlip, energy_that_a_contact_holds_and_friction_make_up_the_work_at_every_step) {
    // Pressed and sheared so slowly that the pieces are brought up to date only every few tens of steps: what
    // is read from the contact must be right in between too.
    const double reach = mu * normal_force() / stuck_stiffness();
    Contact<DissipationBook> contact(overlap);
    for (double leg : {0.6, -0.9, 0.5, -0.2}) {
        const int steps = 20000;
        for (int i = 0; i < steps; ++i) {
            contact.move(0.1 * leg * overlap / steps, leg * reach / steps * contact.tangent());
            const double kept = shear_elastic_energy(contact.memory) + contact.energy.friction;
            ASSERT_NEAR(kept / contact.work, 1, 1e-9) << leg << ", " << i;
        }
    }
    EXPECT_GT(contact.energy.friction, 0.05 * contact.work);
}

TEST(PartialSlip, books_close_over_oblique_impacts) {
    const ElasticMaterial oxide{3.8e11, 0.23};
    const double radius = 2.5e-3, mass = 4.0 / 3 * detail::pi * radius * radius * radius * 4000;
    for (double degrees : {1.0, 5.0, 15.0, 30.0, 60.0, 85.0}) {
        for (double restitution : {1.0, 0.9}) {
            using Law =
                HertzMindlin<Hertz, PartialSlipTangential, RepulsiveDashpot, Constant, DissipationBook>;
            const double angle = degrees * detail::pi / 180;
            grainfall::testing::Oblique ball{radius, mass, 3.9 * std::cos(angle), 3.9 * std::sin(angle), 300};
            const ContactParameters parameters = contact_parameters(
                oxide.young / (1 - oxide.poisson * oxide.poisson), shear_modulus(oxide) / (2 - oxide.poisson),
                radius, mass, damping_ratio_from_restitution(restitution, false));
            const double time_step = grainfall::testing::closed_form_duration(
                                         grainfall::testing::closed_form_overlap(
                                             parameters.normal_coefficient, mass, ball.normal_speed),
                                         ball.normal_speed) /
                                     400;
            const double initial = ball.kinetic_energy();
            DissipationBook book;
            grainfall::testing::oblique_impact<Law>(
                ball, parameters, Constant{0.092}, time_step, book,
                [](const auto&, const auto&, const auto&, const auto&, const auto&) {});
            const double residual =
                (ball.kinetic_energy() + book.friction + book.viscous + book.rescaling - initial) / initial;
            EXPECT_LT(std::abs(residual), 2e-5) << degrees << " degrees";
            EXPECT_GE(book.friction, 0);
        }
    }
}

} // namespace
