// SPDX-License-Identifier: GPL-2.0-or-later
// Kinetic energy of rotation of a body with unequal moments of inertia, as YADE integrates it (Allen &
// Tildesley 1989, page 89). SI units.
//
// In step m the angular momentum L goes from L_(m-1/2) to L_(m+1/2) = L_(m-1/2) + T_m dt, without error; the
// orientation goes from Q_m to Q_(m+1). The form that agrees with the trapezoid sum of leapfrog.hpp is
//
//     K_m = 1/2 L_(m-1/2) . J_m^-1 L_(m+1/2),     J_m: inertia at orientation Q_m.
//
// For equal moments it is the one of leapfrog.hpp, and exact. For unequal moments it errs as the integrator
// does, which takes the body's angular velocity at Q_m for that of the whole step: first order in dt. Q_m is
// no longer known once the integrator has run; it is found by undoing its step.
#pragma once

#include <Eigen/Geometry>

namespace grainfall::energy {

struct AsphericalStep {
    Eigen::Quaterniond orientation; // Q_(m+1)
    Eigen::Vector3d momentum;       // kg m2/s, L_(m+1/2), global axes
    Eigen::Vector3d torque;         // N m, T_m as applied, global axes
    Eigen::Vector3d inertia;        // kg m2, principal
    double time_step = 0;           // s
};

// Q_m. Each round of the iteration brings the error down by the angle turned in a step.
inline Eigen::Quaterniond orientation_before(const AsphericalStep& step) {
    const double dt = step.time_step;
    const auto pure = [](const Eigen::Vector3d& v) { return Eigen::Quaterniond(0, v[0], v[1], v[2]); };
    const Eigen::Vector3d mean_momentum = step.momentum - 0.5 * dt * step.torque;
    Eigen::Quaterniond before = step.orientation;
    for (int round = 0; round < 4; ++round) {
        const Eigen::Quaterniond to_body = before.conjugate();
        const Eigen::Vector3d spin_at_start = (to_body * mean_momentum).cwiseQuotient(step.inertia);
        const Eigen::Vector3d spin = (to_body * step.momentum).cwiseQuotient(step.inertia);
        Eigen::Quaterniond turn = pure(spin);
        turn.coeffs() += 0.25 * dt * (pure(spin_at_start) * pure(spin)).coeffs();
        turn.coeffs() *= 0.5 * dt;
        turn.w() += 1;
        before = step.orientation * turn.conjugate();
        before.normalize();
    }
    return before;
}

// K_m [J].
inline double kinetic_energy(const AsphericalStep& step) {
    const Eigen::Quaterniond to_body = orientation_before(step).conjugate();
    const Eigen::Vector3d after = to_body * step.momentum;
    const Eigen::Vector3d before = to_body * (step.momentum - step.time_step * step.torque);
    return 0.5 * before.cwiseQuotient(step.inertia).dot(after);
}

} // namespace grainfall::energy
