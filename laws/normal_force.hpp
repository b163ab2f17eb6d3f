// SPDX-License-Identifier: GPL-2.0-or-later
// Elastic normal force of two spheres as a function of their overlap.
//
//   Hertz          F = 4/3 E* sqrt(R*) d^(3/2)             k_n = dF/dd = 3/2 F/d
//   report, Eq 3   F = 2G/(3(1-nu)) sqrt(R_e) d^(3/2),     R_e = R1 R2/(R1 + R2)
//
// F in N, d overlap in m, E* = [(1-nu1^2)/E1 + (1-nu2^2)/E2]^-1 in Pa, R* = R1 R2/(R1 + R2) in m, G shear
// modulus in Pa. For spheres of one material E* = G/(1-nu), so Eq 3 with R_e as the report defines it is
// one half of Hertz's force. The printed equation knows one material only; for unlike ones it is read here
// as one half of Hertz's force with their E*. Valid for overlaps much smaller than the radii.
//
// `factor` is F / F_Hertz at the same overlap; its roots are spelled out because std::sqrt and std::cbrt
// are not constexpr in C++17.
#pragma once

namespace grainfall::laws {

template <class Law>
struct NormalForce {
    // N; `root_overlap` is sqrt(overlap), which the law needs in several places.
    template <class Scalar>
    [[gnu::always_inline]] static Scalar force(const Scalar& coefficient, const Scalar& overlap,
                                               const Scalar& root_overlap) {
        return Law::factor * coefficient * (overlap * root_overlap);
    }
    // N/m, tangent.
    template <class Scalar>
    [[gnu::always_inline]] static Scalar stiffness(const Scalar& coefficient, const Scalar& root_overlap) {
        return 1.5 * Law::factor * coefficient * root_overlap;
    }
    // J, work stored between first touch and this overlap: integral of F = 2/5 F d.
    static double elastic_energy(double coefficient, double overlap, double root_overlap) {
        return 0.4 * force(coefficient, overlap, root_overlap) * overlap;
    }
};

struct Hertz : NormalForce<Hertz> {
    static constexpr double factor = 1.0;
    static constexpr double square_root_of_factor = 1.0;
    static constexpr double cube_root_of_factor = 1.0;
    static constexpr double sixth_root_of_factor = 1.0;
};

struct ReportNormal : NormalForce<ReportNormal> {
    static constexpr double factor = 0.5;
    static constexpr double square_root_of_factor = 0.70710678118654752440;
    static constexpr double cube_root_of_factor = 0.79370052598409973738;
    static constexpr double sixth_root_of_factor = 0.89089871814033930474;
};

} // namespace grainfall::laws
