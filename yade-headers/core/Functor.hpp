// SPDX-License-Identifier: GPL-2.0-or-later
// Facts: Functor is 80 bytes (timing 24, scene 40, label 48), one slot more than Serializable
// (getFunctorTypes); a functor family adds one or two functions naming its argument classes, then a second
// base at 80. Verified: pointer-to-member of the Python attributes, vtable relocations, tests/abi. The
// families' intermediate templates have no exported tables, so ours are templates over plain types.
#pragma once

#include <lib/multimethods/FunctorWrapper.hpp>
#include <lib/serialization/Serializable.hpp>
#include <core/Timing.hpp>

namespace yade {

class Scene;

class Functor : public Serializable {
public:
    Functor() {}
    virtual vector<string> getFunctorTypes() const;

    shared_ptr<TimingDeltas> timingDeltas;
    /// Set by the dispatcher before each step.
    Scene* scene;
    string label;

    YADE_ABI_STOCK_CLASS(Functor)
};

template <class Dispatch, class Result, class... Parameters>
class Functor1D : public Functor, public FunctorWrapper<Result, Parameters...> {
public:
    using DispatchType1 = Dispatch;
    vector<string> getFunctorTypes() const override { return {get1DFunctorType1()}; }
    virtual string get1DFunctorType1() const { throw logic_error(getClassName() + " lacks FUNCTOR1D"); }
};

template <class First, class Second, class Result, class... Parameters>
class Functor2D : public Functor, public FunctorWrapper<Result, Parameters...> {
public:
    using DispatchType1 = First;
    using DispatchType2 = Second;
    vector<string> getFunctorTypes() const override { return {get2DFunctorType1(), get2DFunctorType2()}; }
    virtual string get2DFunctorType1() const { throw logic_error(getClassName() + " lacks FUNCTOR2D"); }
    virtual string get2DFunctorType2() const { throw logic_error(getClassName() + " lacks FUNCTOR2D"); }
};

} // namespace yade

YADE_ABI_STOCK_SERIALIZERS(Functor)

#define FUNCTOR1D(type1)                                                                                     \
public:                                                                                                      \
    std::string get1DFunctorType1() const override {                                                         \
        return #type1;                                                                                       \
    }

#define FUNCTOR2D(type1, type2)                                                                              \
public:                                                                                                      \
    std::string get2DFunctorType1() const override {                                                         \
        return #type1;                                                                                       \
    }                                                                                                        \
    std::string get2DFunctorType2() const override {                                                         \
        return #type2;                                                                                       \
    }
