// SPDX-License-Identifier: GPL-2.0-or-later
// Time steps of single grains and single contacts. SI units.
//
//   leapfrog        dt = 2/omega, the limit of stability of an undamped oscillator
//   Hertz impact    m* d'' + K d^1.5 = 0, d' = v at d = 0:  d_max = (5 m* v^2/(4 K))^0.4 (Johnson
//   1985, 11.4),
//                   stiffest there: omega^2 = 3/2 K sqrt(d_max)/m*. The contact lasts 2.9433 d_max/v
//                   = 4.0302/omega, so that a step of s * 2/omega makes 2.015/s steps an impact.
//   Rayleigh        dt = pi R sqrt(rho/G)/(0.1631 nu + 0.8766): a surface wave's way around half a grain
//                   (Thornton & Randall 1988)
//   report, Eq 7-8  dt = pi/10 sqrt(M/k_eff),  k_eff = 2 sqrt(2) G/(3(1-nu)) sqrt(R_e d)
//
// K = 4/3 E* sqrt(R*) in N/m^1.5, d overlap in m, m* effective mass in kg, v speed of approach in m/s. M is
// the mass of the smaller of two grains, R_e = R1 R2/(R1 + R2) as the report defines it; then k_eff = K
// sqrt(d/2).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace grainfall::time_step {

inline constexpr double no_limit = std::numeric_limits<double>::infinity();
inline constexpr double pi = 3.14159265358979323846;

// s; `squared_frequency` omega^2 in 1/s^2.
inline double leapfrog_limit(double squared_frequency) {
    return squared_frequency > 0 ? 2 / std::sqrt(squared_frequency) : no_limit;
}

// m, overlap at which two bodies stop that overlap by `overlap` and approach at `speed`, no other force
// acting.
inline double overlap_reached(double coefficient, double overlap, double effective_mass, double speed) {
    const double stored = overlap * overlap * std::sqrt(overlap);
    const double arriving = speed > 0 ? 1.25 * effective_mass * speed * speed / coefficient : 0;
    // Below this the stiffness rises by less than a thousandth: spare the power.
    if (arriving < 5e-3 * stored)
        return overlap;
    return std::pow(stored + arriving, 0.4);
}

// s, leapfrog's limit at the largest overlap of an impact from free flight.
inline double impact_limit(double coefficient, double effective_mass, double speed) {
    if (!(speed > 0))
        return no_limit;
    const double overlap = overlap_reached(coefficient, 0, effective_mass, speed);
    return leapfrog_limit(1.5 * coefficient * std::sqrt(overlap) / effective_mass);
}

inline double rayleigh_step(double radius, double density, double young, double poisson) {
    const double shear_modulus = young / (2 * (1 + poisson));
    return pi * radius * std::sqrt(density / shear_modulus) / (0.1631 * poisson + 0.8766);
}

// Eq 7 for one contact; no limit without overlap.
inline double report_step(double smaller_mass, double coefficient, double overlap) {
    const double stiffness = coefficient * std::sqrt(overlap / 2);
    return stiffness > 0 ? pi / 10 * std::sqrt(smaller_mass / stiffness) : no_limit;
}

} // namespace grainfall::time_step
