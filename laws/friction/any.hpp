// SPDX-License-Identifier: GPL-2.0-or-later
// A curve whose kind is known only at run time, for scenes that mix kinds (sand with a power law on steel
// with a constant). A scene with one kind uses that kind directly and has no switch in its loop.
#pragma once

#include <laws/friction/asperity.hpp>
#include <laws/friction/combined.hpp>
#include <laws/friction/constant.hpp>
#include <laws/friction/exponential.hpp>
#include <laws/friction/power_law.hpp>
#include <laws/friction/table.hpp>

#include <memory>
#include <utility>
#include <variant>

namespace grainfall::laws::friction {

class Any;

// Operands are shared, so that combinations nest and a contact stays small.
struct AnyOperand {
    std::shared_ptr<const Any> curve;

    double coefficient(double load) const;
    double lower_bound() const;
    AnyOperand scaled(double factor) const;
    AnyOperand with_load_scale(double scale) const;
};

class Any {
public:
    using Pair = Combined<AnyOperand, AnyOperand>;
    using Curve = std::variant<Constant, PowerLaw, Exponential, Asperity, Table, Pair>;

    Any() = default; // no friction
    template <class Kind>
    Any(Kind curve) : curve_(std::move(curve)), lower_bound_(std::get<Kind>(curve_).lower_bound()) {}

    static Any combined(Any first, Any second, CombinationRule rule) {
        return Pair{{std::make_shared<const Any>(std::move(first))},
                    {std::make_shared<const Any>(std::move(second))},
                    rule};
    }

    double coefficient(double load) const {
        return std::visit([load](const auto& curve) { return curve.coefficient(load); }, curve_);
    }
    double lower_bound() const { return lower_bound_; }
    Any scaled(double factor) const {
        return std::visit([factor](const auto& curve) { return Any(curve.scaled(factor)); }, curve_);
    }
    Any with_load_scale(double scale) const {
        return std::visit([scale](const auto& curve) { return Any(curve.with_load_scale(scale)); }, curve_);
    }
    // The kind in use, for callers that pick the law's instantiation from it.
    const Curve& curve() const { return curve_; }

private:
    Curve curve_ = Constant{};
    double lower_bound_ = 0;
};

inline double AnyOperand::coefficient(double load) const {
    return curve->coefficient(load);
}
inline double AnyOperand::lower_bound() const {
    return curve->lower_bound();
}
inline AnyOperand AnyOperand::scaled(double factor) const {
    return {std::make_shared<const Any>(curve->scaled(factor))};
}
inline AnyOperand AnyOperand::with_load_scale(double scale) const {
    return {std::make_shared<const Any>(curve->with_load_scale(scale))};
}

} // namespace grainfall::laws::friction
