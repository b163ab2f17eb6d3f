// SPDX-License-Identifier: GPL-2.0-or-later
// Facts: the second base of every functor has 17 slots: D1, D0, checkOrder, go with 1 to 7 parameters,
// goReverse with 1 to 7 parameters; a family calls one arity only. Verified: thunks in the secondary vtable
// of Law2_ScGeom_FrictPhys_CundallStrack and others, tests/abi. The table is built as a chain of classes, one
// slot each, so that the arities never called need no parameter types.
#pragma once

#include <lib/base/Math.hpp>

namespace yade {

namespace abi {
struct FunctorRoot {
    virtual ~FunctorRoot() = default;
    virtual string checkOrder() const { return ""; }
};

[[noreturn]] inline void notOverridden(const char* what) {
    throw runtime_error(string("functor called through ") + what + ", which it does not override");
}

template <class Below, int count>
struct UnusedSlots : UnusedSlots<Below, count - 1> {
private:
    virtual void unused(UnusedSlots*) {} // parameter: a new slot, never an override
};
template <class Below>
struct UnusedSlots<Below, 0> : Below {};

template <class Below, class Result, class... Parameters>
struct GoSlot : Below {
    virtual Result go(Parameters...) { notOverridden("go"); }
};
template <class Below, class Result, class... Parameters>
struct GoReverseSlot : Below {
    virtual Result goReverse(Parameters...) { notOverridden("goReverse"); }
};

template <class Result, class... Parameters>
struct FunctorTable {
    static constexpr int arity = sizeof...(Parameters);
    using BelowGo = UnusedSlots<FunctorRoot, arity - 1>;
    using WithGo = UnusedSlots<GoSlot<BelowGo, Result, Parameters...>, 7 - arity>;
    using BelowReverse = UnusedSlots<WithGo, arity - 1>;
    using Complete = UnusedSlots<GoReverseSlot<BelowReverse, Result, Parameters...>, 7 - arity>;
};
} // namespace abi

template <class Result, class... Parameters>
class FunctorWrapper : public abi::FunctorTable<Result, Parameters...>::Complete {};

} // namespace yade

#define DEFINE_FUNCTOR_ORDER_2D(first, second)                                                               \
public:                                                                                                      \
    std::string checkOrder() const override {                                                                \
        return #first " " #second;                                                                           \
    }
