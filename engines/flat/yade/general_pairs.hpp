// SPDX-License-Identifier: GPL-2.0-or-later
// Contacts that the flat path does not know, each in YADE's own way: geometry, physics and law functor.
#pragma once

#include <engines/flat/yade/functor_lists.hpp>

#include <core/Body.hpp>
#include <core/Interaction.hpp>
#include <core/Scene.hpp>

#include <vector>

namespace yade {

/// One pair that is near, real or not; in the scene's container only while it is real.
struct GeneralPair {
    shared_ptr<Interaction> contact;
    Body* first;
    Body* second;
    shared_ptr<IGeomFunctor> geometry;
    bool in_scene = false; // is the contact in the scene's container?
    // Where one is a sphere, and the other a body whose bound is that of this step.
    const Body* bounded = nullptr;
    const Body* sphere = nullptr;

    /// Certainly no contact, and quicker to see than by the geometry functor.
    bool is_apart() const;
};

class GeneralPairs {
public:
    void clear() {
        pairs_.clear();
        ++version_;
    }
    size_t size() const { return pairs_.size(); }
    const vector<GeneralPair>& all() const { return pairs_; }
    /// Another number whenever there are other pairs.
    long version() const { return version_; }

    /// Takes a contact that is in the scene already.
    void adopt(const shared_ptr<Interaction>& contact, Scene& scene, FunctorLists& functors);
    /// Keeps what is real; `add` then completes the list.
    void forget_those_apart();
    /// `bounded`: its bound is kept up to date.
    void add(Body& bounded, Body& other, FunctorLists& functors);

    /// Forces of this step, into scene.forces.
    void act(Scene& scene, FunctorLists& functors);

private:
    vector<GeneralPair> pairs_;
    long version_ = 0;
    std::map<std::pair<Body::id_t, Body::id_t>, size_t> places_;

    static void step(GeneralPair& pair, Scene& scene, FunctorLists& functors);
};

/// As YADE's collider decides.
bool may_collide(const Body& first, const Body& second, int avoid_self_interaction);

} // namespace yade
