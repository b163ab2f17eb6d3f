// SPDX-License-Identifier: GPL-2.0-or-later
// Exact solid of revolution as a YADE shape: a projectile that touches each grain once, at its true surface.
#pragma once

#include <lib/base/Math.hpp>
#include <core/Shape.hpp>

#include <engines/projectile/mass_properties.hpp>
#include <engines/projectile/profile.hpp>

#include <limits>
#include <string>
#include <vector>

namespace yade {

class SolidOfRevolution : public Shape {
public:
    virtual ~SolidOfRevolution() = default;

    /// Builds the derived data below; wrong attributes are refused with one sentence.
    void postLoad(SolidOfRevolution&);
    void pyHandleCustomCtorArgs(boost::python::tuple& args, boost::python::dict& keywords) override;

    /// The profile in the frame of the body: z counted from the centroid. Empty for an object without
    /// profile.
    const grainfall::geometry::Profile& body() const { return body_; }
    const grainfall::geometry::MassProperties& massProperties() const { return mass_; }

    /// Bluntness given to edges and tips where a partner of this radius touches them, m.
    Real edgeRadiusFor(Real partner) const { return edgeRadius > 0 ? edgeRadius : partner; }

    // A collider runs again when bodies have moved, not when they have turned. So the functor that makes the
    // bound leaves a margin and notes the axis; whoever sees the body turned by half the margin asks for a
    // run.
    void noteBound(const Quaternionr& orientation, Real turn) {
        boundAxis_ = orientation * Vector3r::UnitZ();
        allowedTurn_ = turn;
    }
    bool hasTurned(const Quaternionr& orientation) const {
        return (orientation * Vector3r::UnitZ() - boundAxis_).squaredNorm() > allowedTurn_ * allowedTurn_;
    }

    Real volume() const { return mass_.volume; }
    Real surfaceArea() const { return mass_.surface_area(); }
    Real frontalArea() const { return mass_.frontal_area; }
    Real lateralArea() const { return mass_.lateral_area; }
    Vector3r zoneAreas() const { return {mass_.zone_area[0], mass_.zone_area[1], mass_.zone_area[2]}; }
    Real length() const { return body_.length(); }
    Real maxRadius() const { return body_.r_max(); }
    Real boundingRadius() const { return body_.reach(); }
    Real centroid() const { return mass_.centroid; }
    Real noseZ() const { return body_.z_min(); }
    Real baseZ() const { return body_.z_max(); }
    Vector3r inertia(Real density) const;
    Vector3r inertiaOfMass(Real mass) const;
    boost::python::tuple closestPoint(const Vector3r& point) const;
    boost::python::tuple mesh(int meridians) const;

    // clang-format off
    YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(SolidOfRevolution, Shape,
        "Solid of revolution about the local z axis, its nose towards -z, its centroid (uniform density) at the "
        "body's position. The generating curve is made of straight lines and circular arcs and used exactly: no facets, one "
        "contact per grain. Profile and zones are fixed once the object exists; they and every other length are in metres. "
        "Needs :yref:`Bo1_SolidOfRevolution_Aabb` and :yref:`Ig2_SolidOfRevolution_Sphere_ScGeom`.",
        ((vector<Vector3r>, profile, , Attr::readonly,
          "Vertices (z, r) or (z, r, bulge) of the generating curve from nose to base, z and r in m. Any origin of z; the first and the "
          "last vertex lie on the axis (r = 0). Bulge [-] of the piece from this vertex to the next = tan(included angle / 4): "
          "0 a straight line, > 0 an arc that stands out, < 0 a hollow one, 1 half a circle; of the last vertex it is ignored."))
        ((vector<string>, zones, , Attr::readonly,
          "Zone of each piece, 'nose', 'shaft' or 'base', one fewer than vertices; :yref:`ProjectileLoad` sums forces by zone. "
          "Empty: nose up to the first vertex of the largest radius, base behind the last one, shaft between."))
        ((Real, edgeRadius, 0, Attr::triggerPostLoad,
          "Radius [m] that sharp edges and tips are given in the contact's stiffness (not in the geometry), >= 0. "
          "0: an edge is as blunt as the grain that touches it; on a wall or box, as the solid's largest radius."))
        , createIndex();
        ,
        .add_property("volume", &SolidOfRevolution::volume, "Volume [m³].")
        .add_property("surfaceArea", &SolidOfRevolution::surfaceArea, "Area of the whole surface [m²].")
        .add_property("zoneAreas", &SolidOfRevolution::zoneAreas, "Areas [m²] of nose, shaft and base.")
        .add_property("frontalArea", &SolidOfRevolution::frontalArea, "Area [m²] seen along the axis.")
        .add_property("lateralArea", &SolidOfRevolution::lateralArea, "Area [m²] seen across the axis.")
        .add_property("length", &SolidOfRevolution::length, "Length along the axis [m].")
        .add_property("maxRadius", &SolidOfRevolution::maxRadius, "Largest distance from the axis [m].")
        .add_property("boundingRadius", &SolidOfRevolution::boundingRadius, "Largest distance from the centroid [m].")
        .add_property("centroid", &SolidOfRevolution::centroid, "z [m] of the centroid in the coordinates of :yref:`profile<SolidOfRevolution.profile>`.")
        .add_property("noseZ", &SolidOfRevolution::noseZ, "Smallest local z [m] (negative): the nose, counted from the centroid.")
        .add_property("baseZ", &SolidOfRevolution::baseZ, "Largest local z [m]: the base, counted from the centroid.")
        .def("inertia", &SolidOfRevolution::inertia, (boost::python::arg("density")),
             "Principal inertia [kg m²] (x, y, z) about the centroid for a uniform density [kg/m³].")
        .def("inertiaOfMass", &SolidOfRevolution::inertiaOfMass, (boost::python::arg("mass")),
             "Principal inertia [kg m²] (x, y, z) about the centroid for a mass [kg] spread uniformly.")
        .def("closestPoint", &SolidOfRevolution::closestPoint, (boost::python::arg("point")),
             "For a point [m] in the local frame: (signed distance [m], positive outside; nearest surface point [m]; outward "
             "normal; zone; principal curvatures [1/m] along and around).")
        .def("mesh", &SolidOfRevolution::mesh, (boost::python::arg("meridians") = 48),
             "Triangles for display, in the local frame: (list of vertices [m], list of index triples, list of zones).")
    );
    // clang-format on
    REGISTER_CLASS_INDEX(SolidOfRevolution, Shape);

private:
    grainfall::geometry::Profile body_;
    grainfall::geometry::MassProperties mass_;
    Vector3r boundAxis_ = Vector3r::UnitZ();
    Real allowedTurn_ = std::numeric_limits<Real>::infinity();
};
REGISTER_SERIALIZABLE(SolidOfRevolution);

} // namespace yade
