// SPDX-License-Identifier: GPL-2.0-or-later
// Surfaces, closest points and kept walls in Python.
#pragma once

#include <femlink/core/closest_point.hpp>
#include <femlink/core/contact_patch.hpp>
#include <femlink/core/wall_model.hpp>
#include <femlink/module/numpy_arrays.hpp>

namespace grainfall::femlink {

namespace py = pybind11;

inline Surface surface_from(int degree, const Rows& nodes, const IntegerRows& faces,
                            const std::vector<int>& loose) {
    Surface surface;
    surface.degree = degree;
    surface.nodes = positions_from("nodes", nodes);
    surface.faces = faces.transpose();
    surface.loose = loose;
    validate(surface);
    surface.connect();
    return surface;
}

inline Positions current_positions(const Surface& surface, const Rows& displacement) {
    if (displacement.size() == 0)
        return surface.nodes;
    require_columns("displacement", displacement, 3);
    laws::require_length("displacement", displacement.rows(), surface.node_count(),
                         "one row a node of the surface");
    return surface.nodes + displacement.transpose();
}

inline int checked_face(const Surface& surface, int face) {
    if (face < 0 || face >= surface.face_count())
        laws::reject("face", face, "in [0, " + std::to_string(surface.face_count() - 1) + "]");
    return face;
}

inline ClosestPoint closest_on_face(const Surface& surface, const Positions& positions, int face,
                                    const Point& point) {
    return surface.degree == 1 ? closest_point<1>(surface.face<1>(face, positions), point)
                               : closest_point<2>(surface.face<2>(face, positions), point);
}

inline ClosestPoint closest_of_nodes(const Rows& nodes, const Point& point) {
    require_columns("nodes", nodes, 3);
    if (nodes.rows() == nodes_per_face<1>)
        return closest_point<1>(FaceNodes<1>(nodes.transpose()), point);
    if (nodes.rows() == nodes_per_face<2>)
        return closest_point<2>(FaceNodes<2>(nodes.transpose()), point);
    laws::reject("nodes", static_cast<double>(nodes.rows()), "4 or 9 points");
}

// All faces, one after the other: for set-up and analysis; in a scene the collider finds the candidates.
inline std::pair<int, ClosestPoint> closest_on_surface(const Surface& surface, const Point& point,
                                                       const Rows& displacement) {
    const Positions positions = current_positions(surface, displacement);
    std::pair<int, ClosestPoint> best = {0, closest_on_face(surface, positions, 0, point)};
    for (int face = 1; face < surface.face_count(); ++face) {
        const ClosestPoint found = closest_on_face(surface, positions, face, point);
        if (std::abs(found.distance) < std::abs(best.second.distance))
            best = {face, found};
    }
    return best;
}

inline void bind_surfaces(py::module_& module) {
    py::enum_<Feature>(module, "Feature")
        .value("interior", Feature::interior)
        .value("edge", Feature::edge)
        .value("corner", Feature::corner);
    py::class_<ClosestPoint>(module, "ClosestPoint", "Nearest point of a face (MR-2629, Eq 22-25).")
        .def_readonly("reference", &ClosestPoint::reference, "on the face, in [-1, 1]^2")
        .def_readonly("position", &ClosestPoint::position, "m")
        .def_readonly("normal", &ClosestPoint::normal, "of the face, out of the continuum")
        .def_readonly("distance", &ClosestPoint::distance, "m, negative behind the face")
        .def_readonly("feature", &ClosestPoint::feature)
        .def_readonly("iterations", &ClosestPoint::iterations)
        .def_readonly("converged", &ClosestPoint::converged)
        .def_readonly("residual", &ClosestPoint::residual, "m");
    module.def("closest_point", &closest_of_nodes, py::arg("nodes"), py::arg("point"),
               "Point of the face with these 4 or 9 nodes, (4, 3) or (9, 3) in m, nearest to `point`.");
    py::class_<Surface>(module, "Surface", R"(The wall towards the grains.

Parameters
----------
degree : 1 or 2
nodes : (n, 3) float, m
faces : (m, 4) or (m, 9) int
    Nodes of each face, X1 running first, dy/dX1 x dy/dX2 towards the grains.
loose : (n,) int
    Place of each node among those that move, -1: fixed.)")
        .def(py::init(&surface_from), py::arg("degree"), py::arg("nodes"), py::arg("faces"), py::arg("loose"))
        .def_readonly("degree", &Surface::degree)
        .def_property_readonly("nodes", [](const Surface& s) { return Rows(s.nodes.transpose()); })
        .def_property_readonly("faces", [](const Surface& s) { return IntegerRows(s.faces.transpose()); })
        .def_readonly("loose", &Surface::loose)
        .def("closest", &closest_on_surface, py::arg("point"), py::arg("displacement") = Rows(),
             "Face nearest to a point and the ClosestPoint on it.")
        .def(
            "face_size",
            [](const Surface& s, int face) { return face_size(s, s.nodes, checked_face(s, face)); },
            py::arg("face"), "Square root of a face's area, m.");
    module.def("disc_compliance", &disc_compliance, py::arg("young"), py::arg("poisson"), py::arg("radius"),
               "Mean displacement under a uniformly loaded disc on a half-space, per force, m/N.");
}

inline void bind_model(py::module_& module) {
    py::class_<WallModel>(module, "WallModel",
                          "Surface, condensed compliance (m/N) and preload (m) of a wall.")
        .def(py::init([](const Surface& surface, const Eigen::MatrixXd& compliance) {
                 WallModel model;
                 model.surface = surface;
                 laws::require_length("compliance", compliance.rows(), 3 * surface.loose_count(),
                                      "three rows a node that moves");
                 model.compliance = compliance;
                 model.preload = Positions::Zero(3, surface.node_count());
                 return model;
             }),
             py::arg("surface"), py::arg("compliance"))
        .def_readonly("key", &WallModel::key)
        .def_readonly("description", &WallModel::description)
        .def_readonly("surface", &WallModel::surface)
        .def_property_readonly(
            "compliance", [](const WallModel& m) -> const Eigen::MatrixXd& { return m.compliance; },
            py::return_value_policy::reference_internal)
        .def_property_readonly("preload", [](const WallModel& m) { return Rows(m.preload.transpose()); })
        .def("save", &save_wall, py::arg("path"));
    module.def(
        "wall_key",
        [](const HexMesh& mesh, const Triples& materials, int degree, const Point& gravity,
           const Point& surface_load) {
            return wall_key(hash_of(mesh, materials_from(materials), degree), gravity, surface_load);
        },
        py::arg("mesh"), py::arg("materials"), py::arg("degree"), py::arg("gravity"), py::arg("surface_load"),
        "WallModel.key of a wall before it is built.");
    module.def("load_wall", &load_wall, py::arg("path"), "WallModel of a file written by WallModel.save.");
}

} // namespace grainfall::femlink
