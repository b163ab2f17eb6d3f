// SPDX-License-Identifier: GPL-2.0-or-later
// Stiffness of all contacts of one body against its own translation v and rotation w, partners held.
//
// A contact at x, r = x - centre, sees the displacement u = v + w x r and answers with D u,
// D = k_t I + (k_n - k_t) n n^T. Hence, with [r] the matrix of r x and p = n x r,
//
//   K_vv = D,   K_vw = -(k_t [r] + (k_n - k_t) n p^T),   K_ww = k_t (r^2 I - r r^T) + (k_n - k_t) p p^T
//
// summed over the contacts. r is the true lever to the contact, not a radius: on flat or pointed solids the
// two have little to do with each other, and there p does not vanish. N/m, N, N m. The eigenvalues of
// M^-1 K are the squared frequencies in 1/s^2 of the body between its held neighbours.
#pragma once

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace grainfall::time_step {

using Vector = Eigen::Vector3d;
using Matrix = Eigen::Matrix3d;

// Roots of inverse mass and inertia in global axes; zero along directions in which the body is held.
struct Mobility {
    Vector translation = Vector::Zero(); // kg^-1/2
    Matrix rotation = Matrix::Zero();    // kg^-1/2 m^-1, symmetric

    // 1/kg, of the centre of mass along a unit vector.
    double inverse_mass(const Vector& along) const { return translation.cwiseProduct(along).squaredNorm(); }
};

struct Stiffness {
    double normal = 0; // N/m
    double shear = 0;  // N/m
};

class BodyStiffness {
public:
    void add(const Stiffness& k, const Vector& normal, const Vector& lever) {
        const double excess = k.normal - k.shear;
        const Vector p = normal.cross(lever);
        const Vector r = k.shear * lever;
        vv_.noalias() += (excess * normal) * normal.transpose();
        vv_.diagonal().array() += k.shear;
        vw_.noalias() -= (excess * normal) * p.transpose();
        vw_(0, 1) += r.z();
        vw_(0, 2) -= r.y();
        vw_(1, 0) -= r.z();
        vw_(1, 2) += r.x();
        vw_(2, 0) += r.y();
        vw_(2, 1) -= r.x();
        ww_.noalias() += (excess * p) * p.transpose() - r * lever.transpose();
        ww_.diagonal().array() += r.dot(lever);
    }

    bool touched() const { return vv_(0, 0) + vv_(1, 1) + vv_(2, 2) > 0; }

    // 1/s^2, never below the largest eigenvalue, at a fraction of its price: for symmetric S of order n
    // lambda <= t/n + sqrt((n-1)/n (|S|^2 - t^2/n)), t the trace (Wolkowicz & Styan 1980).
    double upper_bound(const Mobility& body) const {
        const Matrix t = translation(body), c = coupling(body), r = rotation(body);
        const double trace = t.trace() + r.trace();
        const double squares = t.squaredNorm() + 2 * c.squaredNorm() + r.squaredNorm();
        const double spread = std::max(0.0, squares - trace * trace / 6);
        return trace / 6 + std::sqrt(5.0 / 6 * spread);
    }

    // 1/s^2.
    double largest_eigenvalue(const Mobility& body) const {
        Eigen::Matrix<double, 6, 6> s;
        s.topLeftCorner<3, 3>() = translation(body);
        s.topRightCorner<3, 3>() = coupling(body);
        s.bottomLeftCorner<3, 3>() = coupling(body).transpose();
        s.bottomRightCorner<3, 3>() = rotation(body);
        return largest(s);
    }

    // Is the stiffest rotation faster than the stiffest translation?
    bool rotation_leads(const Mobility& body) const {
        return largest(rotation(body)) > largest(translation(body));
    }

private:
    Matrix vv_ = Matrix::Zero(), vw_ = Matrix::Zero(), ww_ = Matrix::Zero();

    Matrix translation(const Mobility& body) const {
        return body.translation.asDiagonal() * vv_ * body.translation.asDiagonal();
    }
    Matrix coupling(const Mobility& body) const {
        return body.translation.asDiagonal() * vw_ * body.rotation;
    }
    Matrix rotation(const Mobility& body) const { return body.rotation * ww_ * body.rotation; }

    template <class Symmetric>
    static double largest(const Symmetric& matrix) {
        return Eigen::SelfAdjointEigenSolver<Symmetric>(matrix, Eigen::EigenvaluesOnly)
            .eigenvalues()
            .maxCoeff();
    }
};

} // namespace grainfall::time_step
