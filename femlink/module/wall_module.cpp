// SPDX-License-Identifier: GPL-2.0-or-later
// Python module grainfall.femlink._wall: meshes, surfaces, closest points, contact solver, wall files. Needs
// no deal.II.
#include <femlink/core/closest_point.hpp>
#include <femlink/core/compliance.hpp>
#include <femlink/core/hex_mesh.hpp>
#include <femlink/core/staggered.hpp>
#include <femlink/core/wall_model.hpp>
#include <femlink/module/numpy_arrays.hpp>

#include <memory>

namespace py = pybind11;

namespace grainfall::femlink {

namespace {

HexMesh mesh_from(const Rows& vertices, const IntegerRows& cells, const std::vector<int>& regions,
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

Rows vertices_of(const HexMesh& mesh) {
    Rows out(mesh.vertices.size(), 3);
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
        out.row(v) = mesh.vertices[v];
    return out;
}

void set_vertices(HexMesh& mesh, const Rows& vertices) {
    require_columns("vertices", vertices, 3);
    laws::require_length("vertices", vertices.rows(), mesh.vertices.size(), "one point a vertex");
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
        mesh.vertices[v] = vertices.row(v);
}

IntegerRows cells_of(const HexMesh& mesh) {
    IntegerRows out(mesh.cells.size(), 8);
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
        for (int k = 0; k < 8; ++k)
            out(c, k) = mesh.cells[c][k];
    return out;
}

IntegerRows boundary_corners_of(const HexMesh& mesh) {
    IntegerRows out(mesh.boundary.size(), 4);
    for (std::size_t f = 0; f < mesh.boundary.size(); ++f)
        for (int k = 0; k < 4; ++k)
            out(f, k) = mesh.boundary[f].corners[k];
    return out;
}

std::vector<int> boundary_ids_of(const HexMesh& mesh) {
    std::vector<int> out;
    for (const auto& face : mesh.boundary)
        out.push_back(face.id);
    return out;
}

void bind_meshes(py::module_& module) {
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

Surface surface_from(int degree, const Rows& nodes, const IntegerRows& faces, const std::vector<int>& loose) {
    Surface surface;
    surface.degree = degree;
    surface.nodes = positions_from("nodes", nodes);
    surface.faces = faces.transpose();
    surface.loose = loose;
    validate(surface);
    surface.connect();
    return surface;
}

Positions current_positions(const Surface& surface, const Rows& displacement) {
    if (displacement.size() == 0)
        return surface.nodes;
    require_columns("displacement", displacement, 3);
    laws::require_length("displacement", displacement.rows(), surface.node_count(),
                         "one row a node of the surface");
    return surface.nodes + displacement.transpose();
}

int checked_face(const Surface& surface, int face) {
    if (face < 0 || face >= surface.face_count())
        laws::reject("face", face, "in [0, " + std::to_string(surface.face_count() - 1) + "]");
    return face;
}

ClosestPoint closest_on_face(const Surface& surface, const Positions& positions, int face,
                             const Point& point) {
    return surface.degree == 1 ? closest_point<1>(surface.face<1>(face, positions), point)
                               : closest_point<2>(surface.face<2>(face, positions), point);
}

ClosestPoint closest_of_nodes(const Rows& nodes, const Point& point) {
    require_columns("nodes", nodes, 3);
    if (nodes.rows() == nodes_per_face<1>)
        return closest_point<1>(FaceNodes<1>(nodes.transpose()), point);
    if (nodes.rows() == nodes_per_face<2>)
        return closest_point<2>(FaceNodes<2>(nodes.transpose()), point);
    laws::reject("nodes", static_cast<double>(nodes.rows()), "4 or 9 points");
}

// All faces, one after the other: for set-up and analysis; in a scene the collider finds the candidates.
std::pair<int, ClosestPoint> closest_on_surface(const Surface& surface, const Point& point,
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

void bind_surfaces(py::module_& module) {
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

void bind_model(py::module_& module) {
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

// A wall with the matrices it keeps from step to step.
class Wall {
public:
    explicit Wall(WallModel model)
        : model_(std::make_shared<WallModel>(std::move(model))),
          loaded_(model_->surface, model_->compliance) {}

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
        return loaded_.condense(sites(faces, references, normals, patch));
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
        const Eigen::MatrixXd& wall = loaded_.condense(sites);
        Eigen::VectorXd forces = Eigen::VectorXd::Zero(3 * sites.size());
        if (start.size() == forces.size())
            forces = Eigen::Map<const Eigen::VectorXd>(start.data(), start.size());
        SolverReport report;
        if (coupling == "implicit")
            report = solve_contacts(wall, contacts, forces, options);
        else if (coupling == "staggered")
            report = solve_staggered(wall, contacts, forces, options);
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

    std::shared_ptr<WallModel> model_; // at a fixed address: loaded_ refers to it
    LoadedCompliance loaded_;
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
}
