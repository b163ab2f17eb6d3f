// SPDX-License-Identifier: GPL-2.0-or-later
// Which spheres touch the wall, and where: contacts that come, go, and pass from face to face.
#include <femlink/yade/FemWall.hpp>

#include <femlink/core/surface_contacts.hpp>
#include <laws/yade/GrainEffectPhys.hpp>

#include <core/Scene.hpp>
#include <pkg/common/Sphere.hpp>

#include <algorithm>

namespace yade {

namespace fl = grainfall::femlink;

namespace {
constexpr size_t nowhere = static_cast<size_t>(-1);
}

size_t FemWall::known_touch(const Places& of_sphere, const FacePair& pair) const {
    for (auto place = of_sphere.first; place != of_sphere.second; ++place)
        if (faces[static_cast<size_t>(touches_[place->second].place.face)] == pair.face->id)
            return place->second;
    return nowhere;
}

/// Contacts keep their places, so that the solver's matrix changes only where they do.
size_t FemWall::new_touch() {
    for (size_t i = 0; i < touches_.size(); ++i)
        if (touches_[i].is_empty())
            return i;
    touches_.emplace_back();
    partners_.emplace_back();
    return touches_.size() - 1;
}

void FemWall::forget_touch(size_t place) {
    touches_[place] = fl::WallTouch();
    partners_[place] = Partner();
}

Real FemWall::radius_of(size_t place) const {
    return static_cast<const Sphere&>(*partners_[place].sphere->shape).radius;
}

void FemWall::find_touches(const vector<FacePair>& pairs) {
    places_.clear();
    for (size_t i = 0; i < touches_.size(); ++i) {
        partners_[i].found = false;
        if (!touches_[i].is_empty())
            places_.emplace_back(touches_[i].sphere, i);
    }
    std::sort(places_.begin(), places_.end());
    for (auto begin = pairs.begin(); begin != pairs.end();) {
        const auto end = std::find_if(begin, pairs.end(),
                                      [&](const FacePair& pair) { return pair.sphere != begin->sphere; });
        find_touches_of(begin, end);
        begin = end;
    }
    contacts = 0;
    for (size_t i = 0; i < touches_.size(); ++i) {
        if (touches_[i].is_empty())
            continue;
        if (partners_[i].found)
            ++contacts;
        else
            forget_touch(i);
    }
}

/// Pairs of one sphere.
void FemWall::find_touches_of(NextPair begin, NextPair end) {
    const Body& sphere = *begin->sphere;
    const Real radius = static_cast<const Sphere&>(*sphere.shape).radius;
    const Vector3r centre = sphere.state->pos - shift;
    const Places known{
        std::lower_bound(places_.begin(), places_.end(), Place(sphere.id, 0)),
        std::upper_bound(places_.begin(), places_.end(), Place(sphere.id, nowhere)),
    };
    auto& [near, held, found, placed] = look_;
    near.clear();
    held.clear();
    // A wall that is pressed in comes back as the load leaves it, so all that is inside the unloaded wall
    // takes part. One with inertia is where it is, but a contact sees it as its patch does, which beside a
    // dent is not where the surface lies: all that is no farther off than the wall has moved takes part, or
    // it would begin with an overlap. A bridge holds on further out.
    Real reach = radius + largest_displacement_;
    for (auto pair = begin; pair != end; ++pair) {
        const int face = face_of(pair->face->id);
        near.push_back(face);
        const size_t place = known_touch(known, *pair);
        if (place != nowhere)
            held.push_back({face, touches_[place].anchor.at});
        const auto* phys = dynamic_cast<const GrainPhys*>(pair->contact->phys.get());
        if (phys && bridge_of(*phys)) {
            reach = std::max(reach, 1.5 * radius);
            has_bridges_ = true;
        }
    }
    const auto pair_of = [&](int face) {
        return std::find_if(begin, end, [&](const FacePair& pair) { return face_of(pair.face->id) == face; });
    };
    fl::find_surface_contacts(wall_->surface(), positions_, near, held, centre, reach, found);
    const auto takes_part = [&](const fl::SurfaceContact& contact, bool is_real) {
        return is_real || contact.distance < radius ||
               (continuum ? contact.distance < radius + largest_displacement_
                          : wall_->free_overlap(contact, centre, radius) > 0);
    };
    placed.assign(found.size(), 0);
    for (size_t k = 0; k < found.size(); ++k) { // where they were
        const auto pair = pair_of(found[k].face);
        const size_t place = known_touch(known, *pair);
        if (place == nowhere || !takes_part(found[k], pair->contact->isReal()))
            continue;
        follow(place, found[k], *pair);
        placed[k] = 1;
    }
    for (size_t k = 0; k < found.size(); ++k) { // from another face
        for (auto place = known.first; place != known.second; ++place) {
            const size_t i = place->second;
            Partner& old = partners_[i];
            if (placed[k] || old.found || !old.contact ||
                touches_[i].anchor.normal.dot(found[k].normal) < fl::smooth_cosine ||
                !takes_part(found[k], old.contact->isReal()))
                continue;
            const auto pair = pair_of(found[k].face);
            carry(*old.contact, *pair->contact);
            follow(i, found[k], *pair);
            placed[k] = 1;
        }
    }
    for (size_t k = 0; k < found.size(); ++k) { // new
        if (placed[k] || !takes_part(found[k], false))
            continue;
        const size_t place = new_touch();
        touches_[place].sphere = sphere.id;
        follow(place, found[k], *pair_of(found[k].face));
        touches_[place].seen = touches_[place].seen_before = wall_->seen(touches_[place].site);
    }
}

/// A contact's history goes with it to the next face.
void FemWall::carry(Interaction& from, Interaction& to) const {
    if (!from.isReal())
        return;
    to.geom = from.geom;
    to.phys = from.phys;
    to.functorCache = from.functorCache;
    to.iterMadeReal = from.iterMadeReal;
    to.iterLastSeen = scene->iter;
    from.reset();
}

void FemWall::follow(size_t place, const fl::SurfaceContact& found, const FacePair& pair) {
    fl::WallTouch& touch = touches_[place];
    Partner& partner = partners_[place];
    touch.place = found;
    wall_->follow(touch, patch, drift);
    partner.contact = pair.contact;
    if (partner.face != pair.face)
        partner.trial.reset();
    partner.face = pair.face;
    partner.sphere = pair.sphere;
    partner.found = true;
    touch.free_overlap =
        wall_->free_overlap(found, touch.site, pair.sphere->state->pos - shift, radius_of(place));
}

/// Geometry and physics, as the loop would make them.
void FemWall::make(const shared_ptr<Interaction>& contact, size_t place, FunctorLists& lists) const {
    const Partner& partner = partners_[place];
    const auto geometry = lists.geometry(*partner.face->shape, *partner.sphere->shape).functor;
    const auto physics = lists.physics(*partner.face->material, *partner.sphere->material);
    auto& shape = static_cast<FemFace&>(*partner.face->shape);
    shape.touches.assign(1, face_touch(place));
    geometry->go(partner.face->shape, partner.sphere->shape, *partner.face->state, *partner.sphere->state,
                 Vector3r::Zero(), false, contact);
    physics->go(partner.face->material, partner.sphere->material, contact);
    contact->functorCache.geom = geometry;
    contact->functorCache.geomExists = true;
    contact->functorCache.phys = physics;
    contact->iterMadeReal = contact->iterLastSeen = scene->iter;
}

/// The stiffness of a contact is needed before the loop makes it real. Many touches are none: grains that
/// have parted from the wall where that is pressed in. What they would have is kept until they touch.
void FemWall::find_physics(FunctorLists& lists) {
    for (size_t i = 0; i < touches_.size(); ++i) {
        if (touches_[i].is_empty())
            continue;
        Partner& partner = partners_[i];
        if (partner.contact->isReal()) {
            partner.trial.reset();
        } else if (!partner.trial) {
            partner.trial.reset(new Interaction(partner.face->id, partner.sphere->id));
            make(partner.trial, i, lists);
        }
    }
}

/// Is it the loop's business? What a law lets go of is not, unless it is real already.
bool FemWall::touches_wall(size_t place) const {
    return !touches_[place].is_empty() && partners_[place].contact &&
           (partners_[place].contact->isReal() || touches_[place].overlap() >= 0);
}

} // namespace yade
