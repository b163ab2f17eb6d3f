// SPDX-License-Identifier: GPL-2.0-or-later
// Energy of leapfrog motion, taken so that the books close exactly. SI units.
//
// Step m: forces F_m act at positions x_m, v_(m-1/2) becomes v_(m+1/2) = v_(m-1/2) + F_m dt_m/M, then
// x_(m+1) = x_m + v_(m+1/2) dt_m. With the kinetic energy
//
//     K_m = 1/2 M v_(m-1/2) . v_(m+1/2)
//
// and a constant step dt, summation by parts gives for any forces, without error,
//
//     K_m - K_(m-1) = 1/2 (F_(m-1) + F_m) . (x_m - x_(m-1)).
//
// Every work here is this trapezoid sum, as in laws/energy.hpp. What is left over at the end is therefore
// only the difference between the trapezoid work of a nonlinear spring and the change of the energy it
// stores.
//
// Where the step changes, the sum up to x_m arrives at 1/2 M v_(m-1/2) . (v_(m-1/2) + F_m dt_(m-1)/M), and
// goes on from there with 1/2 M (v_(m+1/2) - F_m dt_m/M) . v_(m+1/2) = K_m. The difference is made by the
// change: 1/2 F_m . v_(m-1/2) (dt_m - dt_(m-1)) by YADE's integrator alone, first order in the step, and -1/8
// F_m^2/M (dt_m^2 - dt_(m-1)^2), second order, if its velocity is corrected for the change. That is an error
// of the motion and is left in the residual; its sum is kept beside it.
//
// Half a work belongs to the step before a force acts and half to the one after, so that nothing but
// velocities must be remembered from step to step.
#pragma once

#include <Eigen/Core>

namespace grainfall::energy {

struct StepWidths {
    double now = 0;    // s, dt_m
    double before = 0; // s, dt_(m-1)
};

// Sum over the steps of 1/2 (F_(m-1) + F_m) . (x_m - x_(m-1)), up to the positions x_m.
struct TrapezoidWork {
    double done = 0;    // J
    double pending = 0; // J, share of the last forces in the displacement that follows

    void step(double half_before, double half_after) {
        done += pending + half_before;
        pending = half_after;
    }
};

// The halves of one step, summed over bodies: 1/2 F_m . dx before and after.
struct HalfWorks {
    double before = 0, after = 0; // J

    void add(double force, double displacement_before, double displacement_after) {
        before += 0.5 * force * displacement_before;
        after += 0.5 * force * displacement_after;
    }
    HalfWorks& operator+=(const HalfWorks& other) {
        before += other.before;
        after += other.after;
        return *this;
    }
};

// What one step adds to the books, summed over degrees of freedom.
struct StepSums {
    double kinetic_translation = 0, kinetic_rotation = 0; // J, K_m of what is free to move
    double potential = 0;                                 // J, -M g . x_m of the same
    HalfWorks imposed;                                    // by whatever imposes motions
    HalfWorks load;                                       // by permanent forces
    HalfWorks damping;                                    // by Cundall's damping; negative
    double step_change = 0;                               // J, made by the change of the step
    // A degree of freedom that is let go brings its kinetic energy in; one that is caught takes it away.
    // Their potential energy counts from there on.
    double brought_kinetic = 0, brought_potential = 0; // J

    StepSums& operator+=(const StepSums& other) {
        kinetic_translation += other.kinetic_translation;
        kinetic_rotation += other.kinetic_rotation;
        potential += other.potential;
        imposed += other.imposed;
        load += other.load;
        damping += other.damping;
        step_change += other.step_change;
        brought_kinetic += other.brought_kinetic;
        brought_potential += other.brought_potential;
        return *this;
    }
};

// Cundall's damping: each component is weakened while it drives the motion, strengthened while it slows it.
inline double cundall_factor(double driving, double velocity, double damping) {
    const double power = driving * velocity;
    return power > 0 ? 1 - damping : power < 0 ? 1 + damping : 1.0;
}

// One component of the motion of one body, of translation or of rotation where the inertia is isotropic.
struct DegreeOfFreedom {
    double inertia = 0;  // kg or kg m2
    double velocity = 0; // m/s or 1/s, v_(m+1/2)
    double earlier = 0;  // the same, v_(m-1/2), as remembered
    double position = 0; // m, x_(m+1); where there is a field
    double force = 0;    // N or N m, all that act: contacts and load
    double load = 0;     // N or N m, the permanent part of it
    double field = 0;    // m/s2, gravity; 0 for rotations
    double damping = 0;  // Cundall's coefficient [-]
    bool damps_field = true;
    bool imposed = false, was_imposed = false;
};

// Acceleration as the integrator took it; `damped` also with Cundall's damping, whose sign follows the mean
// of the velocities before and after an undamped step.
struct Acceleration {
    double free, damped; // m/s2

    Acceleration(const DegreeOfFreedom& dof, double time_step) {
        const double forced = dof.force / dof.inertia;
        const double driving = dof.damps_field ? forced + dof.field : forced;
        const double factor = cundall_factor(driving, dof.earlier + 0.5 * time_step * driving, dof.damping);
        free = forced + dof.field;
        damped = factor * driving + (free - driving);
    }
};

// Adds one component to the sums; returns its kinetic energy K_m [J].
inline double add(const DegreeOfFreedom& dof, StepWidths dt, StepSums& sums) {
    const double displacement_before = dof.earlier * dt.before;
    const double displacement_after = dof.velocity * dt.now;
    if (dof.imposed != dof.was_imposed) {
        const double kinetic = 0.5 * dof.inertia * dof.earlier * dof.earlier;
        // Counted from half way between x_(m-1) and x_m, which makes the change exact.
        const double place = dof.position - displacement_after - 0.5 * displacement_before;
        const double potential = -dof.inertia * dof.field * place;
        sums.brought_kinetic += dof.imposed ? -kinetic : kinetic;
        sums.brought_potential += dof.imposed ? -potential : potential;
    }
    sums.load.add(dof.load, displacement_before, displacement_after);
    if (dof.imposed) {
        sums.imposed.add(-dof.force, displacement_before, displacement_after);
        return 0;
    }
    const Acceleration acceleration(dof, dt.now);
    const double before = dof.velocity - dt.now * acceleration.damped;
    sums.potential -= dof.inertia * dof.field * (dof.position - displacement_after);
    sums.damping.add(dof.inertia * (acceleration.damped - acceleration.free), displacement_before,
                     displacement_after);
    const double kinetic = 0.5 * dof.inertia * before * dof.velocity;
    if (dt.now != dt.before)
        sums.step_change +=
            kinetic - 0.5 * dof.inertia * dof.earlier * (dof.earlier + dt.before * acceleration.damped);
    return kinetic;
}

} // namespace grainfall::energy
