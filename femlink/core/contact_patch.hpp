// SPDX-License-Identifier: GPL-2.0-or-later
// The nodes that carry a contact's force F, acting at the point `at` of the surface (MR-2629, Eq 27):
//
//   f_a = w_a F + |w_a| omega x r_a,   J omega = (at - sum_a w_a x_a) x F,   sum_a w_a = 1,
//   J = sum_a |w_a| (|r_a|^2 I - r_a r_a^T),   sum_a |w_a| r_a = 0
//
// so that sum f_a = F and sum x_a x f_a = at x F to rounding, whatever the weights. (The rotation term is
// zero on a flat surface.) The displacement that the contact sees is the transpose, u = sum_a B_a^T u_a with
// f_a = B_a F: the work is the same on both sides.
//
// Weights: the mean of the shape functions over a disc of radius r around the contact, not their value at the
// point. Eq 27 has the point, and a point load on an elastic half-space has an infinite displacement under
// it: on a mesh it is finite, grows as 1/h, and differs by a factor of three between a node and a face's
// middle. A disc under uniform pressure has the mean displacement 16 (1 - nu^2) F/(3 pi^2 E r) whatever the
// mesh (Johnson 1985, section 3.4): `disc_compliance`.
//
// Where the surface ends inside the disc, a sample and its mirror image in the centre are drawn in together
// until both lie on it: the load stays centred, becomes a line at an edge and a point at a corner.
#pragma once

#include <femlink/core/contact_site.hpp>
#include <femlink/core/surface.hpp>

#include <cmath>
#include <vector>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

namespace grainfall::femlink {

// m/N, what a load spread over a disc leaves of the half-space's own compliance.
inline double disc_compliance(double young, double poisson, double radius) {
    constexpr double pi = 3.14159265358979323846;
    return 16 * (1 - poisson * poisson) / (3 * pi * pi * young * radius);
}

// Cosine of the sharpest edge (37 degrees) over which the surface counts as one and a patch runs.
inline constexpr double smooth_cosine = 0.8;

namespace detail {

inline Eigen::Matrix3d cross_matrix(const Point& v) {
    Eigen::Matrix3d m;
    m << 0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0;
    return m;
}

// Foot of p on the face prolonged over its edges.
template <int degree>
Reference foot_on_prolonged_face(const FaceNodes<degree>& nodes, const Point& p) {
    Reference x = Reference::Zero();
    for (int i = 0; i < 8; ++i) {
        const FaceFrame f = face_frame<degree>(nodes, x);
        const Point d = p - f.y;
        const double a = f.y1.squaredNorm(), b = f.y1.dot(f.y2), c = f.y2.squaredNorm();
        const Reference rhs(d.dot(f.y1), d.dot(f.y2));
        const double determinant = a * c - b * b;
        if (!(determinant > 1e-12 * a * c))
            return x;
        const Reference step((c * rhs[0] - b * rhs[1]) / determinant,
                             (a * rhs[1] - b * rhs[0]) / determinant);
        x = (x + step).cwiseMax(-3.0).cwiseMin(3.0);
        if (step.squaredNorm() < 1e-20)
            break;
    }
    return x;
}

template <int degree>
class PatchBuilder {
public:
    PatchBuilder(const Surface& surface, const Positions& positions, int face, const Reference& at)
        : surface_(surface), positions_(positions), face_(face), at_(at) {}

    ContactPatch spread(double radius) {
        const FaceNodes<degree> nodes = surface_.template face<degree>(face_, positions_);
        const FaceFrame frame = face_frame<degree>(nodes, at_);
        normal_ = face_normal<degree>(nodes, frame);
        Point first = frame.y1 - frame.y1.dot(normal_) * normal_;
        first = first.norm() > 0 ? Point(first.normalized()) : Point(normal_.unitOrthogonal());
        const Point second = normal_.cross(first);
        centre_ = frame.y;
        if (radius > 0) {
            for (int ring = 0; ring < rings; ++ring) {
                for (int k = 0; k < pairs; ++k) {
                    const double angle = pi * (k + 0.5 * (ring % 2)) / pairs;
                    const double reach = radius * std::sqrt(squared_radius[ring]);
                    add_pair(reach * (std::cos(angle) * first + std::sin(angle) * second), ring_weight[ring]);
                }
            }
        } else {
            add(face_, at_, 1);
        }
        return balanced(frame.y);
    }

private:
    static constexpr double pi = 3.14159265358979323846;
    // Uniform over the disc: Gauss and Legendre in the squared radius, equal angles: exact for polynomials up
    // to degree 10.
    static constexpr int rings = 3, pairs = 6;
    static constexpr double squared_radius[rings] = {0.11270166537925831, 0.5, 0.88729833462074169};
    static constexpr double ring_weight[rings] = {5. / 18 / (2 * pairs), 8. / 18 / (2 * pairs),
                                                  5. / 18 / (2 * pairs)};
    struct Place {
        int face = -1;
        Reference x;
    };

    // Walks from face to face; not found (-1) beyond the surface's rim or a sharp edge.
    Place locate(const Point& p) const {
        int face = face_, before = -1;
        for (int steps = 0; steps < 64; ++steps) {
            const FaceNodes<degree> nodes = surface_.template face<degree>(face, positions_);
            const Reference x = foot_on_prolonged_face<degree>(nodes, p);
            const double over0 = std::abs(x[0]) - 1, over1 = std::abs(x[1]) - 1;
            constexpr double rounding = 1e-9;
            if (over0 <= rounding && over1 <= rounding)
                return {face, x.cwiseMax(-1.0).cwiseMin(1.0)};
            const int edge0 = x[0] < 0 ? 0 : 1, edge1 = x[1] < 0 ? 2 : 3;
            int next = crossed(face, over0 >= over1 ? edge0 : edge1, before);
            if (next < 0 && std::min(over0, over1) > rounding)
                next = crossed(face, over0 >= over1 ? edge1 : edge0, before);
            if (next < 0)
                return {};
            before = face;
            face = next;
        }
        return {};
    }

    int crossed(int face, int edge, int before) const {
        const int next = surface_.neighbours[face][edge];
        if (next < 0 || next == before)
            return -1;
        const FaceNodes<degree> nodes = surface_.template face<degree>(next, positions_);
        const Point normal = face_normal<degree>(nodes, face_frame<degree>(nodes, Reference::Zero()));
        return normal.dot(normal_) >= smooth_cosine ? next : -1;
    }

    void add_pair(const Point& offset, double weight) {
        Place here = locate(centre_ + offset), there = locate(centre_ - offset);
        if (here.face < 0 || there.face < 0) {
            double inside = 0, outside = 1;
            here = there = {face_, at_};
            for (int i = 0; i < 16; ++i) {
                const double middle = 0.5 * (inside + outside);
                const Place a = locate(centre_ + middle * offset), b = locate(centre_ - middle * offset);
                const bool both = a.face >= 0 && b.face >= 0;
                (both ? inside : outside) = middle;
                if (both) {
                    here = a;
                    there = b;
                }
            }
        }
        add(here.face, here.x, weight);
        add(there.face, there.x, weight);
    }

    void add(int face, const Reference& x, double weight) {
        const auto values = shape_values<degree>(x);
        for (int k = 0; k < nodes_per_face<degree>; ++k) {
            if (values[k] == 0)
                continue;
            const int node = surface_.faces(k, face);
            const auto found = std::find(patch_.nodes.begin(), patch_.nodes.end(), node);
            if (found == patch_.nodes.end()) {
                patch_.nodes.push_back(node);
                patch_.weights.push_back(weight * values[k]);
            } else {
                patch_.weights[found - patch_.nodes.begin()] += weight * values[k];
            }
        }
    }

    ContactPatch balanced(const Point& at) {
        double total = 0, sizes = 0;
        for (const double weight : patch_.weights) {
            total += weight;
            sizes += std::abs(weight);
        }
        // A quadratic face's weights may be negative at a node; their size keeps J positive.
        Point centre = Point::Zero(), middle = Point::Zero();
        for (std::size_t a = 0; a < patch_.nodes.size(); ++a) {
            patch_.weights[a] /= total;
            centre += patch_.weights[a] * positions_.col(patch_.nodes[a]);
            middle += std::abs(patch_.weights[a]) * total / sizes * positions_.col(patch_.nodes[a]);
        }
        Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
        for (std::size_t a = 0; a < patch_.nodes.size(); ++a) {
            const Point r = positions_.col(patch_.nodes[a]) - middle;
            inertia += std::abs(patch_.weights[a]) *
                       (r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose());
        }
        const Point offset = at - centre;
        if (offset.norm() > 1e-13 * std::sqrt(inertia.trace()))
            add_couples(middle, offset, inertia);
        return std::move(patch_);
    }

    void add_couples(const Point& middle, const Point& offset, const Eigen::Matrix3d& inertia) {
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> modes(inertia);
        Eigen::Vector3d inverse = Eigen::Vector3d::Zero(); // a line of nodes takes no couple about itself
        for (int k = 0; k < 3; ++k)
            if (modes.eigenvalues()[k] > 1e-9 * modes.eigenvalues()[2])
                inverse[k] = 1 / modes.eigenvalues()[k];
        const Eigen::Matrix3d turn = modes.eigenvectors() * inverse.asDiagonal() *
                                     modes.eigenvectors().transpose() * cross_matrix(offset);
        patch_.blocks.resize(patch_.nodes.size());
        for (std::size_t a = 0; a < patch_.nodes.size(); ++a) {
            const Point r = positions_.col(patch_.nodes[a]) - middle;
            patch_.blocks[a] = patch_.weights[a] * Eigen::Matrix3d::Identity() -
                               std::abs(patch_.weights[a]) * cross_matrix(r) * turn;
        }
    }

    const Surface& surface_;
    const Positions& positions_;
    const int face_;
    const Reference at_;
    Point normal_, centre_;
    ContactPatch patch_;
};

} // namespace detail

// Patch around a point of a face, on the surface as it now lies. radius (m) 0: Eq 27's point load.
inline ContactPatch contact_patch(const Surface& surface, const Positions& positions, int face,
                                  const Reference& at, double radius) {
    if (surface.degree == 1)
        return detail::PatchBuilder<1>(surface, positions, face, at).spread(radius);
    return detail::PatchBuilder<2>(surface, positions, face, at).spread(radius);
}

// Square root of the face's area: the length by which patch radii are measured (1 to 1.5 of it).
inline double face_size(const Surface& surface, const Positions& positions, int face) {
    const auto size = [](const FaceFrame& f) { return 2 * std::sqrt(f.y1.cross(f.y2).norm()); };
    if (surface.degree == 1)
        return size(face_frame<1>(surface.face<1>(face, positions), Reference::Zero()));
    return size(face_frame<2>(surface.face<2>(face, positions), Reference::Zero()));
}

} // namespace grainfall::femlink
