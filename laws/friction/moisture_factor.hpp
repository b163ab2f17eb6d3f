// SPDX-License-Identifier: GPL-2.0-or-later
// Factor on friction as a function of gravimetric moisture w (kg water per kg dry sand): straight between
// the given points, constant beyond the outermost. Read when a contact is made. Published quartz data show
// no clear fall with moisture (Senetakis, Coop & Todisco 2013), so there is no default curve.
#pragma once

#include <laws/friction/table.hpp>
#include <laws/validation.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace grainfall::laws::friction {

struct MoistureFactor {
    std::vector<double> moistures; // ascending
    std::vector<double> factors;   // -

    double at(double moisture) const { return interpolate(factors, bracket(moistures, moisture)); }

    void validate() const {
        require_ascending("MoistureFactor.moistures", moistures);
        require_length("MoistureFactor.factors", factors.size(), moistures.size(), "one for each moisture");
        for (std::size_t i = 0; i < factors.size(); ++i) {
            require_not_negative("MoistureFactor.factors[" + std::to_string(i) + "]", factors[i]);
        }
    }
};

} // namespace grainfall::laws::friction
