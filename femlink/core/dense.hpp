// SPDX-License-Identifier: GPL-2.0-or-later
// Dense matrices by LAPACK and BLAS, which YADE has in its process anyway: inside the extension Eigen may not
// use vector instructions (YADE was laid out without).
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <vector>

extern "C" {
void dgemv_(const char* transposed, const int* rows, const int* columns, const double* factor,
            const double* matrix, const int* stride, const double* x, const int* step_x,
            const double* factor_y, double* y, const int* step_y, std::size_t);
void sgemv_(const char* transposed, const int* rows, const int* columns, const float* factor,
            const float* matrix, const int* stride, const float* x, const int* step_x, const float* factor_y,
            float* y, const int* step_y, std::size_t);
void sgetrf_(const int* rows, const int* columns, float* matrix, const int* stride, int* pivots, int* info);
void sgetrs_(const char* transposed, const int* size, const int* right_sides, const float* matrix,
             const int* stride, const int* pivots, float* right, const int* stride_right, int* info,
             std::size_t);
void dpotrf_(const char* half, const int* size, double* matrix, const int* stride, int* info, std::size_t);
void dpotri_(const char* half, const int* size, double* matrix, const int* stride, int* info, std::size_t);
}

namespace grainfall::femlink::dense {

// y = A x
inline void multiply(const Eigen::MatrixXd& a, const Eigen::VectorXd& x, Eigen::VectorXd& y) {
    const int rows = static_cast<int>(a.rows()), columns = static_cast<int>(a.cols()), one = 1;
    const int stride = std::max(1, rows);
    const double with = 1, without = 0;
    y.resize(rows);
    dgemv_("N", &rows, &columns, &with, a.data(), &stride, x.data(), &one, &without, y.data(), &one, 1);
}

inline void multiply(const Eigen::MatrixXf& a, const Eigen::VectorXf& x, Eigen::VectorXf& y) {
    const int rows = static_cast<int>(a.rows()), columns = static_cast<int>(a.cols()), one = 1;
    const int stride = std::max(1, rows);
    const float with = 1, without = 0;
    y.resize(rows);
    sgemv_("N", &rows, &columns, &with, a.data(), &stride, x.data(), &one, &without, y.data(), &one, 1);
}

// Inverse of a symmetric positive definite matrix; empty where it is not that.
inline Eigen::MatrixXd inverse(Eigen::MatrixXd a) {
    const int size = static_cast<int>(a.rows()), stride = std::max(1, size);
    int info = 0;
    dpotrf_("L", &size, a.data(), &stride, &info, 1);
    if (info == 0)
        dpotri_("L", &size, a.data(), &stride, &info, 1);
    if (info != 0)
        return {};
    a.triangularView<Eigen::StrictlyUpper>() = a.transpose();
    return a;
}

// LU with row pivots in single precision: half the memory to go through, enough for steps that are checked.
class Factor {
public:
    void compute(const Eigen::MatrixXd& a) {
        matrix_ = a.cast<float>();
        const int size = static_cast<int>(matrix_.rows()), stride = std::max(1, size);
        int info = 0;
        pivots_.resize(static_cast<std::size_t>(size));
        sgetrf_(&size, &size, matrix_.data(), &stride, pivots_.data(), &info);
    }
    void solve_in_place(Eigen::VectorXd& right) {
        const int size = static_cast<int>(matrix_.rows()), stride = std::max(1, size), one = 1;
        int info = 0;
        // Forces may lie beyond what single precision can hold.
        const double scale = right.lpNorm<Eigen::Infinity>();
        if (!(scale > 0))
            return;
        right_ = (right / scale).cast<float>();
        sgetrs_("N", &size, &one, matrix_.data(), &stride, pivots_.data(), right_.data(), &stride, &info, 1);
        right = scale * right_.cast<double>();
    }

private:
    Eigen::MatrixXf matrix_;
    Eigen::VectorXf right_;
    std::vector<int> pivots_;
};

} // namespace grainfall::femlink::dense
