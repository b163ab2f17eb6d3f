// SPDX-License-Identifier: GPL-2.0-or-later
// One leapfrog step of a sphere, as YADE's NewtonIntegrator makes it:
//
//   v += dt (F/m + g),  x += dt v,  w += dt T/I,  q <- turn(w dt) q
//
// with local damping (Cundall) on each component of the acceleration if asked for,
//   a <- a [1 - damping sign(a (v + a dt/2))].
#pragma once

#include <engines/flat/bodies.hpp>

#include <cmath>

namespace grainfall::flat {

struct StepRules {
    double time_step;
    Vector gravity;
    double damping;
    bool damps_gravity;
};

inline double damped(double acceleration, double velocity, double damping, double time_step) {
    const double mean = velocity + 0.5 * time_step * acceleration;
    const double power = acceleration * mean;
    return power > 0 ? acceleration * (1 - damping) : power < 0 ? acceleration * (1 + damping) : acceleration;
}

// New velocity of whatever axes are free, under local damping where it is asked for.
inline void accelerate(Vector& velocity, const Vector& force, const Inertia& inertia,
                       const StepRules& rules) {
    const double damping = inertia.damped ? rules.damping : 0, dt = rules.time_step;
    for (int axis = 0; axis < 3; ++axis) {
        if (inertia.blocked & (1u << axis))
            continue;
        const double push = force[axis] / inertia.mass, pull = rules.gravity[axis], v = velocity[axis];
        velocity[axis] += dt * (rules.damps_gravity ? damped(push + pull, v, damping, dt)
                                                    : damped(push, v, damping, dt) + pull);
    }
}

inline void spin_up(Vector& spin, const Vector& torque, const Inertia& inertia, const StepRules& rules) {
    const double damping = inertia.damped ? rules.damping : 0, dt = rules.time_step;
    for (int axis = 0; axis < 3; ++axis) {
        if (inertia.blocked & (8u << axis))
            continue;
        spin[axis] += dt * damped(torque[axis] / inertia.inertia[axis], spin[axis], damping, dt);
    }
}

// q after turning by the rotation vector `turn`. The series are good to the last bit below 0.1 rad.
[[gnu::always_inline]] inline Eigen::Quaterniond turned(const Eigen::Quaterniond& q, const Vector& turn) {
    const double square = turn.squaredNorm();
    if (square == 0)
        return q;
    double cosine, sine; // cos(angle/2), sin(angle/2)/angle
    if (square < 0.01) {
        const double s = 0.25 * square;
        cosine = 1 - s * (1. / 2 - s * (1. / 24 - s * (1. / 720 - s * (1. / 40320))));
        sine = 0.5 * (1 - s * (1. / 6 - s * (1. / 120 - s * (1. / 5040 - s * (1. / 362880)))));
    } else {
        const double angle = std::sqrt(square);
        cosine = std::cos(0.5 * angle);
        sine = std::sin(0.5 * angle) / angle;
    }
    const Vector axis = sine * turn;
    const Vector imaginary = cosine * q.vec() + q.w() * axis + axis.cross(q.vec());
    Eigen::Quaterniond result;
    result.w() = cosine * q.w() - axis.dot(q.vec());
    result.vec() = imaginary;
    // The length is within rounding of one, for which the first term of 1/sqrt is enough.
    result.coeffs() *= 1.5 - 0.5 * result.coeffs().squaredNorm();
    return result;
}

// Advances sphere i under a force and a torque.
[[gnu::always_inline]] inline void advance(Bodies& bodies, std::size_t i, const Vector& force,
                                           const Vector& torque, const StepRules& rules) {
    const Inertia& inertia = bodies.inertias[i];
    Motion& motion = bodies.motions[i];
    Vector& centre = bodies.places[i].centre;
    const double dt = rules.time_step;
    if (inertia.blocked == 0 && (rules.damping == 0 || !inertia.damped)) {
        motion.velocity += dt * (force / inertia.mass + rules.gravity);
        motion.spin += dt * torque.cwiseQuotient(inertia.inertia);
    } else {
        accelerate(motion.velocity, force, inertia, rules);
        spin_up(motion.spin, torque, inertia, rules);
    }
    centre += dt * motion.velocity;
    Eigen::Quaterniond& orientation = bodies.orientations[i];
    orientation = turned(orientation, dt * motion.spin);
}

} // namespace grainfall::flat
