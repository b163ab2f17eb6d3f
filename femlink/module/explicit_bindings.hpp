// SPDX-License-Identifier: GPL-2.0-or-later
// The explicit continuum in Python.
#pragma once

#include <femlink/explicit/explicit_continuum.hpp>
#include <femlink/module/numpy_arrays.hpp>

#include <pybind11/numpy.h>

namespace grainfall::femlink {

namespace py = pybind11;

inline SolidMaterial solid_from(double young, double poisson, double density, const std::string& law,
                                double yield_stress, double hardening, double cohesion, double friction_angle,
                                double dilatancy) {
    SolidMaterial out{solid_law_from_name("law", law),
                      {young, poisson, density},
                      yield_stress,
                      hardening,
                      cohesion,
                      friction_angle,
                      dilatancy};
    validate(out, "Solid");
    return out;
}

using Mask = Eigen::Matrix<bool, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

inline std::unique_ptr<ExplicitContinuum> explicit_from(const HexMesh& mesh, const SolidMaterials& materials,
                                                        const std::string& element, const std::string& outer,
                                                        double safety, double hourglass, const Mask& held,
                                                        const std::array<double, 3>& gravity) {
    ExplicitOptions options;
    options.element = element_kind_from_name("element", element);
    options.outer = outer_boundary_from_name("outer", outer);
    options.safety = safety;
    options.hourglass = hourglass;
    options.gravity = {gravity[0], gravity[1], gravity[2]};
    if (held.size() != 0) {
        require_columns("held", held, 3);
        laws::require_length("held", static_cast<std::size_t>(held.rows()), mesh.vertices.size(),
                             "one row a vertex");
    }
    for (int node = 0; node < held.rows(); ++node)
        for (int axis = 0; axis < 3; ++axis)
            if (held(node, axis))
                options.held.push_back({node, axis});
    return std::make_unique<ExplicitContinuum>(mesh, materials, options);
}

inline py::dict dict_of(const ExplicitEnergies& energies) {
    py::dict out;
    out["kinetic"] = energies.kinetic;
    out["elastic"] = energies.elastic;
    out["hourglass"] = energies.hourglass;
    out["plastic"] = energies.plastic;
    out["absorbed"] = energies.absorbed;
    out["ground"] = energies.ground;
    out["surface_work"] = energies.surface_work;
    out["support_work"] = energies.support_work;
    out["step_work"] = energies.step_work;
    out["residual"] = energies.content() - energies.work();
    return out;
}

inline Rows stress_of_cells(const ExplicitContinuum& continuum) {
    const auto cells = continuum.cell_states();
    Rows out(cells.size(), 6);
    for (std::size_t c = 0; c < cells.size(); ++c) {
        const Symmetric& s = cells[c].stress;
        out.row(static_cast<Eigen::Index>(c)) << s.xx, s.yy, s.zz, s.yz, s.xz, s.xy;
    }
    return out;
}

inline std::vector<double> plastic_strain_of_cells(const ExplicitContinuum& continuum) {
    std::vector<double> out;
    for (const CellState& cell : continuum.cell_states())
        out.push_back(cell.plastic_strain);
    return out;
}

inline void bind_explicit(py::module_& module) {
    py::class_<SolidMaterial>(module, "Solid", R"(Material of a region of the explicit continuum.

Parameters
----------
young : float, Pa
poisson : float
density : float, kg/m^3
law : 'neo-hooke', 'st-venant', 'j2' or 'drucker-prager'
yield_stress, hardening : float, Pa
    Of 'j2': Kirchhoff stress at first yield and its slope over the equivalent plastic strain.
cohesion : float, Pa; friction_angle, dilatancy : float, rad
    Of 'drucker-prager', matched to Mohr and Coulomb in triaxial compression.)")
        .def(py::init(&solid_from), py::arg("young"), py::arg("poisson"), py::arg("density"), py::kw_only(),
             py::arg("law") = "neo-hooke", py::arg("yield_stress") = 0.0, py::arg("hardening") = 0.0,
             py::arg("cohesion") = 0.0, py::arg("friction_angle") = 0.0, py::arg("dilatancy") = 0.0)
        .def_property_readonly(
            "numbers",
            [](const SolidMaterial& s) {
                return std::vector<double>{static_cast<double>(s.law),
                                           s.elastic.young,
                                           s.elastic.poisson,
                                           s.elastic.density,
                                           s.yield_stress,
                                           s.hardening,
                                           s.cohesion,
                                           s.friction_angle,
                                           s.dilatancy};
            },
            "Number of the law and the parameters in their order, as an engine keeps them.");

    py::class_<ExplicitContinuum>(
        module, "ExplicitContinuum",
        R"(Continuum with inertia at finite strain, moved on in time (MR-2629, section 5.2).

Parameters
----------
mesh : HexMesh
    Boundary ids as for the quasi-static wall; a mesh without fixed or coupling faces is allowed.
materials : dict of int to Solid
    By region.
element : 'gauss' (eight points, mean dilatation) or 'one-point' (hourglass control)
outer : 'fixed', 'absorbing' (dashpots, and springs for the static load) or 'dashpots'
safety : float
    Longest substep over the critical one, which is a bound: regular meshes are stable a little above 1.
hourglass : float
    Stiffness of the one-point element against hourglassing, share of the shear stiffness: 1 under grains, about 0.1
    where plastic flow is large, which it would stiffen.
held : (n, 3) bool
    Components of vertices held besides the fixed boundary. Held components keep the velocity they are given.
gravity : (3,) float, m/s^2
    'drucker-prager' starts from the stress of soil at rest under its own weight, horizontal over vertical pressure
    1 - sin(friction_angle) (Jaky 1944), and what balances it there goes on acting. Needed where cohesion is 0.)")
        .def(py::init(&explicit_from), py::arg("mesh"), py::arg("materials"), py::arg("element") = "gauss",
             py::arg("outer") = "fixed", py::arg("safety") = 0.9, py::arg("hourglass") = 1.0,
             py::arg("held") = Mask(), py::arg("gravity") = std::array<double, 3>{0, 0, 0})
        .def_property_readonly(
            "surface", &ExplicitContinuum::surface,
            "Coupling surface, its nodes and faces as in the quasi-static wall of degree 1.")
        .def_property_readonly("surface_nodes", &ExplicitContinuum::surface_nodes,
                               "vertex of the mesh by node of the surface")
        .def_property_readonly(
            "surface_displacement",
            [](const ExplicitContinuum& c) { return Rows(c.surface_displacement().transpose()); },
            "(k, 3), m")
        .def_property_readonly(
            "displacement", [](const ExplicitContinuum& c) { return Rows(c.displacement().transpose()); },
            "(n, 3), m")
        .def_property(
            "velocities", [](const ExplicitContinuum& c) { return Rows(c.velocities().transpose()); },
            [](ExplicitContinuum& c, const Rows& v) { c.set_velocities(positions_from("velocities", v)); },
            "(n, 3), m/s, at the present time")
        .def_property_readonly("time", &ExplicitContinuum::time, "s")
        .def_property_readonly("substeps", &ExplicitContinuum::substeps, "taken since the start")
        .def_property_readonly("critical_step", &ExplicitContinuum::critical_step,
                               "s, by the cells as they are deformed now")
        .def_property_readonly(
            "energies", [](const ExplicitContinuum& c) { return dict_of(c.energies()); },
            "J: kinetic, elastic (from that at rest), hourglass, plastic, absorbed, ground; surface_work, "
            "support_work, step_work; residual: the first six less the work.")
        .def_property_readonly("stress", &stress_of_cells,
                               "Mean Cauchy stress of each cell, (cells, 6): xx, yy, zz, yz, xz, xy, Pa.")
        .def_property_readonly("plastic_strain", &plastic_strain_of_cells,
                               "Mean equivalent plastic strain of each cell, (cells,).")
        .def(
            "advance",
            [](ExplicitContinuum& c, double dt, const Rows& surface_forces) {
                if (surface_forces.size() == 0)
                    return c.advance(dt, Positions::Zero(3, c.surface().node_count()));
                c.advance(dt, positions_from("surface_forces", surface_forces));
            },
            py::arg("dt"), py::arg("surface_forces") = Rows(),
            "Move on by dt (s) under forces on the surface's nodes, (k, 3), N.")
        .def_property(
            "state",
            [](const ExplicitContinuum& c) {
                const std::vector<double> state = c.state();
                return py::array_t<double>(static_cast<py::ssize_t>(state.size()), state.data());
            },
            &ExplicitContinuum::set_state, "All that the next substep depends on, (m,) float.");
}

} // namespace grainfall::femlink
