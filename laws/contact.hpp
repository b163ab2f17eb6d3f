// SPDX-License-Identifier: GPL-2.0-or-later
// Plain data that goes into and comes out of a contact law. SI units throughout.
//
// Signs are YADE's: the normal points from body 1 to body 2, relative motion is that of body 2 seen from
// body 1, and the force on body 2 is  normal * n + shear  (body 1 gets the opposite).
#pragma once

#include <laws/lanes.hpp>

#include <Eigen/Core>

namespace grainfall::laws {

using Vector = Eigen::Vector3d;

// How the contact lies and how it moved during the last step.
template <class Scalar>
struct ContactGeometryOf {
    using Vector = VectorOf<Scalar>;
    Scalar overlap = 0;                      // m, >= 0: the report's Eq 2 with its sign turned
    Vector normal = Vector::UnitX();         // unit vector, 1 -> 2
    Vector shear_increment = Vector::Zero(); // m, tangential displacement in this step
    Vector tilt = Vector::Zero();            // rad, old normal x new normal
    Vector twist = Vector::Zero();           // rad, turn of the contact about its own normal
    Scalar normal_velocity = 0;              // m/s, along the normal; negative while approaching
    double time_step = 0;                    // s
};
using ContactGeometry = ContactGeometryOf<double>;

// Constants of a contact, fixed when it is made. They do not depend on the law chosen: each law multiplies
// them by its own compile-time factor.
template <class Scalar>
struct ContactParametersOf {
    Scalar normal_coefficient = 0; // N/m^1.5, 4/3 E* sqrt(R*)
    Scalar shear_coefficient = 0;  // N/m^1.5, 8 G* sqrt(R*)
    Scalar normal_damping = 0;     // N s/m^1.25, 2 zeta sqrt(m* 3/2 normal_coefficient)
    Scalar shear_damping = 0;      // N s/m^1.25, 2 zeta sqrt(m* shear_coefficient)
};
using ContactParameters = ContactParametersOf<double>;

// What a contact remembers from step to step.
template <class Scalar>
struct ContactMemoryOf {
    using Vector = VectorOf<Scalar>;
    Vector shear_force = Vector::Zero(); // N, elastic part only
    Scalar shear_stiffness = 0;          // N/m, that of the last step; 0 before the first
};
using ContactMemory = ContactMemoryOf<double>;

template <class Scalar>
struct ContactForceOf {
    using Vector = VectorOf<Scalar>;
    Scalar normal = 0;             // N, on body 2 along the normal; negative only with AttractiveDashpot
    Vector shear = Vector::Zero(); // N, on body 2, elastic and viscous together, never above mu * normal
    Scalar normal_stiffness = 0;   // N/m, tangent dF/d(overlap)
    Scalar shear_stiffness = 0;    // N/m, tangent
    MaskOf<Scalar> sliding{false};
};
using ContactForce = ContactForceOf<double>;

} // namespace grainfall::laws
