// SPDX-License-Identifier: GPL-2.0-or-later
// Bodies of the flat path in packed arrays: spheres first, sorted in space, then planes.
//
// What the contact loop reads of a body fits one cache line for its place and one for its motion; what only
// the integrator needs stands apart.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cstddef>
#include <vector>

namespace grainfall::flat {

using Vector = Eigen::Vector3d;

struct Place {
    Vector centre;
    double radius; // m; of a plane: its radius in the shear kinematics over that of the sphere it touches
};

struct alignas(64) Motion {
    Vector velocity;
    Vector spin;
};

// Forces of contacts on a body in this step.
struct alignas(64) Load {
    Vector force = Vector::Zero();
    Vector torque = Vector::Zero();
};

// A plane normal to an axis. `sense` 0: met from both sides; +1, -1: its inner side.
struct Plane {
    int axis;
    int sense;
};

// What keeps a sphere from moving freely.
struct Inertia {
    double mass;
    Vector inertia;
    unsigned blocked; // bits of the axes, translation first
    bool damped;      // numerical damping
};

struct Bodies {
    std::vector<Place> places;
    std::vector<Motion> motions;
    std::vector<int> ids;
    // Spheres only.
    std::vector<Eigen::Quaterniond, Eigen::aligned_allocator<Eigen::Quaterniond>> orientations;
    std::vector<Inertia> inertias;
    // Planes only.
    std::vector<Plane> planes;

    int spheres() const { return static_cast<int>(inertias.size()); }
    int count() const { return static_cast<int>(ids.size()); }
    bool is_plane(int index) const { return index >= spheres(); }
    const Plane& plane(int index) const { return planes[static_cast<std::size_t>(index - spheres())]; }
};

} // namespace grainfall::flat
