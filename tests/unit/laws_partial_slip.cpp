// SPDX-License-Identifier: GPL-2.0-or-later
#include "laws_impact.hpp"

#include <laws/friction/constant.hpp>
#include <laws/friction/power_law.hpp>
#include <laws/pair_rules.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace {

using namespace grainfall::laws;
using friction::Constant;

template <class Energy = NoEnergy, class Friction = Constant>
using Slip = HertzMindlin<Hertz, PartialSlipTangential, NoDamping, Friction, Energy>;

constexpr double overlap = 2e-7, mu = 0.3; // m, -

ContactParameters quartz_pair() {
    const ElasticMaterial quartz{70e9, 0.2};
    return contact_parameters(effective_modulus(quartz, quartz), effective_shear_modulus(quartz, quartz),
                              0.5e-3, 1e-5, 0);
}
double normal_force(double depth = overlap) {
    return Hertz::force(quartz_pair().normal_coefficient, depth, std::sqrt(depth));
}
// 8 G* a.
double stuck_stiffness(double depth = overlap) {
    return quartz_pair().shear_coefficient * std::sqrt(depth);
}

// One contact led along a path; shears positively along `direction`, and gives the force on it back with the
// sign that makes work positive.
template <class Energy = NoEnergy>
struct Contact {
    PartialSlipMemory memory;
    Energy energy;
    ContactGeometry geometry;
    Vector force = Vector::Zero();
    double work = 0; // J, by the mean of the forces before and after
    bool sliding = false;

    explicit Contact(double depth) {
        geometry.normal = Vector(2, -1, 2) / 3;
        geometry.overlap = depth;
        geometry.time_step = 1e-7;
        move(0, Vector::Zero());
    }
    Vector tangent(double angle = 0) const {
        const Vector first = Vector(1, 2, 0) / std::sqrt(5.0);
        return std::cos(angle) * first + std::sin(angle) * geometry.normal.cross(first);
    }
    void move(double deeper, const Vector& shear, double friction = mu) {
        geometry.overlap += deeper;
        geometry.shear_increment = shear;
        const Vector before = force;
        const ContactForce applied =
            Slip<Energy>::step(geometry, quartz_pair(), Constant{friction}, memory, energy);
        force = -applied.shear;
        sliding = applied.sliding;
        work += 0.5 * (before + force).dot(shear);
    }
    void shear(double distance, int steps, double angle = 0) {
        for (int i = 0; i < steps; ++i)
            move(0, distance / steps * tangent(angle));
    }
};

// Mindlin & Deresiewicz at constant normal force N; `limit` is mu N, `stiffness` 8 G* a, so that S/a = 8/k.
double loading_displacement(double force, double limit, double stiffness) {
    return 1.5 * limit / stiffness * (1 - std::pow(1 - force / limit, 2.0 / 3));
}
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

// The same springs one by one: many of them, each with its own displacement.
struct ManySprings {
    std::vector<double> touch;              // m
    std::vector<std::array<double, 2>> tau; // m
    double width, depth = 0;

    ManySprings(int count, double deepest) : width(std::sqrt(deepest) / count) {
        for (int i = 0; i < count; ++i) {
            const double s = (i + 0.5) * width;
            touch.push_back(s * s);
            tau.push_back({0, 0});
        }
    }
    void advance(double to, const Planar& shift, double limit_slope) {
        for (std::size_t i = 0; i < touch.size(); ++i) {
            if (touch[i] >= to) {
                tau[i] = {0, 0};
                continue;
            }
            const double part = touch[i] < depth ? 1 : (to - touch[i]) / (to - depth);
            double &x = tau[i][0], &y = tau[i][1];
            x += part * shift[0];
            y += part * shift[1];
            const double limit = limit_slope * (to - touch[i]), length = std::hypot(x, y);
            if (length > limit) {
                x *= limit / length;
                y *= limit / length;
            }
        }
        depth = to;
    }
    Planar integral() const {
        double x = 0, y = 0;
        for (const auto& t : tau) {
            x += width * t[0];
            y += width * t[1];
        }
        return {x, y};
    }
};

struct Leg {
    double depth, slope; // in units of the deepest overlap, of kappa
    Planar shift;        // in units of kappa * deepest overlap
};

// Random legs that press, release, shear and reverse; `turning` in two directions, else along one.
std::vector<Leg> random_legs(unsigned seed, bool turning, bool friction_varies) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(0, 1);
    std::vector<Leg> legs;
    for (int i = 0; i < 12; ++i) {
        Leg leg;
        leg.depth = 0.1 + 0.9 * uniform(random);
        leg.slope = friction_varies ? 0.5 + uniform(random) : 1;
        const double size = i % 3 == 0 ? 1.5 : 0.4;
        const double x = size * (2 * uniform(random) - 1), y = size * (2 * uniform(random) - 1);
        leg.shift = Planar(x, turning ? y : 0.0);
        legs.push_back(leg);
    }
    return legs;
}

// Largest difference of the force from that of the many springs, over the force at sliding.
double error_on_random_legs(unsigned seed, bool turning, bool friction_varies) {
    const int springs = 2000, steps = 60;
    ManySprings many(springs, 1.0);
    SlipPieces<slip_pieces> pieces;
    Leg at{0, 1, Planar::Zero()};
    double worst = 0;
    for (const Leg& leg : random_legs(seed, turning, friction_varies)) {
        for (int i = 1; i <= steps; ++i) {
            const double part = static_cast<double>(i) / steps;
            const double depth = at.depth + (leg.depth - at.depth) * part;
            const double slope = at.slope + (leg.slope - at.slope) * part;
            many.advance(depth, leg.shift / steps, slope);
            advance_slip_profile(pieces, std::sqrt(depth), leg.shift / steps, slope);
            const double sliding = 2.0 / 3 * slope * depth * std::sqrt(depth);
            worst = std::max(worst, (many.integral() - pieces.integral()).norm() / sliding);
        }
        at = leg;
    }
    return worst;
}

TEST(PartialSlip, follows_two_thousand_springs_along_a_line) {
    for (unsigned seed = 0; seed < 6; ++seed) {
        // The many springs themselves are off by about 1e-5.
        EXPECT_LT(error_on_random_legs(seed, false, false), 1e-4) << seed;
        EXPECT_LT(error_on_random_legs(seed, false, true), 2e-3) << seed;
    }
}

TEST(PartialSlip, follows_two_thousand_springs_where_the_direction_turns) {
    for (unsigned seed = 0; seed < 6; ++seed) {
        EXPECT_LT(error_on_random_legs(seed, true, false), 2e-3) << seed;
        EXPECT_LT(error_on_random_legs(seed, true, true), 1e-2) << seed;
    }
}

TEST(PartialSlip, follows_two_thousand_springs_through_an_impact) {
    // Pressed and released as in an impact while the shear swings: no two steps in the same ratio, so that
    // each makes a piece of its own.
    const int steps = 1000;
    for (double swing : {2.0, 3.5, 5.0}) {
        ManySprings many(2000, 1.0);
        SlipPieces<slip_pieces> pieces;
        for (int i = 1; i < steps; ++i) {
            const double time = static_cast<double>(i) / steps;
            const double depth = std::sin(detail::pi * time);
            const Planar shift(2.0 / steps * std::cos(swing * time), 0);
            many.advance(depth, shift, 1);
            advance_slip_profile(pieces, std::sqrt(depth), shift, 1);
            EXPECT_LT((many.integral() - pieces.integral()).norm(), 1e-4) << swing << ", " << time;
        }
    }
}

TEST(PartialSlip, waits_until_steps_add_up_without_being_seen_in_the_force) {
    const double reach = 1.5 * mu * normal_force() / stuck_stiffness();
    Contact<> large(overlap), small(overlap);
    for (double leg : {0.7, -0.9, 0.5, -1.1}) {
        large.shear(leg * reach, 500);
        small.shear(leg * reach, 50000);
        EXPECT_LT((large.force - small.force).norm(), 3 * slip_resolution * mu * normal_force());
    }
}

TEST(PartialSlip, never_gives_work_on_a_closed_path_however_large_the_steps) {
    // With the force at the end of each step, as an implicit integrator takes it, a passive contact gives no
    // work in any single step beyond what it had stored.
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (int path = 0; path < 200; ++path) {
        SlipPieces<slip_pieces> pieces;
        double depth = 0.5, work = 0, taken = 0;
        Planar place = Planar::Zero();
        for (int i = 0; i < 60; ++i) {
            const Planar next = i == 59 ? Planar(Planar::Zero()) : Planar(uniform(random), uniform(random));
            depth = std::clamp(depth + 0.3 * uniform(random), 0.0, 1.0);
            const double slope = 0.5 + 0.4 * uniform(random);
            const double stored = 0.5 * pieces.integral_of_square();
            advance_slip_profile(pieces, std::sqrt(depth), next - place, slope);
            const double step_work = pieces.integral().dot(next - place);
            taken += std::abs(step_work);
            EXPECT_GE(step_work - (0.5 * pieces.integral_of_square() - stored), -2e-4);
            work += step_work;
            place = next;
        }
        EXPECT_GE(work, 0);
        EXPECT_GT(taken, 0);
    }
}

TEST(PartialSlip, books_friction_that_is_never_negative_and_work_that_is_never_given) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const double reach = 1.5 * mu * normal_force() / stuck_stiffness();
    for (int path = 0; path < 20; ++path) {
        Contact<DissipationBook> contact(overlap);
        Vector place = Vector::Zero();
        double depth = overlap;
        const int legs = 10, steps = 200;
        for (int leg = 0; leg <= legs; ++leg) {
            const Vector target =
                leg == legs ? Vector(Vector::Zero())
                            : Vector(reach * uniform(random) * contact.tangent(detail::pi * uniform(random)));
            const double next = leg == legs ? 0 : overlap * (1 + 0.8 * uniform(random));
            const double before = contact.energy.friction;
            for (int i = 0; i < steps; ++i)
                contact.move((next - depth) / steps, (target - place) / steps);
            EXPECT_GE(contact.energy.friction - before, -1e-5 * mu * normal_force() * reach);
            place = target;
            depth = next;
        }
        EXPECT_GT(contact.work, 0);
        EXPECT_NEAR(contact.work, contact.energy.friction, 1e-9 * contact.work); // nothing left stored
    }
}

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
