// SPDX-License-Identifier: GPL-2.0-or-later
// Coulomb limit on the tangential force (report, Eq 6):  |F_t| <= mu(F_n) F_n.
//
// F_t is the force applied, spring and dashpot together. Capping the spring alone, as many codes do, lets the total
// exceed mu F_n. Two steps: the spring is shortened to the limit if it exceeds it, then the sum is.
//
// What is kept for the next step is the shortened spring, not the shortened sum. Shortening only ever
// lowers the spring's energy, and with |spring| <= mu F_n = |sum| the force that remains for the dashpot still has no
// positive power on the sliding velocity: nothing here makes energy. In steady sliding the spring stands at
// the limit along the motion, and the dashpot's share is zero.
#pragma once

#include <laws/contact.hpp>

#include <algorithm>
#include <cmath>

namespace grainfall::laws {

// N; `load` is the normal force (N, >= 0), `viscous` the dashpot's tangential force. Shortens both; says if it slides.
// A curve is evaluated only where its lower bound does not already settle the question.
template <class Friction>
bool cap_shear(const Friction& friction, double load, Vector& elastic, Vector& viscous) {
    const double settled = friction.lower_bound() * load;
    double elastic_squared = elastic.squaredNorm();
    Vector sum = elastic + viscous;
    double sum_squared = sum.squaredNorm();
    if (std::max(elastic_squared, sum_squared) <= settled * settled) return false;

    const double limit = friction.coefficient(load) * load;
    bool sliding = false;
    if (elastic_squared > limit * limit) {
        elastic *= limit / std::sqrt(elastic_squared);
        sum = elastic + viscous;
        sum_squared = sum.squaredNorm();
        sliding = true;
    }
    if (sum_squared > limit * limit) {
        sum *= limit / std::sqrt(sum_squared);
        sliding = true;
    }
    viscous = sum - elastic;
    return sliding;
}

// The same without a dashpot.
template <class Friction>
bool cap_shear(const Friction& friction, double load, Vector& elastic) {
    const double settled = friction.lower_bound() * load;
    const double elastic_squared = elastic.squaredNorm();
    if (elastic_squared <= settled * settled) return false;

    const double limit = friction.coefficient(load) * load;
    if (elastic_squared <= limit * limit) return false;
    elastic *= limit / std::sqrt(elastic_squared);
    return true;
}

} // namespace grainfall::laws
