// SPDX-License-Identifier: GPL-2.0-or-later
#include <laws/friction/moisture_factor.hpp>
#include <laws/yade/ContactClass.hpp>
#include <laws/yade/FrictionCurves.hpp>

namespace yade {

YADE_PLUGIN((
    MoistureFactor)(FrictionCurve)(ConstantFriction)(PowerLawFriction)(ExponentialFriction)(AsperityFriction)(TableFriction)(CombinedFriction));

// Defined here so that virtual tables and Python registration are compiled once.
MoistureFactor::~MoistureFactor() = default;
FrictionCurve::~FrictionCurve() = default;
ConstantFriction::~ConstantFriction() = default;
PowerLawFriction::~PowerLawFriction() = default;
ExponentialFriction::~ExponentialFriction() = default;
AsperityFriction::~AsperityFriction() = default;
TableFriction::~TableFriction() = default;
CombinedFriction::~CombinedFriction() = default;

namespace py = boost::python;
namespace gl = grainfall::laws;

namespace {
gl::friction::MoistureFactor kernel_of(const MoistureFactor& factor) {
    return {factor.moistures, factor.factors};
}
} // namespace

void MoistureFactor::validate() const {
    kernel_of(*this).validate();
}
Real MoistureFactor::factor(Real moisture) const {
    return kernel_of(*this).at(moisture);
}

void MoistureFactor::pyHandleCustomCtorArgs(py::tuple& args, py::dict& keywords) {
    take_positional(args, keywords, {"moistures", "factors"});
}

gl::friction::Any FrictionCurve::at_moisture(Real) const {
    throw std::invalid_argument("FrictionCurve is a base class: use ConstantFriction, PowerLawFriction, "
                                "ExponentialFriction, AsperityFriction, TableFriction or CombinedFriction");
}

bool FrictionCurve::depends_on_load() const {
    return form_of(at_moisture(0)) != FrictionForm::constant;
}

ResolvedFriction FrictionCurve::resolve(Real moisture, Real load_scale) const {
    const Real factor = moistureFactor ? moistureFactor->factor(moisture) : 1;
    return std::make_shared<const gl::friction::Any>(
        at_moisture(moisture).scaled(factor).with_load_scale(load_scale));
}

Real FrictionCurve::coefficient(Real load, Real moisture) const {
    gl::require_not_negative("load", load);
    gl::require_not_negative("moisture", moisture);
    return resolve(moisture, 1)->coefficient(load);
}

void TableFriction::pyHandleCustomCtorArgs(py::tuple& args, py::dict& keywords) {
    take_positional(args, keywords, {"loads", "moistures", "mu"});
    if (!keywords.has_key("mu"))
        return;
    const py::object rows(keywords["mu"]);
    py::list flat;
    const py::ssize_t columns = keywords.has_key("moistures") ? py::len(keywords["moistures"]) : 1;
    for (py::ssize_t i = 0; i < py::len(rows); ++i) {
        const py::object row(rows[i]);
        if (!PySequence_Check(row.ptr())) {
            flat.append(row);
            continue;
        }
        gl::require_length("TableFriction.mu[" + std::to_string(i) + "]", py::len(row), columns,
                           "one value for each moisture");
        flat.extend(row);
    }
    keywords["mu"] = flat;
}

gl::friction::Any CombinedFriction::at_moisture(Real moisture) const {
    return gl::friction::Any::combined(*first->resolve(moisture, 1), *second->resolve(moisture, 1),
                                       gl::combination_rule_from_name("CombinedFriction.rule", rule));
}

bool CombinedFriction::depends_on_moisture() const {
    return moistureFactor || first->depends_on_moisture() || second->depends_on_moisture();
}

void CombinedFriction::validate() const {
    if (!first)
        gl::reject("CombinedFriction.first", "None", "a friction curve or a number");
    if (!second)
        gl::reject("CombinedFriction.second", "None", "a friction curve or a number");
    gl::combination_rule_from_name("CombinedFriction.rule", rule);
    first->validate();
    second->validate();
}

void CombinedFriction::pyHandleCustomCtorArgs(py::tuple& args, py::dict& keywords) {
    take_positional(args, keywords, {"first", "second", "rule"});
    for (const char* name : {"first", "second"})
        if (keywords.has_key(name))
            keywords[name] = to_friction_curve(keywords[name], std::string("CombinedFriction.") + name);
}

shared_ptr<FrictionCurve> make_constant_friction(Real coefficient) {
    auto curve = shared_ptr<ConstantFriction>(new ConstantFriction);
    curve->mu = coefficient;
    curve->validate();
    return curve;
}

py::object to_friction_curve(const py::object& value, const std::string& attribute) {
    if (value.is_none() || py::extract<shared_ptr<FrictionCurve>>(value).check())
        return value;
    const py::extract<Real> number(value);
    if (PyBool_Check(value.ptr()) || !number.check())
        gl::reject(attribute, py::extract<std::string>(py::str(value)),
                   "a friction curve (ConstantFriction, PowerLawFriction, ...), a number >= 0 or None");
    gl::require_not_negative(attribute, number());
    return py::object(make_constant_friction(number()));
}

void take_positional(py::tuple& args, py::dict& keywords, const std::vector<const char*>& names) {
    const auto given = static_cast<std::size_t>(py::len(args));
    if (given > names.size())
        throw std::invalid_argument("at most " + std::to_string(names.size()) +
                                    " positional arguments, got " + std::to_string(given));
    for (std::size_t i = 0; i < given; ++i) {
        if (keywords.has_key(names[i]))
            throw std::invalid_argument(std::string("argument '") + names[i] + "' given twice");
        keywords[names[i]] = args[i];
    }
    args = py::tuple();
}

} // namespace yade
