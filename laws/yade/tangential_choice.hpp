// SPDX-License-Identifier: GPL-2.0-or-later
// Which of the tangential laws an attribute names.
#pragma once

#include <string>

namespace yade {

template <class Choice>
Choice by_tangential_law(const std::string& name, Choice incremental, Choice partial_slip, Choice secant,
                         Choice report, Choice frictionless) {
    return name == "mindlin-deresiewicz" ? partial_slip
           : name == "report"            ? report
           : name == "secant"            ? secant
           : name == "none"              ? frictionless
                                         : incremental;
}

} // namespace yade
