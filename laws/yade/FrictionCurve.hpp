// SPDX-License-Identifier: GPL-2.0-or-later
// Friction curves as objects that a script makes, names, saves and hands to materials.
//
// They hold parameters and check them; the mathematics is in laws/friction/. When a contact is made its curve
// is resolved into plain numbers, with the contact's moisture and load scale folded in, so that neither costs
// anything in the contact loop.
#pragma once

#include <laws/friction/any.hpp>
#include <laws/yade/attribute_checks.hpp>

#include <memory>

#include <lib/base/Math.hpp>
#include <lib/serialization/Serializable.hpp>

namespace yade {

/// A curve as plain numbers, moisture and load scale folded in.
using ResolvedFriction = std::shared_ptr<const grainfall::laws::friction::Any>;

/// Dependence of friction on water content alone, as a factor.
class MoistureFactor : public Serializable {
public:
    virtual ~MoistureFactor();
    void validate() const;
    void postLoad(MoistureFactor&) { validate(); }
    Real factor(Real moisture) const;
    void pyHandleCustomCtorArgs(boost::python::tuple& args, boost::python::dict& keywords) override;

    // clang-format off
    YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(MoistureFactor, Serializable,
        "Factor on a friction coefficient as a function of gravimetric moisture: straight lines between the points, constant beyond them.",
        ((vector<Real>, moistures, vector<Real>({0.}), , "gravimetric moistures [-], increasing."))
        ((vector<Real>, factors, vector<Real>({1.}), , "factor at each moisture [-], >= 0."))
        ,
        ,
        .def("factor", &MoistureFactor::factor, (boost::python::arg("moisture")), "Factor [-] at a gravimetric moisture [-].")
    );
    // clang-format on
};
REGISTER_SERIALIZABLE(MoistureFactor);

/// Base of all curves.
class FrictionCurve : public Serializable {
public:
    virtual ~FrictionCurve();

    /// The curve at this moisture, without the moisture factor.
    virtual grainfall::laws::friction::Any at_moisture(Real moisture) const;
    /// Throws std::invalid_argument naming attribute, value and allowed range.
    virtual void validate() const {}
    virtual bool depends_on_moisture() const { return bool(moistureFactor); }
    bool depends_on_load() const;

    /// The curve as a contact reads it: at its moisture, at the normal force divided by `load_scale`.
    ResolvedFriction resolve(Real moisture, Real load_scale) const;
    /// Friction coefficient [-] at a normal force [N] and gravimetric moisture [-].
    Real coefficient(Real load, Real moisture) const;

    // clang-format off
    YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(FrictionCurve, Serializable,
        "Friction coefficient between grains as a function of normal force and moisture. Give one to :yref:`GrainMat.friction`.",
        ((shared_ptr<MoistureFactor>, moistureFactor, , , "factor by which moisture changes this friction; None: moisture has no influence."))
        ,
        ,
        .def("coefficient", &FrictionCurve::coefficient, (boost::python::arg("load"), boost::python::arg("moisture") = 0.),
             "Friction coefficient [-] at a normal force [N] and a gravimetric moisture [-].")
        .def("validate", &FrictionCurve::validate, "Raise ValueError naming attribute, value and allowed range if a parameter is bad.")
        .add_property("dependsOnLoad", &FrictionCurve::depends_on_load, "Does it change with the normal force?")
        .add_property("dependsOnMoisture", &FrictionCurve::depends_on_moisture, "Does it change with the moisture?")
    );
    // clang-format on
};
REGISTER_SERIALIZABLE(FrictionCurve);

shared_ptr<FrictionCurve> make_constant_friction(Real coefficient);

/// None, a curve, or a number (a constant); anything else is an error naming `attribute`.
boost::python::object to_friction_curve(const boost::python::object& value, const std::string& attribute);

/// Moves positional constructor arguments to the keywords of these names, as Python's own functions do.
void take_positional(boost::python::tuple& args, boost::python::dict& keywords,
                     const std::vector<const char*>& names);

/// Class definition visitor: makes the attribute `friction` accept a number as well as a curve.
template <class Class>
class FrictionProperty : public boost::python::def_visitor<FrictionProperty<Class>> {
public:
    explicit FrictionProperty(std::string attribute) : attribute_(std::move(attribute)) {}

private:
    friend class boost::python::def_visitor_access;
    std::string attribute_;

    template <class ClassObject>
    void visit(ClassObject& target) const {
        namespace py = boost::python;
        auto get = [](const Class& self) { return self.friction; };
        auto set = [attribute = attribute_](Class& self, const py::object& value) {
            self.friction = py::extract<shared_ptr<FrictionCurve>>(to_friction_curve(value, attribute));
        };
        const py::object doc = target.attr("friction").attr("__doc__");
        py::setattr(target, "friction",
                    py::import("builtins")
                        .attr("property")(
                            py::make_function(get, py::default_call_policies(),
                                              boost::mpl::vector<shared_ptr<FrictionCurve>, const Class&>()),
                            py::make_function(set, py::default_call_policies(),
                                              boost::mpl::vector<void, Class&, const py::object&>()),
                            py::object(), doc));
    }
};

} // namespace yade
