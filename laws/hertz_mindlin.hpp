// SPDX-License-Identifier: GPL-2.0-or-later
// One step of the contact law: Eq 3 (or Hertz), Eq 4-6 and the dashpots, put together from policies.
//
//   Normal      Hertz | ReportNormal
//   Tangential  NoTangential | IncrementalTangential | PartialSlipTangential | SecantTangential |
//               ReportTangential
//   Damping     NoDamping | RepulsiveDashpot | AttractiveDashpot
//   Friction    one of laws/friction/
//   Energy      NoEnergy | DissipationBook
//
// What is not chosen is not compiled in. The equations stand in the policies' headers. Units SI, signs as in
// contact.hpp. The caller holds overlap >= 0 and time_step > 0.
#pragma once

#include <laws/contact.hpp>
#include <laws/coulomb_cap.hpp>
#include <laws/damping.hpp>
#include <laws/energy.hpp>
#include <laws/normal_force.hpp>
#include <laws/partial_slip.hpp>
#include <laws/tangential_force.hpp>

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace grainfall::laws {

template <class Normal, class Tangential, class Damping, class Friction, class Energy = NoEnergy>
struct HertzMindlin {
    static constexpr bool slips_partially = std::is_same_v<Tangential, PartialSlipTangential>;
    template <class Scalar>
    using MemoryOf = std::conditional_t<slips_partially, PartialSlipMemory, ContactMemoryOf<Scalar>>;
    using Memory = MemoryOf<double>;

    template <class Scalar>
    static ContactForceOf<Scalar> step(const ContactGeometryOf<Scalar>& geometry,
                                       const ContactParametersOf<Scalar>& parameters,
                                       const Friction& friction, MemoryOf<Scalar>& memory, Energy& energy) {
        using std::sqrt;
        const Scalar root_overlap = sqrt(geometry.overlap);
        ContactForceOf<Scalar> force;
        force.normal_stiffness = Normal::stiffness(parameters.normal_coefficient, root_overlap);
        force.normal = Normal::force(parameters.normal_coefficient, geometry.overlap, root_overlap);

        Scalar quarter_power = 0; // overlap^(1/4)
        if constexpr (Damping::active) {
            quarter_power = sqrt(root_overlap);
            const Scalar elastic = force.normal;
            const Scalar c = Normal::square_root_of_factor * parameters.normal_damping * quarter_power;
            force.normal = Damping::total(elastic, Scalar(-c * geometry.normal_velocity));
            if constexpr (Energy::active) {
                energy.add_normal(force.normal - elastic, geometry.normal_velocity * geometry.time_step);
            }
        }
        if constexpr (slips_partially) {
            partial_slip(geometry, parameters, friction, root_overlap, quarter_power, memory, energy, force);
        } else if constexpr (Tangential::active) {
            shear(geometry, parameters, friction, root_overlap, quarter_power, memory, energy, force);
        }
        return force;
    }

private:
    template <class Scalar>
    [[gnu::always_inline]] static void
    shear(const ContactGeometryOf<Scalar>& geometry, const ContactParametersOf<Scalar>& parameters,
          const Friction& friction, const Scalar& root_overlap, const Scalar& quarter_power,
          ContactMemoryOf<Scalar>& memory, Energy& energy, ContactForceOf<Scalar>& force) {
        const Scalar stiffness =
            shear_stiffness<Normal, Tangential>(parameters.shear_coefficient, root_overlap);
        force.shear_stiffness = stiffness;
        const VectorOf<Scalar> before = rotated_with_contact(memory.shear_force, geometry);
        VectorOf<Scalar> elastic = before;
        if constexpr (Tangential::rescales_on_loading || Tangential::rescales_on_unloading) {
            const auto rescales = Tangential::rescales_on_loading ? memory.shear_stiffness > 0
                                                                  : stiffness < memory.shear_stiffness;
            if (any(rescales))
                elastic *= where(rescales, stiffness / memory.shear_stiffness, Scalar(1));
        }
        const VectorOf<Scalar> rescaled = elastic;
        elastic -= stiffness * geometry.shear_increment;
        const VectorOf<Scalar> trial = elastic;

        const Scalar load = Damping::attracts ? larger(Scalar(0), force.normal) : force.normal;
        if constexpr (Damping::active) {
            // sqrt(k_t / k_t of Hertz and Mindlin) at the same overlap.
            constexpr double factor = Tangential::square_root_of_factor * Normal::sixth_root_of_factor;
            const Scalar c = factor * parameters.shear_damping * quarter_power;
            const VectorOf<Scalar> viscous = Scalar(-c / geometry.time_step) * geometry.shear_increment;
            force.sliding = cap_shear(friction, load, viscous, elastic, force.shear);
            if constexpr (Energy::active)
                energy.add_shear_viscous(force.shear - elastic, geometry.shear_increment);
        } else {
            force.sliding = cap_shear(friction, load, elastic);
            force.shear = elastic;
        }
        if constexpr (Energy::active) {
            energy.add_shear(before, memory.shear_stiffness, rescaled, trial, elastic, stiffness,
                             geometry.shear_increment);
        }
        memory.shear_force = elastic;
        memory.shear_stiffness = stiffness;
    }

    static void partial_slip(const ContactGeometry& geometry, const ContactParameters& parameters,
                             const Friction& friction, double root_overlap, double quarter_power,
                             PartialSlipMemory& memory, Energy& energy, ContactForce& force) {
        const double coefficient = shear_stiffness<Normal, Tangential>(parameters.shear_coefficient, 1.0);
        force.shear_stiffness = coefficient * root_overlap;
        const double load = std::max(0.0, force.normal);
        const double limit = load > 0 ? friction.coefficient(load) * load : 0;
        const double limit_slope = limit > 0 ? 1.5 * limit / (force.shear_stiffness * geometry.overlap) : 0;

        carry_slip_history(memory, geometry, coefficient, limit_slope);
        SlipHistory& history = memory.history;
        const Vector across = geometry.normal.cross(history.axis);
        Vector before = Vector::Zero();
        double energy_before = 0;
        if constexpr (Energy::active) {
            before = rotated_with_contact(memory.shear_force, geometry);
            energy_before = shear_elastic_energy(history);
        }
        const Planar shift(-history.axis.dot(geometry.shear_increment),
                           -across.dot(geometry.shear_increment));
        advance_slip_history(history, root_overlap, shift, limit_slope);
        const Planar sum = coefficient * history.integral();
        Vector elastic = sum.x() * history.axis + sum.y() * across;

        Vector viscous = Vector::Zero();
        if constexpr (Damping::active) {
            constexpr double factor = Tangential::square_root_of_factor * Normal::sixth_root_of_factor;
            viscous = (-factor * parameters.shear_damping * quarter_power / geometry.time_step) *
                      geometry.shear_increment;
        }
        force.sliding = cap_shear(friction, load, viscous, elastic, force.shear) || history.slides;
        if constexpr (Energy::active) {
            energy.add_shear_viscous(force.shear - elastic, geometry.shear_increment);
            energy.add_partial_slip(before, energy_before, elastic, shear_elastic_energy(history),
                                    geometry.shear_increment);
        }
        memory.shear_force = elastic;
        memory.shear_stiffness = force.shear_stiffness;
        history.force_squared = elastic.squaredNorm();
    }
};

} // namespace grainfall::laws
