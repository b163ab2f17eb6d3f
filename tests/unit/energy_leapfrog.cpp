// SPDX-License-Identifier: GPL-2.0-or-later
#include <engines/energy/aspherical.hpp>
#include <engines/energy/balance.hpp>
#include <engines/energy/leapfrog.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace {

using namespace grainfall::energy;

// One body on a line, stepped as YADE does it, and its books.
struct Line {
    DegreeOfFreedom dof;
    double contact_work = 0, contact_force_before = 0, place_before = 0; // the trapezoid sum, kept by hand
    StepWidths dt;
    TrapezoidWork imposed, load, damping;
    double brought_kinetic = 0, brought_potential = 0, step_change = 0;
    double kinetic = 0, potential = 0;
    double moved_with = 0;
    bool started = false;
    bool corrected = false; // half of the change of the step is made up for beforehand

    explicit Line(double mass, double velocity) {
        dof.inertia = mass;
        dof.velocity = velocity;
    }

    void step(double contact_force, double time_step) {
        dt = {time_step, started ? dt.now : time_step};
        const double place = dof.position;
        dof.earlier = started ? moved_with : dof.velocity;
        dof.force = contact_force + dof.load;
        if (corrected)
            dof.velocity += 0.5 * (dt.before - dt.now) * dof.force / dof.inertia;
        if (!dof.imposed)
            dof.velocity += time_step * Acceleration(dof, time_step).damped;
        moved_with = dof.velocity;
        dof.position += dof.velocity * time_step;
        StepSums sums;
        kinetic = add(dof, dt, sums);
        potential = sums.potential;
        imposed.step(sums.imposed.before, sums.imposed.after);
        load.step(sums.load.before, sums.load.after);
        damping.step(sums.damping.before, sums.damping.after);
        if (!started) // works count from here
            imposed.done = load.done = damping.done = 0;
        brought_kinetic += sums.brought_kinetic;
        brought_potential += sums.brought_potential;
        step_change += sums.step_change;
        if (started)
            contact_work += 0.5 * (contact_force_before + contact_force) * (place - place_before);
        contact_force_before = contact_force;
        place_before = place;
        dof.was_imposed = dof.imposed;
        started = true;
    }

    // Constant if every work is booked: what the contacts gave is what they lost.
    double total() const {
        return kinetic + potential - brought_potential - contact_work - damping.done - imposed.done -
               load.done - brought_kinetic;
    }
};

std::vector<double> random_forces(int count, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> force(-5, 5);
    std::vector<double> forces(count);
    for (double& f : forces)
        f = force(random);
    return forces;
}

TEST(LeapfrogEnergy, closes_to_rounding_for_any_forces_under_gravity_load_and_damping) {
    for (bool damps_field : {true, false})
        for (double damping : {0.0, 0.3, 0.9}) {
            Line line(0.7, 1.3);
            line.dof.field = -9.81;
            line.dof.damping = damping;
            line.dof.damps_field = damps_field;
            line.dof.load = 2.5;
            double start = 0;
            for (double force : random_forces(200, 3)) {
                line.step(force, 0.01);
                if (start == 0)
                    start = line.total();
                line.dof.load = 2.5 + 0.1 * force; // permanent until changed
                ASSERT_NEAR(line.total(), start, 1e-11);
            }
            EXPECT_EQ(line.damping.done<-0.1, damping> 0);
            EXPECT_GT(std::abs(line.load.done), 1);
        }
}

TEST(LeapfrogEnergy, closes_when_a_moving_body_is_let_go_and_caught_again) {
    Line line(0.7, 1.3);
    line.dof.field = -9.81;
    line.dof.imposed = line.dof.was_imposed = true;
    line.dof.position = 40; // the height at which it is let go must not count
    double start = 0;
    int step = 0;
    for (double force : random_forces(300, 5)) {
        const bool was_imposed = line.dof.imposed;
        line.dof.imposed = step / 50 % 2 == 0;
        if (line.dof.imposed && was_imposed)
            line.dof.velocity = 0.1 * force;
        line.step(force, 0.01);
        if (step == 0)
            start = line.total();
        ASSERT_NEAR(line.total(), start, 1e-11) << step;
        ++step;
    }
}

TEST(LeapfrogEnergy, of_an_oscillator_keeps_its_total_for_ever) {
    Line line(2, 1);
    const double stiffness = 50, time_step = 0.05; // 25 steps a period
    double total = 0;
    for (int step = 0; step < 20000; ++step) {
        const double spring = 0.5 * stiffness * line.dof.position * line.dof.position;
        line.step(-stiffness * line.dof.position, time_step);
        if (step == 0)
            total = line.kinetic + spring;
        ASSERT_NEAR(line.kinetic + spring, total, 1e-11);
    }
}

TEST(LeapfrogEnergy, made_by_a_change_of_the_step_is_told) {
    for (const bool corrected : {false, true}) {
        Line line(0.7, 1.3);
        line.corrected = corrected;
        double start = 0;
        int step = 0;
        for (double force : random_forces(200, 7)) {
            line.step(force, step % 3 == 0 ? 0.01 : 0.013);
            if (step == 0)
                start = line.total();
            EXPECT_NEAR(line.total() - line.step_change, start, 1e-11);
            ++step;
        }
        EXPECT_GT(std::abs(line.step_change), 1e-6);
    }
}

TEST(LeapfrogEnergy, made_by_a_change_of_the_step_is_of_second_order_with_corrected_velocity) {
    // Constant force and one change, closed forms: F v (dt' - dt)/2 and -F^2/M (dt'^2 - dt^2)/8.
    const double mass = 0.7, force = 3, from = 0.01, to = 0.013;
    for (const bool corrected : {false, true}) {
        Line line(mass, 1.3);
        line.corrected = corrected;
        line.step(force, from);
        const double velocity = line.dof.velocity;
        line.step(force, to);
        const double expected = corrected ? -force * force / mass * (to * to - from * from) / 8
                                          : force * velocity * (to - from) / 2;
        EXPECT_NEAR(line.step_change, expected, 1e-15);
    }
}

TEST(LeapfrogEnergy, of_imposed_motion_is_minus_the_work_of_the_contacts) {
    Line line(0, 0.2);
    line.dof.imposed = line.dof.was_imposed = true;
    for (int step = 0; step <= 1000; ++step)
        line.step(-30.0 * step * 0.001, 0.001); // the reaction of a spring of 150 N/m
    EXPECT_NEAR(line.imposed.done, 0.5 * 150 * 0.2 * 0.2, 1e-12);
}

// YADE's rotation of a body with unequal moments of inertia, one step.
AsphericalStep aspherical_step(const Eigen::Quaterniond& start, const Eigen::Vector3d& momentum_before,
                               const Eigen::Vector3d& torque, const Eigen::Vector3d& inertia, double dt) {
    const auto rate = [](const Eigen::Vector3d& spin, const Eigen::Quaterniond& q) {
        Eigen::Quaterniond product = q * Eigen::Quaterniond(0, spin[0], spin[1], spin[2]);
        product.coeffs() *= 0.5;
        return product;
    };
    const Eigen::Quaterniond to_body = start.conjugate();
    const Eigen::Vector3d at_start = (to_body * (momentum_before + 0.5 * dt * torque)).cwiseQuotient(inertia);
    Eigen::Quaterniond half = start;
    half.coeffs() += 0.5 * dt * rate(at_start, start).coeffs();
    const Eigen::Vector3d momentum = momentum_before + dt * torque;
    const Eigen::Vector3d spin = (to_body * momentum).cwiseQuotient(inertia);
    Eigen::Quaterniond end = start;
    end.coeffs() += dt * rate(spin, half).coeffs();
    end.normalize();
    return {end, momentum, torque, inertia, dt};
}

TEST(AsphericalEnergy, undoes_the_integrator_s_step) {
    const Eigen::Quaterniond start(Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, -0.5).normalized()));
    const AsphericalStep step =
        aspherical_step(start, {0.02, -0.03, 0.05}, {0.4, 0.1, -0.2}, {1e-3, 3e-3, 2e-3}, 1e-4);
    EXPECT_LT(orientation_before(step).angularDistance(start), 1e-12);
}

TEST(AsphericalEnergy, with_equal_moments_is_that_of_a_sphere) {
    const Eigen::Vector3d momentum(0.02, -0.03, 0.05), torque(0.4, 0.1, -0.2);
    const AsphericalStep step =
        aspherical_step(Eigen::Quaterniond::Identity(), momentum, torque, {2e-3, 2e-3, 2e-3}, 1e-3);
    const double expected = 0.5 * momentum.dot(momentum + 1e-3 * torque) / 2e-3;
    EXPECT_NEAR(kinetic_energy(step), expected, 1e-15);
}

double drift_of_a_free_top(double time_step) {
    const Eigen::Vector3d inertia(1e-3, 3e-3, 2e-3), momentum(0.02, -0.03, 0.05);
    Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
    double first = 0, last = 0;
    for (int i = 0; i < std::lround(0.2 / time_step); ++i) {
        const AsphericalStep step = aspherical_step(q, momentum, Eigen::Vector3d::Zero(), inertia, time_step);
        last = kinetic_energy(step);
        if (i == 0)
            first = last;
        q = step.orientation;
    }
    return std::abs(last - first) / first;
}

TEST(AsphericalEnergy, of_a_free_top_drifts_by_the_integrator_s_first_order_error) {
    const double slope = std::log2(drift_of_a_free_top(1e-3) / drift_of_a_free_top(5e-4));
    EXPECT_NEAR(slope, 1, 0.15);
}

TEST(Balance, residual_and_energy_in_play_follow_their_definitions) {
    Amounts start, now;
    start[Term::potential] = 7;
    now[Term::potential] = 4;         // lost 3
    now[Term::kinetic_rotation] = 1;  // gained 1
    now[Term::friction] = 2.5;        // gained 2.5
    now[Term::imposed_motion] = 0.25; // gave 0.25
    EXPECT_DOUBLE_EQ(residual(now, start), 0.25);
    EXPECT_DOUBLE_EQ(energy_in_play(now, start), 3.5);
    now[Term::kinetic_translation] = 9; // in play even if nothing happens to it
    EXPECT_DOUBLE_EQ(energy_in_play(now, now), 10);
}

TEST(Balance, names_stand_in_the_order_of_the_terms) {
    for (std::size_t i = 0; i < term_count; ++i)
        EXPECT_EQ(static_cast<std::size_t>(term_names[i].term), i);
}

} // namespace
