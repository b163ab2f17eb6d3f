// SPDX-License-Identifier: GPL-2.0-or-later
#include <engines/projectile/yade/SolidOfRevolution.hpp>

#include <engines/projectile/closest_point.hpp>
#include <engines/projectile/profile_check.hpp>
#include <engines/projectile/tessellation.hpp>

#include <array>
#include <cmath>
#include <stdexcept>

namespace yade {

namespace geometry = grainfall::geometry;

YADE_PLUGIN((SolidOfRevolution));

namespace {

// In the order of geometry::Zone.
const std::array<const char*, 3> zoneNames = {"nose", "shaft", "base"};

const char* nameOf(geometry::Zone zone) {
    return zoneNames[static_cast<std::size_t>(zone)];
}

std::vector<geometry::Zone> zonesNamed(const std::vector<std::string>& names) {
    std::vector<geometry::Zone> zones;
    for (const std::string& name : names) {
        std::size_t i = 0;
        while (i < zoneNames.size() && name != zoneNames[i])
            ++i;
        if (i == zoneNames.size())
            throw std::invalid_argument("zones: entry " + std::to_string(zones.size()) + " is '" + name +
                                        "'; allowed: 'nose', 'shaft', 'base'");
        zones.push_back(static_cast<geometry::Zone>(i));
    }
    return zones;
}

std::vector<geometry::ProfileVertex> verticesOf(const std::vector<Vector3r>& profile, Real origin) {
    std::vector<geometry::ProfileVertex> vertices;
    for (const Vector3r& v : profile)
        vertices.push_back({v[0] - origin, v[1], v[2]});
    return vertices;
}

// (z, r) of a straight piece or (z, r, bulge), from any sequence of numbers.
Vector3r vertexFrom(const boost::python::object& given, long index) {
    try {
        const long count = boost::python::len(given);
        if (count == 2 || count == 3) {
            Vector3r vertex = Vector3r::Zero();
            for (long i = 0; i < count; ++i)
                vertex[i] = boost::python::extract<Real>(given[i]);
            return vertex;
        }
    } catch (const boost::python::error_already_set&) {
        PyErr_Clear();
    }
    const std::string text = boost::python::extract<std::string>(boost::python::str(given));
    throw std::invalid_argument("SolidOfRevolution.profile: vertex " + std::to_string(index) + " is " + text +
                                "; allowed: (z, r) or (z, r, bulge), in m, m and 1");
}

void refuseUnlessPositive(const char* method, Real value, const char* unit) {
    if (!(std::isfinite(value) && value > 0))
        throw std::invalid_argument(std::string("SolidOfRevolution.") + method + " = " +
                                    geometry::detail::number(value) + " " + unit +
                                    "; allowed: > 0 and finite");
}

} // namespace

void SolidOfRevolution::postLoad(SolidOfRevolution&) {
    if (!(std::isfinite(edgeRadius) && edgeRadius >= 0))
        throw std::invalid_argument("SolidOfRevolution.edgeRadius = " + geometry::detail::number(edgeRadius) +
                                    " m; allowed: >= 0 and finite");
    if (profile.empty() && zones.empty()) // as the class factory makes it
        return;
    try {
        const std::vector<geometry::Zone> kinds = zonesNamed(zones);
        geometry::check_profile(verticesOf(profile, 0), kinds);
        const geometry::Profile drawn(verticesOf(profile, 0), kinds);
        mass_ = geometry::mass_properties(drawn);
        body_ = geometry::Profile(verticesOf(profile, mass_.centroid), kinds);
    } catch (const std::invalid_argument& error) {
        throw std::invalid_argument(std::string("SolidOfRevolution.") + error.what());
    }
}

void SolidOfRevolution::pyHandleCustomCtorArgs(boost::python::tuple&, boost::python::dict& keywords) {
    if (boost::python::len(keywords) == 0) // an empty object, as files and copies need it
        return;
    const boost::python::object given = keywords.get("profile", boost::python::list());
    boost::python::list vertices;
    for (long i = 0; i < boost::python::len(given); ++i)
        vertices.append(vertexFrom(given[i], i));
    if (boost::python::len(vertices) < 2)
        throw std::invalid_argument(
            "SolidOfRevolution.profile: " + std::to_string(boost::python::len(vertices)) +
            " vertices; allowed: at least 2");
    keywords["profile"] = vertices;
}

Vector3r SolidOfRevolution::inertia(Real density) const {
    refuseUnlessPositive("inertia: density", density, "kg/m3");
    return density * Vector3r(mass_.transverse, mass_.transverse, mass_.axial);
}

Vector3r SolidOfRevolution::inertiaOfMass(Real mass) const {
    refuseUnlessPositive("inertiaOfMass: mass", mass, "kg");
    return inertia(mass / mass_.volume);
}

boost::python::tuple SolidOfRevolution::closestPoint(const Vector3r& point) const {
    if (body_.empty())
        throw std::runtime_error("SolidOfRevolution.closestPoint: the object has no profile");
    const geometry::SurfacePoint s = geometry::closest_point(body_, point);
    return boost::python::make_tuple(s.distance, Vector3r(s.position), Vector3r(s.normal), nameOf(s.zone),
                                     boost::python::make_tuple(s.meridian_curvature, s.hoop_curvature));
}

boost::python::tuple SolidOfRevolution::mesh(int meridians) const {
    const geometry::SurfaceMesh mesh = geometry::tessellate(body_, meridians);
    boost::python::list vertices, triangles, zonesOfTriangles;
    for (const Eigen::Vector3d& v : mesh.vertices)
        vertices.append(boost::python::make_tuple(v[0], v[1], v[2]));
    for (const std::array<int, 3>& t : mesh.triangles)
        triangles.append(boost::python::make_tuple(t[0], t[1], t[2]));
    for (const geometry::Zone zone : mesh.zones)
        zonesOfTriangles.append(nameOf(zone));
    return boost::python::make_tuple(vertices, triangles, zonesOfTriangles);
}

} // namespace yade
