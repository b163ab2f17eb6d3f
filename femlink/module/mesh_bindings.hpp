// SPDX-License-Identifier: GPL-2.0-or-later
// Meshes in Python.
#pragma once

#include <femlink/core/hex_mesh.hpp>
#include <femlink/module/numpy_arrays.hpp>

namespace grainfall::femlink {

namespace py = pybind11;

inline HexMesh mesh_from(const Rows& vertices, const IntegerRows& cells, const std::vector<int>& regions,
                         const IntegerRows& boundary_corners, const std::vector<int>& boundary_ids) {
    require_columns("vertices", vertices, 3);
    require_columns("cells", cells, 8);
    if (boundary_corners.size() != 0)
        require_columns("boundary_corners", boundary_corners, 4);
    laws::require_length("boundary_ids", boundary_ids.size(), boundary_corners.rows(),
                         "one number a boundary face");
    HexMesh mesh;
    for (Eigen::Index v = 0; v < vertices.rows(); ++v)
        mesh.vertices.push_back(vertices.row(v));
    for (Eigen::Index c = 0; c < cells.rows(); ++c) {
        mesh.cells.emplace_back();
        for (int k = 0; k < 8; ++k)
            mesh.cells.back()[k] = cells(c, k);
    }
    mesh.regions = regions.empty() ? std::vector<int>(mesh.cells.size(), 0) : regions;
    for (Eigen::Index f = 0; f < boundary_corners.rows(); ++f) {
        HexMesh::BoundaryFace face{};
        for (int k = 0; k < 4; ++k)
            face.corners[k] = boundary_corners(f, k);
        face.id = boundary_ids[f];
        mesh.boundary.push_back(face);
    }
    return mesh;
}

inline Rows vertices_of(const HexMesh& mesh) {
    Rows out(mesh.vertices.size(), 3);
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
        out.row(v) = mesh.vertices[v];
    return out;
}

inline void set_vertices(HexMesh& mesh, const Rows& vertices) {
    require_columns("vertices", vertices, 3);
    laws::require_length("vertices", vertices.rows(), mesh.vertices.size(), "one point a vertex");
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
        mesh.vertices[v] = vertices.row(v);
}

inline IntegerRows cells_of(const HexMesh& mesh) {
    IntegerRows out(mesh.cells.size(), 8);
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
        for (int k = 0; k < 8; ++k)
            out(c, k) = mesh.cells[c][k];
    return out;
}

inline IntegerRows boundary_corners_of(const HexMesh& mesh) {
    IntegerRows out(mesh.boundary.size(), 4);
    for (std::size_t f = 0; f < mesh.boundary.size(); ++f)
        for (int k = 0; k < 4; ++k)
            out(f, k) = mesh.boundary[f].corners[k];
    return out;
}

inline std::vector<int> boundary_ids_of(const HexMesh& mesh) {
    std::vector<int> out;
    for (const auto& face : mesh.boundary)
        out.push_back(face.id);
    return out;
}

inline void bind_meshes(py::module_& module) {
    py::class_<HexMesh>(module, "HexMesh",
                        R"(Hexahedra with boundary ids: 1 fixed, 2 coupling surface; other faces are free.

Parameters
----------
vertices : (n, 3) float, m
cells : (m, 8) int
    Corners (0,0,0), (1,0,0), (0,1,0), (1,1,0), (0,0,1), ... of each cell.
regions : (m,) int
    Material of each cell; empty: 0 everywhere.
boundary_corners : (b, 4) int
    Corners (0,0), (1,0), (0,1), (1,1) of each boundary face.
boundary_ids : (b,) int)")
        .def(py::init(&mesh_from), py::arg("vertices"), py::arg("cells"),
             py::arg("regions") = std::vector<int>(), py::arg("boundary_corners") = IntegerRows(),
             py::arg("boundary_ids") = std::vector<int>())
        .def_property("vertices", &vertices_of, &set_vertices)
        .def_readwrite("regions", &HexMesh::regions)
        .def_property_readonly("cells", &cells_of)
        .def_property_readonly("boundary_corners", &boundary_corners_of)
        .def_property_readonly("boundary_ids", &boundary_ids_of)
        .def("validate", [](const HexMesh& mesh) { validate(mesh); });
    module.def(
        "box",
        [](const Point& size, const std::array<int, 3>& divisions, const std::string& fixed) {
            return box(size, divisions, held_from_name("fixed", fixed));
        },
        py::arg("size"), py::arg("divisions"), py::arg("fixed") = "all but top",
        R"(Box of `size` (m) below z = 0, centred on the z axis; its top is the coupling surface.

`fixed`: 'all but top' or 'bottom'.)");
    module.def("half_space_block", &half_space_block, py::arg("patch"), py::arg("reach"), py::arg("element"),
               py::arg("ratio") = 1.3, py::arg("whole_top") = false,
               R"(Block that stands for the half-space z < 0, fixed at |x|, |y|, -z = `reach` (m).

Cells of size `element` (m) within |x|, |y| <= `patch` (m), growing by `ratio` from one to the next outside and below.
The coupling surface is the even part of the top, or the whole top.)");
    module.def(
        "container", &container, py::arg("cavity"), py::arg("thickness"), py::arg("element"),
        py::arg("ratio") = 1.3,
        R"(Block with a cavity (x, y, depth in m), open at z = 0: the cavity's floor and walls are the coupling surface.

The continuum reaches `thickness` (m) beyond the cavity; cells of size `element` (m) at the cavity, growing by
`ratio` towards the fixed outer boundary.)");
}

} // namespace grainfall::femlink
