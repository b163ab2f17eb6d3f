// SPDX-License-Identifier: GPL-2.0-or-later
// Cells at rest: geometry, lumped mass, and the frequency that limits the step.
//
// The largest frequency of a mesh is not above the largest of its cells, each with its own lumped mass
// (Irons' bound). That of a cell at rest is an eigenvalue of its elastic stiffness; when the cell is
// deformed, lengths shrink by at most its least stretch and moduli grow by what the material's law says.
#pragma once

#include <femlink/core/hex_mesh.hpp>
#include <femlink/explicit/cell_block.hpp>
#include <femlink/explicit/stress_at_rest.hpp>
#include <femlink/explicit/symmetric_functions.hpp>

#include <map>
#include <numeric>

#include <Eigen/Dense>

namespace grainfall::femlink {

using CellStiffness = Eigen::Matrix<double, 24, 24>;
using CellGradients = Eigen::Matrix<double, 3, 8>; // of the shape functions, 1/m, one column a node

struct RestCells {
    std::vector<std::array<int, 8>> nodes;
    std::vector<int> in_mesh;   // index of the cell in the mesh
    std::vector<double> volume; // m^3
    std::vector<std::array<double, 8>> nodal_volume;
    std::vector<Symmetric> centre_metric; // (J^T J)^-1 of dX/d(reference) at the middle, 1/m^2
    std::vector<double> frequency2;       // (largest angular frequency)^2, 1/s^2
    double density = 0;

    int count() const { return static_cast<int>(nodes.size()); }
};

inline Eigen::Matrix3d as_eigen(const Matrix3& m) {
    return Eigen::Map<const Eigen::Matrix3d>(&m.c[0][0]);
}

inline Eigen::Matrix3d as_eigen(const Symmetric& a) {
    Eigen::Matrix3d out;
    out << a.xx, a.xy, a.xz, a.xy, a.yy, a.yz, a.xz, a.yz, a.zz;
    return out;
}

inline Symmetric symmetric_part(const Eigen::Matrix3d& m) {
    return {m(0, 0),
            m(1, 1),
            m(2, 2),
            0.5 * (m(1, 2) + m(2, 1)),
            0.5 * (m(0, 2) + m(2, 0)),
            0.5 * (m(0, 1) + m(1, 0))};
}

// Derivatives of the eight shape functions with respect to the reference coordinates.
inline CellGradients reference_gradients(const std::array<double, 3>& at) {
    CellGradients out;
    for (int k = 0; k < 8; ++k) {
        const double x = k & 1 ? 1 : -1, y = k & 2 ? 1 : -1, z = k & 4 ? 1 : -1;
        out.col(k) << 0.125 * x * (1 + y * at[1]) * (1 + z * at[2]),
            0.125 * y * (1 + x * at[0]) * (1 + z * at[2]), 0.125 * z * (1 + x * at[0]) * (1 + y * at[1]);
    }
    return out;
}

struct GaussGeometry {
    CellGradients gradients; // with respect to the position at rest
    Eigen::Matrix3d jacobian;
    double volume;
};

inline std::array<GaussGeometry, 8> gauss_geometry(const CellGradients& corners) {
    std::array<GaussGeometry, 8> out;
    for (int q = 0; q < 8; ++q) {
        const CellGradients reference = reference_gradients(gauss_point(q));
        out[q].jacobian = corners * reference.transpose();
        out[q].volume = out[q].jacobian.determinant();
        out[q].gradients = out[q].jacobian.inverse().transpose() * reference;
    }
    return out;
}

// Shape functions.
inline Eigen::Matrix<double, 8, 1> shape_values(const std::array<double, 3>& at) {
    Eigen::Matrix<double, 8, 1> out;
    for (int k = 0; k < 8; ++k)
        out[k] = 0.125 * (1 + (k & 1 ? at[0] : -at[0])) * (1 + (k & 2 ? at[1] : -at[1])) *
                 (1 + (k & 4 ? at[2] : -at[2]));
    return out;
}

inline CellGradients corners_of(const HexMesh& mesh, int cell) {
    CellGradients out;
    for (int k = 0; k < 8; ++k)
        out.col(k) = mesh.vertices[mesh.cells[cell][k]];
    return out;
}

// Row sums of the consistent mass over the density, m^3.
inline std::array<double, 8> nodal_volumes(const CellGradients& corners) {
    std::array<double, 8> out{};
    const auto geometry = gauss_geometry(corners);
    for (int q = 0; q < 8; ++q) {
        const auto shape = shape_values(gauss_point(q));
        for (int k = 0; k < 8; ++k)
            out[k] += shape[k] * geometry[q].volume;
    }
    return out;
}

// Adds volume * (2 mu dev e + K tr e) at one point; the volumetric part only if `bulk` is given.
inline void add_stiffness(const CellGradients& g, double volume, double mu, double bulk, CellStiffness& k) {
    const Eigen::Map<const Eigen::Matrix<double, 24, 1>> divergence(g.data());
    for (int b = 0; b < 8; ++b)
        for (int a = 0; a < 8; ++a)
            k.block<3, 3>(3 * a, 3 * b) +=
                mu * volume *
                (g.col(b) * g.col(a).transpose() + g.col(a).dot(g.col(b)) * Eigen::Matrix3d::Identity());
    k += volume * (bulk - 2 * mu / 3) * divergence * divergence.transpose();
}

// b of a law at a point of the cells where they have not been deformed.
template <class Law>
Symmetric elastic_b_at_rest(const Law& law, const StressAtRest* at_rest, const Point& at) {
    if constexpr (Law::knows_stress_at_rest)
        if (at_rest)
            return law.b_at_rest(*at_rest, at);
    return Symmetric::identity();
}

// Largest eigenvalue of M^-1 K.
inline double largest_frequency2(const CellStiffness& stiffness, const CellGradients& corners,
                                 double density) {
    const auto volumes = nodal_volumes(corners);
    Eigen::Matrix<double, 24, 1> scale;
    for (int i = 0; i < 24; ++i)
        scale[i] = 1 / std::sqrt(density * volumes[i / 3]);
    const Eigen::MatrixXd scaled = scale.asDiagonal() * stiffness * scale.asDiagonal();
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled, Eigen::EigenvaluesOnly).eigenvalues()[23];
}

// `stiffness(corners)`: elastic stiffness of a cell. Cells of the same shape are computed once.
template <class Stiffness>
RestCells rest_cells(const HexMesh& mesh, const std::vector<int>& cells, double density,
                     const Stiffness& stiffness) {
    RestCells out;
    out.density = density;
    std::map<std::array<long, 21>, double> known;
    for (const int c : cells) {
        const CellGradients corners = corners_of(mesh, c);
        out.nodes.push_back(mesh.cells[c]);
        out.in_mesh.push_back(c);
        const auto volumes = nodal_volumes(corners);
        out.nodal_volume.push_back(volumes);
        out.volume.push_back(std::accumulate(volumes.begin(), volumes.end(), 0.0));
        const Eigen::Matrix3d inverse = (corners * reference_gradients({0, 0, 0}).transpose()).inverse();
        out.centre_metric.push_back(symmetric_part(inverse * inverse.transpose()));
        std::array<long, 21> shape;
        const double unit = 1e-9 * std::cbrt(out.volume.back());
        for (int i = 0; i < 21; ++i)
            shape[i] = std::lround((corners(i % 3, 1 + i / 3) - corners(i % 3, 0)) / unit);
        const auto [found, is_new] = known.emplace(shape, 0.0);
        if (is_new)
            found->second = largest_frequency2(stiffness(corners), corners, density);
        out.frequency2.push_back(found->second);
    }
    return out;
}

inline void add_lumped_mass(const RestCells& rest, std::vector<double>& mass) {
    for (int c = 0; c < rest.count(); ++c)
        for (int k = 0; k < 8; ++k)
            mass[rest.nodes[c][k]] += rest.density * rest.nodal_volume[c][k];
}

template <class Law>
double largest_frequency(const RestCells& rest, const Law& law, const double* positions) {
    double largest = 0;
    for (int c = 0; c < rest.count(); ++c) {
        Modes modes;
        gather_modes(positions, rest.nodes[c], modes);
        const Symmetric b = push(gradient_at(modes, 0, 0, 0), rest.centre_metric[c]);
        const auto [least2, greatest2] = extreme_eigenvalues(b);
        // The floor keeps a squashed cell from stopping the run here: it is reported where it turns over.
        const double least = std::sqrt(std::max(least2, 1e-4)), greatest = std::sqrt(greatest2);
        const double log_volume = 0.5 * std::log(std::max(b.determinant(), 1e-12));
        largest = std::max(largest, rest.frequency2[c] * law.wave_factor(least, greatest, log_volume));
    }
    return std::sqrt(largest);
}

} // namespace grainfall::femlink
