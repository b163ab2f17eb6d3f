// SPDX-License-Identifier: GPL-2.0-or-later
// Friction that falls with a power of the load:  mu = mu_ref (N/N_ref)^-p, kept within [mu_min, mu_max].
//
// N normal force in N. The cap mu_max is needed because the power has no bound as N -> 0.
#pragma once

#include <laws/validation.hpp>

#include <algorithm>
#include <cmath>

namespace grainfall::laws::friction {

struct PowerLaw {
    double mu_ref = 0;   // -, at load_ref
    double load_ref = 1; // N
    double exponent = 0; // -
    double mu_min = 0;   // -
    double mu_max = 0;   // -

    double coefficient(double load) const {
        const double power = mu_ref * std::pow(std::max(load, tiny_load) / load_ref, -exponent);
        // In this order 0 * infinity (no friction, no load) gives mu_max, which is 0 as well.
        return std::max(mu_min, std::min(mu_max, power));
    }
    double lower_bound() const { return mu_min; }
    PowerLaw scaled(double factor) const {
        return {mu_ref * factor, load_ref, exponent, mu_min * factor, mu_max * factor};
    }
    PowerLaw with_load_scale(double scale) const {
        return {mu_ref, load_ref * scale, exponent, mu_min, mu_max};
    }
    void validate() const {
        require_positive("PowerLawFriction.muRef", mu_ref);
        require_positive("PowerLawFriction.loadRef", load_ref);
        require_not_negative("PowerLawFriction.exponent", exponent);
        require_not_negative("PowerLawFriction.muMin", mu_min);
        require_not_negative("PowerLawFriction.muMax", mu_max);
        if (mu_max < mu_min)
            reject("PowerLawFriction.muMax", mu_max, "at least muMin");
    }

private:
    static constexpr double tiny_load = 1e-300;
};

// Cole (2015) as the report quotes him: 0.8 at 1 N and 0.2 at 20 N, ln 4/ln 20 between. Held constant
// outside that range, where nothing was measured.
inline PowerLaw cole_power_law() {
    return {0.8, 1.0, std::log(4.0) / std::log(20.0), 0.2, 0.8};
}

} // namespace grainfall::laws::friction
