// SPDX-License-Identifier: GPL-2.0-or-later
// A face of the wall's surface in space (MR-2629, Eq 23), degree 1 (4 nodes) or 2 (9 nodes):
//
//   y(X) = sum_I N_I(X) x_I,   X = (X1, X2) in [-1, 1]^2
//
// N_I: tensor products of Lagrange polynomials on equidistant points, node I = i + (degree + 1) j, X1 running
// first. The report sums over the element's 8 nodes with X3 = 1; the nodes off the face then drop out. The
// normal dy/dX1 x dy/dX2 points out of the continuum, towards the grains.
#pragma once

#include <array>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace grainfall::femlink {

using Point = Eigen::Vector3d;
using Reference = Eigen::Vector2d;

template <int degree>
constexpr int nodes_per_face = (degree + 1) * (degree + 1);

template <int degree>
using FaceNodes = Eigen::Matrix<double, 3, nodes_per_face<degree>>; // m, one column a node

// Values, first and second derivatives of the polynomials along one axis.
template <int degree>
struct Lagrange {
    static_assert(degree == 1 || degree == 2);
    std::array<double, degree + 1> value, slope, curvature;

    explicit Lagrange(double x) {
        if constexpr (degree == 1) {
            value = {0.5 * (1 - x), 0.5 * (1 + x)};
            slope = {-0.5, 0.5};
            curvature = {0, 0};
        } else {
            value = {0.5 * x * (x - 1), 1 - x * x, 0.5 * x * (x + 1)};
            slope = {x - 0.5, -2 * x, x + 0.5};
            curvature = {1, -2, 1};
        }
    }
};

template <int degree>
Eigen::Matrix<double, nodes_per_face<degree>, 1> shape_values(const Reference& x) {
    const Lagrange<degree> a(x[0]), b(x[1]);
    Eigen::Matrix<double, nodes_per_face<degree>, 1> values;
    for (int j = 0; j <= degree; ++j)
        for (int i = 0; i <= degree; ++i)
            values[i + (degree + 1) * j] = a.value[i] * b.value[j];
    return values;
}

// Position and derivatives of a face at one reference point; y11 means d2y/dX1 dX1.
struct FaceFrame {
    Point y = Point::Zero(), y1 = Point::Zero(), y2 = Point::Zero();
    Point y11 = Point::Zero(), y12 = Point::Zero(), y22 = Point::Zero();
};

// Bilinear: y = m + a X1 + b X2 + w X1 X2. Written out, it takes a third of the time of the sums.
inline FaceFrame bilinear_frame(const FaceNodes<1>& nodes, const Reference& x) {
    const Point d01 = nodes.col(1) - nodes.col(0), d23 = nodes.col(3) - nodes.col(2);
    const Point s01 = nodes.col(1) + nodes.col(0), s23 = nodes.col(3) + nodes.col(2);
    const Point a = 0.25 * (d01 + d23), b = 0.25 * (s23 - s01), w = 0.25 * (d23 - d01);
    FaceFrame frame;
    frame.y1 = a + x[1] * w;
    frame.y2 = b + x[0] * w;
    frame.y = 0.25 * (s01 + s23) + x[0] * frame.y1 + x[1] * b;
    frame.y12 = w;
    return frame;
}

template <int degree>
FaceFrame face_frame(const FaceNodes<degree>& nodes, const Reference& x) {
    if constexpr (degree == 1) {
        return bilinear_frame(nodes, x);
    } else {
        const Lagrange<degree> a(x[0]), b(x[1]);
        FaceFrame frame;
        for (int j = 0; j <= degree; ++j) {
            for (int i = 0; i <= degree; ++i) {
                const auto node = nodes.col(i + (degree + 1) * j);
                frame.y += a.value[i] * b.value[j] * node;
                frame.y1 += a.slope[i] * b.value[j] * node;
                frame.y2 += a.value[i] * b.slope[j] * node;
                frame.y11 += a.curvature[i] * b.value[j] * node;
                frame.y12 += a.slope[i] * b.slope[j] * node;
                frame.y22 += a.value[i] * b.curvature[j] * node;
            }
        }
        return frame;
    }
}

template <int degree>
Point face_point(const FaceNodes<degree>& nodes, const Reference& x) {
    return nodes * shape_values<degree>(x);
}

// Unit normal; where the face is folded to a line there (a collapsed corner), that of its middle.
template <int degree>
Point face_normal(const FaceNodes<degree>& nodes, const FaceFrame& frame) {
    const Point area = frame.y1.cross(frame.y2);
    const double size = area.norm();
    if (size > 1e-10 * (frame.y1.squaredNorm() + frame.y2.squaredNorm()))
        return area / size;
    const FaceFrame middle = face_frame<degree>(nodes, Reference::Zero());
    return middle.y1.cross(middle.y2).normalized();
}

} // namespace grainfall::femlink
