// SPDX-License-Identifier: GPL-2.0-or-later
// Properties of a contact from those of its two bodies. SI units.
//
//   1/E* = (1-nu1^2)/E1 + (1-nu2^2)/E2        1/G* = (2-nu1)/G1 + (2-nu2)/G2,  G = E/(2(1+nu))
//   1/R* = 1/R1 + 1/R2                        1/m* = 1/m1 + 1/m2
//
// A flat wall has an infinite radius, a body that is held has an infinite mass: pass `infinite`.
#pragma once

#include <laws/combination_rule.hpp>
#include <laws/contact.hpp>
#include <laws/damping.hpp>
#include <laws/validation.hpp>

#include <cmath>
#include <limits>
#include <string>

namespace grainfall::laws {

inline constexpr double infinite = std::numeric_limits<double>::infinity();

struct ElasticMaterial {
    double young = 0;   // Pa
    double poisson = 0; // -
};

// `owner` names the material in the complaint, such as "GrainMat".
inline void validate(const ElasticMaterial& material, const std::string& owner) {
    require_positive(owner + ".young", material.young);
    const double nu = material.poisson;
    if (!(nu > -1 && nu <= 0.5))
        reject(owner + ".poisson", nu, "in (-1, 0.5]");
}

inline double shear_modulus(const ElasticMaterial& material) {
    return material.young / (2 * (1 + material.poisson));
}

inline double effective_modulus(const ElasticMaterial& first, const ElasticMaterial& second) {
    return 1 / ((1 - first.poisson * first.poisson) / first.young +
                (1 - second.poisson * second.poisson) / second.young);
}

inline double effective_shear_modulus(const ElasticMaterial& first, const ElasticMaterial& second) {
    return 1 / ((2 - first.poisson) / shear_modulus(first) + (2 - second.poisson) / shear_modulus(second));
}

// x1 x2/(x1 + x2), with either one allowed to be infinite.
inline double reduced(double first, double second) {
    if (std::isinf(first))
        return second;
    if (std::isinf(second))
        return first;
    return first * second / (first + second);
}

inline double effective_radius(double first, double second) {
    return reduced(first, second);
}
inline double effective_mass(double first, double second) {
    return reduced(first, second);
}

// Factor k^2 by which the load on a contact of enlarged grains exceeds that on the real ones it stands for.
//
// Grains made k times larger carry the same stress with k^2 times the force. k = R*/R*_ref, a flat wall
// being flat in both. A reference radius of 0 means a body that was not enlarged.
inline double load_scale(double radius_1, double reference_1, double radius_2, double reference_2) {
    const double real_1 = reference_1 > 0 && std::isfinite(radius_1) ? reference_1 : radius_1;
    const double real_2 = reference_2 > 0 && std::isfinite(radius_2) ? reference_2 : radius_2;
    const double enlarged = effective_radius(radius_1, radius_2);
    if (std::isinf(enlarged))
        return 1;
    const double k = enlarged / effective_radius(real_1, real_2);
    return k * k;
}

inline ContactParameters contact_parameters(double modulus, double modulus_shear, double radius, double mass,
                                            double damping_ratio) {
    ContactParameters parameters;
    const double root_radius = std::sqrt(radius);
    parameters.normal_coefficient = 4.0 / 3.0 * modulus * root_radius;
    parameters.shear_coefficient = 8 * modulus_shear * root_radius;
    // Two bodies that are both held have no mass to damp.
    if (damping_ratio > 0 && std::isfinite(mass)) {
        parameters.normal_damping =
            normal_damping_coefficient(damping_ratio, mass, parameters.normal_coefficient);
        parameters.shear_damping =
            shear_damping_coefficient(damping_ratio, mass, parameters.shear_coefficient);
    }
    return parameters;
}

} // namespace grainfall::laws
