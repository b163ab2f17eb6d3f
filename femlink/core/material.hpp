// SPDX-License-Identifier: GPL-2.0-or-later
// Isotropic linear elasticity (MR-2629, Eq 19): sigma = 2 mu eps + lambda tr(eps) I.
#pragma once

#include <laws/validation.hpp>

#include <map>
#include <string>

namespace grainfall::femlink {

struct Material {
    double young = 0; // Pa
    double poisson = 0;
    double density = 0; // kg/m^3; 0: no weight

    double mu() const { return young / (2 * (1 + poisson)); }
    double lambda() const { return young * poisson / ((1 + poisson) * (1 - 2 * poisson)); }
};

using Materials = std::map<int, Material>; // by region of the mesh

inline void validate(const Material& material, const std::string& owner) {
    laws::require_positive(owner + ".young", material.young);
    if (!(material.poisson > -1 && material.poisson < 0.5))
        laws::reject(owner + ".poisson", material.poisson,
                     "in (-1, 0.5): at 0.5 the continuum has no finite bulk modulus");
    laws::require_not_negative(owner + ".density", material.density);
}

} // namespace grainfall::femlink
