// SPDX-License-Identifier: GPL-2.0-or-later
#include <femlink/continuum/continuum.hpp>
#include <femlink/core/mesh_surface.hpp>

#include <Eigen/IterativeLinearSolvers>

#include <algorithm>
#include <set>
#include <sstream>
#include <stdexcept>

#include <unistd.h>

namespace grainfall::femlink {

struct Continuum::Iterative {
    Eigen::SparseMatrix<double> matrix;
    Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper,
                             Eigen::IncompleteCholesky<double>>
        solver;
};

namespace {

std::size_t half_of_memory() {
    return static_cast<std::size_t>(sysconf(_SC_PHYS_PAGES)) *
           static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) / 2;
}

// Rows and columns `unknown` (three of each node) of a matrix of nodes, lower triangle or all of it.
Eigen::SparseMatrix<double> restricted(const Eigen::SparseMatrix<double>& matrix,
                                       const std::vector<int>& node, const std::vector<int>& place,
                                       bool lower_only) {
    const int count = static_cast<int>(node.size()) * 3;
    Eigen::SparseMatrix<double> out(count, count);
    out.reserve(lower_only ? matrix.nonZeros() / 2 + count : matrix.nonZeros());
    std::vector<std::pair<int, double>> column;
    for (int j = 0; j < count; ++j) {
        column.clear();
        for (Eigen::SparseMatrix<double>::InnerIterator entry(matrix, 3 * node[j / 3] + j % 3); entry;
             ++entry) {
            const int unknown = place[entry.row() / 3];
            const int row = 3 * unknown + static_cast<int>(entry.row() % 3);
            if (unknown >= 0 && (!lower_only || row >= j))
                column.emplace_back(row, entry.value());
        }
        std::sort(column.begin(), column.end());
        out.startVec(j);
        for (const auto& [row, value] : column)
            out.insertBack(row, j) = value;
    }
    out.finalize();
    return out;
}

} // namespace

Solver solver_from_name(const std::string& name) {
    if (name == "auto")
        return Solver::automatic;
    if (name == "direct")
        return Solver::direct;
    if (name == "iterative")
        return Solver::iterative;
    laws::reject("solver", "'" + name + "'", "'auto', 'direct' or 'iterative'");
}

Continuum::Continuum(const HexMesh& mesh, const Materials& materials, const ContinuumOptions& options)
    : discretisation_(mesh, materials, options.degree), materials_(materials),
      hash_(hash_of(mesh, materials, options.degree)) {
    find_held_nodes();
    find_surface();
    order_unknowns();
    assemble();
    choose_solver(options);
}

void Continuum::find_held_nodes() {
    std::set<int> held;
    for (const auto& face : discretisation_.faces(outer_fixed))
        held.insert(face.begin(), face.end());
    held_nodes_.assign(held.begin(), held.end());
}

void Continuum::find_surface() {
    MeshSurface found = surface_of_faces(
        discretisation_.faces(coupling_surface), discretisation_.degree(), nodes(),
        [&](int node) { return std::binary_search(held_nodes_.begin(), held_nodes_.end(), node); });
    surface_ = std::move(found.surface);
    surface_nodes_ = std::move(found.nodes);
    if (surface_.loose_count() == 0)
        laws::reject("coupling surface", "held everywhere", "free to move at one node at least");
}

void Continuum::order_unknowns() {
    const int count = discretisation_.node_count();
    graph_.assign(count, {});
    for (const CellNodes& cell : discretisation_.cells())
        for (const int node : cell)
            graph_[node].insert(graph_[node].end(), cell.begin(), cell.end());
    for (auto& neighbours : graph_) {
        std::sort(neighbours.begin(), neighbours.end());
        neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
        neighbours.shrink_to_fit();
    }
    std::vector<char> placed(count, 0);
    for (const int node : held_nodes_)
        placed[node] = 1;
    std::vector<int> last;
    for (std::size_t k = 0; k < surface_nodes_.size(); ++k) {
        if (surface_.loose[k] != Surface::fixed)
            last.push_back(surface_nodes_[k]);
        placed[surface_nodes_[k]] = 1;
    }
    std::vector<int> plain; // interior, then surface
    for (int node = 0; node < count; ++node)
        if (!placed[node])
            plain.push_back(node);
    plain.insert(plain.end(), last.begin(), last.end());
    unknown_of_node_.assign(count, -1);
    for (std::size_t k = 0; k < plain.size(); ++k)
        unknown_of_node_[plain[k]] = static_cast<int>(k);
    std::vector<std::vector<int>> moving(plain.size());
    for (std::size_t k = 0; k < plain.size(); ++k)
        for (const int other : graph_[plain[k]])
            if (unknown_of_node_[other] >= 0 && other != plain[k])
                moving[k].push_back(unknown_of_node_[other]);
    unknown_node_.clear();
    for (const int k : elimination_order(moving, static_cast<int>(last.size())))
        unknown_node_.push_back(plain[k]);
    for (std::size_t k = 0; k < unknown_node_.size(); ++k)
        unknown_of_node_[unknown_node_[k]] = static_cast<int>(k);
}

void Continuum::assemble() {
    const int count = discretisation_.node_count();
    std::size_t blocks = 0;
    for (const auto& neighbours : graph_)
        blocks += neighbours.size();
    if (9 * blocks > static_cast<std::size_t>(std::numeric_limits<int>::max()))
        laws::reject("mesh", std::to_string(count) + " nodes", "small enough for a stiffness of 2e9 entries");
    stiffness_.resize(3 * count, 3 * count);
    stiffness_.resizeNonZeros(static_cast<Eigen::Index>(9 * blocks));
    int at = 0;
    for (int node = 0; node < count; ++node) {
        for (int d = 0; d < 3; ++d) {
            stiffness_.outerIndexPtr()[3 * node + d] = at;
            for (const int other : graph_[node])
                for (int e = 0; e < 3; ++e)
                    stiffness_.innerIndexPtr()[at++] = 3 * other + e;
        }
    }
    stiffness_.outerIndexPtr()[3 * count] = at;
    std::fill_n(stiffness_.valuePtr(), at, 0.0);
    discretisation_.for_each_stiffness([&](int cell, const Eigen::MatrixXd& local) {
        const CellNodes& nodes = discretisation_.cells()[cell];
        for (std::size_t b = 0; b < nodes.size(); ++b) {
            const auto& neighbours = graph_[nodes[b]];
            for (std::size_t a = 0; a < nodes.size(); ++a) {
                const auto row =
                    std::lower_bound(neighbours.begin(), neighbours.end(), nodes[a]) - neighbours.begin();
                for (int d = 0; d < 3; ++d) {
                    double* column = stiffness_.valuePtr() + stiffness_.outerIndexPtr()[3 * nodes[b] + d];
                    for (int e = 0; e < 3; ++e)
                        column[3 * row + e] +=
                            local(static_cast<Eigen::Index>(3 * a) + e, static_cast<Eigen::Index>(3 * b) + d);
                }
            }
        }
    });
    graph_.clear();
    graph_.shrink_to_fit();
}

void Continuum::choose_solver(const ContinuumOptions& options) {
    const std::size_t limit = options.memory_limit > 0 ? options.memory_limit : half_of_memory();
    const auto n = static_cast<std::size_t>(3 * surface_.loose_count());
    memory_.stiffness = static_cast<std::size_t>(stiffness_.nonZeros()) * (sizeof(double) + sizeof(int));
    memory_.compliance = n * n * sizeof(double);
    if (options.solver != Solver::iterative) {
        factor_ =
            std::make_unique<DirectFactor>(restricted(stiffness_, unknown_node_, unknown_of_node_, true));
        memory_.factor = factor_->bytes();
    }
    direct_ = options.solver == Solver::direct ||
              (options.solver == Solver::automatic && memory_.direct() <= limit);
    if (!direct_)
        factor_.reset();
    const std::size_t need = direct_ ? memory_.direct() : memory_.iterative();
    if (need > limit) {
        std::ostringstream text;
        text << "at least " << need / 1000000 << " MB for this wall (" << unknowns() << " unknowns, " << n
             << " on the coupling surface), solver '" << (direct_ ? "direct" : "iterative")
             << "'; or let the mesh be coarser";
        laws::reject("memory_limit", std::to_string(limit / 1000000) + " MB", text.str());
    }
}

Eigen::VectorXd Continuum::free_displacement(const Eigen::VectorXd& load) {
    if (load.isZero(0))
        return Eigen::VectorXd::Zero(load.size());
    if (direct_) {
        if (!factor_->is_factorized())
            factor_->factorize();
        return factor_->solve(load);
    }
    if (!iterative_) {
        iterative_ = std::make_shared<Iterative>();
        iterative_->matrix = restricted(stiffness_, unknown_node_, unknown_of_node_, false);
        iterative_->solver.setTolerance(1e-11);
        iterative_->solver.setMaxIterations(20000);
        iterative_->solver.compute(iterative_->matrix);
    }
    const Eigen::VectorXd solution = iterative_->solver.solve(load);
    if (iterative_->solver.info() != Eigen::Success)
        throw std::runtime_error(
            "the wall's displacement did not converge in 20000 iterations: part of the mesh is not "
            "held, or its cells are too distorted");
    return solution;
}

Eigen::MatrixXd Continuum::compliance_by_columns(const std::function<void(double)>& progress) {
    const int count = 3 * surface_.loose_count(), first = unknowns() - count;
    Eigen::MatrixXd compliance(count, count);
    Eigen::VectorXd load = Eigen::VectorXd::Zero(unknowns());
    for (int j = 0; j < count; ++j) {
        load[first + j] = 1;
        compliance.col(j) = free_displacement(load).tail(count);
        load[first + j] = 0;
        if (progress)
            progress((j + 1.0) / count);
    }
    return 0.5 * (compliance + compliance.transpose());
}

WallModel Continuum::condense(const Loads& loads, const std::function<void(double)>& progress) {
    if (loads.surface_forces.size() != 0 || loads.held_displacement.size() != 0)
        laws::reject("loads", "forces or displacements of single nodes", "gravity and surface_load only");
    WallModel model;
    model.key = wall_key(hash_, loads.gravity, loads.surface_load);
    std::ostringstream text;
    text << unknowns() << " unknowns, degree " << surface_.degree << ", " << surface_.face_count()
         << " faces";
    model.description = text.str();
    model.surface = surface_;
    if (direct_) {
        if (!factor_->is_factorized())
            factor_->factorize();
        model.compliance = factor_->condensed_compliance(3 * surface_.loose_count());
    } else {
        model.compliance = compliance_by_columns(progress);
    }
    const Field field = solve(loads);
    model.preload.resize(3, surface_.node_count());
    for (int k = 0; k < surface_.node_count(); ++k)
        model.preload.col(k) = field.displacement.col(surface_nodes_[k]);
    return model;
}

Field Continuum::solve(const Loads& loads) {
    const int count = discretisation_.node_count();
    Positions force = Positions::Zero(3, count);
    if (loads.gravity != Point::Zero())
        force += discretisation_.weight(loads.gravity);
    if (loads.surface_load != Point::Zero())
        force += discretisation_.traction(coupling_surface, loads.surface_load);
    if (loads.surface_forces.size() != 0) {
        laws::require_length("surface_forces", loads.surface_forces.cols(), surface_.node_count(),
                             "one force a node of the coupling surface");
        for (int k = 0; k < surface_.node_count(); ++k)
            force.col(surface_nodes_[k]) += loads.surface_forces.col(k);
    }
    Field field;
    field.displacement = Positions::Zero(3, count);
    if (loads.held_displacement.size() != 0) {
        laws::require_length("held_displacement", loads.held_displacement.cols(), count, "one vector a node");
        for (const int node : held_nodes_)
            field.displacement.col(node) = loads.held_displacement.col(node);
    }
    Eigen::Map<Eigen::VectorXd> all(field.displacement.data(), 3 * count);
    Positions rest = force;
    Eigen::Map<Eigen::VectorXd> unbalanced(rest.data(), 3 * count);
    unbalanced.noalias() -= stiffness_ * all;
    Eigen::VectorXd load(unknowns());
    for (std::size_t k = 0; k < unknown_node_.size(); ++k)
        load.segment<3>(3 * static_cast<Eigen::Index>(k)) = rest.col(unknown_node_[k]);
    const Eigen::VectorXd moved = free_displacement(load);
    for (std::size_t k = 0; k < unknown_node_.size(); ++k)
        field.displacement.col(unknown_node_[k]) = moved.segment<3>(3 * static_cast<Eigen::Index>(k));
    Positions internal(3, count);
    Eigen::Map<Eigen::VectorXd> inside(internal.data(), 3 * count);
    inside.noalias() = stiffness_ * all;
    field.strain_energy = 0.5 * all.dot(inside);
    field.reaction = Positions::Zero(3, count);
    for (const int node : held_nodes_)
        field.reaction.col(node) = internal.col(node) - force.col(node);
    return field;
}

} // namespace grainfall::femlink
