// SPDX-License-Identifier: GPL-2.0-or-later
// Lanes: one quantity of several contacts side by side, computed together by the processor's vector
// instructions.
//
// A kernel is a template over its scalar, double or Lanes, so that one text serves both. What a branch
// decides for one contact is decided lane by lane with where(); any() tells whether a branch is worth
// entering at all:
//
//   const auto slides = force > limit;                          // bool, or one for each lane
//   if (any(slides))
//       force *= where(slides, limit / force, Scalar(1));
//
// A lane's result does not depend on its neighbours, to the last bit. The vectors are the compiler's own
// (GCC, Clang); on a processor whose vectors are shorter it splits them. How a vector is returned depends on
// the instruction set that a function is compiled for: all that return Lanes or a LaneMask must be inlined by
// order.
#pragma once

#include <Eigen/Core>

#include <cmath>

namespace grainfall::laws {

struct LaneMask {
    typedef long Pack __attribute__((vector_size(32)));
    Pack pack; // -1 where true, else 0

    LaneMask() = default;
    explicit LaneMask(bool all) : pack(Pack{} - static_cast<long>(all)) {}
    explicit LaneMask(const Pack& values) : pack(values) {}

    // Both sides are computed: nothing is skipped as for bool.
    [[gnu::always_inline]] friend LaneMask operator&&(const LaneMask& a, const LaneMask& b) {
        return LaneMask(a.pack & b.pack);
    }
    [[gnu::always_inline]] friend LaneMask operator||(const LaneMask& a, const LaneMask& b) {
        return LaneMask(a.pack | b.pack);
    }
    [[gnu::always_inline]] friend LaneMask operator!(const LaneMask& a) { return LaneMask(~a.pack); }
};

struct Lanes {
    static constexpr int width = 4;
    typedef double Pack __attribute__((vector_size(32)));
    Pack pack;

    Lanes() = default;
    [[gnu::always_inline]] Lanes(double all) : pack{all, all, all, all} {}
    [[gnu::always_inline]] explicit Lanes(const Pack& values) : pack(values) {}

    [[gnu::always_inline]] Lanes& operator+=(const Lanes& other) { return *this = Lanes(pack + other.pack); }
    [[gnu::always_inline]] Lanes& operator-=(const Lanes& other) { return *this = Lanes(pack - other.pack); }
    [[gnu::always_inline]] Lanes& operator*=(const Lanes& other) { return *this = Lanes(pack * other.pack); }
    [[gnu::always_inline]] Lanes operator-() const { return Lanes(-pack); }
    [[gnu::always_inline]] friend Lanes operator+(const Lanes& a, const Lanes& b) {
        return Lanes(a.pack + b.pack);
    }
    [[gnu::always_inline]] friend Lanes operator-(const Lanes& a, const Lanes& b) {
        return Lanes(a.pack - b.pack);
    }
    [[gnu::always_inline]] friend Lanes operator*(const Lanes& a, const Lanes& b) {
        return Lanes(a.pack * b.pack);
    }
    [[gnu::always_inline]] friend Lanes operator/(const Lanes& a, const Lanes& b) {
        return Lanes(a.pack / b.pack);
    }
    [[gnu::always_inline]] friend LaneMask operator<(const Lanes& a, const Lanes& b) {
        return LaneMask(a.pack < b.pack);
    }
    [[gnu::always_inline]] friend LaneMask operator>(const Lanes& a, const Lanes& b) {
        return LaneMask(a.pack > b.pack);
    }
};

// Vectors of several contacts, with what the kernels use of Eigen's. Eigen itself over Lanes leaves functions
// out of line, compiled for the least of processors.
struct LaneVector {
    Lanes x, y, z;

    LaneVector() = default;
    [[gnu::always_inline]] LaneVector(const Lanes& a, const Lanes& b, const Lanes& c) : x(a), y(b), z(c) {}
    [[gnu::always_inline]] static LaneVector Zero() { return {0, 0, 0}; }
    [[gnu::always_inline]] static LaneVector UnitX() { return {1, 0, 0}; }

    [[gnu::always_inline]] LaneVector& operator+=(const LaneVector& b) { return *this = *this + b; }
    [[gnu::always_inline]] LaneVector& operator-=(const LaneVector& b) { return *this = *this - b; }
    [[gnu::always_inline]] LaneVector& operator*=(const Lanes& factor) { return *this = factor * *this; }
    [[gnu::always_inline]] friend LaneVector operator+(const LaneVector& a, const LaneVector& b) {
        return {a.x + b.x, a.y + b.y, a.z + b.z};
    }
    [[gnu::always_inline]] friend LaneVector operator-(const LaneVector& a, const LaneVector& b) {
        return {a.x - b.x, a.y - b.y, a.z - b.z};
    }
    [[gnu::always_inline]] friend LaneVector operator*(const Lanes& a, const LaneVector& b) {
        return {a * b.x, a * b.y, a * b.z};
    }
    [[gnu::always_inline]] friend LaneVector operator/(const LaneVector& a, const Lanes& b) {
        return {a.x / b, a.y / b, a.z / b};
    }
    [[gnu::always_inline]] Lanes dot(const LaneVector& b) const { return x * b.x + y * b.y + z * b.z; }
    [[gnu::always_inline]] Lanes squaredNorm() const { return dot(*this); }
    [[gnu::always_inline]] LaneVector cross(const LaneVector& b) const {
        return {y * b.z - z * b.y, z * b.x - x * b.z, x * b.y - y * b.x};
    }
};

[[gnu::always_inline]] inline Lanes sqrt(const Lanes& x) {
    Lanes root;
    for (int lane = 0; lane < Lanes::width; ++lane)
        root.pack[lane] = std::sqrt(x.pack[lane]);
    return root;
}

inline bool any(bool condition) {
    return condition;
}
[[gnu::always_inline]] inline bool any(const LaneMask& mask) {
    const auto pairs = __builtin_shufflevector(mask.pack, mask.pack, 0, 1) |
                       __builtin_shufflevector(mask.pack, mask.pack, 2, 3);
    return (pairs[0] | pairs[1]) != 0;
}
inline double where(bool condition, double yes, double no) {
    return condition ? yes : no;
}
[[gnu::always_inline]] inline Lanes where(const LaneMask& mask, const Lanes& yes, const Lanes& no) {
    return Lanes(mask.pack ? yes.pack : no.pack);
}

// As std::max, also where one of them is not a number.
template <class Scalar>
[[gnu::always_inline]] inline Scalar larger(const Scalar& a, const Scalar& b) {
    return where(a < b, b, a);
}

template <class Scalar>
struct ScalarTraits {
    using Vector = Eigen::Matrix<Scalar, 3, 1>;
    using Mask = bool;
    static constexpr int width = 1;
};
template <>
struct ScalarTraits<Lanes> {
    using Vector = LaneVector;
    using Mask = LaneMask;
    static constexpr int width = Lanes::width;
};

template <class Scalar>
using VectorOf = typename ScalarTraits<Scalar>::Vector;
template <class Scalar>
using MaskOf = typename ScalarTraits<Scalar>::Mask;
template <class Scalar>
inline constexpr int width_of = ScalarTraits<Scalar>::width;

inline double lane_of(double value, int) {
    return value;
}
[[gnu::always_inline]] inline double lane_of(const Lanes& values, int lane) {
    return values.pack[lane];
}
inline bool lane_of(bool value, int) {
    return value;
}
[[gnu::always_inline]] inline bool lane_of(const LaneMask& mask, int lane) {
    return mask.pack[lane] != 0;
}

inline double sum_of_lanes(double value) {
    return value;
}
[[gnu::always_inline]] inline double sum_of_lanes(const Lanes& values) {
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
