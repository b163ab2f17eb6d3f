// SPDX-License-Identifier: GPL-2.0-or-later
// Viscous resistance of the liquid in a bridge to normal motion (squeeze film).
//
//   F = -c v,   c = 6 pi eta R*^2 X^2/s,   X = 1 - s/sqrt(s^2 + 2 V/(pi R))
//
// Reynolds' film between spheres, R* = R1 R2/(R1 + R2), with the factor X^2 of Pitois, Moucheront & Chateau
// 2000 (J. Colloid Interface Sci. 231:26) for the finite amount of liquid. eta in Pa s, s separation in m, v
// normal velocity in m/s. Below the `cutoff`, the height of the grains' roughness, and on overlap c stays at
// its value there: the film between rough grains does not close. Tangential resistance is left out.
//
// c >= 0, so the force takes energy as long as the time step resolves it. Where it does not (thick liquids),
// c is held at m*/(4 dt): even a grain with films all around is then slowed, never thrown back.
#pragma once

#include <laws/damping.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace grainfall::laws::bridge {

inline constexpr double largest_damping = 0.25; // of m*/dt

struct FilmParameters {
    double strength = 0;                                   // N s, 6 pi eta R*^2
    double cutoff = 0;                                     // m, > 0
    double area = 0;                                       // m2, 2 V/(pi R)
    double mass = std::numeric_limits<double>::infinity(); // kg, effective mass of the pair
};

struct NoFilm {
    static constexpr bool active = false;
    static double damping(const FilmParameters&, double, double) { return 0; }
};

struct SqueezeFilm {
    static constexpr bool active = true;

    static FilmParameters parameters(double radius, double volume, double viscosity, double cutoff,
                                     double mass) {
        const double reduced_radius = 0.5 * radius;
        return {6 * detail::pi * viscosity * reduced_radius * reduced_radius, cutoff,
                2 * volume / (detail::pi * radius), mass};
    }

    // N s/m
    static double damping(const FilmParameters& film, double separation, double time_step) {
        const double gap = std::max(separation, film.cutoff);
        const double x = 1 - gap / std::sqrt(gap * gap + film.area);
        return std::min(film.strength * x * x / gap, largest_damping * film.mass / time_step);
    }
};

} // namespace grainfall::laws::bridge
