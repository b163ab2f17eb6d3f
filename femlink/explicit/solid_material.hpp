// SPDX-License-Identifier: GPL-2.0-or-later
// Parameters of the solids of the explicit continuum and what they must satisfy.
#pragma once

#include <femlink/core/material.hpp>

#include <map>
#include <string>

namespace grainfall::femlink {

enum class SolidLaw { st_venant, neo_hooke, j2, drucker_prager };

inline SolidLaw solid_law_from_name(const std::string& attribute, const std::string& name) {
    if (name == "st-venant")
        return SolidLaw::st_venant;
    if (name == "neo-hooke")
        return SolidLaw::neo_hooke;
    if (name == "j2")
        return SolidLaw::j2;
    if (name == "drucker-prager")
        return SolidLaw::drucker_prager;
    laws::reject(attribute, "'" + name + "'", "'st-venant', 'neo-hooke', 'j2' or 'drucker-prager'");
}

struct SolidMaterial {
    SolidLaw law = SolidLaw::neo_hooke;
    Material elastic;          // Young's modulus and Poisson's ratio at small strain, density
    double yield_stress = 0;   // Pa, j2
    double hardening = 0;      // Pa, j2: slope of the yield stress over the plastic strain
    double cohesion = 0;       // Pa, drucker-prager
    double friction_angle = 0; // rad, drucker-prager
    double dilatancy = 0;      // rad, drucker-prager
};

using SolidMaterials = std::map<int, SolidMaterial>; // by region of the mesh

inline void validate(const SolidMaterial& material, const std::string& owner) {
    validate(material.elastic, owner);
    laws::require_positive(owner + ".density", material.elastic.density); // inertia
    if (material.law == SolidLaw::j2) {
        laws::require_positive(owner + ".yield_stress", material.yield_stress);
        laws::require_not_negative(owner + ".hardening", material.hardening);
    }
    if (material.law == SolidLaw::drucker_prager) {
        constexpr double right_angle = 1.5707963267948966;
        laws::require_not_negative(owner + ".cohesion", material.cohesion);
        if (!(material.friction_angle >= 0 && material.friction_angle < right_angle))
            laws::reject(owner + ".friction_angle", material.friction_angle, "in [0, pi/2), in rad");
        if (!(material.dilatancy >= 0 && material.dilatancy <= material.friction_angle))
            laws::reject(owner + ".dilatancy", material.dilatancy,
                         "in [0, friction_angle], in rad: above it plastic flow would create energy");
        if (material.cohesion == 0 && material.friction_angle == 0)
            laws::reject(owner + ".cohesion", material.cohesion,
                         "> 0 where the friction angle is 0: without both the soil has no strength");
    }
}

} // namespace grainfall::femlink
