// SPDX-License-Identifier: GPL-2.0-or-later
// Attributes that refuse a bad value and keep the good one.
//
// YADE's own setters store first and ask later, and those of inherited attributes do not ask at all, so that
// a negative modulus is noticed inside the interaction loop, where an exception ends the process. A class
// that names its attributes here gets, in Python, setters that call its validate() and roll back when it
// throws.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <boost/python.hpp>

namespace yade {

/// Class definition visitor: `.def(CheckedAttributes<GrainMat>().add("young", &GrainMat::young))`.
template <class Class>
class CheckedAttributes : public boost::python::def_visitor<CheckedAttributes<Class>> {
public:
    template <class Type, class Owner>
    CheckedAttributes& add(std::string name, Type Owner::*member) {
        namespace py = boost::python;
        auto get = [member](const Class& self) -> Type { return self.*member; };
        auto set = [member, accepted = accepted_](Class& self, const Type& value) {
            Type previous = std::exchange(self.*member, value);
            try {
                self.validate();
                if (accepted)
                    (self.*accepted)();
            } catch (...) {
                self.*member = std::move(previous);
                throw;
            }
        };
        properties_.emplace_back(
            std::move(name),
            py::make_function(get, py::default_call_policies(), boost::mpl::vector<Type, const Class&>()),
            py::make_function(set, py::default_call_policies(),
                              boost::mpl::vector<void, Class&, const Type&>()));
        return *this;
    }

    /// Calls this member function after each accepted change of the attributes that are added later.
    CheckedAttributes& then(void (Class::*accepted)()) {
        accepted_ = accepted;
        return *this;
    }

private:
    friend class boost::python::def_visitor_access;
    void (Class::*accepted_)() = nullptr;

    struct Property {
        std::string name;
        boost::python::object get;
        boost::python::object set;
        Property(std::string n, boost::python::object g, boost::python::object s)
            : name(std::move(n)), get(std::move(g)), set(std::move(s)) {}
    };
    std::vector<Property> properties_;

    template <class ClassObject>
    void visit(ClassObject& target) const {
        namespace py = boost::python;
        const py::object make_property = py::import("builtins").attr("property");
        for (const Property& p : properties_) {
            // The doc string, with its default and type, is the one that the attribute macro wrote.
            const py::object doc = target.attr(p.name.c_str()).attr("__doc__");
            py::setattr(target, p.name.c_str(), make_property(p.get, p.set, py::object(), doc));
        }
    }
};

} // namespace yade
