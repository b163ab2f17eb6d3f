// SPDX-License-Identifier: GPL-2.0-or-later
// Coulomb friction: mu does not depend on the load.
//
// Every friction curve offers the same five things, and a law takes any type that has them:
//   coefficient(load)    mu at a normal force in N, >= 0
//   lower_bound()        mu is never below it; lets the law skip the curve where nothing can slide
//   scaled(factor)       the curve with mu multiplied (moisture), worked into its parameters
//   with_load_scale(s)   the curve read at load/s (grains enlarged k times: s = k^2), worked in likewise
//   validate()           throws std::invalid_argument naming attribute, value and allowed range
// The two that transform are called when a contact is made, so neither costs anything in the loop.
#pragma once

#include <laws/validation.hpp>

namespace grainfall::laws::friction {

struct Constant {
    double mu = 0; // -

    double coefficient(double /*load*/) const { return mu; }
    double lower_bound() const { return mu; }
    Constant scaled(double factor) const { return {mu * factor}; }
    Constant with_load_scale(double /*scale*/) const { return *this; }
    void validate() const { require_not_negative("ConstantFriction.mu", mu); }
};

} // namespace grainfall::laws::friction
