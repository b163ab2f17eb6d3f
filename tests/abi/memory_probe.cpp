// SPDX-License-Identifier: GPL-2.0-or-later
// Reads and writes members of live YADE objects by address and type, and calls virtual functions through the
// tables that our declarations describe.
#include "../../python/module/register_classes.hpp"

#include <lib/base/Math.hpp>
#include <lib/factory/ClassFactory.hpp>
#include <lib/base/Logging.hpp>
#include <lib/multimethods/Indexable.hpp>
#include <core/Dispatching.hpp>
#include <core/Engine.hpp>
#include <core/Omega.hpp>
#include <core/Scene.hpp>

#include <cstdint>
#include <functional>

namespace {

namespace py = boost::python;
using namespace yade;
using Address = std::uintptr_t;

struct Access {
    std::function<py::object(Address)> read;
    std::function<void(Address, const py::object&)> write;
};

template <class T>
Access access() {
    return {[](Address at) { return py::object(*reinterpret_cast<const T*>(at)); },
            [](Address at, const py::object& value) { *reinterpret_cast<T*>(at) = py::extract<T>(value)(); }};
}

// All pointers to YADE objects look alike, because Serializable stands first in each of them.
const std::map<std::string, Access>& types() {
    static const std::map<std::string, Access> table = {
        {"Real", access<Real>()},
        {"int", access<int>()},
        {"unsigned", access<unsigned>()},
        {"long", access<long>()},
        {"unsigned long", access<unsigned long>()},
        {"bool", access<bool>()},
        {"string", access<std::string>()},
        {"Vector3r", access<Vector3r>()},
        {"Vector3i", access<Vector3i>()},
        {"Quaternionr", access<Quaternionr>()},
        {"Matrix3r", access<Matrix3r>()},
        {"Se3r", access<Se3r>()},
        {"vector<int>", access<std::vector<int>>()},
        {"vector<string>", access<std::vector<std::string>>()},
        {"vector<Vector3r>", access<std::vector<Vector3r>>()},
        {"shared_ptr", access<shared_ptr<Serializable>>()},
    };
    return table;
}

py::object read_member(Address at, const std::string& type) {
    return types().at(type).read(at);
}
void write_member(Address at, const std::string& type, const py::object& value) {
    types().at(type).write(at, value);
}
Address pointer(Address at) {
    return *reinterpret_cast<const Address*>(at);
}
Address address(const Serializable& object) {
    return reinterpret_cast<Address>(&object);
}

/// Results of virtual functions, each reached through the slot that our headers give it.
py::dict call_virtual_functions(Serializable& object) {
    py::dict results;
    results["getClassName"] = object.getClassName();
    results["getBaseClassName"] = object.getBaseClassName(0);
    results["getBaseClassNumber"] = object.getBaseClassNumber();
    results["pyDict"] = object.pyDict();
    if (const auto* indexable = dynamic_cast<const Indexable*>(&object)) {
        results["getClassIndex"] = indexable->getClassIndex();
        results["getMaxCurrentlyUsedClassIndexOfKin"] = indexable->getMaxCurrentlyUsedClassIndexOfKin();
    }
    if (const auto* material = dynamic_cast<const Material*>(&object))
        results["newAssocState"] = material->newAssocState()->getClassName();
    if (auto* engine = dynamic_cast<Engine*>(&object))
        results["isActivated"] = engine->isActivated();
    return results;
}

/// Argument classes of a geometry functor, and their order if it has one. Base classes throw.
py::tuple functor_arguments(const IGeomFunctor& functor) {
    return py::make_tuple(functor.getFunctorTypes(), functor.checkOrder());
}

/// Addresses of what only a scene knows, found by ordinary member access.
py::dict scene_parts() {
    Scene& scene = *Omega::instance().getScene();
    const auto at = [](const auto& object) { return reinterpret_cast<Address>(&object); };
    py::dict parts;
    parts["Scene"] = at(scene);
    parts["ForceContainer"] = at(scene.forces);
    parts["BodyContainer"] = at(*scene.bodies);
    parts["InteractionContainer"] = at(*scene.interactions);
    parts["EnergyTracker"] = at(*scene.energy);
    parts["Cell"] = at(*scene.cell);
    return parts;
}

/// Offsets as compiled code sees them, to compare with what the debug information says.
py::dict compiled_offsets() {
    Scene& scene = *Omega::instance().getScene();
    State state;
    const auto offset = [](const auto& object, const auto& member) {
        return reinterpret_cast<Address>(&member) - reinterpret_cast<Address>(&object);
    };
    py::dict offsets;
    offsets["Scene.dt"] = offset(scene, scene.dt);
    offsets["Scene.cell"] = offset(scene, scene.cell);
    offsets["Cell.hSize"] = offset(*scene.cell, scene.cell->hSize);
    offsets["State.vel"] = offset(state, state.vel);
    offsets["State.densityScaling"] = offset(state, state.densityScaling);
    return offsets;
}

py::list plugin_classes() {
    py::list names;
    for (const std::string& name : ClassFactory::instance().pluginClasses)
        names.append(name);
    return names;
}

py::list register_classes() {
    py::list names;
    for (const std::string& name : grainfall::register_new_classes())
        names.append(name);
    return names;
}

} // namespace

BOOST_PYTHON_MODULE(abi_probe) {
    py::def("read", &read_member);
    py::def("write", &write_member);
    py::def("pointer", &pointer);
    py::def("address", &address);
    py::def("call_virtual_functions", &call_virtual_functions);
    py::def("functor_arguments", &functor_arguments);
    py::def("scene_parts", &scene_parts);
    py::def("compiled_offsets", &compiled_offsets);
    py::def("plugin_classes", &plugin_classes);
    py::def("register_classes", &register_classes);
}
