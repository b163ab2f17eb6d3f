// SPDX-License-Identifier: GPL-2.0-or-later
// Python module grainfall.femlink._continuum: what needs deal.II.
#include <femlink/continuum/continuum.hpp>
#include <femlink/module/numpy_arrays.hpp>

namespace py = pybind11;

namespace grainfall::femlink {

namespace {

std::unique_ptr<Continuum> continuum_from(const HexMesh& mesh, const Triples& materials, int degree,
                                          const std::string& solver, double memory_limit) {
    laws::require_not_negative("memory_limit", memory_limit);
    ContinuumOptions options;
    options.degree = degree;
    options.solver = solver_from_name(solver);
    options.memory_limit = static_cast<std::size_t>(memory_limit);
    return std::make_unique<Continuum>(mesh, materials_from(materials), options);
}

Loads loads_from(const Point& gravity, const Point& surface_load, const Rows& surface_forces,
                 const Rows& fixed_displacement) {
    return {gravity, surface_load, positions_from("surface_forces", surface_forces),
            positions_from("fixed_displacement", fixed_displacement)};
}

py::dict memory_of(const Continuum& continuum) {
    const MemoryNeed need = continuum.memory();
    py::dict out;
    out["stiffness_bytes"] = need.stiffness;
    out["factor_bytes"] = need.factor;
    out["compliance_bytes"] = need.compliance;
    out["direct_bytes"] = need.direct();
    out["iterative_bytes"] = need.iterative();
    return out;
}

Rows stress_of(const Continuum& continuum, const Rows& displacement) {
    require_columns("displacement", displacement, 3);
    laws::require_length("displacement", displacement.rows(), continuum.nodes().cols(), "one row a node");
    return continuum.discretisation().stress(displacement.transpose()).transpose();
}

void bind(py::module_& module) {
    py::class_<Field>(module, "Field", "State of the continuum under loads.")
        .def_property_readonly("displacement",
                               [](const Field& f) { return Rows(f.displacement.transpose()); })
        .def_property_readonly("reaction", [](const Field& f) { return Rows(f.reaction.transpose()); })
        .def_readonly("strain_energy", &Field::strain_energy, "J");
    py::class_<Continuum>(module, "Continuum",
                          R"(Quasi-static, linearly elastic far field (MR-2629, Eq 18-21).

Parameters
----------
mesh : HexMesh
materials : dict of int to (young, poisson, density), Pa, 1, kg/m^3
    By region of the mesh.
degree : 1 or 2
    Of the shape functions; both keep nearly incompressible material from locking by mean dilatation.
solver : 'auto', 'direct' or 'iterative'
    'auto': direct if it fits into the memory.
memory_limit : float, bytes
    0: half of the machine's memory. What needs more is refused before it is taken.)")
        .def(py::init(&continuum_from), py::arg("mesh"), py::arg("materials"), py::arg("degree") = 1,
             py::arg("solver") = "auto", py::arg("memory_limit") = 0.0)
        .def_property_readonly("surface", &Continuum::surface, py::return_value_policy::copy)
        .def_property_readonly("surface_nodes", &Continuum::surface_nodes)
        .def_property_readonly("fixed_nodes", &Continuum::held_nodes)
        .def_property_readonly("nodes", [](const Continuum& c) { return Rows(c.nodes().transpose()); })
        .def_property_readonly("unknowns", &Continuum::unknowns)
        .def_property_readonly("solver",
                               [](const Continuum& c) { return c.is_direct() ? "direct" : "iterative"; })
        .def_property_readonly("memory", &memory_of, "what the solvers take, known before it is taken")
        .def(
            "condense",
            [](Continuum& c, const Point& gravity, const Point& surface_load,
               const std::function<void(double)>& progress) {
                return c.condense(loads_from(gravity, surface_load, {}, {}), progress);
            },
            py::arg("gravity") = Point::Zero().eval(), py::arg("surface_load") = Point::Zero().eval(),
            py::arg("progress") = nullptr,
            "WallModel: compliance condensed to the coupling surface; gravity (m/s^2) and a surface load "
            "(Pa) preload it.")
        .def(
            "solve",
            [](Continuum& c, const Point& gravity, const Point& surface_load, const Rows& surface_forces,
               const Rows& fixed_displacement) {
                return c.solve(loads_from(gravity, surface_load, surface_forces, fixed_displacement));
            },
            py::kw_only(), py::arg("gravity") = Point::Zero().eval(),
            py::arg("surface_load") = Point::Zero().eval(), py::arg("surface_forces") = Rows(),
            py::arg("fixed_displacement") = Rows(),
            R"(Whole field under gravity (m/s^2), a load on the coupling surface (Pa), forces on its nodes ((k, 3), N) and
displacements of the fixed nodes ((n, 3), m; rows of other nodes are not read).)")
        .def("stress", &stress_of, py::arg("displacement"),
             "Mean stress of each cell, (cells, 6): xx, yy, zz, yz, xz, xy, Pa.")
        .def(
            "write_vtu",
            [](const Continuum& c, const std::string& path, const Field& field, double time) {
                c.discretisation().write_vtu(path, field.displacement, time);
            },
            py::arg("path"), py::arg("field"), py::arg("time") = 0.0, "For ParaView; time in s.");
    module.def("read_gmsh", &read_gmsh, py::arg("path"), py::arg("fixed"), py::arg("coupling"),
               "HexMesh of a gmsh file; `fixed`, `coupling`: numbers of its physical surfaces.");
}

} // namespace

} // namespace grainfall::femlink

PYBIND11_MODULE(_continuum, module) {
    module.doc() = "The continuum behind the deformable wall; loads deal.II.";
    pybind11::module_::import("grainfall.femlink._wall"); // HexMesh, Surface and WallModel live there
    grainfall::femlink::bind(module);
}
