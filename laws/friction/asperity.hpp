// SPDX-License-Identifier: GPL-2.0-or-later
// Friction of an elastic asperity whose shear strength grows with pressure, tau = tau_0 + alpha p:
//   mu = alpha + C N^(-1/3), kept within [mu_min, mu_max].
//
// N in N, C in N^(1/3). The contact area of a Hertz contact grows as N^(2/3), hence the power (Archard
// 1957). The cap mu_max is needed because N^(-1/3) has no bound as N -> 0. alpha < 0 has no physical
// meaning; it is allowed as a fit, with mu_min (0 by default) below it.
#pragma once

#include <laws/validation.hpp>

#include <algorithm>
#include <cmath>

namespace grainfall::laws::friction {

struct Asperity {
    double alpha = 0;  // -
    double c = 0;      // N^(1/3)
    double mu_max = 0; // -
    double mu_min = 0; // -

    double coefficient(double load) const {
        return std::max(mu_min, std::min(mu_max, alpha + c / std::cbrt(std::max(load, tiny_load))));
    }
    double lower_bound() const { return std::max(mu_min, std::min(mu_max, alpha)); }
    Asperity scaled(double factor) const {
        return {alpha * factor, c * factor, mu_max * factor, mu_min * factor};
    }
    Asperity with_load_scale(double scale) const { return {alpha, c * std::cbrt(scale), mu_max, mu_min}; }
    void validate() const {
        require_finite("AsperityFriction.alpha", alpha);
        require_not_negative("AsperityFriction.c", c);
        require_not_negative("AsperityFriction.muMin", mu_min);
        require_not_negative("AsperityFriction.muMax", mu_max);
        if (mu_max < mu_min)
            reject("AsperityFriction.muMax", mu_max, "at least muMin");
    }

private:
    static constexpr double tiny_load = 1e-300;
};

// Through 0.8 at 1 N and 0.2 at 20 N, the two values the report quotes from Cole (2015), constant outside.
// N^(-1/3) falls by a factor of 2.7 over that range at most, less than the 4 wanted, so alpha comes out
// negative: a fit, and a sign that Cole's fall is steeper than one elastic asperity explains.
inline Asperity cole_asperity() {
    const double c = (0.8 - 0.2) / (1.0 - 1.0 / std::cbrt(20.0));
    return {0.8 - c, c, 0.8, 0.2};
}

} // namespace grainfall::laws::friction
