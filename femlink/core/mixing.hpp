// SPDX-License-Identifier: GPL-2.0-or-later
// Anderson's mixing (Anderson 1965; Walker & Ni 2011): an iteration x += f(x) in fewer steps. How f changed
// with x in the last steps is taken for how it goes on to change, in the sense of least squares.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <algorithm>

namespace grainfall::femlink {

class Mixing {
public:
    // What has been seen does not hold from here on.
    void forget() {
        seen_ = 0;
        has_before_ = false;
    }

    // `step`: f at x; becomes the step to take from there.
    void improve(const Eigen::VectorXd& x, Eigen::VectorXd& step) {
        if (turns_.rows() != x.size()) {
            forget();
            turns_.resize(x.size(), depth);
            detours_.resize(x.size(), depth);
        }
        if (has_before_)
            note(x - x_before_, step - step_before_);
        x_before_ = x;
        step_before_ = step;
        has_before_ = true;
        const int count = std::min(seen_, depth);
        if (count == 0)
            return;
        const Eigen::VectorXd shares =
            products_.topLeftCorner(count, count).ldlt().solve(turns_.leftCols(count).transpose() * step);
        if (shares.allFinite())
            step -= detours_.leftCols(count) * shares;
        else
            forget();
    }

private:
    static constexpr int depth = 8; // more save nothing in beds of 500 contacts

    void note(const Eigen::VectorXd& move, const Eigen::VectorXd& turn) {
        const int place = seen_++ % depth, count = std::min(seen_, depth);
        turns_.col(place) = turn;
        detours_.col(place) = move + turn;
        const Eigen::VectorXd products = turns_.leftCols(count).transpose() * turn;
        products_.col(place).head(count) = products;
        products_.row(place).head(count) = products.transpose();
        products_(place, place) *= 1 + 1e-10; // directions that nearly repeat each other
    }

    int seen_ = 0;
    bool has_before_ = false;
    Eigen::VectorXd x_before_, step_before_;
    Eigen::MatrixXd turns_, detours_; // changes of f from step to step; the same and the steps themselves
    Eigen::Matrix<double, depth, depth> products_; // of the turns
};

} // namespace grainfall::femlink
