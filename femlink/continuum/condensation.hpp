// SPDX-License-Identifier: GPL-2.0-or-later
// Factor of the stiffness with the surface's unknowns last, and what follows from it (CHOLMOD, LAPACK).
//
//   K = L L^T, unknowns ordered (interior, surface):   the trailing block of L is the Cholesky factor of the
//   stiffness condensed to the surface, S = K_ss - K_si K_ii^-1 K_is, so C = S^-1 needs no column by column
//   solves.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace grainfall::femlink {

// Fill-reducing order (nested dissection, METIS) of the nodes of a graph whose last `last` nodes keep their
// place.
std::vector<int> elimination_order(const std::vector<std::vector<int>>& graph, int last);

class DirectFactor {
public:
    // `lower`: lower triangle of the stiffness, already in the order of elimination. Analyses only.
    explicit DirectFactor(const Eigen::SparseMatrix<double>& lower);
    ~DirectFactor();
    DirectFactor(const DirectFactor&) = delete;
    DirectFactor& operator=(const DirectFactor&) = delete;

    std::size_t bytes() const; // that the factor will take, known before it is computed
    void factorize(); // throws std::runtime_error if the matrix is not positive definite or memory is short
    bool is_factorized() const;
    Eigen::VectorXd solve(const Eigen::VectorXd& load) const;
    // Inverse of the condensed stiffness of the last `count` unknowns.
    Eigen::MatrixXd condensed_compliance(int count) const;

private:
    struct Parts; // CHOLMOD's
    std::unique_ptr<Parts> parts_;
};

} // namespace grainfall::femlink
