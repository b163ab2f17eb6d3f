// SPDX-License-Identifier: GPL-2.0-or-later
// The far field with inertia: explicit dynamics at finite strain (MR-2629, section 5.2), a wall model beside
// the quasi-static one. Lumped mass, central differences with velocities at half steps:
//
//   v(n+1/2) = v(n-1/2) + (h(n-1/2) + h(n+1/2))/2 M^-1 f(u(n)),   u(n+1) = u(n) + h(n+1/2) v(n+1/2)
//
// second order also where the step changes. advance() covers a step of the grains with as many equal substeps
// as the cells' frequencies ask for.
#pragma once

#include <femlink/explicit/cell_blocks.hpp>
#include <femlink/explicit/outer_boundary.hpp>

namespace grainfall::femlink {

struct ExplicitOptions {
    ElementKind element = ElementKind::gauss;
    double hourglass = 1; // of the one-point element: share of the shear stiffness
    OuterBoundary outer = OuterBoundary::fixed;
    double safety = 0.9;                  // longest substep over the critical one
    Point gravity = Point::Zero();        // m/s^2; only soil with friction asks for it
    std::vector<std::array<int, 2>> held; // node and axis, held besides the fixed boundary
};

// J
struct ExplicitEnergies {
    double kinetic = 0, hourglass = 0, plastic = 0;
    double elastic = 0; // from that at rest, the loads at rest included: soil under stress may give some back
    double absorbed = 0; // by the dashpots of the outer boundary
    double ground = 0;   // in its springs

    double surface_work = 0; // of the forces on the surface
    double support_work = 0; // of what moves held components
    double step_work = 0;    // what changes of the substep, the first among them, put in

    double content() const { return kinetic + elastic + hourglass + plastic + absorbed + ground; }
    double work() const { return surface_work + support_work + step_work; }
};

class ExplicitContinuum {
public:
    ExplicitContinuum(const HexMesh& mesh, const SolidMaterials& materials, const ExplicitOptions& options)
        : options_(options), rest_(3, static_cast<Eigen::Index>(mesh.vertices.size())),
          cells_(static_cast<int>(mesh.cells.size())) {
        validate_cells(mesh);
        laws::require_not_negative("hourglass", options.hourglass);
        laws::require_positive("safety", options.safety);
        for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
            rest_.col(static_cast<Eigen::Index>(v)) = mesh.vertices[v];
        for (int axis = 0; axis < 3; ++axis)
            laws::require_finite("gravity[" + std::to_string(axis) + "]", options.gravity[axis]);
        blocks_ = cell_blocks(mesh, materials, options.element, options.hourglass, options.gravity);
        find_masses();
        hold(mesh);
        find_surface(mesh);
        if (options.outer != OuterBoundary::fixed)
            find_ground(mesh, materials);
        position_ = rest_;
        displacement_ = velocity_ = force_ = load_ = Positions::Zero(3, rest_.cols());
        surface_force_ = surface_start_ = Positions::Zero(3, surface_.node_count());
        surface_displacement_ = surface_force_;
        find_forces();
        if (!options.gravity.isZero(0))
            balance();
        limit_ = critical_step();
    }

    const Surface& surface() const { return surface_; }
    const std::vector<int>& surface_nodes() const { return surface_nodes_; } // in the mesh
    const Positions& nodes() const { return rest_; }                         // at rest, m
    const Positions& surface_displacement() const { return surface_displacement_; }
    const Positions& displacement() const { return displacement_; }
    // kg, lumped at a node of the surface.
    double surface_mass(int node) const {
        return mass_[static_cast<std::size_t>(surface_nodes_[static_cast<std::size_t>(node)])];
    }
    double time() const { return time_; }
    long substeps() const { return substeps_; }

    // Of all nodes, m/s, at the present time. Held components move on with theirs.
    void set_velocities(const Positions& velocities) {
        laws::require_length("velocities", static_cast<std::size_t>(velocities.cols()),
                             static_cast<std::size_t>(rest_.cols()), "one a node");
        velocity_ = velocities;
        last_step_ = 0;
    }

    // Velocities at the present time (leapfrog keeps them half a substep behind), m/s.
    Positions velocities() const { return 0.5 * (velocity_ + velocities_after(last_step_)); }

    // The longest stable substep as the cells are deformed now, s.
    double critical_step() const {
        double largest = 0;
        for (const auto& block : blocks_)
            largest = std::max(largest, block->largest_frequency(position_.data()));
        return 2 / largest;
    }

    // Moves on by dt (s) under forces on the surface's nodes (N, one column each), constant meanwhile. Throws
    // std::runtime_error if a cell turns over.
    void advance(double dt, const Positions& surface_forces) {
        laws::require_positive("dt", dt);
        laws::require_length("surface_forces", static_cast<std::size_t>(surface_forces.cols()),
                             static_cast<std::size_t>(surface_.node_count()), "one a node of the surface");
        set_load(surface_forces);
        double left = dt;
        while (left > 0) {
            const long count = static_cast<long>(std::ceil(left / (options_.safety * limit_) * (1 - 1e-12)));
            const double h = left / static_cast<double>(count);
            const long run = std::min<long>(count, check_interval - since_check_);
            for (long k = 0; k < run; ++k)
                substep(h);
            left = run == count ? 0 : left - static_cast<double>(run) * h;
            if (since_check_ >= check_interval) {
                limit_ = critical_step();
                since_check_ = 0;
            }
        }
        time_ += dt;
        follow_surface();
    }

    // Kinetic energy is m v(n-1/2) v(n+1/2) / 2: with it central differences keep the energy of a linear
    // system to rounding, whatever the step.
    ExplicitEnergies energies() const {
        ExplicitEnergies out;
        const Positions after = velocities_after(last_step_);
        for (Eigen::Index i = 0; i < after.size(); ++i)
            out.kinetic += 0.5 * mass_[i / 3] * velocity_.data()[i] * after.data()[i];
        for (const auto& block : blocks_) {
            const CellEnergies part = block->energies(position_.data());
            out.elastic += part.elastic;
            out.plastic += part.plastic;
            out.hourglass += part.hourglass;
        }
        if (rest_force_.size() != 0)
            out.elastic -= rest_energy_ + rest_force_.cwiseProduct(displacement_).sum();
        out.absorbed = absorbed_;
        for (const GroundNode& at : ground_) {
            const Point before = velocity_.col(at.node);
            out.absorbed += absorption(at, before, after.col(at.node), last_step_, 0);
            out.ground += 0.5 * at.spring * displacement_.col(at.node).squaredNorm();
        }
        out.surface_work = surface_work_;
        out.support_work = support_work_;
        out.step_work = step_work_;
        return out;
    }

    std::vector<CellState> cell_states() const {
        std::vector<CellState> out(static_cast<std::size_t>(cells_));
        for (const auto& block : blocks_)
            block->states(position_.data(), out);
        return out;
    }

    // Everything that the next substep depends on: set_state(state()) goes on to the last bit.
    std::vector<double> state() const {
        std::vector<double> out = {
            time_,         last_step_,    limit_,     static_cast<double>(since_check_), absorbed_,
            surface_work_, support_work_, step_work_, static_cast<double>(substeps_)};
        for (const Positions* field : {&displacement_, &velocity_, &force_, &load_})
            out.insert(out.end(), field->data(), field->data() + field->size());
        for (const auto& block : blocks_)
            out.insert(out.end(), block->memory().begin(), block->memory().end());
        return out;
    }

    void set_state(const std::vector<double>& state) {
        std::size_t expected = state_numbers + 4 * static_cast<std::size_t>(rest_.size());
        for (const auto& block : blocks_)
            expected += block->memory().size();
        laws::require_length("state", state.size(), expected, "that of a wall of the same mesh");
        const double* at = state.data();
        time_ = at[0], last_step_ = at[1], limit_ = at[2], since_check_ = static_cast<int>(at[3]);
        absorbed_ = at[4], surface_work_ = at[5], support_work_ = at[6], step_work_ = at[7];
        substeps_ = static_cast<long>(at[8]);
        at += state_numbers;
        for (Positions* field : {&displacement_, &velocity_, &force_, &load_}) {
            std::copy_n(at, field->size(), field->data());
            at += field->size();
        }
        for (const auto& block : blocks_) {
            std::copy_n(at, block->memory().size(), block->memory().begin());
            at += block->memory().size();
        }
        position_ = rest_ + displacement_;
        gather_surface();
    }

private:
    static constexpr int check_interval = 16; // substeps between looks at the critical step
    static constexpr std::size_t state_numbers = 9;

    void find_masses() {
        mass_.assign(static_cast<std::size_t>(rest_.cols()), 0.0);
        for (const auto& block : blocks_)
            block->add_mass(mass_);
        for (std::size_t v = 0; v < mass_.size(); ++v) {
            if (!(mass_[v] > 0))
                laws::reject("vertices[" + std::to_string(v) + "]", "a point of no cell",
                             "a corner of at least one cell");
            inverse_mass_.insert(inverse_mass_.end(), 3, 1 / mass_[v]);
        }
    }

    void hold(const HexMesh& mesh) {
        if (options_.outer == OuterBoundary::fixed)
            for (const auto& face : mesh.boundary)
                for (const int node : face.corners)
                    for (int axis = 0; axis < 3 && face.id == outer_fixed; ++axis)
                        inverse_mass_[3 * node + axis] = 0;
        for (const auto& [node, axis] : options_.held) {
            if (node < 0 || node >= rest_.cols() || axis < 0 || axis > 2)
                laws::reject("held", "node " + std::to_string(node) + ", axis " + std::to_string(axis),
                             "a node of the mesh and an axis 0, 1 or 2");
            inverse_mass_[3 * node + axis] = 0;
        }
        for (int i = 0; i < static_cast<int>(inverse_mass_.size()); ++i)
            if (inverse_mass_[i] == 0)
                held_.push_back(i);
    }

    bool is_held(int node) const {
        return inverse_mass_[3 * node] + inverse_mass_[3 * node + 1] + inverse_mass_[3 * node + 2] == 0;
    }

    void find_surface(const HexMesh& mesh) {
        std::vector<std::vector<int>> faces;
        for (const CellFace& face : cell_faces(mesh, coupling_surface))
            faces.push_back(face.nodes);
        MeshSurface found = surface_of_faces(faces, 1, rest_, [&](int node) { return is_held(node); });
        surface_ = std::move(found.surface);
        surface_nodes_ = std::move(found.nodes);
    }

    void find_ground(const HexMesh& mesh, const SolidMaterials& materials) {
        const Positions& loaded = surface_.node_count() > 0 ? surface_.nodes : rest_;
        ground_ = absorbing_nodes(mesh, materials, loaded.rowwise().mean(),
                                  options_.outer == OuterBoundary::absorbing);
        ground_velocity_.assign(ground_.size(), Point::Zero());
        for (GroundNode& at : ground_) {
            for (int axis = 0; axis < 3; ++axis) {
                if (inverse_mass_[3 * at.node + axis] != 0)
                    continue;
                at.damping.row(axis).setZero();
                at.damping.col(axis).setZero();
            }
        }
    }

    void find_forces() {
        force_.setZero();
        for (const auto& block : blocks_)
            block->add_forces(position_.data(), force_.data());
        for (const GroundNode& at : ground_)
            force_.col(at.node) -= at.spring * displacement_.col(at.node);
        if (rest_force_.size() != 0)
            force_ += rest_force_;
    }

    // Weight, and whatever else holds the soil at rest, go on acting as they do there.
    void balance() {
        for (const auto& block : blocks_)
            rest_energy_ += block->energies(position_.data()).elastic;
        rest_force_ = -force_;
        force_.setZero();
    }

    // A load acts from the middle of the last substep on: central differences kick with it over both halves.
    void set_load(const Positions& surface_forces) {
        surface_force_ = surface_forces;
        gather_surface();
        surface_start_ = surface_displacement_;
        for (std::size_t k = 0; k < surface_nodes_.size(); ++k) {
            for (int axis = 0; axis < 3; ++axis) {
                const int i = 3 * surface_nodes_[k] + axis;
                const double change = surface_forces(axis, static_cast<Eigen::Index>(k)) - load_.data()[i];
                if (inverse_mass_[i] > 0)
                    surface_work_ += 0.5 * last_step_ * velocity_.data()[i] * change;
                load_.data()[i] = surface_forces(axis, static_cast<Eigen::Index>(k));
            }
        }
    }

    void gather_surface() {
        for (std::size_t k = 0; k < surface_nodes_.size(); ++k)
            surface_displacement_.col(static_cast<Eigen::Index>(k)) = displacement_.col(surface_nodes_[k]);
    }

    void follow_surface() {
        gather_surface();
        surface_work_ += surface_force_.cwiseProduct(surface_displacement_ - surface_start_).sum();
    }

    // Velocity of a node after a kick of h, its dashpots at the mean velocity: stable at any step.
    Point damped(const GroundNode& at, double h) const {
        const Point before = velocity_.col(at.node);
        Point push = force_.col(at.node) + load_.col(at.node);
        for (int axis = 0; axis < 3; ++axis)
            if (inverse_mass_[3 * at.node + axis] == 0)
                push[axis] = 0;
        const Eigen::Matrix3d inertia = mass_[at.node] * Eigen::Matrix3d::Identity();
        return (inertia + 0.5 * h * at.damping).inverse() *
               (inertia * before - 0.5 * h * (at.damping * before) + h * push);
    }

    // Energy that a dashpot takes from the substeps on both sides of a kick, J.
    static double absorption(const GroundNode& at, const Point& before, const Point& after, double last,
                             double next) {
        return 0.25 * (last * before + next * after).dot(at.damping * (before + after));
    }

    Positions velocities_after(double kick) const {
        Positions out = velocity_;
        for (Eigen::Index i = 0; i < out.size(); ++i)
            out.data()[i] += kick * inverse_mass_[i] * (force_.data()[i] + load_.data()[i]);
        for (const GroundNode& at : ground_)
            out.col(at.node) = damped(at, kick);
        return out;
    }

    // Power of the supports that move held components on, W.
    double held_power() const {
        double power = 0;
        for (const int i : held_)
            power -= velocity_.data()[i] * (force_.data()[i] + load_.data()[i]);
        return power;
    }

    void kick_ground(double kick, double next) {
        for (std::size_t k = 0; k < ground_.size(); ++k) {
            ground_velocity_[k] = damped(ground_[k], kick);
            absorbed_ +=
                absorption(ground_[k], velocity_.col(ground_[k].node), ground_velocity_[k], last_step_, next);
        }
    }

    // What a change of the step adds to the energy as energies() has it, J; the first step is one from zero.
    double change_of_step(double h) const {
        double sum = 0;
        for (Eigen::Index i = 0; i < force_.size(); ++i) {
            const double force = force_.data()[i] + load_.data()[i];
            sum += inverse_mass_[i] * force * force;
        }
        return 0.125 * (last_step_ * last_step_ - h * h) * sum;
    }

    void substep(double h) {
        const double kick = 0.5 * (last_step_ + h);
        if (h != last_step_)
            step_work_ += change_of_step(h);
        kick_ground(kick, h);
        double support_power = held_power();
        double *u = displacement_.data(), *v = velocity_.data(), *x = position_.data();
        const double *f = force_.data(), *p = load_.data(), *at_rest = rest_.data();
        const auto count = static_cast<std::size_t>(rest_.size());
        for (std::size_t i = 0; i < count; ++i)
            v[i] += kick * inverse_mass_[i] * (f[i] + p[i]);
        for (std::size_t k = 0; k < ground_.size(); ++k)
            velocity_.col(ground_[k].node) = ground_velocity_[k];
        for (std::size_t i = 0; i < count; ++i) {
            u[i] += h * v[i];
            x[i] = at_rest[i] + u[i];
        }
        find_forces();
        support_power += held_power();
        support_work_ += 0.5 * h * support_power;
        last_step_ = h;
        ++since_check_;
        ++substeps_;
    }

    ExplicitOptions options_;
    Positions rest_; // m
    int cells_;
    std::vector<std::unique_ptr<CellBlock>> blocks_;
    std::vector<double> mass_;         // kg a node
    std::vector<double> inverse_mass_; // 1/kg a component, 0: held
    std::vector<int> held_;            // components
    Surface surface_;
    std::vector<int> surface_nodes_;
    std::vector<GroundNode> ground_;
    std::vector<Point> ground_velocity_;

    Positions position_, displacement_, velocity_; // m, m, m/s (half a substep behind)
    Positions force_, load_;                       // N: internal and of the ground; of the grains
    Positions rest_force_;                         // N, against the stress at rest; empty: there is none
    double rest_energy_ = 0;                       // J, elastic, at rest
    Positions surface_force_, surface_start_, surface_displacement_;
    double time_ = 0, last_step_ = 0, limit_ = 0;                               // s
    double absorbed_ = 0, surface_work_ = 0, support_work_ = 0, step_work_ = 0; // J
    int since_check_ = 0;
    long substeps_ = 0;
};

} // namespace grainfall::femlink
