// SPDX-License-Identifier: GPL-2.0-or-later
// Attraction of two grains by the liquid bridge between them.
//
// Willett, Adams, Johnson & Seville 2000, Langmuir 16:9396; s separation, S = (s/2) sqrt(R/V), R and V* as in
// geometry.hpp, gamma surface tension in N/m, theta contact angle in rad, both grains alike (for unlike ones
// the mean of the two angles goes in):
//
//   fit (their appendix)   ln(F/(2 pi R gamma)) = f1 - f2 exp(f3 ln S + f4 ln^2 S),   f1..f4 of ln V* and
//   theta closed form (Eq 12)    F = 2 pi R gamma cos(theta)/(1 + 2.1 S + 10 S^2)
//
// The fit follows the Young-Laplace equation to 2 % up to three quarters of the rupture distance and to 9 %
// at nine tenths (theta = 0, 1e-4 <= V* <= 0.085), to 4 % and 13 % at 20 and 40 degrees. The closed form is 4
// to 25 % high at contact and 10 to 25 % low from half the rupture distance on. Stated range: V* <= 0.1,
// theta <= 50 degrees. Outside 1e-5 <= V* <= 1 the coefficients are those of the nearer end; below it the
// printed ones would let the force rise with the separation. So from V* = 1e-6 on the force falls steadily
// from its value at contact, which is also the force on overlap.
//
// Everything that depends on V* and theta is worked out when a bridge is made.
#pragma once

#include <laws/bridge/geometry.hpp>

#include <algorithm>
#include <cmath>

namespace grainfall::laws::bridge {

struct ForceCurve {
    double contact_force = 0;      // N, at contact and on overlap
    double inverse_length = 0;     // 1/m, S = separation * inverse_length
    double f2 = 0, f3 = 0, f4 = 0; // -, of the fit only
};

struct WillettNumeric {
    static ForceCurve curve(double radius, double volume, double surface_tension, double contact_angle) {
        const double t = contact_angle, t2 = t * t;
        const double l = std::log(std::clamp(volume / (radius * radius * radius), 1e-5, 1.0));
        const auto cubic = [l](double a, double b, double c, double d) {
            return a + l * (b + l * (c + l * d));
        };
        const double f1 =
            cubic(-0.44507 + 0.050832 * t - 1.1466 * t2, -0.1119 - 0.000411 * t - 0.1490 * t2,
                  -0.012101 - 0.0036456 * t - 0.01255 * t2, -0.0005 - 0.0003505 * t - 0.00029076 * t2);
        ForceCurve curve;
        curve.contact_force = 2 * detail::pi * radius * surface_tension * std::exp(f1);
        curve.inverse_length = 0.5 * std::sqrt(radius / volume);
        curve.f2 = cubic(1.9222 - 0.57473 * t - 1.2918 * t2, -0.0668 - 0.1201 * t - 0.22574 * t2,
                         -0.0013375 - 0.0068988 * t - 0.01137 * t2, 0);
        curve.f3 = cubic(1.268 - 0.01396 * t - 0.23566 * t2, 0.198 + 0.092 * t - 0.06418 * t2,
                         0.02232 + 0.02238 * t - 0.009853 * t2, 0.0008585 + 0.001318 * t - 0.00053 * t2);
        curve.f4 = cubic(-0.010703 + 0.073776 * t - 0.34742 * t2, 0.03345 + 0.04543 * t - 0.09056 * t2,
                         0.0018574 + 0.004456 * t - 0.006257 * t2, 0);
        return curve;
    }

    // N, towards each other.
    static double force(const ForceCurve& curve, double separation) {
        if (separation <= 0)
            return curve.contact_force;
        const double log_s = std::log(separation * curve.inverse_length);
        return curve.contact_force * std::exp(-curve.f2 * std::exp(log_s * (curve.f3 + curve.f4 * log_s)));
    }
};

struct WillettClosed {
    static ForceCurve curve(double radius, double volume, double surface_tension, double contact_angle) {
        ForceCurve curve;
        curve.contact_force = 2 * detail::pi * radius * surface_tension * std::cos(contact_angle);
        curve.inverse_length = 0.5 * std::sqrt(radius / volume);
        return curve;
    }

    static double force(const ForceCurve& curve, double separation) {
        const double s = std::max(0.0, separation) * curve.inverse_length;
        return curve.contact_force / (1 + s * (2.1 + 10 * s));
    }
};

} // namespace grainfall::laws::bridge
