// SPDX-License-Identifier: GPL-2.0-or-later
// The far field: a quasi-static, linearly elastic continuum (MR-2629, Eq 18-21), held at its outer boundary,
// loaded at its coupling surface.
#pragma once

#include <femlink/continuum/condensation.hpp>
#include <femlink/continuum/discretisation.hpp>
#include <femlink/core/wall_model.hpp>

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace grainfall::femlink {

struct Loads {
    Point gravity = Point::Zero();      // m/s^2
    Point surface_load = Point::Zero(); // Pa, traction on the whole coupling surface
    Positions surface_forces;           // N, one column a node of Surface; empty: none
    Positions held_displacement;        // m, one column a node of Field, read at held nodes; empty: none
};

struct Field {
    Positions displacement; // m, one column a node
    Positions reaction;     // N, forces of the support on held nodes; zero elsewhere
    double strain_energy;   // J
};

// Bytes, of what is largest.
struct MemoryNeed {
    std::size_t stiffness = 0, factor = 0, compliance = 0;
    std::size_t direct() const { return stiffness + factor + compliance; }
    std::size_t iterative() const { return 3 * stiffness + compliance; } // preconditioner and its copy
};

enum class Solver { automatic, direct, iterative };

Solver solver_from_name(const std::string& name); // 'auto', 'direct', 'iterative'

struct ContinuumOptions {
    int degree = 1;
    Solver solver = Solver::automatic;
    std::size_t memory_limit = 0; // bytes; 0: half of the machine's memory
};

class Continuum {
public:
    Continuum(const HexMesh& mesh, const Materials& materials, const ContinuumOptions& options);

    const Surface& surface() const { return surface_; }
    // Node of the field by node of the surface.
    const std::vector<int>& surface_nodes() const { return surface_nodes_; }
    const Positions& nodes() const { return discretisation_.nodes(); }
    const std::vector<int>& held_nodes() const { return held_nodes_; }
    const Discretisation& discretisation() const { return discretisation_; }
    int unknowns() const { return static_cast<int>(unknown_node_.size()) * 3; }
    MemoryNeed memory() const { return memory_; }
    bool is_direct() const { return direct_; }

    // The wall for the contact solver. `loads` (gravity, surface load) give its preload; forces in them are
    // refused. `progress` is told the share done where it takes long (iterative path).
    WallModel condense(const Loads& loads, const std::function<void(double)>& progress = {});
    Field solve(const Loads& loads);

private:
    void find_held_nodes();
    void find_surface();
    void order_unknowns();
    void assemble();
    void choose_solver(const ContinuumOptions& options);
    Eigen::VectorXd free_displacement(const Eigen::VectorXd& load);
    Eigen::MatrixXd compliance_by_columns(const std::function<void(double)>& progress);

    Discretisation discretisation_;
    Materials materials_;
    Surface surface_;
    std::vector<int> surface_nodes_, held_nodes_;
    std::vector<std::vector<int>> graph_;   // neighbours of each node, itself among them, ascending
    std::vector<int> unknown_node_;         // nodes that move, in order of elimination, the surface's last
    std::vector<int> unknown_of_node_;      // the other way round, -1: held
    Eigen::SparseMatrix<double> stiffness_; // of all nodes, three rows a node
    MemoryNeed memory_;
    bool direct_ = true;
    std::unique_ptr<DirectFactor> factor_;
    struct Iterative;
    std::shared_ptr<Iterative> iterative_;
    Fnv1a hash_; // of mesh, materials, degree
};

} // namespace grainfall::femlink
