// SPDX-License-Identifier: GPL-2.0-or-later
// Three by three matrices written out: the element loops spend their time here, and their speed must not hang
// on how Eigen is compiled.
#pragma once

#include <cmath>

namespace grainfall::femlink {

struct Symmetric {
    double xx = 0, yy = 0, zz = 0, yz = 0, xz = 0, xy = 0;

    static Symmetric identity(double scale = 1) { return {scale, scale, scale, 0, 0, 0}; }
    double trace() const { return xx + yy + zz; }
    double determinant() const {
        return xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz);
    }
    Symmetric deviator() const {
        const double mean = trace() / 3;
        return {xx - mean, yy - mean, zz - mean, yz, xz, xy};
    }
};

inline Symmetric operator+(const Symmetric& a, const Symmetric& b) {
    return {a.xx + b.xx, a.yy + b.yy, a.zz + b.zz, a.yz + b.yz, a.xz + b.xz, a.xy + b.xy};
}
inline Symmetric operator-(const Symmetric& a, const Symmetric& b) {
    return {a.xx - b.xx, a.yy - b.yy, a.zz - b.zz, a.yz - b.yz, a.xz - b.xz, a.xy - b.xy};
}
inline Symmetric operator*(double s, const Symmetric& a) {
    return {s * a.xx, s * a.yy, s * a.zz, s * a.yz, s * a.xz, s * a.xy};
}
inline Symmetric plus_identity(const Symmetric& a, double scale) {
    return {a.xx + scale, a.yy + scale, a.zz + scale, a.yz, a.xz, a.xy};
}

// a : b
inline double contraction(const Symmetric& a, const Symmetric& b) {
    return a.xx * b.xx + a.yy * b.yy + a.zz * b.zz + 2 * (a.yz * b.yz + a.xz * b.xz + a.xy * b.xy);
}

// a b of matrices with the same principal axes: symmetric too.
inline Symmetric coaxial_product(const Symmetric& a, const Symmetric& b) {
    return {a.xx * b.xx + a.xy * b.xy + a.xz * b.xz, a.xy * b.xy + a.yy * b.yy + a.yz * b.yz,
            a.xz * b.xz + a.yz * b.yz + a.zz * b.zz, a.xy * b.xz + a.yy * b.yz + a.yz * b.zz,
            a.xx * b.xz + a.xy * b.yz + a.xz * b.zz, a.xx * b.xy + a.xy * b.yy + a.xz * b.yz};
}

inline Symmetric inverse(const Symmetric& a) {
    const double factor = 1 / a.determinant();
    return factor * Symmetric{a.yy * a.zz - a.yz * a.yz, a.xx * a.zz - a.xz * a.xz,
                              a.xx * a.yy - a.xy * a.xy, a.xy * a.xz - a.xx * a.yz,
                              a.xy * a.yz - a.xz * a.yy, a.xz * a.yz - a.xy * a.zz};
}

struct Matrix3 {
    double c[3][3]; // c[j][i]: row i of column j
};

// cof(M) = det(M) M^-T
inline Matrix3 cofactors(const Matrix3& m) {
    Matrix3 out;
    for (int j = 0; j < 3; ++j) {
        const double* a = m.c[(j + 1) % 3];
        const double* b = m.c[(j + 2) % 3];
        out.c[j][0] = a[1] * b[2] - a[2] * b[1];
        out.c[j][1] = a[2] * b[0] - a[0] * b[2];
        out.c[j][2] = a[0] * b[1] - a[1] * b[0];
    }
    return out;
}

inline double determinant(const Matrix3& m, const Matrix3& cofactor) {
    return m.c[0][0] * cofactor.c[0][0] + m.c[0][1] * cofactor.c[0][1] + m.c[0][2] * cofactor.c[0][2];
}

// M A M^T
inline Symmetric push(const Matrix3& m, const Symmetric& a) {
    double p[3][3]; // columns of M A
    for (int i = 0; i < 3; ++i) {
        const double x = m.c[0][i], y = m.c[1][i], z = m.c[2][i];
        p[0][i] = x * a.xx + y * a.xy + z * a.xz;
        p[1][i] = x * a.xy + y * a.yy + z * a.yz;
        p[2][i] = x * a.xz + y * a.yz + z * a.zz;
    }
    const auto entry = [&](int i, int j) {
        return p[0][i] * m.c[0][j] + p[1][i] * m.c[1][j] + p[2][i] * m.c[2][j];
    };
    return {entry(0, 0), entry(1, 1), entry(2, 2), entry(1, 2), entry(0, 2), entry(0, 1)};
}

// M^-1 B M^-T, from the cofactors of M.
inline Symmetric pull(const Matrix3& cofactor, double determinant_of_m, const Symmetric& b) {
    Matrix3 transposed;
    for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i)
            transposed.c[j][i] = cofactor.c[i][j];
    return (1 / (determinant_of_m * determinant_of_m)) * push(transposed, b);
}

// S M
inline Matrix3 product(const Symmetric& s, const Matrix3& m) {
    Matrix3 out;
    for (int j = 0; j < 3; ++j) {
        const double x = m.c[j][0], y = m.c[j][1], z = m.c[j][2];
        out.c[j][0] = s.xx * x + s.xy * y + s.xz * z;
        out.c[j][1] = s.xy * x + s.yy * y + s.yz * z;
        out.c[j][2] = s.xz * x + s.yz * y + s.zz * z;
    }
    return out;
}

} // namespace grainfall::femlink
