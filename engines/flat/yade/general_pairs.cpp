// SPDX-License-Identifier: GPL-2.0-or-later
#include <engines/flat/yade/general_pairs.hpp>

#include <core/InteractionContainer.hpp>
#include <core/State.hpp>
#include <pkg/common/Sphere.hpp>

#include <algorithm>
#include <stdexcept>

namespace yade {

bool may_collide(const Body& first, const Body& second, int avoid_self_interaction) {
    if (first.isClumpMember() && first.clumpId == second.clumpId)
        return false;
    const bool share_mask = first.groupMask & second.groupMask;
    const bool avoid = first.groupMask == second.groupMask && (first.groupMask & avoid_self_interaction);
    return share_mask && !avoid;
}

namespace {

std::pair<Body::id_t, Body::id_t> key(const Body& first, const Body& second) {
    return std::minmax(first.id, second.id);
}

} // namespace

void GeneralPairs::adopt(const shared_ptr<Interaction>& contact, Scene& scene, FunctorLists& functors) {
    Body& first = *Body::byId(contact->getId1(), &scene);
    Body& second = *Body::byId(contact->getId2(), &scene);
    const Found<IGeomFunctor> found = functors.geometry(*first.shape, *second.shape);
    if (!found.functor || found.swapped)
        return; // what made it is gone: it stays as it is
    ++version_;
    places_[key(first, second)] = pairs_.size();
    pairs_.push_back({contact, &first, &second, found.functor, true});
}

void GeneralPairs::forget_those_apart() {
    const auto apart = [](const GeneralPair& pair) { return !pair.contact->isReal(); };
    pairs_.erase(std::remove_if(pairs_.begin(), pairs_.end(), apart), pairs_.end());
    ++version_;
    places_.clear();
    for (size_t i = 0; i < pairs_.size(); ++i)
        places_[key(*pairs_[i].first, *pairs_[i].second)] = i;
}

bool GeneralPair::is_apart() const {
    if (!sphere || contact->isReal() || !bounded->bound)
        return false;
    const Vector3r& centre = sphere->state->pos;
    const Real radius = static_cast<const Sphere&>(*sphere->shape).radius;
    const Vector3r outside = (bounded->bound->min - centre).cwiseMax(centre - bounded->bound->max);
    return outside.maxCoeff() > radius;
}

void GeneralPairs::add(Body& bounded, Body& other, FunctorLists& functors) {
    if (places_.count(key(bounded, other)))
        return;
    Body* first = &bounded;
    Body* second = &other;
    if (first->id > second->id)
        std::swap(first, second);
    const Found<IGeomFunctor> found = functors.geometry(*first->shape, *second->shape);
    if (!found.functor || !may_collide(bounded, other, functors.avoid_self_interaction))
        return;
    if (found.swapped)
        std::swap(first, second);
    ++version_;
    places_[key(bounded, other)] = pairs_.size();
    pairs_.push_back(
        {shared_ptr<Interaction>(new Interaction(first->id, second->id)), first, second, found.functor});
    if (dynamic_cast<const Sphere*>(other.shape.get())) {
        pairs_.back().bounded = &bounded;
        pairs_.back().sphere = &other;
    }
}

void GeneralPairs::step(GeneralPair& pair, Scene& scene, FunctorLists& functors) {
    if (pair.is_apart())
        return;
    const shared_ptr<Interaction>& contact = pair.contact;
    if (!pair.geometry->go(pair.first->shape, pair.second->shape, *pair.first->state, *pair.second->state,
                           Vector3r::Zero(), false, contact)) {
        contact->reset();
        return;
    }
    if (!contact->phys) {
        const auto physics = functors.physics(*pair.first->material, *pair.second->material);
        contact->functorCache.geom = pair.geometry;
        contact->functorCache.phys = physics;
        physics->go(pair.first->material, pair.second->material, contact);
        contact->iterMadeReal = contact->iterLastSeen = scene.iter;
    }
    if (!contact->functorCache.constLaw) { // new, or adopted from a file
        contact->functorCache.constLaw = functors.law(*contact->geom, *contact->phys);
        if (!contact->functorCache.constLaw)
            throw std::runtime_error("no Law2 functor for " + contact->geom->getClassName() + " and " +
                                     contact->phys->getClassName());
    }
    if (!contact->functorCache.constLaw->go(contact->geom, contact->phys, contact.get()))
        contact->reset();
}

void GeneralPairs::act(Scene& scene, FunctorLists& functors) {
    for (GeneralPair& pair : pairs_)
        step(pair, scene, functors);
    InteractionContainer& container = *scene.interactions;
    // Those that ended first: a history that changed face is in the scene once.
    for (GeneralPair& pair : pairs_) {
        Interaction& contact = *pair.contact;
        if (!pair.in_scene || contact.isReal())
            continue;
        container.erase(contact.getId1(), contact.getId2(), contact.linIx);
        pair.in_scene = false;
    }
    for (GeneralPair& pair : pairs_) {
        if (pair.in_scene || !pair.contact->isReal())
            continue;
        container.insert(pair.contact);
        pair.in_scene = true;
    }
}

} // namespace yade
