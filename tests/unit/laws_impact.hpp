// SPDX-License-Identifier: GPL-2.0-or-later
// Impacts integrated through the contact law with leapfrog, in YADE's order: the force at a position is
// computed with the velocity of half a step before.
#pragma once

#include <laws/hertz_mindlin.hpp>
#include <laws/pair_rules.hpp>

#include <algorithm>
#include <cmath>

namespace grainfall::testing {

struct HeadOn {
    double peak_force = 0;   // N
    double peak_overlap = 0; // m
    double duration = 0;     // s, until the overlap is zero again
    double restitution = 0;
    double lowest_force = 0; // N, below 0 if the contact ever pulled
};

// Hertz: overlap at which 1/2 m v^2 is stored, and the time until it is given back.
inline double closed_form_overlap(double coefficient, double mass, double speed) {
    return std::pow(1.25 * mass * speed * speed / coefficient, 0.4);
}
inline double closed_form_duration(double overlap, double speed) {
    return 4 * std::sqrt(laws::detail::pi) / 5 * std::tgamma(0.4) / std::tgamma(0.9) * overlap / speed;
}

template <class Law, class Friction>
HeadOn head_on_impact(const laws::ContactParameters& parameters, const Friction& friction, double mass,
                      double speed, double steps_per_contact) {
    const double expected = closed_form_overlap(parameters.normal_coefficient, mass, speed);
    laws::ContactGeometry geometry;
    geometry.time_step = closed_form_duration(expected, speed) / steps_per_contact;
    laws::ContactMemory memory;
    laws::NoEnergy energy;
    HeadOn result;
    double velocity = speed, overlap = 0;
    while (overlap >= 0) {
        geometry.overlap = overlap;
        geometry.normal_velocity = -velocity;
        const double force = Law::step(geometry, parameters, friction, memory, energy).normal;
        result.peak_force = std::max(result.peak_force, force);
        result.peak_overlap = std::max(result.peak_overlap, overlap);
        result.lowest_force = std::min(result.lowest_force, force);
        velocity -= force / mass * geometry.time_step;
        overlap += velocity * geometry.time_step;
        result.duration += geometry.time_step;
    }
    result.duration -= overlap / velocity; // the last step went past zero
    result.restitution = -velocity / speed;
    return result;
}

// A sphere, and the plane z = 0 which it hits with tangential velocity along x.
struct Oblique {
    double radius, mass;  // m, kg
    double normal_speed;  // m/s, > 0
    double tangent_speed; // m/s
    double spin = 0;      // rad/s about y; the surface velocity at the contact is v_x - spin * radius
    double overlap = 0;   // m, during the impact
    double steps = 0;     // done

    double inertia() const { return 0.4 * mass * radius * radius; }
    double kinetic_energy() const {
        return 0.5 * mass * (normal_speed * normal_speed + tangent_speed * tangent_speed) +
               0.5 * inertia() * spin * spin;
    }
};

template <class Law, class Friction, class Energy, class Observer>
void oblique_impact(Oblique& ball, const laws::ContactParameters& parameters, const Friction& friction,
                    double time_step, Energy& energy, Observer&& observe) {
    laws::ContactGeometry geometry;
    geometry.time_step = time_step;
    geometry.normal = laws::Vector::UnitZ();
    typename Law::Memory memory;
    while (ball.overlap >= 0) {
        const double lever = ball.radius - ball.overlap;
        geometry.overlap = ball.overlap;
        geometry.normal_velocity = -ball.normal_speed;
        geometry.shear_increment =
            laws::Vector::UnitX() * (ball.tangent_speed - ball.spin * lever) * time_step;
        const laws::ContactForce force = Law::step(geometry, parameters, friction, memory, energy);
        const Oblique before = ball;
        ball.normal_speed -= force.normal / ball.mass * time_step;
        ball.tangent_speed += force.shear.x() / ball.mass * time_step;
        ball.spin -= force.shear.x() * lever / ball.inertia() * time_step;
        observe(before, ball, force, memory, energy);
        ball.overlap += ball.normal_speed * time_step;
        ball.steps += 1;
    }
    if constexpr (Energy::active)
        energy.add_opening(memory);
}

} // namespace grainfall::testing
