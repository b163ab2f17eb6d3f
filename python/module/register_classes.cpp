// SPDX-License-Identifier: GPL-2.0-or-later
#include "register_classes.hpp"

#include <lib/base/Math.hpp>
#include <lib/factory/ClassFactory.hpp>
#include <core/Omega.hpp>

#include <stdexcept>

namespace grainfall {

namespace {

using RegisterClasses = void (yade::Omega::*)(const std::vector<std::string>&);

RegisterClasses register_classes();

// YADE registers its own classes through a private member function, because it never meant classes to arrive
// after the start. Arguments of an explicit instantiation are exempt from access control: that is the door
// taken here.
template <RegisterClasses function>
struct Door {
    friend RegisterClasses register_classes() { return function; }
};
template struct Door<&yade::Omega::buildDynlibDatabase>;

} // namespace

std::vector<std::string> register_new_classes() {
    yade::Omega& omega = yade::Omega::instance();
    const auto& known = omega.getDynlibsDescriptor();
    std::vector<std::string> names;
    for (const std::string& name : yade::ClassFactory::instance().pluginClasses)
        if (known.count(name) == 0)
            names.push_back(name);

    (omega.*register_classes())(names);

    const boost::python::object wrapper = boost::python::import("yade.wrapper");
    for (const std::string& name : names)
        if (!PyObject_HasAttrString(wrapper.ptr(), name.c_str()))
            throw std::runtime_error("YADE did not accept the class " + name);
    return names;
}

} // namespace grainfall
