// SPDX-License-Identifier: GPL-2.0-or-later
// Contact forces of one step; contacts made and lost.
#include <engines/flat/yade/FlatGrains.hpp>

#include <femlink/yade/FemFace.hpp>
#include <femlink/yade/scene_walls.hpp>
#include <laws/yade/Law2_ScGeom_GrainPhys_HertzMindlin.hpp>

#include <core/InteractionContainer.hpp>
#include <core/State.hpp>
#include <pkg/common/Sphere.hpp>

#include <utility>

namespace yade {

namespace gf = grainfall::flat;

void FlatGrains::contacts(Scene& scene, const FlatTables::Pair& tables, bool publish) {
    ++census.steps;
    if (scene.trackEnergy != booking_)
        start_booking(scene.trackEnergy);
    if (tables.slips != slipping_)
        start_remembering_slip(tables.slips);
    read_obstacles();
    const Step step{booking_ ? tables.booking : tables.plain, scene.dt, scene.iter, publish};
    const int threads = static_cast<int>(domains_.size());
#pragma omp parallel for schedule(static, 1) num_threads(threads)
    for (int d = 0; d < threads; ++d) {
        Domain& domain = domains_[static_cast<size_t>(d)];
        try {
            run_domain(domain, step);
            find_touching(domain);
            bury(domain);
            bear(domain, step, domain.near, domain.touching);
        } catch (...) {
            domain.failure = std::current_exception();
        }
    }
    for (Domain& domain : domains_) {
        if (domain.failure)
            std::rethrow_exception(std::exchange(domain.failure, nullptr));
        // One after the other, for the first contact of a plane says which radius it has.
        bear(domain, step, domain.near_obstacles, domain.touching_obstacles);
        census.born += std::exchange(domain.born_now, 0);
        census.parted += std::exchange(domain.parted_now, 0);
    }
    if (publish)
        list_contacts(scene);
    settle_books();
    load_obstacles(scene);
    show_exposed(scene);
    for (const int i : touched_by_others_)
        publish_state(static_cast<size_t>(i));
    prepare_walls(scene);
    general_.act(scene, functors);
    forces_published_ = contacts_published_ = publish;
    if (publish)
        publish_forces(scene);
}

/// The dashpots' last forces are known if the last step was published; else their first half step is not
/// booked.
void FlatGrains::start_booking(bool booking) {
    booking_ = booking;
    for (Domain& domain : domains_)
        for (FlatContacts& segment : domain.segments) {
            segment.books = booking;
            segment.dashpots.assign(booking ? segment.size() : 0, gf::DashpotMemory());
            for (size_t i = 0; booking && contacts_published_ && i < segment.size(); ++i)
                segment.dashpots[i] = recall_dashpots(segment.owners[i]);
        }
}

/// The law was changed in the middle of a run. Histories begin with the forces that the contacts have.
void FlatGrains::start_remembering_slip(bool slipping) {
    slipping_ = slipping;
    for (Domain& domain : domains_)
        for (FlatContacts& segment : domain.segments) {
            segment.slips = slipping;
            segment.slip.assign(slipping ? segment.size() : 0, grainfall::laws::SlipHistory());
        }
}

void FlatGrains::run(Domain& domain, size_t segment, const Step& step, vector<size_t>& opened, size_t begin,
                     size_t end) const {
    FlatContacts& contacts = domain.segments[segment];
    const bool publish = step.publish || is_exposed(contacts.partner);
    FlatLoop loop{bodies_, domain.loads.data(), step.length, publish, domain.book, opened};
    if (!contacts.wet)
        step.table[static_cast<size_t>(contacts.contact_class)](loop, contacts, begin, end);
    else
        run_wet_flat(step.table, booking_, loop, contacts, begin, end);
}

void FlatGrains::run_domain(Domain& domain, const Step& step) const {
    domain.opened.resize(domain.segments.size());
    for (size_t s = 0; s < domain.segments.size(); ++s) {
        domain.opened[s].clear();
        run(domain, s, step, domain.opened[s], 0, domain.segments[s].size());
    }
}

void FlatGrains::find_touching(Domain& domain) const {
    domain.touching.clear();
    domain.touching_obstacles.clear();
    const gf::Place* places = bodies_.places.data();
    for (size_t i = 0; i < domain.near.size(); ++i) {
        const gf::Pair pair = domain.near[i];
        const Real sum = places[pair.first].radius + places[pair.second].radius;
        if ((places[pair.first].centre - places[pair.second].centre).squaredNorm() <= sum * sum)
            domain.touching.push_back(i);
    }
    for (size_t i = 0; i < domain.near_obstacles.size(); ++i) {
        const gf::Pair pair = domain.near_obstacles[i];
        if (gf::gap(bodies_.obstacle(pair.first), places[pair.first], places[pair.second], 0) <= 0)
            domain.touching_obstacles.push_back(i);
    }
}

/// Contacts that have opened; their pairs are looked after as near ones.
void FlatGrains::bury(Domain& domain) const {
    for (size_t s = 0; s < domain.segments.size(); ++s) {
        FlatContacts& contacts = domain.segments[s];
        domain.parted_now += static_cast<long>(domain.opened[s].size());
        for (size_t k = domain.opened[s].size(); k-- > 0;) {
            const size_t i = domain.opened[s][k];
            const gf::ContactState& state = contacts.states[i];
            if (contacts.on_obstacles())
                domain.near_obstacles.push_back({state.first, state.second});
            else
                domain.near.push_back(
                    {std::min(state.first, state.second), std::max(state.first, state.second)});
            if (contacts.owners[i].in_scene)
                (is_exposed(contacts.partner) ? domain.parted_exposed : domain.parted)
                    .push_back(std::move(contacts.owners[i].contact));
            contacts.remove(i);
        }
    }
}

/// Pairs that touch become contacts and act in this step already.
void FlatGrains::bear(Domain& domain, const Step& step, vector<gf::Pair>& near,
                      const vector<size_t>& touching) {
    for (size_t k = touching.size(); k-- > 0;) {
        const size_t i = touching[k];
        Imported made;
        if (!make_contact(domain, step, near[i], made))
            continue;
        near[i] = near.back();
        near.pop_back();
        ++domain.born_now;
        const FlatContacts& contacts = add_contact(domain, std::move(made));
        const auto segment = static_cast<size_t>(&contacts - domain.segments.data());
        domain.opened.resize(domain.segments.size());
        vector<size_t> opened;
        run(domain, segment, step, opened, contacts.size() - 1, contacts.size());
    }
}

/// By the scene's own functors. False where they make none, as for a pair that touches in a rounding error.
bool FlatGrains::make_contact(Domain& domain, const Step& step, gf::Pair pair, Imported& made) {
    Body* body1 = yade_[static_cast<size_t>(pair.first)];
    Body* body2 = yade_[static_cast<size_t>(pair.second)];
    State* state1 = body1->state.get();
    State* state2 = domain.second_state.get();
    write_state(*state2, static_cast<size_t>(pair.second));
    if (!bodies_.is_obstacle(pair.first)) {
        state1 = domain.first_state.get();
        write_state(*state1, static_cast<size_t>(pair.first));
        if (body1->id > body2->id) {
            std::swap(body1, body2);
            std::swap(state1, state2);
        }
    }
    const shared_ptr<IGeomFunctor>& geometry = functors.known_geometry(*body1->shape, *body2->shape);
    if (!geometry)
        return false;
    const shared_ptr<IPhysFunctor>& physics = functors.known_physics(*body1->material, *body2->material);
    auto contact = shared_ptr<Interaction>(new Interaction(body1->id, body2->id));
    if (!geometry->go(body1->shape, body2->shape, *state1, *state2, Vector3r::Zero(), false, contact))
        return false;
    physics->go(body1->material, body2->material, contact);
    if (!dynamic_cast<GrainPhys*>(contact->phys.get()))
        throw std::runtime_error(physics->getClassName() + " does not make GrainPhys: set "
                                                           "GrainInteractionLoop.flat = False");
    contact->functorCache.geom = geometry;
    contact->functorCache.phys = physics;
    contact->iterMadeReal = contact->iterLastSeen = step.number;
    made = imported(contact);
    note_plane_radius(pair.first, *contact);
    return true;
}

namespace {

void let_go(InteractionContainer& container, vector<shared_ptr<Interaction>>& parted) {
    for (const auto& contact : parted)
        container.erase(contact->getId1(), contact->getId2(), contact->linIx);
    parted.clear();
}

void take_in(InteractionContainer& container, FlatContacts& contacts) {
    for (ContactOwner& owner : contacts.owners)
        if (!owner.in_scene) {
            container.insert(owner.contact);
            owner.in_scene = true;
        }
}

} // namespace

void FlatGrains::list_contacts(Scene& scene) {
    for (Domain& domain : domains_)
        let_go(*scene.interactions, domain.parted);
    for (Domain& domain : domains_)
        for (FlatContacts& segment : domain.segments)
            take_in(*scene.interactions, segment);
}

/// Contacts that YADE sees in every step, and their spheres.
void FlatGrains::show_exposed(Scene& scene) {
    for (Domain& domain : domains_)
        let_go(*scene.interactions, domain.parted_exposed);
    for (Domain& domain : domains_)
        for (FlatContacts& segment : domain.segments) {
            if (!is_exposed(segment.partner))
                continue;
            take_in(*scene.interactions, segment);
            for (const gf::ContactState& state : segment.states)
                publish_state(static_cast<size_t>(state.second));
        }
}

/// Deformable walls are solved for where their grains now are.
void FlatGrains::prepare_walls(Scene& scene) {
    if (!has_walls(scene))
        return;
    if (face_pairs_version_ != general_.version()) {
        face_pairs_version_ = general_.version();
        face_pairs_.clear();
        const int face = FemFace::getClassIndexStatic();
        for (const GeneralPair& pair : general_.all())
            if (pair.first->shape->getClassIndex() == face &&
                dynamic_cast<const Sphere*>(pair.second->shape.get()))
                face_pairs_.push_back({pair.contact, pair.first, pair.second});
        sort_pairs(face_pairs_);
    }
    yade::prepare_walls(scene, face_pairs_, functors);
}

void FlatGrains::settle_books() {
    FlatBook sum;
    for (Domain& domain : domains_) {
        sum.friction += domain.book.friction;
        sum.viscous += domain.book.viscous;
        sum.rescaling += domain.book.rescaling;
        sum.kinematics += domain.book.kinematics;
        sum.bridge += domain.book.bridge;
        domain.book = FlatBook();
    }
    if (!booking_)
        return;
    functors.grain_law->book(sum.friction, sum.viscous, sum.rescaling, sum.kinematics);
    if (sum.bridge != 0)
        functors.grain_law->book_bridge(sum.bridge);
}

void FlatGrains::load_obstacles(Scene& scene) {
    for (size_t i = static_cast<size_t>(bodies_.spheres()); i < yade_.size(); ++i) {
        gf::Load sum;
        for (Domain& domain : domains_) {
            sum.force += domain.loads[i].force;
            sum.torque += domain.loads[i].torque;
            domain.loads[i] = gf::Load();
        }
        // Adding the usual way would make the container sum up all bodies anew.
        if (scene.forces.synced && has_room_) {
            scene.forces.addForceUnsynced(bodies_.ids[i], sum.force);
            scene.forces.addTorqueUnsynced(bodies_.ids[i], sum.torque);
        } else {
            scene.forces.addForce(bodies_.ids[i], sum.force);
            scene.forces.addTorque(bodies_.ids[i], sum.torque);
        }
    }
    if (has_room_)
        return;
    for (const Body* body : others_)
        if (body->isClump())
            scene.forces.addForce(body->id, Vector3r::Zero());
    has_room_ = true;
}

/// Load on a sphere from the contacts of all threads; read once, then gone.
gf::Load FlatGrains::take_load(size_t i) {
    gf::Load sum;
    for (Domain& domain : domains_) {
        if (static_cast<int>(i) < domain.begin || static_cast<int>(i) >= domain.loaded_end)
            continue;
        sum.force += domain.loads[i].force;
        sum.torque += domain.loads[i].torque;
        domain.loads[i] = gf::Load();
    }
    return sum;
}

void FlatGrains::publish_forces(Scene& scene) {
    const int spheres = bodies_.spheres();
#pragma omp parallel for schedule(static)
    for (int i = 0; i < spheres; ++i) {
        const gf::Load load = take_load(static_cast<size_t>(i));
        scene.forces.addForce(bodies_.ids[static_cast<size_t>(i)], load.force);
        scene.forces.addTorque(bodies_.ids[static_cast<size_t>(i)], load.torque);
    }
}

} // namespace yade
