// SPDX-License-Identifier: GPL-2.0-or-later
// Contact forces of one step; contacts made and lost.
#include <engines/flat/yade/FlatGrains.hpp>

#include <femlink/yade/FemFace.hpp>
#include <femlink/yade/scene_walls.hpp>
#include <laws/yade/Law2_ScGeom_GrainPhys_HertzMindlin.hpp>

#include <core/InteractionContainer.hpp>
#include <core/State.hpp>

namespace yade {

namespace gf = grainfall::flat;

void FlatGrains::contacts(Scene& scene, const FlatTables::Pair& tables, bool publish) {
    ++census.steps;
    if (scene.trackEnergy != booking_)
        start_booking(scene.trackEnergy);
    read_planes();
    const FlatTable& table = booking_ ? tables.booking : tables.plain;
    const int threads = static_cast<int>(domains_.size());
#pragma omp parallel for schedule(static, 1) num_threads(threads)
    for (int d = 0; d < threads; ++d) {
        run_domain(domains_[static_cast<size_t>(d)], table, scene.dt, publish);
        find_touching(domains_[static_cast<size_t>(d)]);
    }
    for (Domain& domain : domains_) {
        bury(scene, domain);
        bear(scene, domain, table, publish);
    }
    settle_books();
    load_planes(scene);
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
            segment.dashpots.assign(booking ? segment.size() : 0, gf::DashpotMemory());
            for (size_t i = 0; booking && contacts_published_ && i < segment.size(); ++i)
                segment.dashpots[i] = recall_dashpots(segment.owners[i]);
        }
}

void FlatGrains::run(Domain& domain, size_t segment, const FlatTable& table, FlatLoop& loop, size_t begin,
                     size_t end) const {
    FlatContacts& contacts = domain.segments[segment];
    const ContactClass kind(contacts.contact_class);
    if (kind.bridge() == BridgeKind::none)
        table[static_cast<size_t>(kind.index)](loop, contacts, begin, end);
    else
        run_wet_flat(table, booking_, loop, contacts, begin, end);
}

void FlatGrains::run_domain(Domain& domain, const FlatTable& table, Real time_step, bool publish) {
    domain.opened.resize(domain.segments.size());
    for (size_t s = 0; s < domain.segments.size(); ++s) {
        domain.opened[s].clear();
        FlatLoop loop{bodies_, domain.loads.data(), time_step, publish, domain.book, domain.opened[s]};
        run(domain, s, table, loop, 0, domain.segments[s].size());
    }
}

void FlatGrains::find_touching(Domain& domain) {
    domain.touching.clear();
    const gf::Place* places = bodies_.places.data();
    for (size_t i = 0; i < domain.near.size(); ++i) {
        const gf::Pair pair = domain.near[i];
        bool touches;
        if (bodies_.is_plane(pair.first)) {
            touches = gf::gap(bodies_.plane(pair.first), places[pair.first], places[pair.second]) <= 0;
        } else {
            const Real sum = places[pair.first].radius + places[pair.second].radius;
            touches = (places[pair.first].centre - places[pair.second].centre).squaredNorm() <= sum * sum;
        }
        if (touches)
            domain.touching.push_back(i);
    }
}

/// Contacts that have opened leave the scene; their pairs are looked after as near ones.
void FlatGrains::bury(Scene& scene, Domain& domain) {
    for (size_t s = 0; s < domain.segments.size(); ++s) {
        FlatContacts& contacts = domain.segments[s];
        for (size_t k = domain.opened[s].size(); k-- > 0;) {
            const size_t i = domain.opened[s][k];
            int first = contacts.states[i].first, second = contacts.states[i].second;
            if (!bodies_.is_plane(first) && first > second)
                std::swap(first, second);
            domain.near.push_back({first, second});
            Interaction& contact = *contacts.owners[i].contact;
            scene.interactions->erase(contact.getId1(), contact.getId2(), contact.linIx);
            contacts.remove(i);
            ++census.parted;
        }
    }
}

/// Pairs that touch become contacts and act in this step already.
void FlatGrains::bear(Scene& scene, Domain& domain, const FlatTable& table, bool publish) {
    for (size_t k = domain.touching.size(); k-- > 0;) {
        const size_t i = domain.touching[k];
        Imported made;
        if (!make_contact(scene, domain.near[i].first, domain.near[i].second, made))
            continue;
        domain.near[i] = domain.near.back();
        domain.near.pop_back();
        ++census.born;
        FlatContacts& contacts = domain.segment(made.contact_class, made.on_plane);
        contacts.add(made.state, made.constants, made.owner, booking_ ? &made.dashpot : nullptr);
        const auto segment = static_cast<size_t>(&contacts - domain.segments.data());
        domain.opened.resize(domain.segments.size());
        vector<size_t> opened;
        FlatLoop loop{bodies_, domain.loads.data(), scene.dt, publish, domain.book, opened};
        run(domain, segment, table, loop, contacts.size() - 1, contacts.size());
    }
}

/// By the scene's own functors. False where they make none, as for a pair that touches in a rounding error.
bool FlatGrains::make_contact(Scene& scene, int first, int second, Imported& made) {
    const auto a = static_cast<size_t>(first), b = static_cast<size_t>(second);
    Body* body1 = yade_[a];
    Body* body2 = yade_[b];
    publish_state(b);
    if (!bodies_.is_plane(first)) {
        publish_state(a);
        if (body1->id > body2->id)
            std::swap(body1, body2);
    }
    const auto geometry = functors.geometry(*body1->shape, *body2->shape).functor;
    const auto physics = functors.physics(*body1->material, *body2->material);
    if (!geometry)
        return false;
    const shared_ptr<Interaction> contact(new Interaction(body1->id, body2->id));
    if (!geometry->go(body1->shape, body2->shape, *body1->state, *body2->state, Vector3r::Zero(), false,
                      contact))
        return false;
    physics->go(body1->material, body2->material, contact);
    if (!dynamic_cast<GrainPhys*>(contact->phys.get()))
        throw std::runtime_error(physics->getClassName() + " does not make GrainPhys: set "
                                                           "GrainInteractionLoop.flat = False");
    contact->functorCache.geom = geometry;
    contact->functorCache.phys = physics;
    contact->iterMadeReal = contact->iterLastSeen = scene.iter;
    scene.interactions->insert(contact);
    made = imported(*contact);
    note_plane_radius(first, *contact);
    return true;
}

/// Deformable walls are solved for where their grains now are.
void FlatGrains::prepare_walls(Scene& scene) {
    if (!has_walls(scene))
        return;
    vector<FacePair> pairs;
    const int face = FemFace::getClassIndexStatic();
    for (const GeneralPair& pair : general_.all())
        if (pair.first->shape->getClassIndex() == face && is_flat(pair.second->id))
            pairs.push_back({pair.contact, pair.first, pair.second});
    yade::prepare_walls(scene, std::move(pairs), functors);
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

void FlatGrains::load_planes(Scene& scene) {
    for (size_t i = static_cast<size_t>(bodies_.spheres()); i < yade_.size(); ++i) {
        gf::Load sum;
        for (Domain& domain : domains_) {
            sum.force += domain.loads[i].force;
            sum.torque += domain.loads[i].torque;
            domain.loads[i] = gf::Load();
        }
        // Adding the usual way would make the container sum up all bodies anew.
        if (scene.forces.synced && planes_known_) {
            scene.forces.addForceUnsynced(bodies_.ids[i], sum.force);
            scene.forces.addTorqueUnsynced(bodies_.ids[i], sum.torque);
        } else {
            scene.forces.addForce(bodies_.ids[i], sum.force);
            scene.forces.addTorque(bodies_.ids[i], sum.torque);
        }
    }
    planes_known_ = true;
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
