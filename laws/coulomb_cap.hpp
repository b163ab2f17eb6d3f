// SPDX-License-Identifier: GPL-2.0-or-later
// Coulomb limit on the tangential force (report, Eq 6):  |F_t| <= mu(F_n) F_n.
//
// F_t is the force applied, spring and dashpot together. Capping the spring alone, as many codes do, lets
// the total exceed mu F_n. Two steps: the spring is shortened to the limit if it exceeds it, then so is the
// sum.
//
// What is kept for the next step is the shortened spring, not the shortened sum. Shortening only ever
// lowers the spring's energy, and with |spring| <= mu F_n = |sum| the force that remains for the dashpot
// still has no positive power on the sliding velocity: nothing here makes energy. In steady sliding the
// spring stands at the limit along the motion, and the dashpot's share is zero.
//
// The inner functions are inlined by order: left to itself, the compiler keeps a copy shared by several laws
// out of line, and vectors passed through memory cost a fifth of the step (benchmarks/instruction_count.py).
#pragma once

#include <laws/contact.hpp>

#include <cmath>

namespace grainfall::laws {

// Shortens the spring `elastic`, gives the `total` to apply, says if it slides. `load` is the normal force
// in N, never negative; `viscous` is the dashpot's tangential force. A curve is evaluated only where its
// lower bound does not settle the question.
template <class Friction>
[[gnu::always_inline]] inline bool cap_shear(const Friction& friction, double load, const Vector& viscous,
                                             Vector& elastic, Vector& total) {
    total = elastic + viscous;
    const double settled = friction.lower_bound() * load;
    const double elastic_squared = elastic.squaredNorm();
    double total_squared = total.squaredNorm();
    if (!(elastic_squared > settled * settled || total_squared > settled * settled))
        return false;

    const double limit = friction.coefficient(load) * load;
    bool sliding = false;
    if (elastic_squared > limit * limit) {
        elastic *= limit / std::sqrt(elastic_squared);
        total = elastic + viscous;
        total_squared = total.squaredNorm();
        sliding = true;
    }
    if (total_squared > limit * limit) {
        total *= limit / std::sqrt(total_squared);
        sliding = true;
    }
    return sliding;
}

// The same without a dashpot.
template <class Friction>
[[gnu::always_inline]] inline bool cap_shear(const Friction& friction, double load, Vector& elastic) {
    const double settled = friction.lower_bound() * load;
    const double elastic_squared = elastic.squaredNorm();
    if (!(elastic_squared > settled * settled))
        return false;

    const double limit = friction.coefficient(load) * load;
    if (!(elastic_squared > limit * limit))
        return false;
    elastic *= limit / std::sqrt(elastic_squared);
    return true;
}

} // namespace grainfall::laws
