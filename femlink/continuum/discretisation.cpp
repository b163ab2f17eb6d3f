// SPDX-License-Identifier: GPL-2.0-or-later
#include <femlink/continuum/discretisation.hpp>

#include <deal.II/base/multithread_info.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_tools.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q1.h>
#include <deal.II/grid/grid_in.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/vector.h>
#include <deal.II/numerics/data_out.h>

#include <array>
#include <fstream>
#include <stdexcept>

namespace grainfall::femlink {

namespace {

// Local node numbers of face 0 ... 5 (x = 0, x = 1, y = 0, ...) on a grid of (degree + 1)^3, so that the
// first axis times the second points out of the cell.
std::vector<int> face_nodes_of_cell(int degree, int face) {
    static constexpr int first_axis[6] = {2, 1, 0, 2, 1, 0}, second_axis[6] = {1, 2, 2, 0, 0, 1};
    const int n = degree + 1, stride[3] = {1, n, n * n};
    std::vector<int> nodes;
    for (int b = 0; b < n; ++b)
        for (int a = 0; a < n; ++a)
            nodes.push_back((face % 2 ? degree : 0) * stride[face / 2] + a * stride[first_axis[face]] +
                            b * stride[second_axis[face]]);
    return nodes;
}

// deal.II's messages run over many lines; users get the last that says something.
std::string short_reason(const std::exception& error) {
    const std::string text = error.what();
    const std::string mark = "Additional information:";
    std::size_t begin = text.find(mark);
    begin = begin == std::string::npos ? 0 : begin + mark.size();
    std::string out;
    for (std::size_t i = begin; i < text.size() && text.compare(i, 2, "\n-") != 0; ++i) {
        const char c = text[i] == '\n' ? ' ' : text[i];
        if (c != ' ' || (!out.empty() && out.back() != ' '))
            out += c;
    }
    while (!out.empty() && (out.back() == ' ' || out.back() == '.'))
        out.pop_back();
    return out;
}

} // namespace

struct Discretisation::Parts {
    int degree;
    Materials materials;
    dealii::Triangulation<3> triangulation;
    dealii::FE_Q<3> element; // one number a node; the three components share it
    dealii::DoFHandler<3> handler{triangulation};
    std::vector<unsigned int> hierarchic; // deal.II's local number of a node in lexicographic order
    Positions nodes;
    std::vector<CellNodes> cells;

    Parts(int element_degree, Materials by_region)
        : degree(element_degree), materials(std::move(by_region)), element(element_degree),
          hierarchic(dealii::FETools::lexicographic_to_hierarchic_numbering<3>(element_degree)) {}

    void triangulate(const HexMesh& mesh) {
        std::vector<dealii::Point<3>> vertices;
        for (const Point& v : mesh.vertices)
            vertices.emplace_back(v[0], v[1], v[2]);
        std::vector<dealii::CellData<3>> cell_data(mesh.cells.size());
        for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
            for (int k = 0; k < 8; ++k)
                cell_data[c].vertices[k] = mesh.cells[c][k];
            cell_data[c].material_id = mesh.regions[c];
        }
        dealii::SubCellData boundary;
        for (const HexMesh::BoundaryFace& face : mesh.boundary) {
            dealii::CellData<2> quad;
            for (int k = 0; k < 4; ++k)
                quad.vertices[k] = face.corners[k];
            quad.boundary_id = face.id;
            boundary.boundary_quads.push_back(quad);
        }
        triangulation.create_triangulation(vertices, cell_data, boundary);
        handler.distribute_dofs(element);
    }

    void number_nodes() {
        const dealii::Quadrature<3> points(element.get_unit_support_points());
        dealii::FEValues<3> values(element, points, dealii::update_quadrature_points);
        nodes.resize(3, handler.n_dofs());
        std::vector<dealii::types::global_dof_index> local(element.n_dofs_per_cell());
        for (const auto& cell : handler.active_cell_iterators()) {
            values.reinit(cell);
            cell->get_dof_indices(local);
            CellNodes lexicographic;
            for (const unsigned int k : hierarchic) {
                lexicographic.push_back(static_cast<int>(local[k]));
                for (int d = 0; d < 3; ++d)
                    nodes(d, local[k]) = values.quadrature_point(k)[d];
            }
            cells.push_back(std::move(lexicographic));
        }
    }

    const Material& material(unsigned int region) const { return materials.at(static_cast<int>(region)); }

    // Polynomials that the dilatation is projected on: 1, and for degree 2 the coordinates from the cell's
    // middle.
    Eigen::MatrixXd dilatation_basis(const dealii::FEValues<3>& values, const dealii::Point<3>& middle,
                                     double size) const {
        const unsigned int points = values.n_quadrature_points;
        Eigen::MatrixXd basis = Eigen::MatrixXd::Ones(degree == 1 ? 1 : 4, points);
        for (unsigned int q = 0; degree > 1 && q < points; ++q)
            for (int d = 0; d < 3; ++d)
                basis(1 + d, q) = (values.quadrature_point(q)[d] - middle[d]) / size;
        return basis;
    }

    // Gradients of the shape functions at a point, lexicographic, one column a node.
    Positions gradients(const dealii::FEValues<3>& values, unsigned int q) const {
        Positions out(3, hierarchic.size());
        for (std::size_t a = 0; a < hierarchic.size(); ++a)
            for (int d = 0; d < 3; ++d)
                out(d, a) = values.shape_grad(hierarchic[a], q)[d];
        return out;
    }
};

Discretisation::Discretisation(const HexMesh& mesh, Materials materials, int degree) {
    if (degree != 1 && degree != 2)
        laws::reject("degree", degree, "1 or 2");
    validate(mesh);
    for (const auto& [region, material] : materials)
        validate(material, "materials[" + std::to_string(region) + "]");
    for (const int region : mesh.regions)
        if (materials.count(region) == 0)
            laws::reject("materials", "no entry " + std::to_string(region),
                         "given for every region of the mesh");
    // Each solve is small; threads that wait for each other would cost more than they bring.
    dealii::MultithreadInfo::set_thread_limit(1);
    parts_ = std::make_unique<Parts>(degree, std::move(materials));
    try {
        parts_->triangulate(mesh);
    } catch (const std::exception& error) {
        laws::reject("mesh", "not accepted by deal.II (" + short_reason(error) + ")",
                     "a conforming hexahedral mesh");
    }
    parts_->number_nodes();
}

Discretisation::~Discretisation() = default;

int Discretisation::degree() const {
    return parts_->degree;
}
int Discretisation::node_count() const {
    return static_cast<int>(parts_->nodes.cols());
}
const Positions& Discretisation::nodes() const {
    return parts_->nodes;
}
const std::vector<CellNodes>& Discretisation::cells() const {
    return parts_->cells;
}

std::vector<std::vector<int>> Discretisation::faces(int boundary_id) const {
    std::vector<std::vector<int>> out;
    std::size_t c = 0;
    for (const auto& cell : parts_->triangulation.active_cell_iterators()) {
        for (unsigned int face = 0; face < 6; ++face) {
            if (!cell->face(face)->at_boundary() ||
                static_cast<int>(cell->face(face)->boundary_id()) != boundary_id)
                continue;
            out.emplace_back();
            for (const int local : face_nodes_of_cell(parts_->degree, static_cast<int>(face)))
                out.back().push_back(parts_->cells[c][local]);
        }
        ++c;
    }
    return out;
}

void Discretisation::for_each_stiffness(const std::function<void(int, const Eigen::MatrixXd&)>& add) const {
    const dealii::QGauss<3> quadrature(parts_->degree + 1);
    dealii::FEValues<3> values(parts_->element, quadrature,
                               dealii::update_gradients | dealii::update_JxW_values |
                                   dealii::update_quadrature_points);
    const int n = static_cast<int>(parts_->hierarchic.size());
    Eigen::MatrixXd stiffness(3 * n, 3 * n);
    int index = 0;
    for (const auto& cell : parts_->handler.active_cell_iterators()) {
        values.reinit(cell);
        const Material& material = parts_->material(cell->material_id());
        const Eigen::MatrixXd basis = parts_->dilatation_basis(values, cell->center(), cell->diameter());
        Eigen::MatrixXd dilatation = Eigen::MatrixXd::Zero(basis.rows(), 3 * n);
        Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(basis.rows(), basis.rows());
        stiffness.setZero();
        for (unsigned int q = 0; q < quadrature.size(); ++q) {
            const double volume = values.JxW(q);
            const Positions gradient = parts_->gradients(values, q);
            for (int b = 0; b < n; ++b) {
                for (int a = 0; a < n; ++a) {
                    auto block = stiffness.block<3, 3>(3 * a, 3 * b);
                    block += material.mu() * volume * gradient.col(b) * gradient.col(a).transpose();
                    block.diagonal().array() += material.mu() * volume * gradient.col(a).dot(gradient.col(b));
                }
            }
            mass += volume * basis.col(q) * basis.col(q).transpose();
            dilatation +=
                volume * basis.col(q) * Eigen::Map<const Eigen::RowVectorXd>(gradient.data(), 3 * n);
        }
        stiffness += material.lambda() * dilatation.transpose() * mass.ldlt().solve(dilatation);
        add(index++, stiffness);
    }
}

Positions Discretisation::weight(const Point& gravity) const {
    const dealii::QGauss<3> quadrature(parts_->degree + 1);
    dealii::FEValues<3> values(parts_->element, quadrature,
                               dealii::update_values | dealii::update_JxW_values);
    Positions out = Positions::Zero(3, node_count());
    std::size_t index = 0;
    for (const auto& cell : parts_->handler.active_cell_iterators()) {
        values.reinit(cell);
        const Point body_force = parts_->material(cell->material_id()).density * gravity;
        const CellNodes& nodes = parts_->cells[index++];
        for (unsigned int q = 0; q < quadrature.size(); ++q)
            for (std::size_t a = 0; a < nodes.size(); ++a)
                out.col(nodes[a]) +=
                    values.shape_value(parts_->hierarchic[a], q) * values.JxW(q) * body_force;
    }
    return out;
}

Positions Discretisation::traction(int boundary_id, const Point& pressure) const {
    const dealii::QGauss<2> quadrature(parts_->degree + 1);
    dealii::FEFaceValues<3> values(parts_->element, quadrature,
                                   dealii::update_values | dealii::update_JxW_values);
    Positions out = Positions::Zero(3, node_count());
    std::size_t index = 0;
    for (const auto& cell : parts_->handler.active_cell_iterators()) {
        const CellNodes& nodes = parts_->cells[index++];
        for (const unsigned int face : cell->face_indices()) {
            if (!cell->face(face)->at_boundary() ||
                static_cast<int>(cell->face(face)->boundary_id()) != boundary_id)
                continue;
            values.reinit(cell, face);
            for (unsigned int q = 0; q < quadrature.size(); ++q)
                for (std::size_t a = 0; a < nodes.size(); ++a)
                    out.col(nodes[a]) +=
                        values.shape_value(parts_->hierarchic[a], q) * values.JxW(q) * pressure;
        }
    }
    return out;
}

Eigen::MatrixXd Discretisation::stress(const Positions& displacement) const {
    const dealii::QGauss<3> quadrature(parts_->degree + 1);
    dealii::FEValues<3> values(parts_->element, quadrature,
                               dealii::update_gradients | dealii::update_JxW_values);
    Eigen::MatrixXd out(6, parts_->cells.size());
    int index = 0;
    for (const auto& cell : parts_->handler.active_cell_iterators()) {
        values.reinit(cell);
        const Material& material = parts_->material(cell->material_id());
        Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();
        double volume = 0;
        for (unsigned int q = 0; q < quadrature.size(); ++q) {
            const Positions shape = parts_->gradients(values, q);
            for (std::size_t a = 0; a < parts_->hierarchic.size(); ++a)
                gradient +=
                    values.JxW(q) * displacement.col(parts_->cells[index][a]) * shape.col(a).transpose();
            volume += values.JxW(q);
        }
        const Eigen::Matrix3d strain = (gradient + gradient.transpose()) / (2 * volume);
        const Eigen::Matrix3d sigma =
            2 * material.mu() * strain + material.lambda() * strain.trace() * Eigen::Matrix3d::Identity();
        out.col(index++) << sigma(0, 0), sigma(1, 1), sigma(2, 2), sigma(1, 2), sigma(0, 2), sigma(0, 1);
    }
    return out;
}

void Discretisation::write_vtu(const std::string& path, const Positions& displacement, double time) const {
    std::ofstream file(path);
    if (!file)
        throw std::runtime_error("VTU file '" + path + "': cannot be written");
    const dealii::FESystem<3> element(parts_->element, 3);
    dealii::DoFHandler<3> handler(parts_->triangulation);
    handler.distribute_dofs(element);
    dealii::Vector<double> numbers(handler.n_dofs());
    std::vector<dealii::types::global_dof_index> local(element.n_dofs_per_cell()),
        nodes(parts_->element.n_dofs_per_cell());
    auto scalar_cell = parts_->handler.begin_active();
    for (const auto& cell : handler.active_cell_iterators()) {
        cell->get_dof_indices(local);
        scalar_cell->get_dof_indices(nodes);
        for (unsigned int i = 0; i < local.size(); ++i) {
            const auto [component, base] = element.system_to_component_index(i);
            numbers[local[i]] = displacement(component, nodes[base]);
        }
        ++scalar_cell;
    }
    const Eigen::MatrixXd stresses = stress(displacement);
    static const char* const names[6] = {"stress_xx", "stress_yy", "stress_zz",
                                         "stress_yz", "stress_xz", "stress_xy"};
    std::array<dealii::Vector<double>, 6> columns;
    dealii::DataOut<3> out;
    out.attach_dof_handler(handler);
    using Interpretation = dealii::DataComponentInterpretation::DataComponentInterpretation;
    out.add_data_vector(numbers, std::vector<std::string>(3, "displacement"),
                        dealii::DataOut<3>::type_dof_data,
                        std::vector<Interpretation>(3, Interpretation::component_is_part_of_vector));
    for (int k = 0; k < 6; ++k) {
        columns[k].reinit(stresses.cols());
        for (Eigen::Index c = 0; c < stresses.cols(); ++c)
            columns[k][c] = stresses(k, c);
        out.add_data_vector(columns[k], names[k], dealii::DataOut<3>::type_cell_data);
    }
    out.build_patches(parts_->degree);
    dealii::DataOutBase::VtkFlags flags;
    flags.time = time;
    out.set_flags(flags);
    out.write_vtu(file);
    file.flush();
    if (!file)
        throw std::runtime_error("VTU file '" + path + "': the disk is full");
}

HexMesh read_gmsh(const std::string& path, const std::vector<int>& fixed_ids,
                  const std::vector<int>& coupling_ids) {
    std::ifstream file(path);
    if (!file)
        throw std::runtime_error("mesh file '" + path + "': cannot be read");
    dealii::Triangulation<3> triangulation;
    try {
        dealii::GridIn<3> reader(triangulation);
        reader.read_msh(file);
    } catch (const std::exception& error) {
        throw std::runtime_error("mesh file '" + path + "': not a hexahedral gmsh mesh (" +
                                 short_reason(error) + ")");
    }
    const auto contains = [](const std::vector<int>& list, int id) {
        return std::find(list.begin(), list.end(), id) != list.end();
    };
    HexMesh mesh;
    for (const dealii::Point<3>& v : triangulation.get_vertices())
        mesh.vertices.push_back({v[0], v[1], v[2]});
    for (const auto& cell : triangulation.active_cell_iterators()) {
        mesh.cells.emplace_back();
        for (int k = 0; k < 8; ++k)
            mesh.cells.back()[k] = static_cast<int>(cell->vertex_index(k));
        mesh.regions.push_back(static_cast<int>(cell->material_id()));
        for (const unsigned int face : cell->face_indices()) {
            if (!cell->face(face)->at_boundary())
                continue;
            const int id = static_cast<int>(cell->face(face)->boundary_id());
            const int ours = contains(fixed_ids, id)      ? outer_fixed
                             : contains(coupling_ids, id) ? coupling_surface
                                                          : free_surface;
            if (ours == free_surface)
                continue;
            HexMesh::BoundaryFace found{};
            for (int k = 0; k < 4; ++k)
                found.corners[k] = mesh.cells.back()[detail::face_corners[face][k]];
            found.id = ours;
            mesh.boundary.push_back(found);
        }
    }
    return mesh;
}

} // namespace grainfall::femlink
