// SPDX-License-Identifier: GPL-2.0-or-later
#include <engines/flat/yade/functor_lists.hpp>

#include <engines/flat/yade/python_lock.hpp>
#include <laws/yade/Law2_ScGeom_GrainPhys_HertzMindlin.hpp>

#include <core/Omega.hpp>

#include <limits>
#include <stdexcept>

namespace yade {

namespace py = boost::python;

namespace {

constexpr int unrelated = std::numeric_limits<int>::max();

/// How many classes up from `name` its base `base` stands; `unrelated` where it does not.
int distance_to_base(string name, const string& base) {
    const auto& classes = Omega::instance().getDynlibsDescriptor();
    for (int distance = 0; !name.empty(); ++distance) {
        if (name == base)
            return distance;
        const auto known = classes.find(name);
        if (known == classes.end() || known->second.baseClasses.empty())
            break;
        name = *known->second.baseClasses.begin();
    }
    return unrelated;
}

int distance(const vector<string>& types, const string& first, const string& second) {
    const int a = distance_to_base(first, types[0]), b = distance_to_base(second, types[1]);
    return a == unrelated || b == unrelated ? unrelated : a + b;
}

/// The functor whose argument classes are nearest; the other order counts where `both_orders`.
template <class Functor>
Found<Functor> nearest(const vector<shared_ptr<Functor>>& functors, const string& first, const string& second,
                       bool both_orders) {
    Found<Functor> best;
    int least = unrelated;
    for (const auto& functor : functors) {
        const vector<string> types = functor->getFunctorTypes();
        const int straight = distance(types, first, second);
        if (straight < least) {
            least = straight;
            best = {functor, false};
        }
        const int reversed = both_orders ? distance(types, second, first) : unrelated;
        if (reversed < least) {
            least = reversed;
            best = {functor, true};
        }
    }
    return best;
}

/// The pointers are the scene's own: those that Python hands out must not be let go without its lock.
template <class Functor>
vector<shared_ptr<Functor>> functors_of(const py::object& engine, const char* dispatcher) {
    const py::object list = engine.attr(dispatcher).attr("functors");
    vector<shared_ptr<Functor>> functors;
    for (int i = 0; i < py::len(list); ++i) {
        Functor* functor = py::extract<Functor*>(list[i]);
        functors.push_back(boost::dynamic_pointer_cast<Functor>(functor->shared_from_this()));
    }
    return functors;
}

bool flag(const shared_ptr<IGeomFunctor>& functor, const char* name) {
    return py::extract<bool>(py::object(functor).attr(name));
}
Real number(const shared_ptr<IGeomFunctor>& functor, const char* name) {
    return py::extract<double>(py::object(functor).attr(name));
}

} // namespace

void FunctorLists::read(const shared_ptr<Engine>& loop, const shared_ptr<Engine>& collider) {
    const PythonLock lock;
    const py::object engine(loop);
    geometries_ = functors_of<IGeomFunctor>(engine, "geomDispatcher");
    physics_ = functors_of<IPhysFunctor>(engine, "physDispatcher");
    laws_ = functors_of<LawFunctor>(engine, "lawDispatcher");
    bounds_.clear();
    avoid_self_interaction = 0;
    if (collider) {
        const py::object box(collider);
        bounds_ = functors_of<BoundFunctor>(box, "boundDispatcher");
        avoid_self_interaction = py::extract<int>(box.attr("avoidSelfInteractionMask"));
    }
    found_geometries_.clear();
    found_physics_.clear();
    found_laws_.clear();
    grain_law = nullptr;
    for (const auto& law : laws_)
        if (auto* ours = dynamic_cast<Law2_ScGeom_GrainPhys_HertzMindlin*>(law.get()))
            grain_law = ours;
    ratcheting_ = distant_ = false;
    for (const auto& functor : geometries_) {
        const string name = functor->getClassName();
        if (name == "Ig2_Sphere_Sphere_ScGeom") {
            ratcheting_ |= !flag(functor, "avoidGranularRatcheting");
            distant_ |= number(functor, "interactionDetectionFactor") != 1;
        } else if (name == "Ig2_Wall_Sphere_ScGeom") {
            ratcheting_ |= !flag(functor, "noRatch");
        }
    }
    const auto serves = [this](const char* shape, const char* name) -> shared_ptr<IGeomFunctor> {
        const Found<IGeomFunctor> found = nearest(geometries_, shape, "Sphere", true);
        const bool usual = found.functor && !found.swapped && found.functor->getClassName() == name &&
                           number(found.functor, "interactionDetectionFactor") == 1;
        return usual ? found.functor : nullptr;
    };
    usual_boxes_ = serves("Box", "Ig2_Box_Sphere_ScGeom") != nullptr;
    const auto of_solids = serves("SolidOfRevolution", "Ig2_SolidOfRevolution_Sphere_ScGeom");
    usual_solids_ = of_solids != nullptr;
    flat_radius_factor_ = of_solids ? number(of_solids, "flatRadiusFactor") : 0;
}

void FunctorLists::set_scene(Scene* scene) const {
    for (const auto& functor : geometries_) {
        functor->scene = scene;
        functor->preStep();
    }
    for (const auto& functor : physics_)
        functor->scene = scene;
    for (const auto& functor : laws_)
        functor->scene = scene;
    for (const auto& functor : bounds_)
        functor->scene = scene;
}

std::string FunctorLists::obstacle() const {
    const auto serves = [this](const char* first, const char* second, const char* name) {
        const auto found = nearest(geometries_, first, second, true).functor;
        return !found || found->getClassName() == name;
    };
    if (!grain_law)
        return "the law is not Law2_ScGeom_GrainPhys_HertzMindlin";
    if (!serves("Sphere", "Sphere", "Ig2_Sphere_Sphere_ScGeom"))
        return "spheres do not meet by Ig2_Sphere_Sphere_ScGeom";
    if (!serves("Wall", "Sphere", "Ig2_Wall_Sphere_ScGeom"))
        return "spheres and walls do not meet by Ig2_Wall_Sphere_ScGeom";
    if (ratcheting_)
        return "avoidGranularRatcheting or noRatch is off";
    if (distant_)
        return "interactionDetectionFactor is not 1";
    if (bounds_.empty())
        return "no collider in O.engines lends its bounding functors";
    return "";
}

Found<IGeomFunctor> FunctorLists::geometry(const Shape& first, const Shape& second) {
    const Names names{first.getClassName(), second.getClassName()};
    const auto known = found_geometries_.find(names);
    if (known != found_geometries_.end())
        return known->second;
    return found_geometries_[names] = nearest(geometries_, names.first, names.second, true);
}

shared_ptr<IPhysFunctor> FunctorLists::physics(const Material& first, const Material& second) {
    const Names names{first.getClassName(), second.getClassName()};
    const auto known = found_physics_.find(names);
    if (known != found_physics_.end())
        return known->second;
    const auto functor = nearest(physics_, names.first, names.second, true).functor;
    if (!functor)
        throw std::runtime_error("no Ip2 functor for " + names.first + " and " + names.second);
    return found_physics_[names] = functor;
}

shared_ptr<LawFunctor> FunctorLists::law(const IGeom& geometry, const IPhys& physics) {
    const Names names{geometry.getClassName(), physics.getClassName()};
    const auto known = found_laws_.find(names);
    if (known != found_laws_.end())
        return known->second;
    return found_laws_[names] = nearest(laws_, names.first, names.second, false).functor;
}

shared_ptr<BoundFunctor> FunctorLists::bound(const Shape& shape) {
    shared_ptr<BoundFunctor> best;
    int least = unrelated;
    for (const auto& functor : bounds_) {
        const int steps = distance_to_base(shape.getClassName(), functor->getFunctorTypes()[0]);
        if (steps < least) {
            least = steps;
            best = functor;
        }
    }
    return best;
}

} // namespace yade
