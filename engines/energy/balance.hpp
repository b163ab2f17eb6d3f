// SPDX-License-Identifier: GPL-2.0-or-later
// The terms of an energy balance, what is left over, and by what to measure it. J throughout.
//
//     residual = (stored + dissipated - supplied) now - the same at the start
//
// Energy in play, to which the residual is compared: the largest so far of (a) the kinetic energy and (b) the
// energy that has changed hands since the start, i.e. the sum of all terms that have gained.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace grainfall::energy {

enum class Term {
    kinetic_translation,
    kinetic_rotation,
    potential,
    elastic_normal,
    elastic_shear,
    bridge,
    far_field,
    friction,
    viscous,
    rescaling,
    bridge_rupture,
    far_field_dissipation,
    numerical_damping,
    imposed_motion,
    permanent_load,
    shear_kinematics,
};

enum class Kind { stored, dissipated, supplied };

struct TermName {
    Term term;
    const char* name;
    Kind kind;
    const char* booked_by_law; // name in O.energy of what the contact law sums up itself; else nullptr
};

// In the order of Term.
constexpr std::array<TermName, 16> term_names = {{
    {Term::kinetic_translation, "kineticTranslation", Kind::stored, nullptr},
    {Term::kinetic_rotation, "kineticRotation", Kind::stored, nullptr},
    {Term::potential, "potential", Kind::stored, nullptr},
    {Term::elastic_normal, "elasticNormal", Kind::stored, nullptr},
    {Term::elastic_shear, "elasticShear", Kind::stored, nullptr},
    {Term::bridge, "bridge", Kind::stored, nullptr},
    {Term::far_field, "farField", Kind::stored, nullptr},
    {Term::friction, "friction", Kind::dissipated, "grainFriction"},
    {Term::viscous, "viscous", Kind::dissipated, "grainViscous"},
    {Term::rescaling, "rescaling", Kind::dissipated, "grainRescaling"},
    {Term::bridge_rupture, "bridgeRupture", Kind::dissipated, "grainBridge"},
    {Term::far_field_dissipation, "farFieldDissipation", Kind::dissipated, nullptr},
    {Term::numerical_damping, "numericalDamping", Kind::dissipated, nullptr},
    {Term::imposed_motion, "imposedMotion", Kind::supplied, nullptr},
    {Term::permanent_load, "permanentLoad", Kind::supplied, nullptr},
    {Term::shear_kinematics, "shearKinematics", Kind::supplied, "grainShearKinematics"},
}};

constexpr std::size_t term_count = term_names.size();

struct Amounts {
    std::array<double, term_count> value{};

    double& operator[](Term term) { return value[static_cast<std::size_t>(term)]; }
    double operator[](Term term) const { return value[static_cast<std::size_t>(term)]; }
};

// Gain of a term since the start, counted positive where energy went to.
inline double gain(const TermName& term, const Amounts& now, const Amounts& start) {
    const double change = now[term.term] - start[term.term];
    return term.kind == Kind::supplied ? -change : change;
}

inline double residual(const Amounts& now, const Amounts& start) {
    double sum = 0;
    for (const TermName& term : term_names)
        sum += gain(term, now, start);
    return sum;
}

inline double energy_in_play(const Amounts& now, const Amounts& start) {
    double moved = 0;
    for (const TermName& term : term_names)
        moved += std::max(0.0, gain(term, now, start));
    return std::max(moved, now[Term::kinetic_translation] + now[Term::kinetic_rotation]);
}

} // namespace grainfall::energy
