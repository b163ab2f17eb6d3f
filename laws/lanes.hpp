// SPDX-License-Identifier: GPL-2.0-or-later
// Lanes: one quantity of several contacts side by side, computed together by the processor's vector instructions.
//
// A kernel is a template over its scalar, double or Lanes, so that one text serves both. What a branch decides
// for one contact is decided lane by lane with where(); any() tells whether a branch is worth entering at all:
//
//   const auto slides = force > limit;                          // bool, or one for each lane
//   if (any(slides))
//       force *= where(slides, limit / force, Scalar(1));
//
// A lane's result does not depend on its neighbours, to the last bit. The vectors are the compiler's own
// (GCC, Clang); on a processor whose vectors are shorter it splits them.
#pragma once

#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <utility>

namespace grainfall::laws {

struct LaneMask {
    typedef long Pack __attribute__((vector_size(32)));
    Pack pack; // -1 where true, else 0

    LaneMask() = default;
    explicit LaneMask(bool all) : pack(Pack{} - static_cast<long>(all)) {}
    explicit LaneMask(const Pack& values) : pack(values) {}
    bool operator[](int lane) const { return pack[lane] != 0; }

    // Both sides are computed: nothing is skipped as for bool.
    friend LaneMask operator&&(const LaneMask& a, const LaneMask& b) { return LaneMask(a.pack & b.pack); }
    friend LaneMask operator||(const LaneMask& a, const LaneMask& b) { return LaneMask(a.pack | b.pack); }
    friend LaneMask operator!(const LaneMask& a) { return LaneMask(~a.pack); }
};

struct Lanes {
    static constexpr int width = 4;
    typedef double Pack __attribute__((vector_size(32)));
    Pack pack;

    Lanes() = default;
    Lanes(double all) : pack{all, all, all, all} {}
    explicit Lanes(const Pack& values) : pack(values) {}
    double operator[](int lane) const { return pack[lane]; }

    Lanes& operator+=(const Lanes& other) { return *this = *this + other; }
    Lanes& operator-=(const Lanes& other) { return *this = *this - other; }
    Lanes& operator*=(const Lanes& other) { return *this = *this * other; }
    Lanes operator-() const { return Lanes(-pack); }
    friend Lanes operator+(const Lanes& a, const Lanes& b) { return Lanes(a.pack + b.pack); }
    friend Lanes operator-(const Lanes& a, const Lanes& b) { return Lanes(a.pack - b.pack); }
    friend Lanes operator*(const Lanes& a, const Lanes& b) { return Lanes(a.pack * b.pack); }
    friend Lanes operator/(const Lanes& a, const Lanes& b) { return Lanes(a.pack / b.pack); }
    friend LaneMask operator<(const Lanes& a, const Lanes& b) { return LaneMask(a.pack < b.pack); }
    friend LaneMask operator>(const Lanes& a, const Lanes& b) { return LaneMask(a.pack > b.pack); }
};

inline Lanes sqrt(const Lanes& x) {
    Lanes root;
    for (int lane = 0; lane < Lanes::width; ++lane)
        root.pack[lane] = std::sqrt(x.pack[lane]);
    return root;
}

inline bool any(bool condition) {
    return condition;
}
inline bool any(const LaneMask& mask) {
    return (mask.pack[0] | mask.pack[1] | mask.pack[2] | mask.pack[3]) != 0;
}
inline double where(bool condition, double yes, double no) {
    return condition ? yes : no;
}
inline Lanes where(const LaneMask& mask, const Lanes& yes, const Lanes& no) {
    return Lanes(mask.pack ? yes.pack : no.pack);
}

// As std::max, also where one of them is not a number.
template <class Scalar>
Scalar larger(const Scalar& a, const Scalar& b) {
    return where(a < b, b, a);
}

template <class Scalar>
struct ScalarTraits {
    using Itself = Scalar;
    using Mask = bool;
    static constexpr int width = 1;
};
template <>
struct ScalarTraits<Lanes> {
    using Itself = Lanes;
    using Mask = LaneMask;
    static constexpr int width = Lanes::width;
};

template <class Scalar>
using MaskOf = typename ScalarTraits<Scalar>::Mask;
template <class Scalar>
inline constexpr int width_of = ScalarTraits<Scalar>::width;

inline double lane_of(double value, int) {
    return value;
}
inline double lane_of(const Lanes& values, int lane) {
    return values.pack[lane];
}
inline bool lane_of(bool value, int) {
    return value;
}
inline bool lane_of(const LaneMask& mask, int lane) {
    return mask[lane];
}

inline double sum_of_lanes(double value) {
    return value;
}
inline double sum_of_lanes(const Lanes& values) {
    return values.pack[0] + values.pack[1] + values.pack[2] + values.pack[3];
}

// The scalar whose lanes are value(0), value(1), ...
template <class Scalar, class Value>
[[gnu::always_inline]] inline Scalar packed(const Value& value) {
    if constexpr (width_of<Scalar> == 1)
        return value(0);
    else
        return Scalar(Lanes::Pack{value(0), value(1), value(2), value(3)});
}

} // namespace grainfall::laws

namespace Eigen {

template <>
struct NumTraits<grainfall::laws::Lanes> : GenericNumTraits<double> {
    using Real = grainfall::laws::Lanes;
    using NonInteger = grainfall::laws::Lanes;
    using Nested = grainfall::laws::Lanes;
    using Literal = double;
};
template <class Operation>
struct ScalarBinaryOpTraits<double, grainfall::laws::Lanes, Operation> {
    using ReturnType = grainfall::laws::Lanes;
};

} // namespace Eigen
