// SPDX-License-Identifier: GPL-2.0-or-later
// Normal force of a contact as a function of its overlap d (m), and the same in series with a compliance g:
//
//   LinearContact   F = K d              (MR-2629, Eq 26)
//   HertzContact    F = k d^(3/2)        k = 4/3 E* sqrt(R*); with the wall in C, E* is the grain's alone
//
//   in_series:      F = F(d),  d + g F(d) = o      o: overlap if the wall did not give way here
//
// F rises with d, so d + g F(d) does and the root is unique. Any type with `force`, `stiffness` (dF/dd) and
// `response` (both) as these have them will do.
#pragma once

#include <cmath>

namespace grainfall::femlink {

struct Response {
    double force, stiffness; // N, N/m
};

struct LinearContact {
    double coefficient; // N/m
    double force(double overlap) const { return coefficient * overlap; }
    double stiffness(double) const { return coefficient; }
    Response response(double overlap) const { return {force(overlap), coefficient}; }
};

struct HertzContact {
    double coefficient; // N/m^(3/2)
    double force(double overlap) const { return coefficient * overlap * std::sqrt(overlap); }
    double stiffness(double overlap) const { return 1.5 * coefficient * std::sqrt(overlap); }
    Response response(double overlap) const {
        const double slope = coefficient * std::sqrt(overlap);
        return {slope * overlap, 1.5 * slope};
    }
};

// Newton inside a bracket that shrinks, from the overlap `guess`. N; 0 where there is no overlap.
template <class Relation>
double in_series(const Relation& relation, double compliance, double free_overlap, double guess) {
    if (!(free_overlap > 0))
        return 0;
    double low = 0, high = free_overlap;
    double overlap = compliance > 0 && guess > 0 && guess < high ? guess : free_overlap;
    Response found = relation.response(overlap);
    if (found.force == 0 && overlap < free_overlap) { // a dashpot that keeps the guess from pushing
        overlap = free_overlap;
        found = relation.response(overlap);
    }
    if (compliance <= 0 || found.force == 0)
        return found.force;
    while (found.force < 0 && overlap + compliance * found.force < free_overlap) { // a dashpot that pulls
        high *= 2;
        overlap = high;
        found = relation.response(overlap);
    }
    for (int i = 0; i < 80; ++i) {
        const double excess = overlap - free_overlap + compliance * found.force;
        if (std::abs(excess) <= 4e-16 * free_overlap)
            break;
        (excess > 0 ? high : low) = overlap;
        double next = overlap - excess / (1 + compliance * found.stiffness);
        if (std::abs(next - overlap) <= 4e-16 * overlap)
            break;
        // Far below the free overlap Newton's steps in d are many; a geometric cut is not.
        if (!(next > low && next < high))
            next = low > 0 ? std::sqrt(low * high) : 1e-3 * high;
        overlap = next;
        found = relation.response(overlap);
    }
    // The overlap left over is a small difference where the wall is far softer than the contact.
    return 2 * compliance * found.force > free_overlap ? (free_overlap - overlap) / compliance : found.force;
}

inline double in_series(const LinearContact& relation, double compliance, double free_overlap, double) {
    return free_overlap > 0 ? free_overlap / (1 / relation.coefficient + compliance) : 0;
}

template <class Relation>
double in_series(const Relation& relation, double compliance, double free_overlap) {
    return in_series(relation, compliance, free_overlap, free_overlap);
}

} // namespace grainfall::femlink
