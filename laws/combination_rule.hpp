// SPDX-License-Identifier: GPL-2.0-or-later
// How one number of a pair is made from the numbers of its two members.
#pragma once

#include <laws/validation.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace grainfall::laws {

enum class CombinationRule { minimum, maximum, mean, geometric };

inline double combine(CombinationRule rule, double first, double second) {
    switch (rule) {
    case CombinationRule::minimum:
        return std::min(first, second);
    case CombinationRule::maximum:
        return std::max(first, second);
    case CombinationRule::mean:
        return 0.5 * (first + second);
    case CombinationRule::geometric:
        break;
    }
    return std::sqrt(first * second);
}

// `attribute` is what the complaint calls it, such as "frictionRule".
inline CombinationRule combination_rule_from_name(const std::string& attribute, const std::string& name) {
    if (name == "min")
        return CombinationRule::minimum;
    if (name == "max")
        return CombinationRule::maximum;
    if (name == "mean")
        return CombinationRule::mean;
    if (name == "geometric")
        return CombinationRule::geometric;
    reject(attribute, "'" + name + "'", "'min', 'max', 'mean' or 'geometric'");
}

} // namespace grainfall::laws
