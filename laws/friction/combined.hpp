// SPDX-License-Identifier: GPL-2.0-or-later
// Friction of two unlike surfaces: both curves read at the same load, then one rule.
//
// min, max, mean and geometric mean all commute with a common factor and never lie below the same rule
// applied to the lower bounds, so factors and bounds pass through to the two curves.
#pragma once

#include <laws/combination_rule.hpp>

namespace grainfall::laws::friction {

template <class First, class Second>
struct Combined {
    First first;
    Second second;
    CombinationRule rule = CombinationRule::minimum;

    double coefficient(double load) const {
        return combine(rule, first.coefficient(load), second.coefficient(load));
    }
    double lower_bound() const { return combine(rule, first.lower_bound(), second.lower_bound()); }
    Combined scaled(double factor) const { return {first.scaled(factor), second.scaled(factor), rule}; }
    Combined with_load_scale(double scale) const {
        return {first.with_load_scale(scale), second.with_load_scale(scale), rule};
    }
    void validate() const {
        first.validate();
        second.validate();
    }
};

} // namespace grainfall::laws::friction
