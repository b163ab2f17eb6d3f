// SPDX-License-Identifier: GPL-2.0-or-later
// The curves that a script can choose from; each translates its attributes into a kernel of laws/friction/.
#pragma once

#include <laws/yade/FrictionCurve.hpp>

namespace yade {

class ConstantFriction : public FrictionCurve {
public:
    virtual ~ConstantFriction();
    grainfall::laws::friction::Constant kernel() const { return {mu}; }
    grainfall::laws::friction::Any at_moisture(Real) const override { return kernel(); }
    void validate() const override { kernel().validate(); }
    void postLoad(ConstantFriction&) { validate(); }
    void pyHandleCustomCtorArgs(boost::python::tuple& args, boost::python::dict& keywords) override {
        take_positional(args, keywords, {"mu"});
    }
    // clang-format off
    YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(ConstantFriction, FrictionCurve, "Friction that does not depend on the load. Positional: mu.",
        ((Real, mu, 0.5, , "friction coefficient [-], >= 0."))
        ,
        ,
        .def(CheckedAttributes<ConstantFriction>().add("mu", &ConstantFriction::mu))
    );
    // clang-format on
};
REGISTER_SERIALIZABLE(ConstantFriction);

class PowerLawFriction : public FrictionCurve {
public:
    virtual ~PowerLawFriction();
    grainfall::laws::friction::PowerLaw kernel() const { return {muRef, loadRef, exponent, muMin, muMax}; }
    grainfall::laws::friction::Any at_moisture(Real) const override { return kernel(); }
    void validate() const override { kernel().validate(); }
    void postLoad(PowerLawFriction&) { validate(); }
    void pyHandleCustomCtorArgs(boost::python::tuple& args, boost::python::dict& keywords) override {
        take_positional(args, keywords, {"muRef", "loadRef", "exponent", "muMin", "muMax"});
    }
    // clang-format off
    YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(PowerLawFriction, FrictionCurve,
        "mu = muRef (N/loadRef)^-exponent, kept within [muMin, muMax]. Defaults: through 0.8 at 1 N and 0.2 at 20 N (Cole 2015, as MR-2629 section 2.2.2 quotes him). Positional: muRef, loadRef, exponent, muMin, muMax.",
        ((Real, muRef, 0.8, , "friction coefficient at loadRef [-], > 0."))
        ((Real, loadRef, 1.0, , "normal force at which muRef holds [N], > 0."))
        ((Real, exponent, std::log(4.) / std::log(20.), , "exponent [-], >= 0."))
        ((Real, muMin, 0.2, , "lower limit [-], >= 0."))
        ((Real, muMax, 0.8, , "upper limit [-], >= muMin; the power has none as the load goes to zero."))
        ,
        ,
        .def(CheckedAttributes<PowerLawFriction>()
            .add("muRef", &PowerLawFriction::muRef).add("loadRef", &PowerLawFriction::loadRef)
            .add("exponent", &PowerLawFriction::exponent)
            .add("muMin", &PowerLawFriction::muMin).add("muMax", &PowerLawFriction::muMax))
    );
    // clang-format on
};
REGISTER_SERIALIZABLE(PowerLawFriction);

class ExponentialFriction : public FrictionCurve {
public:
    virtual ~ExponentialFriction();
    grainfall::laws::friction::Exponential kernel() const { return {mu0, muInf, loadScale}; }
    grainfall::laws::friction::Any at_moisture(Real) const override { return kernel(); }
    void validate() const override { kernel().validate(); }
    void postLoad(ExponentialFriction&) { validate(); }
    void pyHandleCustomCtorArgs(boost::python::tuple& args, boost::python::dict& keywords) override {
        take_positional(args, keywords, {"mu0", "muInf", "loadScale"});
    }
    // clang-format off
    YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(ExponentialFriction, FrictionCurve,
        "mu = muInf + (mu0 - muInf) exp(-N/loadScale). Positional: mu0, muInf, loadScale.",
        ((Real, mu0, 0.8, , "friction coefficient at vanishing load [-], >= 0."))
        ((Real, muInf, 0.2, , "friction coefficient at high load [-], >= 0."))
        ((Real, loadScale, 5.0, , "normal force over which the coefficient falls [N], > 0."))
        ,
        ,
        .def(CheckedAttributes<ExponentialFriction>()
            .add("mu0", &ExponentialFriction::mu0).add("muInf", &ExponentialFriction::muInf)
            .add("loadScale", &ExponentialFriction::loadScale))
    );
    // clang-format on
};
REGISTER_SERIALIZABLE(ExponentialFriction);

class AsperityFriction : public FrictionCurve {
public:
    virtual ~AsperityFriction();
    grainfall::laws::friction::Asperity kernel() const { return {alpha, c, muMax, muMin}; }
    grainfall::laws::friction::Any at_moisture(Real) const override { return kernel(); }
    void validate() const override { kernel().validate(); }
    void postLoad(AsperityFriction&) { validate(); }
    void pyHandleCustomCtorArgs(boost::python::tuple& args, boost::python::dict& keywords) override {
        take_positional(args, keywords, {"alpha", "c", "muMax", "muMin"});
    }
    // clang-format off
    YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(AsperityFriction, FrictionCurve,
        "mu = alpha + c N^(-1/3), kept within [muMin, muMax]: one elastic asperity with shear strength tau0 + alpha p (Archard 1957). Positional: alpha, c, muMax, muMin.",
        ((Real, alpha, 0.2, , "friction coefficient at high load [-]."))
        ((Real, c, 0.3, , "strength of the load dependence [N^(1/3)], >= 0."))
        ((Real, muMax, 1.0, , "upper limit [-]; the power has none as the load goes to zero."))
        ((Real, muMin, 0.0, , "lower limit [-], >= 0."))
        ,
        ,
        .def(CheckedAttributes<AsperityFriction>()
            .add("alpha", &AsperityFriction::alpha).add("c", &AsperityFriction::c)
            .add("muMax", &AsperityFriction::muMax).add("muMin", &AsperityFriction::muMin))
    );
    // clang-format on
};
REGISTER_SERIALIZABLE(AsperityFriction);

class TableFriction : public FrictionCurve {
public:
    virtual ~TableFriction();
    grainfall::laws::friction::TableGrid kernel() const { return {loads, moistures, mu}; }
    grainfall::laws::friction::Any at_moisture(Real moisture) const override {
        const auto row = kernel().at_moisture(moisture);
        if (loads.size() == 1)
            return grainfall::laws::friction::Constant{row.coefficient(loads[0])}; // nothing to look up
        return row;
    }
    bool depends_on_moisture() const override { return moistures.size() > 1 || moistureFactor; }
    void validate() const override { kernel().validate(); }
    void postLoad(TableFriction&) { validate(); }
    /// Takes mu as one row for each load, or flat; a single row of moistures may be left out.
    void pyHandleCustomCtorArgs(boost::python::tuple& args, boost::python::dict& keywords) override;
    // clang-format off
    YADE_CLASS_BASE_DOC_ATTRS_CTOR(TableFriction, FrictionCurve,
        "Friction coefficient tabulated over load and moisture, bilinear between the points, constant beyond them. Positional: loads, moistures, mu, where mu has one row for each load and one column for each moisture.",
        ((vector<Real>, loads, vector<Real>({1.}), , "normal forces [N], increasing."))
        ((vector<Real>, moistures, vector<Real>({0.}), , "gravimetric moistures [-], increasing."))
        ((vector<Real>, mu, vector<Real>({0.5}), , "friction coefficients [-], >= 0, row by row: mu[i*len(moistures)+j] at loads[i], moistures[j]."))
        ,
    );
    // clang-format on
};
REGISTER_SERIALIZABLE(TableFriction);

class CombinedFriction : public FrictionCurve {
public:
    virtual ~CombinedFriction();
    grainfall::laws::friction::Any at_moisture(Real moisture) const override;
    bool depends_on_moisture() const override;
    void validate() const override;
    void postLoad(CombinedFriction&) { validate(); }
    void pyHandleCustomCtorArgs(boost::python::tuple& args, boost::python::dict& keywords) override;
    // clang-format off
    YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(CombinedFriction, FrictionCurve,
        "Friction of two unlike surfaces: both curves read at the same load, then a rule. Positional: first, second, rule.",
        ((shared_ptr<FrictionCurve>, first, make_constant_friction(0.5), , "curve of one surface (or a number)."))
        ((shared_ptr<FrictionCurve>, second, make_constant_friction(0.5), , "curve of the other surface (or a number)."))
        ((std::string, rule, "min", , "'min', 'max', 'mean' or 'geometric'."))
        ,
        ,
        .def(CheckedAttributes<CombinedFriction>().add("rule", &CombinedFriction::rule))
    );
    // clang-format on
};
REGISTER_SERIALIZABLE(CombinedFriction);

} // namespace yade
