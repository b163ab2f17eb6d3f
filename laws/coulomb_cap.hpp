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

namespace detail {

// mu where it is asked for; a curve of several contacts need not be evaluated elsewhere, where its lower
// bound has settled the question.
template <class Friction>
[[gnu::always_inline]] inline double coefficient(const Friction& friction, double load, bool) {
    return friction.coefficient(load);
}
template <class Friction>
[[gnu::always_inline]] inline Lanes coefficient(const Friction& friction, const Lanes& load,
                                                const LaneMask& open) {
    return friction.coefficient(load, open);
}

template <class Scalar>
[[gnu::always_inline]] inline Scalar shortening(const MaskOf<Scalar>& slides, const Scalar& limit,
                                                const Scalar& squared) {
    using std::sqrt;
    return where(slides, limit / sqrt(squared), Scalar(1));
}

} // namespace detail

// Shortens the spring `elastic`, gives the `total` to apply, says if it slides. `load` is the normal force
// in N, never negative; `viscous` is the dashpot's tangential force. A curve is evaluated only where its
// lower bound does not settle the question.
template <class Friction, class Scalar>
[[gnu::always_inline]] inline MaskOf<Scalar> cap_shear(const Friction& friction, const Scalar& load,
                                                       const VectorOf<Scalar>& viscous,
                                                       VectorOf<Scalar>& elastic, VectorOf<Scalar>& total) {
    total = elastic + viscous;
    const Scalar settled = friction.lower_bound() * load;
    const Scalar elastic_squared = elastic.squaredNorm();
    Scalar total_squared = total.squaredNorm();
    const auto open = elastic_squared > settled * settled || total_squared > settled * settled;
    if (!any(open))
        return MaskOf<Scalar>(false);

    const Scalar limit = detail::coefficient(friction, load, open) * load;
    const auto spring_slides = elastic_squared > limit * limit;
    if (any(spring_slides)) {
        elastic *= detail::shortening(spring_slides, limit, elastic_squared);
        total = elastic + viscous;
        total_squared = total.squaredNorm();
    }
    const auto sum_slides = total_squared > limit * limit;
    if (any(sum_slides))
        total *= detail::shortening(sum_slides, limit, total_squared);
    return spring_slides || sum_slides;
}

// The same without a dashpot.
template <class Friction, class Scalar>
[[gnu::always_inline]] inline MaskOf<Scalar> cap_shear(const Friction& friction, const Scalar& load,
                                                       VectorOf<Scalar>& elastic) {
    const Scalar settled = friction.lower_bound() * load;
    const Scalar elastic_squared = elastic.squaredNorm();
    const auto open = elastic_squared > settled * settled;
    if (!any(open))
        return MaskOf<Scalar>(false);

    const Scalar limit = detail::coefficient(friction, load, open) * load;
    const auto slides = elastic_squared > limit * limit;
    if (any(slides))
        elastic *= detail::shortening(slides, limit, elastic_squared);
    return slides;
}

} // namespace grainfall::laws
