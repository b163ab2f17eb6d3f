// SPDX-License-Identifier: GPL-2.0-or-later
// Sorts the spheres in space and lists the pairs that are near each other.
#include <engines/flat/yade/FlatGrains.hpp>

#include <core/Aabb.hpp>
#include <core/State.hpp>
#include <femlink/yade/FemFace.hpp>

#include <algorithm>

namespace yade {

namespace gf = grainfall::flat;

namespace {

template <class Values>
void reorder(Values& values, const vector<int>& order) {
    Values sorted;
    sorted.reserve(values.size());
    for (const int from : order)
        sorted.push_back(values[static_cast<size_t>(from)]);
    for (size_t i = order.size(); i < values.size(); ++i)
        sorted.push_back(values[i]);
    values.swap(sorted);
}

} // namespace

void FlatGrains::search(Reach reach) {
    ++census.searches;
    read_obstacles();
    set_anchors(reach);
    Real farthest = 0;
    for (int i = 0; i < bodies_.spheres(); ++i) {
        const auto at = static_cast<size_t>(i);
        if (!is_giant(i))
            farthest = std::max(farthest, bodies_.places[at].radius + anchors_[at].margin);
    }
    const gf::CellTable cells(bodies_.places, bodies_.spheres(), farthest);
    const vector<int> place_of = sort_spheres(cells);
    giants_.clear();
    for (int i = 0; i < bodies_.spheres(); ++i)
        if (is_giant(i))
            giants_.push_back(i);
    share_out(place_of);
    note_roamers(reach);

    const int threads = static_cast<int>(domains_.size());
#pragma omp parallel for schedule(static, 1) num_threads(threads)
    for (int d = 0; d < threads; ++d)
        list_near(domains_[static_cast<size_t>(d)], cells);
    list_general(cells);
    moved_ = false;
}

/// A sphere at rest gets the skin, a moving one what it travels besides; no more than its radius, or a few
/// fast grains would be neighbours of everything.
void FlatGrains::set_anchors(Reach reach) {
    anchors_.resize(yade_.size());
    for (size_t i = 0; i < yade_.size(); ++i) {
        const gf::Motion& motion = bodies_.motions[i];
        const bool obstacle = bodies_.is_obstacle(static_cast<int>(i));
        const Real turning =
            obstacle ? gf::turning_speed(bodies_.obstacle(static_cast<int>(i)), motion.spin) : 0;
        const Real travel = (motion.velocity.norm() + turning) * reach.horizon;
        const Real most = obstacle ? 20 * reach.skin : bodies_.places[i].radius;
        anchors_[i] = {bodies_.places[i].centre, reach.skin + std::min(travel, most)};
    }
}

/// Returns where each body stands now, by its place before.
vector<int> FlatGrains::sort_spheres(const gf::CellTable& cells) {
    reorder(bodies_.places, cells.order);
    reorder(bodies_.motions, cells.order);
    reorder(bodies_.ids, cells.order);
    reorder(bodies_.orientations, cells.order);
    reorder(bodies_.inertias, cells.order);
    reorder(yade_, cells.order);
    reorder(anchors_, cells.order);
    earlier_.assign(bodies_.motions.begin(), bodies_.motions.end());
    vector<int> place_of(yade_.size());
    for (size_t i = 0; i < yade_.size(); ++i) {
        place_of[i < cells.order.size() ? static_cast<size_t>(cells.order[i]) : i] = static_cast<int>(i);
        index_of_[static_cast<size_t>(bodies_.ids[i])] = static_cast<int>(i);
    }
    return place_of;
}

/// Shares the spheres among the threads and the contacts with them, in the order of their lower spheres.
void FlatGrains::share_out(const vector<int>& place_of) {
    const int count = bodies_.spheres(), threads = static_cast<int>(domains_.size());
    vector<FlatContacts> former;
    for (Domain& domain : domains_) {
        std::move(domain.segments.begin(), domain.segments.end(), std::back_inserter(former));
        domain.segments.clear();
        domain.opened.clear();
    }
#pragma omp parallel for schedule(static, 1) num_threads(threads)
    for (int d = 0; d < threads; ++d) {
        Domain& domain = domains_[static_cast<size_t>(d)];
        domain.begin = static_cast<int>(static_cast<long>(count) * d / threads);
        domain.end = static_cast<int>(static_cast<long>(count) * (d + 1) / threads);
        domain.loaded_end = domain.end;
        domain.loads.assign(yade_.size(), gf::Load());
        take_contacts(domain, former, place_of);
    }
}

/// Of the former contacts those that are the domain's now.
void FlatGrains::take_contacts(Domain& domain, vector<FlatContacts>& former,
                               const vector<int>& place_of) const {
    struct Found {
        int owner, other;
        size_t segment, index;
    };
    vector<Found> found;
    const auto stands = [&](int before) { return place_of[static_cast<size_t>(before)]; };
    for (size_t s = 0; s < former.size(); ++s)
        for (size_t i = 0; i < former[s].size(); ++i) {
            const int first = stands(former[s].states[i].first), second = stands(former[s].states[i].second);
            const int owner = owner_of(first, second);
            if (owner >= domain.begin && owner < domain.end)
                found.push_back({owner, first + second - owner, s, i});
        }
    std::sort(found.begin(), found.end(), [](const Found& a, const Found& b) {
        return std::make_pair(a.owner, a.other) < std::make_pair(b.owner, b.other);
    });
    for (const Found& at : found) {
        FlatContacts& from = former[at.segment];
        FlatContacts& contacts = segment(domain, from.contact_class, from.partner);
        contacts.take(from, at.index);
        gf::ContactState& state = contacts.states.back();
        state.first = stands(state.first);
        state.second = stands(state.second);
        const int higher = std::max(at.owner, at.other);
        if (!bodies_.is_obstacle(higher))
            domain.loaded_end = std::max(domain.loaded_end, higher + 1);
    }
}

bool FlatGrains::near_enough(int first, int second) const {
    const auto a = static_cast<size_t>(first), b = static_cast<size_t>(second);
    const Real margin = anchors_[a].margin + anchors_[b].margin;
    if (bodies_.is_obstacle(first)) {
        if (gf::gap(bodies_.obstacle(first), bodies_.places[a], bodies_.places[b], margin) >= margin)
            return false;
    } else {
        const Real range = bodies_.places[a].radius + bodies_.places[b].radius + margin;
        if ((bodies_.places[a].centre - bodies_.places[b].centre).squaredNorm() >= range * range)
            return false;
    }
    return same_masks_ || may_collide(*yade_[a], *yade_[b], functors.avoid_self_interaction);
}

void FlatGrains::list_near(Domain& domain, const gf::CellTable& cells) const {
    domain.near.clear();
    // Partners of each sphere that are in contact with it already.
    vector<vector<std::pair<int, int>>> partners(domain.segments.size());
    for (size_t s = 0; s < domain.segments.size(); ++s)
        for (const gf::ContactState& state : domain.segments[s].states) {
            const int owner = owner_of(state.first, state.second);
            partners[s].emplace_back(owner, state.first + state.second - owner);
        }
    vector<size_t> next(partners.size(), 0);
    vector<int> touches(yade_.size(), -1);
    for (int i = domain.begin; i < domain.end; ++i) {
        for (size_t s = 0; s < partners.size(); ++s)
            for (; next[s] < partners[s].size() && partners[s][next[s]].first == i; ++next[s])
                touches[static_cast<size_t>(partners[s][next[s]].second)] = i;
        const auto consider = [&](int other) {
            if (touches[static_cast<size_t>(other)] != i && near_enough(i, other))
                domain.near.push_back({i, other});
        };
        if (is_giant(i)) {
            for (int j = i + 1; j < bodies_.spheres(); ++j)
                consider(j);
            continue;
        }
        cells.grid.around(bodies_.places[static_cast<size_t>(i)].centre, [&](int from, int to) {
            const int begin = std::max(cells.starts[static_cast<size_t>(from)], i + 1);
            const int end = cells.starts[static_cast<size_t>(to)];
            for (int j = begin; j < end; ++j)
                if (!is_giant(j))
                    consider(j);
        });
        for (const int giant : giants_)
            if (giant > i)
                consider(giant);
    }
    for (const gf::Pair& pair : domain.near)
        domain.loaded_end = std::max(domain.loaded_end, pair.second + 1);
    list_near_obstacles(domain, cells);
}

/// Calls visit(sphere) for those that may reach into the roamer's room.
template <class Visit>
void FlatGrains::visit_spheres_in(const Roamer& roamer, const gf::CellTable& cells,
                                  const Visit& visit) const {
    const bool has_room = (roamer.room.low.array() <= roamer.room.high.array()).all();
    if (bodies_.spheres() == 0 || !has_room)
        return; // no cells, or no functor that makes its bound
    const auto consider = [&](int i) {
        const auto at = static_cast<size_t>(i);
        const Vector3r reach = Vector3r::Constant(bodies_.places[at].radius + anchors_[at].margin);
        const Vector3r& centre = bodies_.places[at].centre;
        if (roamer.room.meets({centre - reach, centre + reach}))
            visit(i);
    };
    cells.grid.inside(roamer.room.low, roamer.room.high, [&](int from, int to) {
        const int end = cells.starts[static_cast<size_t>(to)];
        for (int i = cells.starts[static_cast<size_t>(from)]; i < end; ++i)
            if (!is_giant(i))
                consider(i);
    });
    for (const int giant : giants_) // may reach farther than from the next cell
        consider(giant);
}

void FlatGrains::list_near_obstacles(Domain& domain, const gf::CellTable& cells) const {
    domain.near_obstacles.clear();
    vector<vector<int>> touching(bodies_.obstacles.size());
    for (const FlatContacts& segment : domain.segments)
        if (segment.on_obstacles())
            for (const gf::ContactState& state : segment.states)
                touching[static_cast<size_t>(state.first - bodies_.spheres())].push_back(state.second);
    vector<int> met(static_cast<size_t>(bodies_.spheres()), -1);
    for (const Roamer& roamer : roamers_) {
        const int obstacle = roamer.obstacle;
        if (obstacle < 0)
            continue;
        for (const int sphere : touching[static_cast<size_t>(obstacle - bodies_.spheres())])
            met[static_cast<size_t>(sphere)] = obstacle;
        visit_spheres_in(roamer, cells, [&](int i) {
            if (i >= domain.begin && i < domain.end && met[static_cast<size_t>(i)] != obstacle &&
                near_enough(obstacle, i))
                domain.near_obstacles.push_back({obstacle, i});
        });
    }
}

FlatGrains::Bounds FlatGrains::box_of(const Body& body) {
    const auto functor = functors.bound(*body.shape);
    shared_ptr<Bound>& bound = const_cast<Body&>(body).bound;
    if (functor)
        functor->go(body.shape, bound, body.state->se3, &body);
    if (!functor || !bound)
        return {Vector3r::Constant(NaN), Vector3r::Constant(NaN)}; // meets nothing
    return {bound->min, bound->max};
}

/// The box of a body that is no flat sphere, with room for what it travels until the next search.
FlatGrains::Bounds FlatGrains::room_of(const Body& body, Reach reach) {
    Bounds box = box_of(body);
    const Vector3r extent = box.high - box.low;
    const Real arm = extent.allFinite() ? 0.5 * extent.norm() : 0;
    const Real speed = body.state->vel.norm() + arm * body.state->angVel.norm();
    const Vector3r room = Vector3r::Constant(reach.skin + std::min(speed * reach.horizon, 20 * reach.skin));
    return {box.low - room, box.high + room};
}

/// Has a body that is no flat sphere left the room that it had at the last search?
bool FlatGrains::others_have_moved() {
    for (const Roamer& roamer : roamers_) {
        const State& state = *roamer.body->state;
        const bool rests = state.vel == Vector3r::Zero() && state.angVel == Vector3r::Zero() &&
                           state.pos == roamer.centre && !(roamer.face && roamer.face->has_left_bound());
        if (!rests && (has_gone_too_far(roamer) || !roamer.room.holds(box_of(*roamer.body))))
            return true;
    }
    return false;
}

/// The bound of a box or a solid does not tell how far its surface has gone when it turns; that of a plane
/// tells all.
bool FlatGrains::has_gone_too_far(const Roamer& roamer) const {
    if (roamer.obstacle < 0 || bodies_.kind(roamer.obstacle) == gf::Partner::plane)
        return false;
    const State& state = *roamer.body->state;
    const Real turned = gf::turned_by(bodies_.obstacle(roamer.obstacle), roamer.orientation, state.ori);
    return (state.pos - roamer.centre).norm() + turned >
           anchors_[static_cast<size_t>(roamer.obstacle)].margin;
}

void FlatGrains::note_roamers(Reach reach) {
    roamers_.clear();
    for (Body* body : others_)
        if (body->shape && body->isBounded())
            roamers_.push_back({body, body->state->pos, body->state->ori, room_of(*body, reach),
                                dynamic_cast<const FemFace*>(body->shape.get()),
                                index_of_[static_cast<size_t>(body->id)]});
    // Faces of deformable walls, which may be many, do not meet each other: they stand last.
    std::stable_partition(roamers_.begin(), roamers_.end(),
                          [](const Roamer& roamer) { return !roamer.face; });
}

void FlatGrains::list_general(const gf::CellTable& cells) {
    general_.forget_those_apart();
    const auto faces =
        std::find_if(roamers_.begin(), roamers_.end(), [](const Roamer& roamer) { return roamer.face; });
    const auto first_face = static_cast<size_t>(faces - roamers_.begin());
    for (size_t a = 0; a < roamers_.size(); ++a) {
        Body& body = *roamers_[a].body;
        for (size_t b = a + 1; a < first_face && b < roamers_.size(); ++b)
            if (roamers_[a].room.meets(roamers_[b].room))
                general_.add(body, *roamers_[b].body, functors);
        if (roamers_[a].obstacle < 0) // else its pairs with spheres are flat
            visit_spheres_in(roamers_[a], cells,
                             [&](int i) { general_.add(body, *yade_[static_cast<size_t>(i)], functors); });
    }
    // Spheres that take part: their State is written before, their forces read after.
    touched_by_others_.clear();
    for (const GeneralPair& pair : general_.all())
        for (const Body* body : {pair.first, pair.second})
            if (is_flat(body->id))
                touched_by_others_.push_back(index_of_[static_cast<size_t>(body->id)]);
    std::sort(touched_by_others_.begin(), touched_by_others_.end());
    touched_by_others_.erase(std::unique(touched_by_others_.begin(), touched_by_others_.end()),
                             touched_by_others_.end());
}

} // namespace yade
