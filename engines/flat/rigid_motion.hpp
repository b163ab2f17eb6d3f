// SPDX-License-Identifier: GPL-2.0-or-later
// One leapfrog step of any rigid body, as YADE's NewtonIntegrator makes it. A body with three equal moments
// of inertia, or with a blocked rotation, turns like a sphere; the others by the scheme of Allen & Tildesley
// (Computer Simulation of Liquids, 1989, section 3.3): angular momentum J at the half steps in global axes,
//
//   w_n = Q_n I^-1 Q_n^T (J + T dt/2),  q_(n+1/2) = q_n + dt/2 dq/dt(w_n, q_n),
//   J += T dt,  q_(n+1) = q_n + dt dq/dt(w_(n+1/2), q_(n+1/2)).
#pragma once

#include <engines/flat/sphere_motion.hpp>

namespace grainfall::flat {

struct RigidBody {
    Vector& centre;
    Eigen::Quaterniond& orientation;
    Vector& velocity;
    Vector& spin;
    Vector& angular_momentum;
    Inertia inertia;
};

namespace detail {

// dq/dt for a spin [rad/s] in the body's own axes.
inline Eigen::Vector4d quaternion_rate(const Vector& spin, const Eigen::Quaterniond& q) {
    return 0.5 * (q * Eigen::Quaterniond(0, spin[0], spin[1], spin[2])).coeffs();
}

inline void tumble(RigidBody& body, Vector torque, const StepRules& rules) {
    const double dt = rules.time_step;
    if (body.inertia.damped)
        for (int axis = 0; axis < 3; ++axis) {
            const double power = torque[axis] * body.spin[axis];
            torque[axis] *= 1 - rules.damping * ((power > 0) - (power < 0));
        }
    Eigen::Quaterniond& q = body.orientation;
    const auto own_spin = [&](const Vector& momentum) {
        return Vector((q.conjugate() * momentum).cwiseQuotient(body.inertia.inertia));
    };
    const Vector spin_now = own_spin(body.angular_momentum + 0.5 * dt * torque);
    const Eigen::Quaterniond half(Eigen::Vector4d(q.coeffs() + 0.5 * dt * quaternion_rate(spin_now, q)));
    body.angular_momentum += dt * torque;
    const Vector spin_half = own_spin(body.angular_momentum);
    q.coeffs() += dt * quaternion_rate(spin_half, half);
    body.spin = q * spin_half;
    q.normalize();
}

} // namespace detail

// `aspherical`: the moments of inertia are those of the body's own axes and differ.
inline void advance(RigidBody& body, const Vector& force, const Vector& torque, const StepRules& rules,
                    bool aspherical) {
    constexpr unsigned all = 63, rotations = 56;
    const bool tumbles = aspherical && !(body.inertia.blocked & rotations);
    if (body.inertia.blocked != all) {
        accelerate(body.velocity, force, body.inertia, rules);
        if (!tumbles)
            spin_up(body.spin, torque, body.inertia, rules);
    }
    body.centre += rules.time_step * body.velocity;
    if (tumbles)
        detail::tumble(body, torque, rules);
    else
        body.orientation = turned(body.orientation, rules.time_step * body.spin).normalized();
}

} // namespace grainfall::flat
