// SPDX-License-Identifier: GPL-2.0-or-later
// Motion of the spheres, and what of it YADE gets to see.
#include <engines/flat/yade/FlatGrains.hpp>

#include <core/State.hpp>

namespace yade {

namespace gf = grainfall::flat;

Real FlatGrains::move(Scene& scene, const gf::StepRules& rules, bool keep_velocities) {
    ForceContainer& forces = scene.forces;
    // Forces that stand with YADE: all of them after publishing, else those of general pairs.
    const bool all_with_yade = forces_published_ || forces.getPermForceUsed();
    if (!all_with_yade)
        for (const int i : touched_by_others_) {
            const auto at = static_cast<size_t>(i);
            domains_[0].loads[at].force += forces.getForce(bodies_.ids[at]);
            domains_[0].loads[at].torque += forces.getTorque(bodies_.ids[at]);
            domains_[0].loaded_end = std::max(domains_[0].loaded_end, i + 1);
        }
    if (keep_velocities)
        earlier_ = bodies_.motions;
    const int threads = static_cast<int>(domains_.size());
    vector<Moved> parts(domains_.size());
#pragma omp parallel for schedule(static, 1) num_threads(threads)
    for (int d = 0; d < threads; ++d)
        parts[static_cast<size_t>(d)] =
            move_domain(domains_[static_cast<size_t>(d)], scene, rules, all_with_yade);
    Moved sum;
    for (const Moved& part : parts) {
        sum.book += part.book;
        sum.fastest = std::max(sum.fastest, part.fastest);
        sum.beyond_margin |= part.beyond_margin;
    }
    motion_book_ = sum.book;
    moved_ = sum.beyond_margin;
    forces_published_ = states_published_ = false;
    return sum.fastest;
}

/// Flattened for the same reason as the contact loop.
[[gnu::flatten, gnu::target_clones("arch=x86-64-v3", "default")]] FlatGrains::Moved
FlatGrains::move_domain(const Domain& domain, Scene& scene, const gf::StepRules& rules, bool all_with_yade) {
    Moved result;
    for (int i = domain.begin; i < domain.end; ++i) {
        const auto at = static_cast<size_t>(i);
        gf::Load load = take_load(at);
        if (all_with_yade) {
            load.force += scene.forces.getForce(bodies_.ids[at]);
            load.torque += scene.forces.getTorque(bodies_.ids[at]);
        }
        if (booking_)
            result.book.add(bodies_.inertias[at], bodies_.motions[at], bodies_.motions[at].spin, load.force,
                            load.torque, rules);
        gf::advance(bodies_, at, load.force, load.torque, rules);
        result.fastest = std::max(result.fastest, bodies_.motions[at].velocity.squaredNorm());
        const Anchor& anchor = anchors_[at];
        // Not a number counts as moved.
        result.beyond_margin |=
            !((bodies_.places[at].centre - anchor.centre).squaredNorm() <= anchor.margin * anchor.margin);
    }
    return result;
}

void FlatGrains::publish_state(size_t at) const {
    write_state(*yade_[at]->state, at);
}

void FlatGrains::write_state(State& state, size_t at) const {
    state.pos = bodies_.places[at].centre;
    state.vel = bodies_.motions[at].velocity;
    state.angVel = bodies_.motions[at].spin;
    state.ori = bodies_.orientations[at];
}

void FlatGrains::publish_states() {
    ++census.publications;
    states_published_ = true;
#pragma omp parallel for schedule(static) num_threads(static_cast <int>(domains_.size()))
    for (int i = 0; i < bodies_.spheres(); ++i)
        publish_state(static_cast<size_t>(i));
}

size_t FlatGrains::contact_count() const {
    size_t count = 0;
    for (const Domain& domain : domains_)
        for (const FlatContacts& segment : domain.segments)
            count += segment.size();
    return count;
}

size_t FlatGrains::near_count() const {
    size_t count = 0;
    for (const Domain& domain : domains_)
        count += domain.near.size() + domain.near_obstacles.size();
    return count;
}

} // namespace yade
