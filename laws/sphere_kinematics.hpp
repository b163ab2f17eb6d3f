// SPDX-License-Identifier: GPL-2.0-or-later
// How the contact of two spheres, or of a sphere and a plane, lies and moves.
//
//   overlap  d = R1 + R2 - |x2 - x1|                                        (report, Eq 2 with its sign
//   turned) shear    ds = dt (1 - n n) [a (v2 - v1) - (R1 w1 + R2 w2) x n],  a = (R1 + R2)/(R1 + R2 - d) tilt
//   old normal x new normal;   twist = dt/2 [old normal . (w1 + w2)] old normal
//
// a and the undeformed radii in place of the distances to the contact point are YADE's
// ("avoidGranularRatcheting", after McNamara, Garcia-Rojo & Herrmann 2008, Phys. Rev. E 77:031304): a closed
// path of the spheres leaves no shear behind. The normal velocity is that of the material at the contact
// point, where the force acts.
#pragma once

#include <laws/contact.hpp>

#include <Eigen/Geometry>

#include <cmath>

namespace grainfall::laws {

// Where two bodies touch. A plane counts as a sphere of some large radius.
template <class Scalar>
struct TouchOf {
    using Vector = VectorOf<Scalar>;
    Vector normal = Vector::UnitX(); // unit vector, 1 -> 2
    Scalar overlap = 0;              // m, negative when apart
    Scalar radius1 = 0, radius2 = 0; // m, of the undeformed bodies
};
using Touch = TouchOf<double>;

template <class Scalar>
[[gnu::always_inline]] inline TouchOf<Scalar> touch_of_spheres(const VectorOf<Scalar>& branch,
                                                               const Scalar& distance, const Scalar& radius1,
                                                               const Scalar& radius2) {
    return {branch / distance, radius1 + radius2 - distance, radius1, radius2};
}

// m/s, velocity of body 2 seen from body 1 at the contact, as shear counts it.
template <class Scalar>
[[gnu::always_inline]] inline VectorOf<Scalar>
shear_velocity(const TouchOf<Scalar>& touch, const VectorOf<Scalar>& velocity, const VectorOf<Scalar>& spin1,
               const VectorOf<Scalar>& spin2) {
    const Scalar sum = touch.radius1 + touch.radius2;
    const Scalar alpha = sum / (sum - touch.overlap);
    const VectorOf<Scalar> spin = touch.radius1 * spin1 + touch.radius2 * spin2;
    const VectorOf<Scalar> relative = alpha * velocity - spin.cross(touch.normal);
    return relative - touch.normal.dot(relative) * touch.normal;
}

// `velocity` is that of body 2 less that of body 1. Fills everything but tilt and twist.
template <class Scalar>
[[gnu::always_inline]] inline void put_motion(ContactGeometryOf<Scalar>& geometry,
                                              const TouchOf<Scalar>& touch, const VectorOf<Scalar>& velocity,
                                              const VectorOf<Scalar>& spin1, const VectorOf<Scalar>& spin2,
                                              double time_step) {
    geometry.overlap = touch.overlap;
    geometry.normal = touch.normal;
    geometry.shear_increment = Scalar(time_step) * shear_velocity(touch, velocity, spin1, spin2);
    geometry.normal_velocity = velocity.dot(touch.normal);
    geometry.time_step = time_step;
}

// How the contact turned since its normal was `before`.
template <class Scalar>
[[gnu::always_inline]] inline void put_rotation(ContactGeometryOf<Scalar>& geometry,
                                                const VectorOf<Scalar>& before, const VectorOf<Scalar>& spin1,
                                                const VectorOf<Scalar>& spin2) {
    geometry.tilt = before.cross(geometry.normal);
    geometry.twist = (0.5 * geometry.time_step * before.dot(spin1 + spin2)) * before;
}

} // namespace grainfall::laws
