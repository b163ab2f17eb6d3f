// SPDX-License-Identifier: GPL-2.0-or-later
// Point of a face closest to a given point P (MR-2629, Eq 22, 24, 25):
//
//   min z(X) = 1/2 |y(X) - P|^2   over X in [-1, 1]^2,     X <- X - (d2z/dX2)^-1 dz/dX
//
// The report iterates without the bounds and snaps afterwards, which may land on the wrong edge of a skewed
// face and diverges where the matrix is not positive definite. Here the bounds belong to the iteration: a
// coordinate at its bound with the slope pointing out of the face is held there (an edge; both held: a
// corner), the others take Newton's step, or Gauss and Newton's (J^T J, always positive definite) where the
// full matrix is not, and a step is shortened until z falls. So z falls monotonically and the end is a
// minimum. A face that is curved as strongly as P is far may have several: then all four corners and the
// middle are tried as starts, and the nearest minimum is taken.
//
// Signed distance: negative behind the surface, where the unsigned distance would hide the penetration.
#pragma once

#include <femlink/core/face_shape.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace grainfall::femlink {

enum class Feature { interior, edge, corner };

struct ClosestPoint {
    Reference reference; // in [-1, 1]^2
    Point position;      // m, on the face
    Point normal;        // unit, of the face at that point, out of the continuum
    double distance;     // m, negative behind the face
    Feature feature;
    int iterations;  // of all starts together
    bool converged;  // false: the best point found so far
    double residual; // m, |dz/dX| of the free coordinates over the face's size

    // Unit vector along which a grain centred at `from` is pushed: the face's normal, or at an edge or corner
    // the line to the centre.
    Point push_direction(const Point& from) const {
        const Point line = from - position;
        const double length = line.norm();
        if (feature == Feature::interior || length < 1e-12 * (1 + position.norm()))
            return normal;
        return (distance >= 0 ? 1 : -1) * line / length;
    }
};

namespace detail {

struct Step {
    Reference direction = Reference::Zero();
    bool held[2] = {false, false};
    double residual = 0;
    bool is_minimum = true; // second derivatives of the free coordinates positive definite
};

inline Step newton_step(const FaceFrame& f, const Point& p, const Reference& x) {
    const Point d = f.y - p;
    const Reference gradient(d.dot(f.y1), d.dot(f.y2));
    const double a = f.y1.squaredNorm(), b = f.y1.dot(f.y2), c = f.y2.squaredNorm();
    const double haa = a + d.dot(f.y11), hab = b + d.dot(f.y12), hcc = c + d.dot(f.y22);
    const double size = std::sqrt(std::max(a, c));
    Step step;
    for (int k = 0; k < 2; ++k)
        step.held[k] = (x[k] >= 1 && gradient[k] <= 0) || (x[k] <= -1 && gradient[k] >= 0);
    if (step.held[0] && step.held[1])
        return step;
    if (step.held[0] || step.held[1]) {
        const int k = step.held[0] ? 1 : 0;
        const double full = k ? hcc : haa, gauss = k ? c : a;
        step.is_minimum = full > 0;
        const double slope = full > 1e-8 * gauss ? full : std::max(gauss, std::numeric_limits<double>::min());
        step.direction[k] = -gradient[k] / slope;
        step.residual = std::abs(gradient[k]) / size;
        return step;
    }
    const double determinant = haa * hcc - hab * hab, gauss_determinant = a * c - b * b;
    step.is_minimum = haa + hcc > 0 && determinant > 0;
    step.residual = gradient.norm() / size;
    if (step.is_minimum && determinant > 1e-8 * gauss_determinant)
        step.direction =
            -Reference(hcc * gradient[0] - hab * gradient[1], haa * gradient[1] - hab * gradient[0]) /
            determinant;
    else if (gauss_determinant > 1e-12 * a * c)
        step.direction = -Reference(c * gradient[0] - b * gradient[1], a * gradient[1] - b * gradient[0]) /
                         gauss_determinant;
    else // a face folded to a line
        step.direction = -gradient / std::max(a + c, std::numeric_limits<double>::min());
    return step;
}

inline Reference clamped(const Reference& x) {
    return x.cwiseMax(-1.0).cwiseMin(1.0);
}

struct Minimum {
    Reference x;
    double squared = std::numeric_limits<double>::infinity();
    double residual = 0;
    bool converged = false, is_minimum = false;
    Step last;
    FaceFrame frame;
};

// Descent from one start. `iterations` counts on.
template <int degree>
Minimum descend(const FaceNodes<degree>& nodes, const Point& p, Reference x, int& iterations) {
    constexpr int limit = 60;
    int polished = 0;
    Minimum out;
    out.frame = face_frame<degree>(nodes, x);
    out.squared = (out.frame.y - p).squaredNorm();
    for (int i = 0; i < limit; ++i) {
        out.last = newton_step(out.frame, p, x);
        out.residual = out.last.residual;
        out.is_minimum = out.last.is_minimum;
        const double size = std::sqrt(std::max(out.frame.y1.squaredNorm(), out.frame.y2.squaredNorm()));
        // Rounding in y - P limits how small the slope can get.
        if (out.residual <= 1e-14 * size + 4e-16 * (p.norm() + out.frame.y.norm())) {
            out.converged = true;
            break;
        }
        ++iterations;
        Reference next = x;
        FaceFrame frame;
        double squared = out.squared, length = 1;
        // Close to the end rounding hides in z what Newton's step still gains: it is then taken unseen.
        const bool is_polish = out.is_minimum && out.last.direction.squaredNorm() < 1e-10;
        for (; length > 1e-4; length *= 0.5) {
            next = clamped(x + length * out.last.direction);
            frame = face_frame<degree>(nodes, next);
            squared = (frame.y - p).squaredNorm();
            if (squared < out.squared || is_polish)
                break;
        }
        if (!(squared < out.squared || is_polish)) { // no descent left at this precision
            out.converged = out.residual <= 1e-7 * size;
            break;
        }
        const double move = (next - x).norm();
        x = next;
        out.frame = frame;
        out.squared = squared;
        if (move < 1e-15 || (is_polish && ++polished == 2)) {
            out.converged = true;
            break;
        }
    }
    out.x = x;
    return out;
}

// True where the distance, seen from the minimum found, may have another one.
inline bool may_have_others(const FaceFrame& f, double distance) {
    const double a = f.y1.squaredNorm(), b = f.y1.dot(f.y2), c = f.y2.squaredNorm();
    const double mean = 0.5 * (a + c), spread = std::sqrt(0.25 * (a - c) * (a - c) + b * b);
    const double bend = std::sqrt(f.y11.squaredNorm() + 2 * f.y12.squaredNorm() + f.y22.squaredNorm());
    return distance * bend >= 0.5 * (mean - spread);
}

} // namespace detail

// `start`: where to begin, for instance the point of the step before.
template <int degree>
ClosestPoint closest_point(const FaceNodes<degree>& nodes, const Point& p,
                           const Reference& start = Reference::Zero()) {
    ClosestPoint out{};
    detail::Minimum best = detail::descend<degree>(nodes, p, detail::clamped(start), out.iterations);
    if (!best.converged || !best.is_minimum || detail::may_have_others(best.frame, std::sqrt(best.squared))) {
        const Reference others[] = {{-1, -1}, {1, -1}, {-1, 1}, {1, 1}, {0, 0}};
        for (const Reference& other : others) {
            const detail::Minimum trial = detail::descend<degree>(nodes, p, other, out.iterations);
            const bool nearer = trial.squared < best.squared * (1 - 1e-12);
            const bool sounder = trial.converged && trial.is_minimum &&
                                 !(best.converged && best.is_minimum) &&
                                 trial.squared <= best.squared * (1 + 1e-12);
            if (nearer || sounder)
                best = trial;
        }
    }
    out.reference = best.x;
    out.position = best.frame.y;
    out.normal = face_normal<degree>(nodes, best.frame);
    out.converged = best.converged;
    out.residual = best.residual;
    const int held = int(best.last.held[0]) + int(best.last.held[1]);
    out.feature = held == 0 ? Feature::interior : held == 1 ? Feature::edge : Feature::corner;
    const double side = (p - out.position).dot(out.normal);
    out.distance = std::copysign(std::sqrt(best.squared), side < 0 ? -1.0 : 1.0);
    return out;
}

} // namespace grainfall::femlink
