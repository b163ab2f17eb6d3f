// SPDX-License-Identifier: GPL-2.0-or-later
// Size of a liquid bridge between two grains, or between a grain and a flat wall. SI units.
//
//   R    = 2 R1 R2/(R1 + R2)                            radius of the equal spheres that stand for the pair
//   V*   = V/R^3                                        relative volume
//   s_r  = R (1 + theta/2)(V*^(1/3) + V*^(2/3)/10)      separation at which the bridge ruptures
//
// R after Derjaguin: a wall, infinite radius, gives R = 2 R1. s_r: Lian, Thornton & Adams 1993, in the form
// of Willett, Adams, Johnson & Seville 2000 (Langmuir 16:9396), Eq 15, theta in rad. Unequal radii enter by R
// alone, which is good while the bridge is small beside the smaller sphere.
//
// Beyond what volume is this no longer the picture? Two limits, both as V* of equal spheres that touch:
//   - merging: three spheres in mutual contact have their bridges 60 degrees apart, so bridges meet when
//   their
//     half filling angle is 30 degrees. That volume at theta = 0 is 0.0577 by numerical solution of the
//     Young-Laplace equation (benchmarks/young_laplace.py). Beyond it liquid is shared by more than two
//     grains (funicular); Scheel et al. 2008 (Nature Mater. 7:189) saw clusters appear in glass beads at 2 to
//     3 % of the total volume.
//   - fit: 0.1, the largest volume that Willett et al. fitted.
#pragma once

#include <laws/pair_rules.hpp>

#include <cmath>

namespace grainfall::laws::bridge {

inline constexpr double largest_pendular_volume = 0.0577; // V*, bridges of neighbouring contacts meet
inline constexpr double largest_fitted_volume = 0.1;      // V*, Willett et al. 2000
inline constexpr double largest_contact_angle = 0.8727;   // rad, 50 degrees, Willett et al. 2000

// m; either radius may be infinite, not both.
inline double equal_sphere_radius(double first, double second) {
    return 2 * effective_radius(first, second);
}

// m, distance of the surfaces.
inline double rupture_distance(double radius, double volume, double contact_angle) {
    const double root = std::cbrt(volume) / radius; // V*^(1/3)
    return radius * (1 + 0.5 * contact_angle) * root * (1 + 0.1 * root);
}

} // namespace grainfall::laws::bridge
