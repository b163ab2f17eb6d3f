// SPDX-License-Identifier: GPL-2.0-or-later
// The life of a bridge between a fixed grain and one on a prescribed or free path.
#include <laws/bridge/liquid_bridge.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

using namespace grainfall::laws::bridge;
using grainfall::laws::NoEnergy;
using grainfall::laws::detail::pi;

constexpr double radius = 3.6e-4, volume = 0.05 * 4.6656e-11, tension = 0.0728;

template <class Form>
BridgeParameters wetted(double viscosity = 0) {
    return {Form::curve(radius, volume, tension, 0),
            SqueezeFilm::parameters(radius, volume, viscosity, 1e-6, 1.3e-7),
            rupture_distance(radius, volume, 0)};
}

// Work of the closed form from contact to a separation: integral of F0/(1 + 2.1 S + 10 S^2), whose
// denominator is 10 (S + 0.105)^2 + 0.88975.
double closed_form_work(const ForceCurve& curve, double separation) {
    const double root = std::sqrt(10 * 0.88975);
    const auto primitive = [&](double s) { return std::atan(10 * (s + 0.105) / root) / root; };
    return curve.contact_force / curve.inverse_length *
           (primitive(separation * curve.inverse_length) - primitive(0));
}

// Moves the grain in equal steps, until its bridge ruptures; returns the state at the end.
template <class Bridge, class Book>
BridgeState move(double from, double to, int steps, const BridgeParameters& parameters, BridgeMemory& memory,
                 Book& book) {
    const double step = (to - from) / steps;
    BridgeState state = BridgeState::waiting;
    for (int i = 1; i <= steps; ++i) {
        const bool held = memory.formed;
        state = Bridge::step(from + i * step, step / 1e-6, 1e-6, parameters, memory, book);
        if (held && !memory.formed)
            break;
    }
    return state;
}

TEST(LiquidBridge, forms_only_by_touch) {
    using Bridge = LiquidBridge<WillettNumeric, NoFilm, NoEnergy>;
    const auto parameters = wetted<WillettNumeric>();
    BridgeMemory memory;
    NoEnergy book;
    EXPECT_EQ(Bridge::step(1e-9, -1, 1e-6, parameters, memory, book), BridgeState::waiting);
    EXPECT_EQ(memory.attraction, 0);
    EXPECT_EQ(Bridge::step(0, -1, 1e-6, parameters, memory, book), BridgeState::holding);
    EXPECT_EQ(memory.attraction, parameters.curve.contact_force);
    EXPECT_EQ(Bridge::step(1e-9, 1, 1e-6, parameters, memory, book), BridgeState::holding);
    EXPECT_GT(memory.attraction, 0.9 * parameters.curve.contact_force);
}

TEST(LiquidBridge, is_dropped_where_it_cannot_be_before_it_has_formed) {
    using Bridge = LiquidBridge<WillettNumeric, NoFilm, NoEnergy>;
    const auto parameters = wetted<WillettNumeric>();
    BridgeMemory memory;
    NoEnergy book;
    EXPECT_EQ(Bridge::step(1.01 * parameters.rupture_distance, 0, 1e-6, parameters, memory, book),
              BridgeState::ended);
}

TEST(LiquidBridge, ruptures_at_its_distance_and_needs_another_touch) {
    using Bridge = LiquidBridge<WillettNumeric, NoFilm, NoEnergy>;
    const auto parameters = wetted<WillettNumeric>();
    const double end = parameters.rupture_distance;
    BridgeMemory memory;
    NoEnergy book;
    Bridge::step(0, 0, 1e-6, parameters, memory, book);
    EXPECT_EQ(Bridge::step(end * (1 - 1e-9), 1, 1e-6, parameters, memory, book), BridgeState::holding);
    EXPECT_GT(memory.attraction, 0);
    EXPECT_EQ(Bridge::step(end, 1, 1e-6, parameters, memory, book), BridgeState::ended);
    EXPECT_EQ(memory.attraction, 0);
    EXPECT_EQ(Bridge::step(0.5 * end, -1, 1e-6, parameters, memory, book), BridgeState::waiting);
    EXPECT_EQ(memory.attraction, 0);
}

TEST(LiquidBridge, returns_the_work_of_a_cycle_that_does_not_rupture_it) {
    using Bridge = LiquidBridge<WillettClosed, NoFilm, BridgeBook>;
    const auto parameters = wetted<WillettClosed>();
    BridgeMemory memory;
    BridgeBook book;
    const double far = 0.9 * parameters.rupture_distance;
    Bridge::step(0, 0, 1e-6, parameters, memory, book);
    move<Bridge>(0, far, 2000, parameters, memory, book);
    EXPECT_NEAR(memory.work / closed_form_work(parameters.curve, far), 1, 1e-6);
    move<Bridge>(far, -1e-6, 2000, parameters, memory, book);
    EXPECT_NEAR(memory.work / (-1e-6 * parameters.curve.contact_force), 1, 0.02);
    EXPECT_EQ(book.rupture, 0);
}

TEST(LiquidBridge, loses_at_rupture_the_integral_of_its_force) {
    using Bridge = LiquidBridge<WillettClosed, NoFilm, BridgeBook>;
    const auto parameters = wetted<WillettClosed>();
    const double expected = closed_form_work(parameters.curve, parameters.rupture_distance);
    BridgeMemory memory;
    BridgeBook book;
    Bridge::step(0, 0, 1e-6, parameters, memory, book);
    EXPECT_EQ(move<Bridge>(0, 2 * parameters.rupture_distance, 40000, parameters, memory, book),
              BridgeState::ended);
    EXPECT_NEAR(book.rupture / expected, 1, 1e-4); // half a step of the last force
    EXPECT_EQ(memory.work, 0);
}

TEST(LiquidBridge, loses_a_hundred_times_as_much_in_a_hundred_ruptures) {
    using Bridge = LiquidBridge<WillettNumeric, NoFilm, BridgeBook>;
    const auto parameters = wetted<WillettNumeric>();
    const double far = 1.2 * parameters.rupture_distance;
    BridgeMemory memory;
    BridgeBook book;
    double once = 0;
    for (int i = 0; i < 100; ++i) {
        move<Bridge>(far, -1e-7, 500, parameters, memory, book);
        ASSERT_TRUE(memory.formed);
        move<Bridge>(-1e-7, far, 500, parameters, memory, book);
        if (i == 0)
            once = book.rupture;
    }
    EXPECT_GT(once, 0);
    EXPECT_NEAR(book.rupture / (100 * once), 1, 1e-12);
}

// A grain flung off a wall of the other grain and caught by the bridge or not; leapfrog, no other force.
struct Flight {
    double kinetic_before, kinetic_after, work, rupture, viscous;
    double residual() const {
        return (kinetic_after + work + rupture + viscous - kinetic_before) / kinetic_before;
    }
};

template <class Form, class Film>
Flight fling(double speed, double viscosity, int steps) {
    using Bridge = LiquidBridge<Form, Film, BridgeBook>;
    const auto parameters = wetted<Form>(viscosity);
    const double mass = 4.0 / 3 * pi * radius * radius * radius * 2650, time_step = 2e-8;
    BridgeMemory memory;
    BridgeBook book;
    double separation = 0, velocity = 0;
    Bridge::step(0, 0, time_step, parameters, memory, book); // made at rest
    velocity = speed - 0.5 * memory.attraction / mass * time_step;
    const double kinetic = 0.5 * mass * speed * speed;
    double last_force = 0;
    for (int i = 0; i < steps; ++i) {
        separation += velocity * time_step;
        const auto state = Bridge::step(separation, velocity, time_step, parameters, memory, book);
        last_force = memory.viscous_force - memory.attraction;
        velocity += last_force / mass * time_step;
        if (state == BridgeState::ended)
            break;
    }
    const double velocity_now = velocity - 0.5 * last_force / mass * time_step;
    return {kinetic, 0.5 * mass * velocity_now * velocity_now, memory.work, book.rupture, book.viscous};
}

TEST(LiquidBridge, keeps_the_books_of_a_grain_that_tears_it) {
    const Flight flight = fling<WillettNumeric, NoFilm>(0.6, 0, 100000);
    EXPECT_GT(flight.rupture, 0);
    EXPECT_EQ(flight.work, 0);
    EXPECT_NEAR(flight.residual(), 0, 1e-9);
    // Escape speed: the kinetic energy lost is the work of rupture, nothing else.
    EXPECT_NEAR(flight.kinetic_before - flight.kinetic_after, flight.rupture, 1e-9 * flight.kinetic_before);
}

TEST(LiquidBridge, keeps_the_books_of_a_grain_that_it_holds) {
    const Flight flight = fling<WillettNumeric, NoFilm>(0.1, 0, 1000);
    EXPECT_GT(flight.work, 0);
    EXPECT_EQ(flight.rupture, 0);
    EXPECT_NEAR(flight.residual(), 0, 1e-6);
}

TEST(LiquidBridge, with_a_film_takes_energy_and_keeps_the_books) {
    const Flight flight = fling<WillettNumeric, SqueezeFilm>(0.6, 1e-3, 100000);
    EXPECT_GT(flight.viscous, 0);
    // The film stiffens within a few steps of the start, which trapezoids follow to a percent.
    EXPECT_NEAR(flight.residual(), 0, 1e-4);
    const Flight frictionless = fling<WillettNumeric, NoFilm>(0.6, 0, 100000);
    EXPECT_LT(flight.kinetic_after, frictionless.kinetic_after);
}

TEST(LiquidBridge, film_opposes_motion_both_ways) {
    using Bridge = LiquidBridge<WillettNumeric, SqueezeFilm, NoEnergy>;
    const auto parameters = wetted<WillettNumeric>(1e-3);
    BridgeMemory memory;
    NoEnergy book;
    for (double separation : {-1e-7, 1e-7, 1e-5, 1e-4})
        for (double speed : {-0.3, 0.3}) {
            memory.formed = true;
            Bridge::step(separation, speed, 1e-6, parameters, memory, book);
            EXPECT_LT(memory.viscous_force * speed, 0);
        }
}

} // namespace
