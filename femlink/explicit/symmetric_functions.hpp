// SPDX-License-Identifier: GPL-2.0-or-later
// Logarithm and exponential of symmetric 3 x 3 matrices, without eigenvectors where the argument is near the
// identity: elastic strains of soil and metal are, and there an eigenvalue solver takes several times longer.
#pragma once

#include <femlink/explicit/small_tensors.hpp>

#include <algorithm>
#include <array>

#include <Eigen/Eigenvalues>

namespace grainfall::femlink {

// f(a) by principal axes.
template <class Function>
Symmetric by_principal_axes(const Symmetric& a, const Function& function) {
    Eigen::Matrix3d matrix;
    matrix << a.xx, a.xy, a.xz, a.xy, a.yy, a.yz, a.xz, a.yz, a.zz;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(matrix);
    const Eigen::Matrix3d& axes = solver.eigenvectors();
    const Eigen::Matrix3d out =
        axes * solver.eigenvalues().unaryExpr(function).asDiagonal() * axes.transpose();
    return {out(0, 0), out(1, 1), out(2, 2), out(1, 2), out(0, 2), out(0, 1)};
}

// (1/2) ln b of a positive definite b:
//
//   (1/2) ln b = artanh Z = Z + Z^3/3 + Z^5/5 + ...,   Z = (b - I) (b + I)^-1
//
// cut where a term falls below rounding; |Z| > 0.3 goes by principal axes.
inline Symmetric half_logarithm(const Symmetric& b) {
    const Symmetric z = coaxial_product(plus_identity(b, -1), inverse(plus_identity(b, 1)));
    const double size2 = contraction(z, z);
    if (!(size2 < 0.09))
        return by_principal_axes(b, [](double value) { return 0.5 * std::log(value); });
    int last = 3; // of the odd powers
    for (double term = size2; term > 1e-17; term *= size2)
        last += 2;
    const Symmetric square = coaxial_product(z, z);
    Symmetric sum = Symmetric::identity(1.0 / last);
    for (int power = last - 2; power >= 1; power -= 2)
        sum = plus_identity(coaxial_product(square, sum), 1.0 / power);
    return coaxial_product(z, sum);
}

// exp a by its series; made for |a| below 1, where at most 20 terms count.
inline Symmetric exponential(const Symmetric& a) {
    const double size = std::sqrt(contraction(a, a));
    if (!(size < 1))
        return by_principal_axes(a, [](double value) { return std::exp(value); });
    int last = 1;
    for (double term = size; term > 1e-17; term *= size / last)
        ++last;
    Symmetric sum = Symmetric::identity();
    for (int k = last; k >= 1; --k)
        sum = plus_identity((1.0 / k) * coaxial_product(a, sum), 1);
    return sum;
}

// x^(2/3); two steps of Halley's iteration where x is near 1, as the ratio of volumes within a cell is.
inline double two_thirds_power(double x) {
    double root = 1 + (x - 1) / 3;
    if (!(std::abs(x - 1) < 0.1)) {
        root = std::cbrt(x);
    } else {
        for (int step = 0; step < 2; ++step) {
            const double cube = root * root * root;
            root *= (cube + 2 * x) / (2 * cube + x);
        }
    }
    return root * root;
}

// Smallest and largest eigenvalue in closed form (Smith 1961), to about 1e-8 of the largest.
inline std::array<double, 2> extreme_eigenvalues(const Symmetric& a) {
    const double mean = a.trace() / 3;
    const Symmetric d = a.deviator();
    const double size = std::sqrt(contraction(d, d) / 6);
    if (!(size > 1e-14 * std::abs(mean)))
        return {mean, mean};
    const double cosine = d.determinant() / (2 * size * size * size);
    const double angle = std::acos(std::min(1.0, std::max(-1.0, cosine))) / 3;
    constexpr double third_of_turn = 2.0943951023931953;
    return {mean + 2 * size * std::cos(angle + third_of_turn), mean + 2 * size * std::cos(angle)};
}

} // namespace grainfall::femlink
