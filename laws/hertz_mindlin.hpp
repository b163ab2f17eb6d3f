// SPDX-License-Identifier: GPL-2.0-or-later
// One step of the contact law: Eq 3 (or Hertz), Eq 4-6 and the dashpots, put together from policies.
//
//   Normal      Hertz | ReportNormal
//   Tangential  NoTangential | IncrementalTangential | SecantTangential | ReportTangential
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
#include <laws/tangential_force.hpp>

#include <algorithm>
#include <cmath>

namespace grainfall::laws {

template <class Normal, class Tangential, class Damping, class Friction, class Energy = NoEnergy>
struct HertzMindlin {
    static ContactForce step(const ContactGeometry& geometry, const ContactParameters& parameters,
                             const Friction& friction, ContactMemory& memory, Energy& energy) {
        const double root_overlap = std::sqrt(geometry.overlap);
        ContactForce force;
        force.normal_stiffness = Normal::stiffness(parameters.normal_coefficient, root_overlap);
        force.normal = Normal::force(parameters.normal_coefficient, geometry.overlap, root_overlap);

        double quarter_power = 0; // overlap^(1/4)
        if constexpr (Damping::active) {
            quarter_power = std::sqrt(root_overlap);
            const double elastic = force.normal;
            const double c = Normal::square_root_of_factor * parameters.normal_damping * quarter_power;
            force.normal = Damping::total(elastic, -c * geometry.normal_velocity);
            if constexpr (Energy::active) {
                energy.add_normal(force.normal - elastic, geometry.normal_velocity * geometry.time_step);
            }
        }
        if constexpr (Tangential::active) {
            shear(geometry, parameters, friction, root_overlap, quarter_power, memory, energy, force);
        }
        return force;
    }

private:
    [[gnu::always_inline]] static void shear(const ContactGeometry& geometry,
                                             const ContactParameters& parameters, const Friction& friction,
                                             double root_overlap, double quarter_power, ContactMemory& memory,
                                             Energy& energy, ContactForce& force) {
        const double stiffness =
            shear_stiffness<Normal, Tangential>(parameters.shear_coefficient, root_overlap);
        force.shear_stiffness = stiffness;
        const Vector before = rotated_with_contact(memory.shear_force, geometry);
        Vector elastic = before;
        if constexpr (Tangential::rescales_on_loading) {
            if (memory.shear_stiffness > 0)
                elastic *= stiffness / memory.shear_stiffness;
        } else if constexpr (Tangential::rescales_on_unloading) {
            if (stiffness < memory.shear_stiffness)
                elastic *= stiffness / memory.shear_stiffness;
        }
        const Vector rescaled = elastic;
        elastic -= stiffness * geometry.shear_increment;
        const Vector trial = elastic;

        const double load = Damping::attracts ? std::max(0.0, force.normal) : force.normal;
        if constexpr (Damping::active) {
            // sqrt(k_t / k_t of Hertz and Mindlin) at the same overlap.
            constexpr double factor = Tangential::square_root_of_factor * Normal::sixth_root_of_factor;
            const double c = factor * parameters.shear_damping * quarter_power;
            const Vector viscous = (-c / geometry.time_step) * geometry.shear_increment;
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
};

} // namespace grainfall::laws
