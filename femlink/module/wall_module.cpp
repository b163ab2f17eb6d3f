// SPDX-License-Identifier: GPL-2.0-or-later
// Python module grainfall.femlink._wall: meshes, surfaces, closest points, contact solver, wall files,
// explicit continuum. Needs no deal.II.
#include <femlink/core/staggered.hpp>
#include <femlink/core/wall_solver.hpp>
#include <femlink/module/explicit_bindings.hpp>
#include <femlink/module/mesh_bindings.hpp>
#include <femlink/module/surface_bindings.hpp>

#include <memory>

namespace grainfall::femlink {

namespace {

// A wall with the matrices it keeps from step to step.
class Wall {
public:
    explicit Wall(WallModel model)
        : model_(std::make_shared<WallModel>(std::move(model))),
          solver_(model_->surface, model_->compliance) {}

    const WallModel& model() const { return *model_; }

    // Patches on the surface at rest: the theory is that of small displacements.
    std::vector<ContactSite> sites(const std::vector<int>& faces, const Rows& references, const Rows& normals,
                                   double patch) const {
        const Surface& surface = model_->surface;
        require_columns("references", references, 2);
        laws::require_length("references", references.rows(), faces.size(), "one a contact");
        if (normals.size() != 0) {
            require_columns("normals", normals, 3);
            laws::require_length("normals", normals.rows(), faces.size(), "one a contact");
        }
        laws::require_not_negative("patch", patch);
        std::vector<ContactSite> out;
        for (std::size_t i = 0; i < faces.size(); ++i) {
            const int face = checked_face(surface, faces[i]);
            const Reference at = references.row(i);
            laws::require_between("references", at.cwiseAbs().maxCoeff(), 0, 1);
            const double radius = patch * face_size(surface, surface.nodes, face);
            Point normal = normals.size() != 0 ? Point(normals.row(i)).normalized() : rest_normal(face, at);
            out.push_back({contact_patch(surface, surface.nodes, face, at, radius), contact_axes(normal)});
        }
        return out;
    }

    Eigen::MatrixXd compliance(const std::vector<int>& faces, const Rows& references, const Rows& normals,
                               double patch) {
        return solver_.condense(listed(sites(faces, references, normals, patch)));
    }

    py::dict solve(const std::vector<int>& faces, const Rows& references, const Rows& normals, double patch,
                   const std::vector<double>& free_overlap, const Rows& free_shear,
                   const std::string& relation, const std::vector<double>& coefficient,
                   double shear_stiffness, double friction, const Rows& start, const std::string& coupling,
                   double tolerance, int max_sweeps) {
        for (const double value : coefficient)
            laws::require_positive("coefficient", value);
        const SolverOptions options{tolerance, max_sweeps};
        if (relation == "linear")
            return solve_as<LinearContact>(sites(faces, references, normals, patch), free_overlap, free_shear,
                                           coefficient, shear_stiffness, friction, start, coupling, options);
        if (relation == "hertz")
            return solve_as<HertzContact>(sites(faces, references, normals, patch), free_overlap, free_shear,
                                          coefficient, shear_stiffness, friction, start, coupling, options);
        laws::reject("relation", "'" + relation + "'", "'linear' or 'hertz'");
    }

private:
    Point rest_normal(int face, const Reference& at) const {
        const Surface& s = model_->surface;
        if (s.degree == 1)
            return face_normal<1>(s.face<1>(face, s.nodes), face_frame<1>(s.face<1>(face, s.nodes), at));
        return face_normal<2>(s.face<2>(face, s.nodes), face_frame<2>(s.face<2>(face, s.nodes), at));
    }

    template <class Relation>
    py::dict solve_as(const std::vector<ContactSite>& sites, const std::vector<double>& free_overlap,
                      const Rows& free_shear, const std::vector<double>& coefficient, double shear_stiffness,
                      double friction, const Rows& start, const std::string& coupling,
                      const SolverOptions& options) {
        laws::require_length("free_overlap", free_overlap.size(), sites.size(), "one a contact");
        laws::require_length("coefficient", coefficient.size(), sites.size(), "one a contact");
        if (free_shear.size() != 0)
            laws::require_length("free_shear", free_shear.rows(), sites.size(), "one a contact");
        laws::require_not_negative("shear_stiffness", shear_stiffness);
        laws::require_not_negative("friction", friction);
        std::vector<WallContact<Relation>> contacts;
        for (std::size_t i = 0; i < sites.size(); ++i) {
            WallContact<Relation> contact{Relation{coefficient[i]}};
            contact.free_overlap = free_overlap[i];
            if (free_shear.size() != 0)
                contact.free_shear = free_shear.row(i);
            contact.shear_stiffness = shear_stiffness;
            contact.friction = friction;
            contacts.push_back(contact);
        }
        std::vector<Eigen::Matrix3d> own;
        for (const ContactSite& site : sites)
            own.push_back(own_compliance(model_->surface, model_->compliance, site));
        Eigen::VectorXd forces = Eigen::VectorXd::Zero(3 * sites.size());
        if (start.size() == forces.size())
            forces = Eigen::Map<const Eigen::VectorXd>(start.data(), start.size());
        SolverReport report;
        if (coupling == "implicit")
            report = solver_.solve(listed(sites), own, contacts, forces, options);
        else if (coupling == "staggered")
            report = solve_staggered(solver_.condense(listed(sites)), contacts, forces, options);
        else
            laws::reject("coupling", "'" + coupling + "'", "'implicit' or 'staggered'");
        const Positions nodal = nodal_forces(model_->surface, sites, forces);
        py::dict out;
        out["force"] = Rows(Eigen::Map<const Rows>(forces.data(), sites.size(), 3));
        out["nodal_force"] = Rows(nodal.transpose());
        out["displacement"] = Rows(displacements(model_->surface, model_->compliance, nodal).transpose());
        out["sweeps"] = report.sweeps;
        out["converged"] = report.converged;
        out["change"] = report.change;
        return out;
    }

    std::shared_ptr<WallModel> model_; // at a fixed address: solver_ refers to it
    WallSolver solver_;
};

void bind_wall(py::module_& module) {
    py::class_<Wall>(module, "Wall", "A wall under grains: solves its contacts implicitly in its compliance.")
        .def(py::init<WallModel>(), py::arg("model"))
        .def_property_readonly("model", &Wall::model, py::return_value_policy::reference_internal)
        .def(
            "compliance", &Wall::compliance, py::arg("faces"), py::arg("references"),
            py::arg("normals") = Rows(), py::arg("patch") = 1.25,
            R"(Compliance that the contacts see, (3 m, 3 m), m/N, in each contact's axes (normal, two tangents).

faces: (m,), references: (m, 2) in [-1, 1]; patch: radius of the loaded disc over the face's size (0: point load).)")
        .def("solve", &Wall::solve, py::arg("faces"), py::arg("references"), py::arg("normals") = Rows(),
             py::arg("patch") = 1.25, py::kw_only(), py::arg("free_overlap"), py::arg("free_shear") = Rows(),
             py::arg("relation") = "hertz", py::arg("coefficient"), py::arg("shear_stiffness") = 0.0,
             py::arg("friction") = 0.0, py::arg("start") = Rows(), py::arg("coupling") = "implicit",
             py::arg("tolerance") = 1e-10, py::arg("max_sweeps") = 10000,
             R"(Contact forces and the wall's displacement.

Parameters
----------
free_overlap : (m,) float, m
    Overlap of each grain with the wall if no grain loaded it.
free_shear : (m, 2) float, m
    Stretch of each shear spring on that wall.
relation : 'hertz' (coefficient in N/m^1.5) or 'linear' (N/m)
start : (m, 3) float, N
    Forces of the step before.
coupling : 'implicit' or 'staggered' (refused where it diverges)

Returns
-------
dict
    force (m, 3) on the grains, N; nodal_force (n, 3), N; displacement (n, 3), m; sweeps, converged, change.)");
    module.def("contact_axes", &contact_axes, py::arg("normal"),
               "Axes (columns: normal, two tangents) in which contact forces are given.");
}

} // namespace

} // namespace grainfall::femlink

PYBIND11_MODULE(_wall, module) {
    module.doc() = "Meshes, closest points and contact solver of the deformable wall; no deal.II.";
    grainfall::femlink::bind_meshes(module);
    grainfall::femlink::bind_surfaces(module);
    grainfall::femlink::bind_model(module);
    grainfall::femlink::bind_wall(module);
    grainfall::femlink::bind_explicit(module);
}
