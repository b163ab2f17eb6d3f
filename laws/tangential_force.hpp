// SPDX-License-Identifier: GPL-2.0-or-later
// Elastic tangential force, kept step by step.
//
//   report, Eq 4   F_t <- F_t - k_t ds
//   Mindlin        k_t = 8 G* a,  a = (3 F_n R*/(4 E*))^(1/3),  1/G* = (2-nu1)/G1 + (2-nu2)/G2
//   report, Eq 5   k_t = 2 [3 G^2 (1-nu) F_n R_e]^(1/3) / (2-nu) = 2^(-1/3) Mindlin's at the same F_n
//
// F_t in N, k_t in N/m, a contact radius in m, ds the tangential displacement of body 2 seen from body 1 in
// this step in m. Eq 4 prints V1; only the velocity of one surface relative to the other makes sense and is
// used. F_n is the elastic normal force of the law in use. With Hertz a = sqrt(R* d); with Eq 3 it is
// 2^(-1/3) of that.
//
// Eq 4 alone makes energy: shear by s at stiffness k1, let the normal force fall until k2 < k1, shear back,
// and (k1 - k2) s^2/2 has been gained (Elata & Berryman 1996). IncrementalTangential therefore shrinks F_t
// by k2/k1 whenever the stiffness falls, which keeps the elastic displacement; ReportTangential leaves Eq 4
// as printed.
#pragma once

#include <laws/contact.hpp>

#include <Eigen/Geometry>

#include <cmath>

namespace grainfall::laws {

// Turns a tangential force with its contact.
//
// One Cayley step, which keeps lengths to rounding, through tilt and twist together; what the finite step
// leaves standing out of the new tangent plane is removed and the length restored. So rotation alone
// neither makes nor loses elastic energy, and the direction after a full turn in n steps is good to
// O(n^-2). When nothing turns the force is returned unchanged. (YADE's own first-order rotation lengthens
// the force by half the angle squared in every step.)
template <class Scalar>
[[gnu::always_inline]] inline VectorOf<Scalar>
rotated_with_contact(const VectorOf<Scalar>& force, const ContactGeometryOf<Scalar>& geometry) {
    const VectorOf<Scalar> half = 0.5 * (geometry.tilt + geometry.twist);
    const VectorOf<Scalar> turned = half.cross(force);
    VectorOf<Scalar> result =
        force + Scalar(2.0 / (1.0 + half.squaredNorm())) * (turned + half.cross(turned));

    const Scalar out_of_plane = result.dot(geometry.normal);
    const Scalar length_squared = result.squaredNorm();
    result -= out_of_plane * geometry.normal;
    // Below this the length has changed by less than rounding.
    const Scalar lost = out_of_plane * out_of_plane;
    const auto shorter = lost > 1e-20 * length_squared && lost < length_squared;
    if (any(shorter)) {
        using std::sqrt;
        result *= where(shorter, sqrt(length_squared / (length_squared - lost)), Scalar(1));
    }
    return result;
}

// No tangential force at all, hence no friction.
struct NoTangential {
    static constexpr bool active = false;
};

struct IncrementalTangential {
    static constexpr bool active = true;
    static constexpr bool rescales_on_unloading = true;
    static constexpr bool rescales_on_loading = false;
    static constexpr double factor = 1.0;
    static constexpr double square_root_of_factor = 1.0;
};

// Stiffness of the moment times the whole tangential displacement, the law of the reference codes in Chung
// & Ooi (2011). The force grows with the stiffness at constant displacement, so normal loading of a sheared
// contact makes energy: for comparison with published results, not for predictions.
struct SecantTangential {
    static constexpr bool active = true;
    static constexpr bool rescales_on_unloading = true;
    static constexpr bool rescales_on_loading = true;
    static constexpr double factor = 1.0;
    static constexpr double square_root_of_factor = 1.0;
};

struct ReportTangential {
    static constexpr bool active = true;
    static constexpr bool rescales_on_unloading = false;
    static constexpr bool rescales_on_loading = false;
    static constexpr double factor = 0.79370052598409973738;                // 2^(-1/3)
    static constexpr double square_root_of_factor = 0.89089871814033930474; // 2^(-1/6)
};

// N/m, tangent k_t; `coefficient` is 8 G* sqrt(R*).
template <class Normal, class Tangential, class Scalar>
[[gnu::always_inline]] inline Scalar shear_stiffness(const Scalar& coefficient, const Scalar& root_overlap) {
    return Tangential::factor * Normal::cube_root_of_factor * coefficient * root_overlap;
}

// J, energy in the tangential spring: F_t^2/(2 k_t).
template <class Scalar>
[[gnu::always_inline]] inline Scalar shear_elastic_energy(const VectorOf<Scalar>& force,
                                                          const Scalar& stiffness) {
    return where(stiffness > 0, 0.5 * force.squaredNorm() / stiffness, Scalar(0));
}

template <class Scalar>
[[gnu::always_inline]] inline Scalar shear_elastic_energy(const ContactMemoryOf<Scalar>& memory) {
    return shear_elastic_energy(memory.shear_force, memory.shear_stiffness);
}

} // namespace grainfall::laws
