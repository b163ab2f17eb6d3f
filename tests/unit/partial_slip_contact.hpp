// SPDX-License-Identifier: GPL-2.0-or-later
// One contact under the partial-slip law, led along a path.
#pragma once

#include "laws_impact.hpp"

#include <laws/friction/constant.hpp>
#include <laws/pair_rules.hpp>

#include <cmath>

namespace partial_slip {

using namespace grainfall::laws;
using friction::Constant;

template <class Energy = NoEnergy, class Friction = Constant>
using Slip = HertzMindlin<Hertz, PartialSlipTangential, NoDamping, Friction, Energy>;

constexpr double overlap = 2e-7, mu = 0.3; // m, -

inline ContactParameters quartz_pair() {
    const ElasticMaterial quartz{70e9, 0.2};
    return contact_parameters(effective_modulus(quartz, quartz), effective_shear_modulus(quartz, quartz),
                              0.5e-3, 1e-5, 0);
}
inline double normal_force(double depth = overlap) {
    return Hertz::force(quartz_pair().normal_coefficient, depth, std::sqrt(depth));
}
// 8 G* a.
inline double stuck_stiffness(double depth = overlap) {
    return quartz_pair().shear_coefficient * std::sqrt(depth);
}

// One contact led along a path; shears positively along `direction`, and gives the force on it back with the
// sign that makes work positive.
template <class Energy = NoEnergy>
struct Contact {
    PartialSlipMemory memory;
    Energy energy;
    ContactGeometry geometry;
    Vector force = Vector::Zero();
    double work = 0; // J, by the mean of the forces before and after
    bool sliding = false;

    explicit Contact(double depth) {
        geometry.normal = Vector(2, -1, 2) / 3;
        geometry.overlap = depth;
        geometry.time_step = 1e-7;
        move(0, Vector::Zero());
    }
    Vector tangent(double angle = 0) const {
        const Vector first = Vector(1, 2, 0) / std::sqrt(5.0);
        return std::cos(angle) * first + std::sin(angle) * geometry.normal.cross(first);
    }
    void move(double deeper, const Vector& shear, double friction = mu) {
        geometry.overlap += deeper;
        geometry.shear_increment = shear;
        const Vector before = force;
        const ContactForce applied =
            Slip<Energy>::step(geometry, quartz_pair(), Constant{friction}, memory, energy);
        force = -applied.shear;
        sliding = applied.sliding;
        work += 0.5 * (before + force).dot(shear);
    }
    void shear(double distance, int steps, double angle = 0) {
        for (int i = 0; i < steps; ++i)
            move(0, distance / steps * tangent(angle));
    }
};

// Mindlin & Deresiewicz at constant normal force N; `limit` is mu N, `stiffness` 8 G* a, so that S/a = 8/k.
inline double loading_displacement(double force, double limit, double stiffness) {
    return 1.5 * limit / stiffness * (1 - std::pow(1 - force / limit, 2.0 / 3));
}

} // namespace partial_slip
