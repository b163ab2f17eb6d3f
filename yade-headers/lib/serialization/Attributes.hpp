// SPDX-License-Identifier: GPL-2.0-or-later
// Facts: attribute flags and their numbers; what YADE appends to an attribute's help text; which types Python
// gets by reference; the order of hooks around loading and saving. Verified: tests/abi (doc strings, dict(),
// files).
//
// An attribute is described once, as Attribute<pointer to member, flags>; each use (set, dict, save, class
// definition) is one function that visits these descriptions.
#pragma once

#include <lib/base/Math.hpp>

#include <boost/serialization/nvp.hpp>

namespace yade {

namespace Attr {
enum flags { noSave = 1, readonly = 2, triggerPostLoad = 4, hidden = 8, noResize = 16 };
}

namespace abi {
template <class Class, class Type>
Type typeOfMember(Type Class::*);

template <auto member, int flags_>
struct Attribute {
    using Type = decltype(typeOfMember(member));
    static constexpr auto pointer = member;
    static constexpr int flags = flags_;
    const char* name;
    const char* doc;
};

/// A member's initial value as the attribute tuple spells it (nothing: value-initialised).
template <class T, class... Arguments>
T initial(Arguments&&... arguments) {
    return T(std::forward<Arguments>(arguments)...);
}

/// Python may change these in place: O.bodies[0].state.vel[2] = 1.
template <class T>
constexpr bool returnedByReference = false;
template <>
inline constexpr bool returnedByReference<Vector2r> = true;
template <>
inline constexpr bool returnedByReference<Vector2i> = true;
template <>
inline constexpr bool returnedByReference<Vector3r> = true;
template <>
inline constexpr bool returnedByReference<Vector3i> = true;
template <>
inline constexpr bool returnedByReference<Quaternionr> = true;
template <>
inline constexpr bool returnedByReference<Matrix3r> = true;

template <class Class>
bool setAttribute(Class& object, const string& key, const boost::python::object& value) {
    bool found = false;
    Class::visitAttributes([&](auto attribute) {
        using Description = decltype(attribute);
        if constexpr (!(Description::flags & Attr::hidden)) {
            if (found || key != attribute.name)
                return;
            object.*Description::pointer = boost::python::extract<typename Description::Type>(value)();
            found = true;
        }
    });
    return found;
}

template <class Class>
boost::python::dict attributeDict(const Class& object, const boost::python::dict& custom,
                                  const boost::python::dict& inherited) {
    boost::python::dict dict;
    Class::visitAttributes([&](auto attribute) {
        using Description = decltype(attribute);
        if constexpr (!(Description::flags & Attr::hidden))
            dict[attribute.name] = boost::python::object(object.*Description::pointer);
    });
    dict.update(custom);
    dict.update(inherited);
    return dict;
}

template <class Archive, class Class>
void archiveAttributes(Archive& archive, Class& object) {
    Class::visitAttributes([&](auto attribute) {
        using Description = decltype(attribute);
        if constexpr (!(Description::flags & Attr::noSave))
            archive& boost::serialization::make_nvp(attribute.name, object.*Description::pointer);
    });
}

template <class Class, class Type, Type Class::*member>
void setAndPostLoad(Class& object, const Type& value) {
    object.*member = value;
    object.callPostLoad();
}

template <class Class, class Type>
boost::python::object attributeGetter(Type Class::*member) {
    namespace bp = boost::python;
    if constexpr (returnedByReference<Type>)
        return bp::make_getter(member, bp::return_internal_reference<>());
    else
        return bp::make_getter(member, bp::return_value_policy<bp::return_by_value>());
}

template <class Class, class PyClass>
void defineAttributes(PyClass& pyClass) {
    Class::visitAttributes([&](auto attribute) {
        using Description = decltype(attribute);
        constexpr int flags = Description::flags;
        constexpr auto member = Description::pointer;
        if constexpr (!(flags & Attr::hidden)) {
            const string doc = string(attribute.doc) + " :yattrflags:`" + std::to_string(flags) + "` ";
            const auto get = attributeGetter(member);
            if constexpr (flags & Attr::readonly)
                pyClass.add_property(attribute.name, get, doc.c_str());
            else if constexpr (flags & Attr::triggerPostLoad)
                pyClass.add_property(attribute.name, get,
                                     &setAndPostLoad<Class, typename Description::Type, member>, doc.c_str());
            else
                pyClass.add_property(attribute.name, get, boost::python::make_setter(member), doc.c_str());
        }
    });
}
} // namespace abi

template <class T>
void preLoad(T&) {}
template <class T>
void postLoad(T&) {}
template <class T>
void preSave(T&) {}
template <class T>
void postSave(T&) {}

} // namespace yade
