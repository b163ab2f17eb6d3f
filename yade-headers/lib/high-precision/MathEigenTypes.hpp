// SPDX-License-Identifier: GPL-2.0-or-later
// Facts: names of the fixed-size Eigen types; their sizes and alignment of 8 bytes in the double build.
// Verified: sizes by tests/abi (State.se3, State.refOri, Cell.hSize lie where these sizes put them).
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#ifndef EIGEN_DONT_ALIGN
#error                                                                                                       \
    "YADE's classes were laid out with EIGEN_DONT_ALIGN; without it State is 16 bytes longer than in the library"
#endif

namespace yade {

template <typename Scalar>
using Vector2 = Eigen::Matrix<Scalar, 2, 1>;
template <typename Scalar>
using Vector3 = Eigen::Matrix<Scalar, 3, 1>;
template <typename Scalar>
using Vector6 = Eigen::Matrix<Scalar, 6, 1>;
template <typename Scalar>
using Matrix3 = Eigen::Matrix<Scalar, 3, 3>;

using Vector2i = Vector2<int>;
using Vector3i = Vector3<int>;
using Vector2r = Vector2<Real>;
using Vector3r = Vector3<Real>;
using Vector6r = Vector6<Real>;
using Matrix3r = Matrix3<Real>;
using Quaternionr = Eigen::Quaternion<Real>;
using AngleAxisr = Eigen::AngleAxis<Real>;

/// Rigid motion; position first, then orientation (stored x, y, z, w).
template <class Scalar>
class Se3 {
public:
    Vector3<Scalar> position;
    Eigen::Quaternion<Scalar> orientation;

    Se3() = default;
    Se3(Vector3<Scalar> where, Eigen::Quaternion<Scalar> attitude) : position(where), orientation(attitude) {}
    Vector3<Scalar> operator*(const Vector3<Scalar>& local) const { return orientation * local + position; }
};
using Se3r = Se3<Real>;

static_assert(sizeof(Vector3r) == 24 && sizeof(Quaternionr) == 32 && sizeof(Matrix3r) == 72 &&
                  sizeof(Se3r) == 56,
              "sizes measured in the installed library");

} // namespace yade
