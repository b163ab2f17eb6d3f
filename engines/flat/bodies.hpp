// SPDX-License-Identifier: GPL-2.0-or-later
// Bodies of the flat path in packed arrays: spheres first, sorted in space, then the obstacles that they
// touch.
//
// What the contact loop reads of a body fits one cache line for its place and one for its motion; what only
// the integrator needs stands apart.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cstddef>
#include <vector>

namespace grainfall::geometry {
class Profile;
}

namespace grainfall::flat {

using Vector = Eigen::Vector3d;

struct Place {
    Vector centre;
    // m; of a plane: its radius in the shear kinematics over that of the sphere it touches; else of an
    // obstacle without meaning
    double radius;
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

// What a sphere can touch.
enum class Partner { sphere, plane, box, solid };

// A body that spheres touch and whose motion is not computed here.
struct Obstacle {
    Partner kind = Partner::plane;
    // A plane is normal to an axis. `sense` 0: met from both sides; +1, -1: its inner side.
    int axis = 0;
    int sense = 0;
    // A box and a solid of revolution (about its third axis) have axes of their own.
    Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
    Vector half_edges = Vector::Zero(); // m, of a box
    const geometry::Profile* profile = nullptr;
    double edge_radius = 0;          // m, of a solid's edges; 0: that of the sphere which touches them
    double flat_radius_factor = 1e8; // radius of a solid's flat places over the sphere's
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
    // Obstacles only.
    std::vector<Obstacle> obstacles;

    int spheres() const { return static_cast<int>(inertias.size()); }
    int count() const { return static_cast<int>(ids.size()); }
    bool is_obstacle(int index) const { return index >= spheres(); }
    const Obstacle& obstacle(int index) const {
        return obstacles[static_cast<std::size_t>(index - spheres())];
    }
    Partner kind(int index) const { return is_obstacle(index) ? obstacle(index).kind : Partner::sphere; }
};

} // namespace grainfall::flat
