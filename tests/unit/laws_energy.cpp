// SPDX-License-Identifier: GPL-2.0-or-later
#include "laws_impact.hpp"

#include <laws/energy.hpp>
#include <laws/friction/constant.hpp>
#include <laws/friction/power_law.hpp>
#include <laws/pair_rules.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace grainfall::laws;
using friction::Constant;
using grainfall::testing::Oblique;

const ElasticMaterial oxide{3.8e11, 0.23};

Oblique ball(double normal_speed, double tangent_speed, double spin = 0) {
    const double radius = 2.5e-3;
    return {radius, 4.0 / 3 * detail::pi * radius * radius * radius * 4000, normal_speed, tangent_speed,
            spin};
}

ContactParameters on_plane(double mass, double zeta) {
    return contact_parameters(oxide.young / (1 - oxide.poisson * oxide.poisson),
                              shear_modulus(oxide) / (2 - oxide.poisson), 2.5e-3, mass, zeta);
}

double contact_time(const Oblique& impact, const ContactParameters& parameters) {
    using namespace grainfall::testing;
    return closed_form_duration(
        closed_form_overlap(parameters.normal_coefficient, impact.mass, impact.normal_speed),
        impact.normal_speed);
}

struct Balance {
    double initial, final, friction, viscous, rescaling; // J
    double residual() const { return (final + friction + viscous + rescaling - initial) / initial; }
};

template <class Law, class Friction>
Balance balance(Oblique impact, const Friction& curve, double zeta, int steps_per_contact) {
    const ContactParameters parameters = on_plane(impact.mass, zeta);
    const double time_step = contact_time(impact, parameters) / steps_per_contact;
    DissipationBook book;
    const double initial = impact.kinetic_energy();
    grainfall::testing::oblique_impact<Law>(
        impact, parameters, curve, time_step, book,
        [](const auto&, const auto&, const auto&, const auto&, const auto&) {});
    return {initial, impact.kinetic_energy(), book.friction, book.viscous, book.rescaling};
}

template <class Tangential, class Damping, class Friction = Constant>
using Booked = HertzMindlin<Hertz, Tangential, Damping, Friction, DissipationBook>;

TEST(DissipationBook, closes_over_oblique_impacts_from_sticking_to_gross_sliding) {
    for (double degrees : {1.0, 5.0, 15.0, 30.0, 60.0, 85.0}) {
        const double angle = degrees * detail::pi / 180;
        const Oblique impact = ball(3.9 * std::cos(angle), 3.9 * std::sin(angle), 300);
        for (double e : {1.0, 0.98, 0.5}) {
            const double zeta = damping_ratio_from_restitution(e, false);
            const Balance energy =
                balance<Booked<IncrementalTangential, RepulsiveDashpot>>(impact, Constant{0.092}, zeta, 400);
            // What leapfrog itself is off by in the normal spring, at 400 steps a contact.
            EXPECT_LT(std::abs(energy.residual()), 2e-5) << degrees << " degrees, e = " << e;
            const double rounding = -1e-15 * energy.initial;
            EXPECT_GE(energy.friction, rounding);
            EXPECT_GE(energy.viscous, rounding);
            EXPECT_GE(energy.rescaling, rounding);
        }
    }
}

TEST(DissipationBook, closes_for_every_law_and_for_load_dependent_friction) {
    const Oblique impact = ball(1, 0.8, -200);
    const Constant constant{0.3};
    const double zeta = damping_ratio_from_restitution(0.8, false);
    EXPECT_LT(
        std::abs(balance<Booked<ReportTangential, RepulsiveDashpot>>(impact, constant, zeta, 400).residual()),
        2e-5);
    EXPECT_LT(
        std::abs(balance<Booked<SecantTangential, RepulsiveDashpot>>(impact, constant, zeta, 400).residual()),
        2e-5);
    EXPECT_LT(
        std::abs(balance<Booked<IncrementalTangential, NoDamping>>(impact, constant, 0, 400).residual()),
        2e-5);
    EXPECT_LT(
        std::abs(balance<Booked<NoTangential, RepulsiveDashpot>>(impact, constant, zeta, 400).residual()),
        2e-5);
    EXPECT_LT(std::abs(balance<Booked<IncrementalTangential, RepulsiveDashpot, friction::PowerLaw>>(
                           impact, friction::cole_power_law(), zeta, 400)
                           .residual()),
              2e-5);
}

TEST(DissipationBook, residual_shrinks_with_the_integrators_order) {
    const Oblique impact = ball(3, 1.0, 100);
    const double zeta = damping_ratio_from_restitution(0.9, false);
    double worst[2] = {0, 0};
    for (int i : {0, 1}) {
        // Over a range of steps, since the error of a single impact depends on where its steps happen to
        // fall.
        for (int extra = 0; extra < 20; ++extra) {
            const int steps = (i == 0 ? 50 : 400) + extra;
            const Balance energy =
                balance<Booked<IncrementalTangential, RepulsiveDashpot>>(impact, Constant{0.3}, zeta, steps);
            worst[i] = std::max(worst[i], std::abs(energy.residual()));
        }
    }
    EXPECT_LT(worst[0], 5e-4);
    EXPECT_LT(worst[1], worst[0] / 64); // eight times the steps, second order
}

TEST(DissipationBook, closes_at_every_moment_of_the_impact) {
    Oblique impact = ball(3, 1.5, 0);
    const double initial = impact.kinetic_energy();
    const ContactParameters parameters = on_plane(impact.mass, damping_ratio_from_restitution(0.9, false));
    DissipationBook book;
    double worst = 0;
    using Law = Booked<IncrementalTangential, RepulsiveDashpot>;
    grainfall::testing::oblique_impact<Law>(
        impact, parameters, Constant{0.2}, contact_time(impact, parameters) / 1000, book,
        [&](const Oblique& before, const Oblique& after, const ContactForce&, const ContactMemory& memory,
            const DissipationBook& so_far) {
            // Kinetic energy at the step itself lies between those half a step before and after.
            const double kinetic = 0.5 * (before.kinetic_energy() + after.kinetic_energy());
            const double elastic = Hertz::elastic_energy(parameters.normal_coefficient, before.overlap,
                                                         std::sqrt(before.overlap)) +
                                   shear_elastic_energy(memory);
            const double sum = kinetic + elastic + so_far.friction + so_far.viscous + so_far.rescaling;
            worst = std::max(worst, std::abs(sum / initial - 1));
        });
    EXPECT_LT(worst, 2e-5);
}

TEST(DissipationBook, books_no_friction_for_a_contact_that_only_sticks) {
    const Balance energy =
        balance<Booked<IncrementalTangential, NoDamping>>(ball(3, 1), Constant{1e6}, 0, 400);
    EXPECT_EQ(energy.friction, 0);
    EXPECT_EQ(energy.viscous, 0);
    EXPECT_GT(energy.rescaling, 0);
}

TEST(DissipationBook, books_mu_F_n_times_the_slip_and_not_the_elastic_part_of_the_first_slipping_step) {
    using Law = Booked<IncrementalTangential, NoDamping>;
    ContactGeometry geometry;
    geometry.overlap = 1e-6;
    geometry.time_step = 1e-8;
    const ContactParameters parameters = on_plane(1e-3, 0);
    const double normal = Hertz::force(parameters.normal_coefficient, 1e-6, 1e-3);
    const double limit = 0.3 * normal;
    const double elastic =
        limit / shear_stiffness<Hertz, IncrementalTangential>(parameters.shear_coefficient, 1e-3);
    const double slip = 5 * elastic;
    for (int steps : {1, 7, 1000}) {
        geometry.shear_increment = Vector(0, (elastic + slip) / steps, 0);
        DissipationBook book;
        ContactMemory memory;
        for (int i = 0; i < steps; ++i)
            Law::step(geometry, parameters, Constant{0.3}, memory, book);
        // A step that crosses the limit counts the mean of the forces at its ends, as the motion does.
        const double first_step = std::min(slip, (elastic + slip) / steps);
        EXPECT_NEAR(book.friction, limit * slip, 0.5 * limit * first_step * (1 + 1e-9));
        EXPECT_NEAR(shear_elastic_energy(memory), 0.5 * limit * elastic, 1e-12 * limit * elastic);
    }
}

TEST(DissipationBook, books_what_a_contact_that_is_torn_open_still_held) {
    ContactMemory memory;
    memory.shear_force = Vector(0, 3, 4);
    memory.shear_stiffness = 1e6;
    DissipationBook book;
    book.add_opening(memory);
    EXPECT_DOUBLE_EQ(book.rescaling, 25 / 2e6);
    book.add_opening(ContactMemory{}); // a contact without tangential force holds nothing
    EXPECT_DOUBLE_EQ(book.rescaling, 25 / 2e6);
}

TEST(Impact, never_gains_energy_at_any_angle_or_spin) {
    const double zeta = damping_ratio_from_restitution(0.98, false);
    for (double degrees = 0; degrees < 90; degrees += 3) {
        for (double spin : {-2000.0, 0.0, 2000.0}) {
            const double angle = degrees * detail::pi / 180;
            const Oblique impact = ball(3.9 * std::cos(angle), 3.9 * std::sin(angle), spin);
            const Balance elastic =
                balance<Booked<IncrementalTangential, NoDamping>>(impact, Constant{0.4}, 0, 400);
            EXPECT_LE(elastic.final, elastic.initial * (1 + 2e-5)) << degrees << " " << spin;
            const Balance damped =
                balance<Booked<IncrementalTangential, RepulsiveDashpot>>(impact, Constant{0.4}, zeta, 400);
            EXPECT_LT(damped.final, damped.initial) << degrees << " " << spin;
        }
    }
}

TEST(Impact, grazing_at_89_degrees_gains_no_energy) {
    const Oblique impact = ball(3.9 * std::cos(1.5533), 3.9 * std::sin(1.5533));
    const Balance energy = balance<Booked<IncrementalTangential, RepulsiveDashpot>>(
        impact, Constant{0.092}, damping_ratio_from_restitution(0.98, false), 100);
    EXPECT_LT(energy.final, energy.initial);
}

// Chung & Ooi (2011) test 4: where the contact slides throughout, the rebound follows from momentum alone.
TEST(Impact, sliding_throughout_rebounds_as_a_rigid_body_does) {
    const double e = 0.98, mu = 0.092, speed = 3.9;
    const double zeta = damping_ratio_from_restitution(e, false);
    for (double degrees : {35.0, 40.0, 50.0, 60.0, 70.0, 80.0, 85.0}) {
        const double angle = degrees * detail::pi / 180;
        Oblique impact = ball(speed * std::cos(angle), speed * std::sin(angle));
        const double tangent_speed = impact.tangent_speed, normal_speed = impact.normal_speed;
        const ContactParameters parameters = on_plane(impact.mass, zeta);
        NoEnergy none;
        grainfall::testing::oblique_impact<
            HertzMindlin<Hertz, IncrementalTangential, RepulsiveDashpot, Constant>>(
            impact, parameters, Constant{mu}, contact_time(impact, parameters) / 1000, none,
            [](const auto&, const auto&, const auto&, const auto&, const auto&) {});
        const double impulse = mu * (1 + e) * normal_speed;
        // The spring takes a little displacement to reach the limit and gives it back: 0.1 %. The lever arm
        // is short by the overlap, 0.3 % of the radius.
        EXPECT_NEAR(impact.tangent_speed / (tangent_speed - impulse), 1, 1e-3) << degrees;
        EXPECT_NEAR(impact.spin / (2.5 * impulse / impact.radius), 1, 4e-3) << degrees;
        EXPECT_NEAR(-impact.normal_speed / normal_speed, e, 1e-4) << degrees;
    }
}

} // namespace
