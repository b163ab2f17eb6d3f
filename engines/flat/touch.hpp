// SPDX-License-Identifier: GPL-2.0-or-later
// Where a sphere touches another sphere, a plane, a box or a solid of revolution.
#pragma once

#include <engines/flat/bodies.hpp>
#include <engines/projectile/closest_point.hpp>

#include <laws/sphere_kinematics.hpp>

#include <algorithm>
#include <cmath>

namespace grainfall::flat {

// The contact point lies at arm1 n from the centre of a first sphere, at -arm2 n from that of the second.
template <class Scalar>
struct TouchAt {
    laws::TouchOf<Scalar> touch;
    Scalar arm1, arm2;
};

// Does the motion at the contact point differ from what the centres and radii of two spheres would tell?
inline bool has_surface_motion(Partner kind) {
    return kind == Partner::box || kind == Partner::solid;
}

// Of the surface of an obstacle that is nearest to a point.
struct Nearest {
    Vector normal;   // out of the obstacle
    double distance; // m, negative within it
};

inline Nearest nearest_of_box(const Obstacle& box, const Vector& centre, const Vector& point) {
    const Vector local = box.axes.transpose() * (point - centre);
    const Vector out = local - local.cwiseMax(-box.half_edges).cwiseMin(box.half_edges);
    const double distance = out.norm();
    if (distance > 0)
        return {box.axes * (out / distance), distance};
    int axis;
    const double depth = (box.half_edges - local.cwiseAbs()).minCoeff(&axis);
    return {local[axis] > 0 ? Vector(box.axes.col(axis)) : Vector(-box.axes.col(axis)), -depth};
}

// The contact point of a plane lies on it.
inline TouchAt<double> touch_of_plane(const Obstacle& plane, const Place& at, const Place& sphere) {
    const double distance = sphere.centre[plane.axis] - at.centre[plane.axis];
    TouchAt<double> result;
    result.touch.normal = Vector::Zero();
    result.touch.normal[plane.axis] = plane.sense ? plane.sense : distance > 0 ? 1 : -1;
    result.touch.overlap = sphere.radius - std::abs(distance);
    result.touch.radius1 = at.radius * sphere.radius;
    result.touch.radius2 = sphere.radius;
    result.arm1 = 0;
    result.arm2 = distance * result.touch.normal[plane.axis];
    return result;
}

// Of boxes and solids: in the middle of the overlap.
inline TouchAt<double> touch_amid_overlap(const Nearest& nearest, double radius1, double radius2) {
    const double overlap = radius2 - nearest.distance;
    return {{nearest.normal, overlap, radius1, radius2}, 0, radius2 - 0.5 * overlap};
}

inline TouchAt<double> touch_of_box(const Obstacle& box, const Place& at, const Place& sphere) {
    return touch_amid_overlap(nearest_of_box(box, at.centre, sphere.centre), sphere.radius, sphere.radius);
}

inline TouchAt<double> touch_of_solid(const Obstacle& solid, const Place& at, const Place& sphere) {
    const geometry::SurfacePoint surface =
        geometry::closest_point(*solid.profile, solid.axes.transpose() * (sphere.centre - at.centre));
    const double edge = solid.edge_radius > 0 ? solid.edge_radius : sphere.radius;
    const double radius =
        std::min(geometry::equivalent_radius(surface, edge), solid.flat_radius_factor * sphere.radius);
    return touch_amid_overlap({solid.axes * surface.normal, surface.distance}, radius, sphere.radius);
}

// m, between two surfaces; negative when they overlap.
inline double gap(const Place& a, const Place& b) {
    return (a.centre - b.centre).norm() - a.radius - b.radius;
}

// m, of a sphere's surface from an obstacle's. Beyond `enough` a smaller number may do.
inline double gap(const Obstacle& obstacle, const Place& at, const Place& sphere, double enough) {
    switch (obstacle.kind) {
    case Partner::box:
        return nearest_of_box(obstacle, at.centre, sphere.centre).distance - sphere.radius;
    case Partner::solid: {
        const Vector local = obstacle.axes.transpose() * (sphere.centre - at.centre);
        const double at_least = geometry::distance_bound(*obstacle.profile, local) - sphere.radius;
        return at_least > enough ? at_least
                                 : geometry::closest_point(*obstacle.profile, local).distance - sphere.radius;
    }
    default:
        return std::abs(sphere.centre[obstacle.axis] - at.centre[obstacle.axis]) - sphere.radius;
    }
}

} // namespace grainfall::flat
