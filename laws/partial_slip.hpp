// SPDX-License-Identifier: GPL-2.0-or-later
// Tangential force of a contact that slips from its rim inwards: Cattaneo, Mindlin and Deresiewicz.
//
// Method of dimensionality reduction (Popov & Hess 2015, Springer, ch. 5; after Jaeger 1995 and Ciavarella
// 1998): under Hertz's pressure the contact answers to any history of overlap d and shear as a row of
// independent springs does. The spring at x touches once d > y = x^2/R*, and then
//
//   normal      E* dx (d - y)                          sum over x:  4/3 E* sqrt(R*) d^1.5, Hertz
//   tangential  4 G* dx tau, tau its own stretch       all stuck:   8 G* a u, Mindlin; a = sqrt(R* d)
//   slip        4 G* |tau| <= mu E* (d - y)
//
// N, m, Pa; 1/G* = (2-nu1)/G1 + (2-nu2)/G2, u shear displacement. With s = x/sqrt(R*) = sqrt(y) the
// coefficients of ContactParameters suffice: force 8 G* sqrt(R*) integral tau ds over 0 < s < sqrt(d), energy
// half of that with tau^2, and |tau| <= kappa (d - y) with kappa = 3/2 mu F_n/(8 G* sqrt(R*) d^1.5), so that
// all slipping together hold mu F_n. F_n is the normal force of Eq 6, dashpot included: as it grows or falls
// beside Hertz's, every spring's limit does.
//
// A spring comes into contact unstretched, leaves it unstretched and is elastic-perfectly plastic between: no
// history makes energy. Assumes what Mindlin does: spheres, overlap far below the radii, like materials (or
// nu = 1/2), slip opposed to the force rather than to the sliding velocity at each point.
#pragma once

#include <laws/contact.hpp>
#include <laws/slip_profile.hpp>
#include <laws/tangential_force.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace grainfall::laws {

// How many straight pieces a contact remembers; docs/physics/partial_slip.md has the error for other numbers.
inline constexpr int slip_pieces = 8;
// Of the overlap, of kappa, and of the shear at which an unloaded contact slides, kappa times the overlap.
inline constexpr double slip_resolution = 1e-4;

// What such a contact remembers besides ContactMemory.
//
// What one step adds is mostly too little to matter: the pieces are only brought up to date once overlap,
// limit or shear have changed by `slip_resolution`. Until then they are stretched by `pending` as a whole, as
// if all stuck. That is elastic too, so it makes no energy either; the force is off by about
// slip_resolution mu F_n.
struct SlipHistory {
    SlipPieces<slip_pieces> pieces;
    Vector axis = Vector::Zero();    // unit vector in the contact plane: first axis of the pieces' vectors
    Planar pending = Planar::Zero(); // m, shear since the pieces were up to date
    double limit_slope = 0;          // kappa at that time
    double coefficient = 0;          // N/m^1.5, 8 G* sqrt(R*) of the law that kept it
    double force_squared = 0;        // N^2, of the elastic force that this history gave last
    bool slides = false;             // did all springs slip when the pieces were brought up to date?

    Planar integral() const { return pieces.integral() + pieces.rim() * pending; }
    double integral_of_square() const {
        return pieces.integral_of_square() + pending.dot(2 * pieces.integral() + pieces.rim() * pending);
    }
};

struct PartialSlipMemory : ContactMemory {
    SlipHistory history;

    // Was the history kept by the law that acted last? Another law leaves it as it was and changes the force.
    bool holds_history() const {
        const double now = shear_force.squaredNorm();
        return std::abs(now - history.force_squared) <= 1e-12 * now;
    }
};

// J, energy in the springs.
inline double shear_elastic_energy(const SlipHistory& history) {
    return 0.5 * history.coefficient * history.integral_of_square();
}

inline double shear_elastic_energy(const PartialSlipMemory& memory) {
    if (!(memory.history.pieces.count > 0 && memory.holds_history()))
        return shear_elastic_energy(memory.shear_force, memory.shear_stiffness);
    return shear_elastic_energy(memory.history);
}

struct PartialSlipTangential {
    static constexpr bool active = true;
    static constexpr double factor = 1.0;
    static constexpr double square_root_of_factor = 1.0;
};

namespace detail {

// Pieces whose joining takes less than this share of the energy are the same to rounding.
inline constexpr double negligible_slip_energy = 1e-14;
// Share of the energy at gross sliding that one line may miss where the direction of slip turns.
inline constexpr double negligible_turn = 1e-9;

inline Vector any_tangent(const Vector& normal) {
    const Vector other = std::abs(normal.x()) < 0.6 ? Vector::UnitX() : Vector::UnitY();
    return normal.cross(other).normalized();
}

// The springs of a contact pressed to `limit.depth` and then sheared until integral tau ds is `integral`
// (Cattaneo, Mindlin): one displacement inside, slip outside.
template <int Capacity>
void load_slip_profile(SlipPieces<Capacity>& pieces, const Planar& integral, const SlipLimit& limit) {
    pieces.count = 0;
    const double size = integral.norm(), rim = std::sqrt(limit.depth);
    if (!(size > 0 && limit.slope > 0 && rim > 0))
        return;
    const Planar direction = integral / size;
    const double full = 2.0 / 3.0 * limit.slope * limit.depth * rim;
    const double stuck = rim * std::cbrt(std::max(0.0, 1 - size / full));
    if (stuck > 0)
        pieces.add(SlipStretch(0, stuck), limit.at(stuck * stuck) * direction, Planar::Zero(), stuck, 0);
    const SlipStretch slipping(stuck, rim);
    if (slipping.width > 0)
        pieces.add(slipping, limit.at(slipping.centre) * direction, -limit.slope * direction, rim, 0);
}

} // namespace detail

// One step: the contact reaches the overlap rim^2, is sheared by `shift` (m, in the direction of the force)
// and may hold limit_slope (d - y). Springs that come into touch meanwhile take their part of the shift.
// Returns whether all slip.
inline bool advance_slip_profile(SlipPieces<slip_pieces>& pieces, double rim, const Planar& shift,
                                 double limit_slope) {
    // Each of the pieces and a new one may fall into slip, stick, slip.
    constexpr int spare_pieces = 8;
    SlipPieces<3 * (slip_pieces + 1) + spare_pieces> next;
    int spare = spare_pieces;
    const double full = limit_slope * rim * rim;
    const SlipLimit limit{limit_slope, rim * rim, detail::negligible_turn * full * full * rim};
    bool sticks = false;
    double from = 0;
    for (int i = 0; i < pieces.count && from < rim; ++i) {
        const SlipPiece& piece = pieces[i];
        const SlipLine trial{piece.stretch.centre, piece.mean + shift, piece.slope};
        const double to = std::min(piece.end, rim);
        sticks |= add_limited(next, from, to, &piece, trial, limit, spare);
        from = to;
    }
    if (rim > from) {
        const SlipLine trial{limit.depth, Planar::Zero(), -shift / (limit.depth - from * from)};
        sticks |= add_limited(next, from, rim, nullptr, trial, limit, spare);
    }
    join_pieces(next, slip_pieces, detail::negligible_slip_energy * next.integral_of_square());
    pieces.take(next);
    return !sticks;
}

// One step of the history: see advance_slip_profile.
inline void advance_slip_history(SlipHistory& history, double rim, const Planar& shift, double limit_slope) {
    history.pending += shift;
    const double depth = rim * rim, last_rim = history.pieces.rim();
    const double allowed = slip_resolution * limit_slope * depth;
    if (history.pending.squaredNorm() < allowed * allowed &&
        std::abs(depth - last_rim * last_rim) < slip_resolution * depth &&
        std::abs(limit_slope - history.limit_slope) < slip_resolution * limit_slope)
        return;
    history.slides = advance_slip_profile(history.pieces, rim, history.pending, limit_slope);
    history.pending.setZero();
    history.limit_slope = limit_slope;
}

// Turns the history with its contact. One that was loaded by another law, which shows in its force, starts as
// if pressed first and then sheared until that force: `coefficient` is 8 G* sqrt(R*), `limit_slope` kappa.
inline void carry_slip_history(PartialSlipMemory& memory, const ContactGeometry& geometry, double coefficient,
                               double limit_slope) {
    SlipHistory& history = memory.history;
    history.coefficient = coefficient;
    bool adopt = !memory.holds_history();
    history.axis = rotated_with_contact(history.axis, geometry);
    // A new contact has no axis yet; one whose normal jumped by a right angle has lost it.
    if (!(history.axis.squaredNorm() > 0.5)) {
        history.axis = detail::any_tangent(geometry.normal);
        adopt = true;
    }
    if (!adopt)
        return;
    const Vector force = rotated_with_contact(memory.shear_force, geometry);
    const Planar integral(history.axis.dot(force) / coefficient,
                          geometry.normal.cross(history.axis).dot(force) / coefficient);
    history.pending.setZero();
    history.limit_slope = limit_slope;
    detail::load_slip_profile(history.pieces, integral, SlipLimit{limit_slope, geometry.overlap, 0});
}

} // namespace grainfall::laws
