// SPDX-License-Identifier: GPL-2.0-or-later
// Viscous resistance of the liquid in a bridge to normal motion (squeeze film).
//
//   F = -c v,   c = 6 pi eta R*^2 X^2/s,   X = 1 - s/sqrt(s^2 + 2 V/(pi R))
//
// Reynolds' film between spheres, R* = R1 R2/(R1 + R2), with the factor X^2 of Pitois, Moucheront & Chateau
// 2000 (J. Colloid Interface Sci. 231:26) for the finite amount of liquid. eta in Pa s, s separation in m, v
// normal velocity in m/s. Below the `cutoff`, the height of the grains' roughness, and on overlap c stays at
// its value there: the film between rough grains does not close. c >= 0, so the force never does work on the
// grains. Tangential resistance is left out.
#pragma once

#include <laws/damping.hpp>

#include <algorithm>
#include <cmath>

namespace grainfall::laws::bridge {

struct FilmParameters {
    double strength = 0; // N s, 6 pi eta R*^2
    double cutoff = 0;   // m, > 0
    double area = 0;     // m2, 2 V/(pi R)
};

struct NoFilm {
    static constexpr bool active = false;
    static double damping(const FilmParameters&, double) { return 0; }
};

struct SqueezeFilm {
    static constexpr bool active = true;

    static FilmParameters parameters(double radius, double volume, double viscosity, double cutoff) {
        const double reduced_radius = 0.5 * radius;
        return {6 * detail::pi * viscosity * reduced_radius * reduced_radius, cutoff,
                2 * volume / (detail::pi * radius)};
    }

    // N s/m
    static double damping(const FilmParameters& film, double separation) {
        const double gap = std::max(separation, film.cutoff);
        const double x = 1 - gap / std::sqrt(gap * gap + film.area);
        return film.strength * x * x / gap;
    }
};

} // namespace grainfall::laws::bridge
