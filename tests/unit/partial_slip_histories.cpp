// SPDX-License-Identifier: GPL-2.0-or-later
#include "partial_slip_contact.hpp"

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <vector>

namespace {

using namespace partial_slip;

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

} // namespace
