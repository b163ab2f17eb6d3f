// SPDX-License-Identifier: GPL-2.0-or-later
// YADE's objects -> packed arrays.
#include <engines/flat/yade/FlatGrains.hpp>

#include <engines/projectile/yade/SolidOfRevolution.hpp>
#include <femlink/yade/FemFace.hpp>
#include <laws/yade/GrainMat.hpp>
#include <laws/yade/GrainEffectPhys.hpp>
#include <laws/yade/Law2_ScGeom_GrainPhys_HertzMindlin.hpp>

#include <core/Cell.hpp>
#include <core/InteractionContainer.hpp>
#include <core/State.hpp>
#include <pkg/common/Box.hpp>
#include <pkg/common/Sphere.hpp>
#include <pkg/common/Wall.hpp>

#include <algorithm>
#include <limits>

namespace yade {

namespace gf = grainfall::flat;

namespace {

bool is_grain(const Body& body) {
    return body.isStandalone() && dynamic_cast<const GrainMat*>(body.material.get());
}
bool is_flat_sphere(const Body& body) {
    return is_grain(body) && !body.isAspherical() && body.shape && body.shape->getClassName() == "Sphere";
}
bool is_wall(const Body& body) {
    return is_grain(body) && body.shape && body.shape->getClassName() == "Wall";
}

/// Faces of a deformable wall meet spheres only, so many of them do no harm.
bool is_face(const Body& body) {
    return dynamic_cast<const FemFace*>(body.shape.get());
}

} // namespace

std::string FlatGrains::obstacle(const Scene& scene) const {
    if (scene.isPeriodic)
        return "the cell is periodic";
    size_t others = 0;
    for (const auto& body : scene.bodies->body) {
        if (!body)
            continue;
        if (body->isBounded() && !is_flat_sphere(*body) && !is_wall(*body) && !is_face(*body))
            ++others;
    }
    if (others > 500)
        return std::to_string(others) +
               " bodies are members of clumps, or neither spheres nor walls of GrainMat";
    return functors.obstacle();
}

void FlatGrains::take_over(Scene& scene, int threads, bool slips) {
    ++census.takeovers;
    booking_ = scene.trackEnergy;
    slipping_ = slips;
    domains_.clear();
    domains_.resize(static_cast<size_t>(threads));
    take_over_bodies(scene);
    find_functors();
    measure_radii();
    scene.interactions->eraseNonReal();
    vector<Imported> contacts;
    take_over_contacts(scene, contacts);
    // Not yet in space: the first domain holds all until the search.
    domains_[0].end = bodies_.spheres();
    for (Imported& contact : contacts)
        add_contact(domains_[0], std::move(contact));
    moved_ = true;
    forces_published_ = has_room_ = false;
}

void FlatGrains::take_over_bodies(Scene& scene) {
    bodies_ = gf::Bodies();
    yade_.clear();
    others_.clear();
    const auto& all = scene.bodies->body;
    index_of_.assign(all.size(), -1);
    vector<std::pair<Body*, gf::Obstacle>> obstacles;
    same_masks_ = functors.avoid_self_interaction == 0;
    for (const auto& body : all) {
        if (!body || !body->shape)
            continue;
        if (!is_flat_sphere(*body)) {
            others_.push_back(body.get());
            if (const auto obstacle = obstacle_of(*body))
                obstacles.emplace_back(body.get(), *obstacle);
            continue;
        }
        same_masks_ = same_masks_ && body->groupMask == 1;
        const State& state = *body->state;
        index_of_[static_cast<size_t>(body->id)] = static_cast<int>(yade_.size());
        yade_.push_back(body.get());
        bodies_.ids.push_back(body->id);
        bodies_.places.push_back({state.pos, static_cast<const Sphere&>(*body->shape).radius});
        bodies_.motions.push_back({state.vel, state.angVel});
        bodies_.orientations.push_back(state.ori);
        bodies_.inertias.push_back({state.mass, state.inertia, state.blockedDOFs, state.isDamped});
    }
    for (const auto& [body, obstacle] : obstacles) {
        same_masks_ = same_masks_ && body->groupMask == 1;
        index_of_[static_cast<size_t>(body->id)] = static_cast<int>(yade_.size());
        yade_.push_back(body);
        bodies_.ids.push_back(body->id);
        bodies_.places.push_back({body->state->pos, 1});
        bodies_.motions.push_back({body->state->vel, body->state->angVel});
        bodies_.obstacles.push_back(obstacle);
    }
}

/// Nothing for a body whose contacts go through their own functors.
std::optional<gf::Obstacle> FlatGrains::obstacle_of(const Body& body) const {
    if (!is_grain(body))
        return {};
    gf::Obstacle result;
    if (is_wall(body)) {
        const auto& wall = static_cast<const Wall&>(*body.shape);
        result.axis = wall.axis;
        result.sense = wall.sense;
        return result;
    }
    if (functors.usual_boxes() && body.shape->getClassName() == "Box") {
        result.kind = gf::Partner::box;
        result.half_edges = static_cast<const Box&>(*body.shape).extents;
        return result;
    }
    const auto* solid = dynamic_cast<const SolidOfRevolution*>(body.shape.get());
    if (functors.usual_solids() && solid && !solid->body().empty()) {
        result.kind = gf::Partner::solid;
        result.profile = &solid->body();
        result.edge_radius = solid->edgeRadius;
        result.flat_radius_factor = functors.flat_radius_factor();
        return result;
    }
    return {};
}

/// The functors of all contacts that may come, so that threads need not look for them.
void FlatGrains::find_functors() {
    std::map<string, const Body*> of_shape, of_material;
    for (const Body* body : yade_) {
        of_shape.emplace(body->shape->getClassName(), body);
        of_material.emplace(body->material->getClassName(), body);
    }
    if (const auto sphere = of_shape.find("Sphere"); sphere != of_shape.end())
        for (const auto& [name, body] : of_shape)
            functors.geometry(*body->shape, *sphere->second->shape);
    for (const auto& [name1, body1] : of_material)
        for (const auto& [name2, body2] : of_material)
            functors.physics(*body1->material, *body2->material);
}

/// Few spheres that are much larger than the others would make the cells of all others too large: as giants
/// they look for their neighbours by themselves.
void FlatGrains::measure_radii() {
    vector<Real> radii;
    for (int i = 0; i < bodies_.spheres(); ++i)
        radii.push_back(bodies_.places[static_cast<size_t>(i)].radius);
    smallest_radius_ = 0;
    giant_radius_ = std::numeric_limits<Real>::infinity();
    if (radii.empty())
        return;
    smallest_radius_ = *std::min_element(radii.begin(), radii.end());
    const size_t place = radii.size() - 1 - std::min(radii.size() / 1000 + 8, radii.size() - 1);
    std::nth_element(radii.begin(), radii.begin() + static_cast<long>(place), radii.end());
    giant_radius_ = 2 * radii[place];
}

void FlatGrains::take_over_contacts(Scene& scene, vector<Imported>& contacts) {
    general_.clear();
    InteractionContainer& container = *scene.interactions;
    for (size_t i = 0; i < container.size(); ++i) {
        const shared_ptr<Interaction>& contact = container[i];
        const int first = index_of_[static_cast<size_t>(contact->getId1())];
        const int second = index_of_[static_cast<size_t>(contact->getId2())];
        const bool ours = first >= 0 && second >= 0 && !bodies_.is_obstacle(second) &&
                          dynamic_cast<GrainPhys*>(contact->phys.get()) &&
                          dynamic_cast<ScGeom*>(contact->geom.get());
        if (ours) {
            contacts.push_back(imported(contact));
            contacts.back().owner.in_scene = true;
            note_plane_radius(first, *contact);
        } else {
            general_.adopt(contact, scene, functors);
        }
    }
    // The container's order depends on the scene's history; this one does not.
    std::sort(contacts.begin(), contacts.end(), [](const Imported& a, const Imported& b) {
        return std::make_pair(a.state.first, a.state.second) < std::make_pair(b.state.first, b.state.second);
    });
}

/// What radius the geometry functor gives a plane, over that of the sphere (`hertzian`: a large number).
void FlatGrains::note_plane_radius(int first, const Interaction& contact) {
    const auto& geom = static_cast<const ScGeom&>(*contact.geom);
    if (bodies_.kind(first) == gf::Partner::plane)
        bodies_.places[static_cast<size_t>(first)].radius = geom.refR1 / geom.refR2;
}

FlatGrains::Imported FlatGrains::imported(const shared_ptr<Interaction>& contact) const {
    auto& phys = static_cast<GrainPhys&>(*contact->phys);
    auto& geom = static_cast<ScGeom&>(*contact->geom);
    Imported result;
    result.contact_class = phys.contactClass;
    result.owner = {contact, &geom, &phys, false};
    result.state.first = index_of_[static_cast<size_t>(contact->getId1())];
    result.state.second = index_of_[static_cast<size_t>(contact->getId2())];
    result.partner = bodies_.kind(result.state.first);
    result.state.normal = geom.normal;
    result.state.shear_force = phys.shearElastic;
    result.state.shear_stiffness = phys.ks;
    result.constants.parameters = {phys.normalCoefficient, phys.shearCoefficient, phys.normalDamping,
                                   phys.shearDamping};
    if (ContactClass(phys.contactClass).friction() == FrictionForm::constant)
        result.constants.friction = phys.tangensOfFrictionAngle;
    else
        result.curve = phys.effects()->curve();
    result.dashpot = recall_dashpots(result.owner);
    if (const LiquidBridge* bridge = bridge_of(phys))
        result.bridge = {bridge->parameters(), bridge->memory()};
    if (const PartialSlip* slip = slip_of(phys))
        slip->recall(result.slip);
    return result;
}

FlatContacts& FlatGrains::segment(Domain& domain, int contact_class, gf::Partner partner) const {
    for (FlatContacts& known : domain.segments)
        if (known.contact_class == contact_class && known.partner == partner)
            return known;
    FlatContacts fresh;
    fresh.contact_class = contact_class;
    fresh.partner = partner;
    fresh.curved = ContactClass(contact_class).friction() != FrictionForm::constant;
    fresh.wet = ContactClass(contact_class).bridge() != BridgeKind::none;
    fresh.books = booking_;
    fresh.slips = slipping_;
    domain.segments.push_back(std::move(fresh));
    return domain.segments.back();
}

FlatContacts& FlatGrains::add_contact(Domain& domain, Imported contact) const {
    FlatContacts& contacts = segment(domain, contact.contact_class, contact.partner);
    contacts.add(std::move(contact));
    return contacts;
}

/// Forces of the dashpots in the step that was published last: the forces applied less their elastic parts.
gf::DashpotMemory FlatGrains::recall_dashpots(const ContactOwner& owner) const {
    const GrainPhys& phys = *owner.phys;
    if (!(phys.normalCoefficient > 0))
        return {};
    const Real factor = functors.grain_law->normalLaw == "report" ? 0.5 : 1;
    const Real root_overlap = phys.kn / (1.5 * factor * phys.normalCoefficient);
    const Real elastic = 2. / 3 * phys.kn * root_overlap * root_overlap;
    return {phys.normalForce.dot(owner.geom->normal) - elastic, phys.shearForce - phys.shearElastic};
}

void FlatGrains::take_over_states() {
#pragma omp parallel for schedule(static) if (bodies_.spheres() > 1000)
    for (int i = 0; i < bodies_.spheres(); ++i) {
        const auto at = static_cast<size_t>(i);
        const State& state = *yade_[at]->state;
        bodies_.places[at].centre = state.pos;
        bodies_.motions[at] = {state.vel, state.angVel};
        bodies_.orientations[at] = state.ori;
        bodies_.inertias[at] = {state.mass, state.inertia, state.blockedDOFs, state.isDamped};
    }
}

void FlatGrains::read_obstacles() {
    const auto spheres = static_cast<size_t>(bodies_.spheres());
    for (size_t i = spheres; i < yade_.size(); ++i) {
        const State& state = *yade_[i]->state;
        bodies_.places[i].centre = state.pos;
        bodies_.motions[i] = {state.vel, state.angVel};
        bodies_.obstacles[i - spheres].axes = state.ori.toRotationMatrix();
    }
}

} // namespace yade
