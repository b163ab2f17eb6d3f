// SPDX-License-Identifier: GPL-2.0-or-later
// How a contact turned in the last step.
//
// ScGeom knows it but only offers to turn a vector to first order, which lengthens the vector at every step;
// the kernels turn without changing the length and need the two rotation vectors. They are private members.
// Arguments of an explicit instantiation are exempt from access control: that is the door taken here.
#pragma once

#include <pkg/dem/ScGeom.hpp>

namespace yade {

constexpr Vector3r ScGeom::*contact_tilt_member();
constexpr Vector3r ScGeom::*contact_twist_member();

template <Vector3r ScGeom::*tilt, Vector3r ScGeom::*twist>
struct ScGeomDoor {
    friend constexpr Vector3r ScGeom::*contact_tilt_member() { return tilt; }
    friend constexpr Vector3r ScGeom::*contact_twist_member() { return twist; }
};
template struct ScGeomDoor<&ScGeom::orthonormal_axis, &ScGeom::twist_axis>;

/// Rotation vector [rad] in the contact plane: old normal x new normal.
inline const Vector3r& contact_tilt(const ScGeom& geometry) {
    return geometry.*contact_tilt_member();
}
/// Rotation vector [rad] about the normal.
inline const Vector3r& contact_twist(const ScGeom& geometry) {
    return geometry.*contact_twist_member();
}

} // namespace yade
