// SPDX-License-Identifier: GPL-2.0-or-later
// The trilinear field of a cell with eight nodes, in modes of its reference cube [-1, 1]^3:
//
//   v = m0 + mx X + my Y + mz Z + mxy X Y + mxz X Z + myz Y Z + mxyz X Y Z
//
// The gradients at all eight Gauss points take a third of the work of sums over shape functions that way. The
// transpose sends stresses at the points to forces on the nodes.
#pragma once

#include <femlink/explicit/small_tensors.hpp>

#include <array>

namespace grainfall::femlink {

struct Modes {
    enum { x, y, z, xy, xz, yz, xyz, count };
    double m[count][3];
};

// Of the values (3 numbers a node) at the nodes of a cell.
inline void gather_modes(const double* values, const std::array<int, 8>& cell, Modes& out) {
    for (int d = 0; d < 3; ++d) {
        double a[8];
        for (int k = 0; k < 8; ++k)
            a[k] = 0.125 * values[3 * cell[k] + d];
        const double s0 = a[1] + a[0], s1 = a[3] + a[2], s2 = a[5] + a[4], s3 = a[7] + a[6];
        const double d0 = a[1] - a[0], d1 = a[3] - a[2], d2 = a[5] - a[4], d3 = a[7] - a[6];
        out.m[Modes::x][d] = (d0 + d1) + (d2 + d3);
        out.m[Modes::y][d] = (s1 - s0) + (s3 - s2);
        out.m[Modes::z][d] = (s2 + s3) - (s0 + s1);
        out.m[Modes::xy][d] = (d1 - d0) + (d3 - d2);
        out.m[Modes::xz][d] = (d2 + d3) - (d0 + d1);
        out.m[Modes::yz][d] = (s3 - s2) - (s1 - s0);
        out.m[Modes::xyz][d] = (d3 - d2) - (d1 - d0);
    }
}

// Subtracts sum_modes m * (sign of the mode at the node) / 8 from the values at the nodes.
inline void subtract_scattered(const Modes& m, const std::array<int, 8>& cell, double* values) {
    for (int d = 0; d < 3; ++d) {
        const double low = -m.m[Modes::z][d], high = m.m[Modes::z][d];
        // At Z = -1 and Z = 1: coefficients of 1, X, Y, XY.
        for (int side = 0; side < 2; ++side) {
            const double sign = side ? 1 : -1;
            const double one = side ? high : low, x = m.m[Modes::x][d] + sign * m.m[Modes::xz][d],
                         y = m.m[Modes::y][d] + sign * m.m[Modes::yz][d],
                         xy = m.m[Modes::xy][d] + sign * m.m[Modes::xyz][d];
            const int* node = cell.data() + 4 * side;
            values[3 * node[0] + d] -= 0.125 * ((one - x) - (y - xy));
            values[3 * node[1] + d] -= 0.125 * ((one + x) - (y + xy));
            values[3 * node[2] + d] -= 0.125 * ((one - x) + (y - xy));
            values[3 * node[3] + d] -= 0.125 * ((one + x) + (y + xy));
        }
    }
}

// Gauss point q of eight: its coordinates are -g or g by the bits of q, of weight 1.
inline constexpr double gauss_coordinate = 0.5773502691896258; // 1/sqrt 3

inline std::array<double, 3> gauss_point(int q) {
    return {q & 1 ? gauss_coordinate : -gauss_coordinate, q & 2 ? gauss_coordinate : -gauss_coordinate,
            q & 4 ? gauss_coordinate : -gauss_coordinate};
}

// dx/d(X, Y, Z)
inline Matrix3 gradient_at(const Modes& m, double x, double y, double z) {
    Matrix3 out;
    for (int d = 0; d < 3; ++d) {
        out.c[0][d] =
            m.m[Modes::x][d] + y * m.m[Modes::xy][d] + z * (m.m[Modes::xz][d] + y * m.m[Modes::xyz][d]);
        out.c[1][d] =
            m.m[Modes::y][d] + x * m.m[Modes::xy][d] + z * (m.m[Modes::yz][d] + x * m.m[Modes::xyz][d]);
        out.c[2][d] =
            m.m[Modes::z][d] + x * m.m[Modes::xz][d] + y * (m.m[Modes::yz][d] + x * m.m[Modes::xyz][d]);
    }
    return out;
}

inline Matrix3 gradient_at(const Modes& m, const std::array<double, 3>& at) {
    return gradient_at(m, at[0], at[1], at[2]);
}

// Transpose of gradient_at.
inline void add_flux_at(const Matrix3& t, const std::array<double, 3>& at, Modes& m) {
    const double x = at[0], y = at[1], z = at[2];
    for (int d = 0; d < 3; ++d) {
        const double a = t.c[0][d], b = t.c[1][d], c = t.c[2][d];
        m.m[Modes::x][d] += a;
        m.m[Modes::y][d] += b;
        m.m[Modes::z][d] += c;
        m.m[Modes::xy][d] += y * a + x * b;
        m.m[Modes::xz][d] += z * a + x * c;
        m.m[Modes::yz][d] += z * b + y * c;
        m.m[Modes::xyz][d] += y * z * a + x * z * b + x * y * c;
    }
}

} // namespace grainfall::femlink
