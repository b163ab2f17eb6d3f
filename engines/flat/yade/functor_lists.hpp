// SPDX-License-Identifier: GPL-2.0-or-later
// The functors that a scene was given, and which of them serves a pair.
#pragma once

#include <core/Dispatching.hpp>
#include <core/Engine.hpp>

#include <map>
#include <utility>

namespace yade {

class Law2_ScGeom_GrainPhys_HertzMindlin;
class Collider;

template <class Functor>
struct Found {
    shared_ptr<Functor> functor; // null: none serves
    bool swapped = false;        // it takes the two in the other order
};

class FunctorLists {
public:
    /// Reads the lists of the loop and of the collider; asks Python, so not to be done in a parallel region.
    void read(const shared_ptr<Engine>& loop, const shared_ptr<Engine>& collider);
    /// Before each step.
    void set_scene(Scene* scene) const;

    Found<IGeomFunctor> geometry(const Shape& first, const Shape& second);
    /// Throws std::runtime_error if there is none.
    shared_ptr<IPhysFunctor> physics(const Material& first, const Material& second);
    /// Of pairs that were asked for before; may be asked by several threads at once.
    const shared_ptr<IGeomFunctor>& known_geometry(const Shape& first, const Shape& second) const {
        return found_geometries_.at({first.getClassName(), second.getClassName()}).functor;
    }
    const shared_ptr<IPhysFunctor>& known_physics(const Material& first, const Material& second) const {
        return found_physics_.at({first.getClassName(), second.getClassName()});
    }
    shared_ptr<LawFunctor> law(const IGeom& geometry, const IPhys& physics);
    shared_ptr<BoundFunctor> bound(const Shape& shape);

    /// Do spheres meet boxes, and solids of revolution, by the usual geometry?
    bool usual_boxes() const { return usual_boxes_; }
    bool usual_solids() const { return usual_solids_; }
    /// Of flat places of solids, over the sphere's.
    Real flat_radius_factor() const { return flat_radius_factor_; }
    /// Why contacts of spheres and walls with these functors cannot run on the flat path; empty if they can.
    std::string obstacle() const;

    Law2_ScGeom_GrainPhys_HertzMindlin* grain_law = nullptr;
    int avoid_self_interaction = 0; // the collider's mask

private:
    vector<shared_ptr<IGeomFunctor>> geometries_;
    vector<shared_ptr<IPhysFunctor>> physics_;
    vector<shared_ptr<LawFunctor>> laws_;
    vector<shared_ptr<BoundFunctor>> bounds_;
    bool ratcheting_ = false, distant_ = false, usual_boxes_ = false, usual_solids_ = false;
    Real flat_radius_factor_ = 0;

    using Names = std::pair<string, string>;
    std::map<Names, Found<IGeomFunctor>> found_geometries_;
    std::map<Names, shared_ptr<IPhysFunctor>> found_physics_;
    std::map<Names, shared_ptr<LawFunctor>> found_laws_;
};

} // namespace yade
