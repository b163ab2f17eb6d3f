// SPDX-License-Identifier: GPL-2.0-or-later
// Where the energy of a contact goes. All in J, added up over the steps.
//
// Leapfrog takes F_m . (v_(m-1/2) + v_(m+1/2)) dt/2 from the motion at step m. Summed over the steps this
// is the mean of the forces applied before and after each displacement increment, times that increment. The
// book uses exactly this sum for the tangential spring, the slider and both dashpots, so that kinetic +
// elastic + booked is constant up to the integrator's own error in the normal spring.
#pragma once

#include <laws/tangential_force.hpp>

namespace grainfall::laws {

struct NoEnergy {
    static constexpr bool active = false;
};

template <class Scalar>
struct DissipationBookOf {
    using Vector = VectorOf<Scalar>;
    static constexpr bool active = true;

    Scalar friction = 0; // work of slip; the elastic part of a step that slips is not in it
    Scalar viscous = 0;  // both dashpots
    // Elastic shear energy that goes when the contact stiffens at constant force or is rescaled as it
    // softens. Negative where the law makes energy: ReportTangential as it softens, SecantTangential as it
    // stiffens.
    Scalar rescaling = 0;

    // The dashpots' part of the last applied force: belongs to the contact, kept from step to step.
    Scalar normal_viscous_force = 0;
    Vector shear_viscous_force = Vector::Zero();

    void add_normal(const Scalar& viscous_force, const Scalar& displacement) {
        viscous -= 0.5 * (normal_viscous_force + viscous_force) * displacement;
        normal_viscous_force = viscous_force;
    }

    // Elastic shear force: `before` the step (already turned with the contact), `rescaled`, after the
    // increment (`trial`) and after the cap (`after`).
    void add_shear(const Vector& before, const Scalar& stiffness_before, const Vector& rescaled,
                   const Vector& trial, const Vector& after, const Scalar& stiffness,
                   const Vector& increment) {
        rescaling += shear_elastic_energy(before, stiffness_before) -
                     shear_elastic_energy(rescaled, stiffness) - 0.5 * (before - rescaled).dot(increment);
        const Scalar slip_work = 0.5 * (rescaled + after).dot(trial - after) / stiffness;
        friction += where(stiffness > 0, slip_work, Scalar(0));
    }

    // A contact that slips from its rim inwards: elastic shear force (turned with the contact) and energy
    // before and after the step. What is not stored is slip.
    void add_partial_slip(const Vector& before, const Scalar& energy_before, const Vector& after,
                          const Scalar& energy_after, const Vector& increment) {
        friction -= 0.5 * (before + after).dot(increment) + (energy_after - energy_before);
    }

    void add_shear_viscous(const Vector& viscous_force, const Vector& increment) {
        viscous -= 0.5 * (shear_viscous_force + viscous_force).dot(increment);
        shear_viscous_force = viscous_force;
    }

    // A contact that opens drops what its tangential spring still held.
    template <class Memory>
    void add_opening(const Memory& memory) {
        rescaling += shear_elastic_energy(memory);
    }
};
using DissipationBook = DissipationBookOf<double>;

} // namespace grainfall::laws
