// SPDX-License-Identifier: GPL-2.0-or-later
#include <femlink/yade/FemWall.hpp>

#include <engines/flat/yade/GrainInteractionLoop.hpp>
#include <femlink/explicit/explicit_continuum.hpp>
#include <femlink/yade/Ig2_FemFace_Sphere_ScGeom.hpp>
#include <laws/yade/GrainEffectPhys.hpp>
#include <laws/yade/Law2_ScGeom_GrainPhys_HertzMindlin.hpp>

#include <core/InteractionContainer.hpp>
#include <core/Omega.hpp>
#include <core/Scene.hpp>
#include <pkg/common/Sphere.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>

namespace yade {

YADE_PLUGIN((FemWall));
CREATE_LOGGER(FemWall);

namespace fl = grainfall::femlink;

namespace {

vector<Vector3r> list_of(const fl::Positions& columns) {
    vector<Vector3r> list;
    for (Eigen::Index i = 0; i < columns.cols(); ++i)
        list.push_back(columns.col(i));
    return list;
}

constexpr size_t nowhere = static_cast<size_t>(-1);

/// Elastic shear force of the last step, turned into the contact plane of this one.
Vector3r turned_into_plane(const Vector3r& force, const Vector3r& normal) {
    const Vector3r inside = force - normal.dot(force) * normal;
    const Real length = inside.norm();
    return length > 0 ? Vector3r(inside * (force.norm() / length)) : Vector3r::Zero();
}

} // namespace

namespace {

vector<FemWall*> walls_of(const Scene& scene) {
    vector<FemWall*> walls;
    for (const auto& engine : scene.engines)
        if (auto* wall = dynamic_cast<FemWall*>(engine.get()))
            if (!wall->dead)
                walls.push_back(wall);
    return walls;
}

} // namespace

bool is_wall(const Engine& engine) {
    return dynamic_cast<const FemWall*>(&engine);
}

bool has_walls(const Scene& scene) {
    return !walls_of(scene).empty();
}

void prepare_walls(Scene& scene, const vector<FacePair>& pairs, FunctorLists& functors) {
    for (FemWall* wall : walls_of(scene)) {
        wall->scene = &scene;
        vector<FacePair> own;
        std::copy_if(pairs.begin(), pairs.end(), std::back_inserter(own),
                     [&](const FacePair& pair) { return wall->has_face(*pair.face); });
        wall->prepare(own, functors);
    }
}

void prepare_walls(Scene& scene) {
    for (FemWall* wall : walls_of(scene))
        wall->prepare_in_scene();
}

WallEnergies wall_energies(const Scene& scene) {
    WallEnergies sum;
    for (const FemWall* wall : walls_of(scene)) {
        sum.stored += wall->storedEnergy;
        sum.dissipated += wall->dissipatedEnergy;
        sum.supplied += wall->boundaryWork;
    }
    return sum;
}

ExchangeLimit exchange_limit(const Scene& scene) {
    ExchangeLimit least;
    for (const FemWall* wall : walls_of(scene)) {
        const ExchangeLimit limit = wall->exchange_limit();
        if (limit.step < least.step)
            least = limit;
    }
    return least;
}

void FemWall::validate() const {
    using namespace grainfall::laws;
    if (coupling != "implicit" && coupling != "staggered")
        reject("FemWall.coupling", "'" + coupling + "'", "'implicit' or 'staggered'");
    if (interval < 1)
        reject("FemWall.interval", interval, ">= 1");
    require_not_negative("FemWall.patch", patch);
    require_not_negative("FemWall.drift", drift);
    if (!(tolerance > 0 && tolerance < 1))
        reject("FemWall.tolerance", tolerance, "in (0, 1)");
    if (maxSweeps < 1)
        reject("FemWall.maxSweeps", maxSweeps, ">= 1");
    for (int axis = 0; axis < 3; ++axis)
        require_finite("FemWall.velocity", velocity[axis]);
    if (continuum && velocity != Vector3r::Zero())
        reject("FemWall.velocity", velocity.norm(), "0 with a continuum that has inertia");
}

void FemWall::postLoad(FemWall&) {
    validate();
    wall_.reset();
    if (continuum) {
        fl::WallModel model;
        model.surface = continuum->continuum().surface();
        model.preload = fl::Positions::Zero(3, model.surface.node_count());
        wall_ = std::make_unique<fl::QuasiStaticWall>(std::move(model));
        restore();
        return;
    }
    if (file.empty())
        return;
    fl::WallModel model = fl::load_wall(file);
    if (key.empty())
        key = model.key;
    else if (model.key != key)
        throw std::runtime_error("FemWall.file = '" + file + "': it holds wall " + model.key +
                                 ", the scene was made with " + key);
    wall_ = std::make_unique<fl::QuasiStaticWall>(std::move(model));
    restore();
}

/// From what preSave has kept; interactions follow with the first look at the scene.
void FemWall::restore() {
    touches_.clear();
    partners_.clear();
    const auto columns = [&](const vector<Vector3r>& list) {
        fl::Positions out = fl::Positions::Zero(3, wall_->surface().node_count());
        for (size_t i = 0; i < list.size() && i < static_cast<size_t>(out.cols()); ++i)
            out.col(static_cast<Eigen::Index>(i)) = list[i];
        return out;
    };
    wall_->put(columns(savedDisplacement), columns(savedForces));
    wall_->put_datum(columns(datum));
    glide_start_ = columns(savedGlideStart);
    load_sum_ = columns(savedLoadSum);
    restored_ = true;
    for (size_t i = 0; i < savedTouches.size() && i < savedNumbers.size(); ++i) {
        fl::WallTouch touch;
        Partner partner;
        const vector<Real>& numbers = savedNumbers[i];
        touch.sphere = savedTouches[i][0];
        if (!touch.is_empty() && numbers.size() == 17) {
            const auto three = [&](size_t at) {
                return Vector3r(numbers[at], numbers[at + 1], numbers[at + 2]);
            };
            touch.place.face = savedTouches[i][1];
            touch.anchor.face = savedTouches[i][2];
            touch.anchor.at = {numbers[0], numbers[1]};
            touch.anchor.normal = three(2);
            wall_->put_site(touch, patch);
            touch.force = three(5);
            touch.seen = three(8);
            touch.drift = three(11);
            partner.velocity = three(14);
        }
        touches_.push_back(touch);
        partners_.push_back(partner);
    }
}

void FemWall::preSave(FemWall&) {
    savedDisplacement.clear();
    savedForces.clear();
    savedTouches.clear();
    savedNumbers.clear();
    if (!wall_)
        return;
    savedGlideStart = list_of(glide_start_);
    savedLoadSum = list_of(load_sum_);
    wall_->forget_matrix(); // so that this run goes on as the saved one will, to the last bit
    for (int i = 0; i < wall_->surface().node_count(); ++i) {
        savedDisplacement.push_back(wall_->displacement().col(i));
        savedForces.push_back(wall_->nodal_forces().col(i));
    }
    for (size_t i = 0; i < touches_.size(); ++i) {
        const fl::WallTouch& touch = touches_[i];
        savedTouches.emplace_back(touch.sphere, touch.place.face, touch.anchor.face);
        vector<Real> numbers = {touch.anchor.at[0], touch.anchor.at[1]};
        for (const Vector3r& three :
             {touch.anchor.normal, Vector3r(touch.force), touch.seen, touch.drift, partners_[i].velocity})
            numbers.insert(numbers.end(), three.data(), three.data() + 3);
        savedNumbers.push_back(numbers);
    }
}

bool FemWall::has_face(const Body& body) {
    if (shapes_.empty())
        set_up();
    return face_of(body.id) >= 0;
}

shared_ptr<Engine> FemWall::interaction_loop() const {
    bool passed_this = false;
    for (const auto& engine : scene->engines) {
        passed_this |= engine.get() == this;
        if (!dynamic_cast<InteractionLoop*>(engine.get()))
            continue;
        if (!passed_this)
            throw std::runtime_error("FemWall stands after the InteractionLoop in O.engines: must stand "
                                     "between the collider and it");
        return engine;
    }
    throw std::runtime_error("FemWall: no InteractionLoop in O.engines: one must follow the wall");
}

void FemWall::set_up() {
    if (!wall_)
        throw std::runtime_error("FemWall.file = '': must be a wall file; make walls with "
                                 "grainfall.femlink.add_wall");
    if (scene->isPeriodic)
        throw std::runtime_error("FemWall: O.periodic = True: must be False with a deformable wall");
    if (static_cast<int>(faces.size()) != wall_->surface().face_count())
        throw std::runtime_error("FemWall.faces: " + std::to_string(faces.size()) + " bodies, must be " +
                                 std::to_string(wall_->surface().face_count()) +
                                 ", one a face of the wall in its file");
    shapes_.clear();
    face_of_body_.assign(scene->bodies->body.size(), -1);
    for (size_t i = 0; i < faces.size(); ++i) {
        const bool there = faces[i] >= 0 && static_cast<size_t>(faces[i]) < scene->bodies->body.size() &&
                           scene->bodies->body[static_cast<size_t>(faces[i])];
        auto* shape =
            there ? dynamic_cast<FemFace*>(scene->bodies->body[static_cast<size_t>(faces[i])]->shape.get())
                  : nullptr;
        if (!shape)
            throw std::runtime_error("FemWall.faces: body " + std::to_string(faces[i]) +
                                     " is no FemFace (any more): the faces of a wall stay in the scene");
        shapes_.push_back(shape);
        face_of_body_[static_cast<size_t>(faces[i])] = static_cast<int>(i);
    }
    write_faces();
}

void FemWall::check_functors(FunctorLists& lists) const {
    const auto geometry = lists.geometry(*shapes_.front(), Sphere());
    if (!geometry.functor)
        throw std::runtime_error("FemWall: the InteractionLoop has no Ig2_FemFace_Sphere_ScGeom");
    if (!lists.grain_law)
        return;
    const auto law = lists.law(FemGeom(), GrainPhys());
    if (!law || law->getClassName() != "Law2_FemGeom_GrainPhys_HertzMindlin")
        throw std::runtime_error(
            "FemWall: the InteractionLoop has no Law2_FemGeom_GrainPhys_HertzMindlin: add "
            "it beside Law2_ScGeom_GrainPhys_HertzMindlin");
}

void FemWall::action() {
    // That loop asks for the wall itself, when it knows which spheres are near.
    if (auto* loop = dynamic_cast<GrainInteractionLoop*>(interaction_loop().get()))
        if (!loop->dead)
            return;
    prepare_in_scene();
}

void FemWall::prepare_in_scene() {
    const shared_ptr<Engine> loop = interaction_loop();
    if (listed_loop_ != loop.get()) {
        lists_.read(loop, {});
        listed_loop_ = loop.get();
        checked_lists_ = nullptr;
    }
    lists_.set_scene(scene);
    if (shapes_.empty())
        set_up();
    vector<FacePair> pairs = pairs_in_scene(lists_);
    prepare(pairs, lists_);
}

vector<FacePair> FemWall::pairs_in_scene(FunctorLists& lists) {
    vector<FacePair> pairs;
    for (const int id : faces) {
        Body* face = Body::byId(id, scene).get();
        for (const auto& [other, contact] : face->intrs) {
            Body* sphere = Body::byId(other, scene).get();
            if (!sphere || !dynamic_cast<const Sphere*>(sphere->shape.get()))
                continue;
            if (contact->getId1() != id && !contact->isReal() && !contact->geom) {
                contact->swapOrder();
                contact->functorCache.geom = lists.geometry(*face->shape, *sphere->shape).functor;
                contact->functorCache.geomExists = true;
            }
            pairs.push_back({contact, face, sphere});
        }
    }
    return pairs;
}

void FemWall::prepare(vector<FacePair>& pairs, FunctorLists& lists) {
    if (preparedStep == scene->iter)
        return;
    if (shapes_.empty())
        set_up();
    if (checked_lists_ != &lists) {
        check_functors(lists);
        checked_lists_ = &lists;
    }
    if (restored_)
        find_interactions();
    compare_with_law();
    if (preparedStep >= 0)
        shift += scene->dt * velocity;
    if (continuum && preparedStep >= 0)
        move_continuum();
    const Vector3r force_before = force;
    for (fl::WallTouch& touch : touches_)
        touch.seen_before = touch.seen;
    find_touches(pairs);
    make_new_contacts_real(lists);
    solve(solvedStep < 0 || scene->iter - solvedStep >= interval);
    boundaryWork -= 0.5 * scene->dt * velocity.dot(force + force_before);
    preparedStep = scene->iter;
    write_faces();
}

/// Of the touches that a file has brought back.
void FemWall::find_interactions() {
    for (size_t i = 0; i < touches_.size(); ++i)
        if (!touches_[i].is_empty())
            partners_[i].contact = scene->interactions->find(
                faces[static_cast<size_t>(touches_[i].place.face)], touches_[i].sphere);
    restored_ = false;
}

/// Before the forces of the last step are overwritten.
void FemWall::compare_with_law() {
    if (coupling != "implicit" || continuum)
        return;
    Real largest = 0, difference = 0;
    for (size_t i = 0; i < touches_.size(); ++i) {
        if (touches_[i].is_empty() || !partners_[i].contact || !partners_[i].contact->isReal())
            continue;
        const auto* phys = dynamic_cast<const FrictPhys*>(partners_[i].contact->phys.get());
        if (!phys)
            continue;
        const Vector3r law = phys->normalForce + phys->shearForce;
        largest = std::max(largest, law.norm());
        difference = std::max(difference, (law - touches_[i].site.axes * touches_[i].force).norm());
    }
    disagreement = largest > 0 ? difference / largest : 0;
}

size_t FemWall::known_touch(const FacePair& pair) const {
    const auto places = places_.find(pair.sphere->id);
    if (places == places_.end())
        return nowhere;
    for (const size_t i : places->second)
        if (faces[static_cast<size_t>(touches_[i].place.face)] == pair.face->id)
            return i;
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

void FemWall::find_touches(vector<FacePair>& pairs) {
    places_.clear();
    for (size_t i = 0; i < touches_.size(); ++i) {
        partners_[i].found = false;
        if (!touches_[i].is_empty())
            places_[touches_[i].sphere].push_back(i);
    }
    std::sort(pairs.begin(), pairs.end(), [&](const FacePair& a, const FacePair& b) {
        return std::make_pair(a.sphere->id, a.face->id) < std::make_pair(b.sphere->id, b.face->id);
    });
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
void FemWall::find_touches_of(vector<FacePair>::iterator begin, vector<FacePair>::iterator end) {
    const Body& sphere = *begin->sphere;
    const Real radius = static_cast<const Sphere&>(*sphere.shape).radius;
    const Vector3r centre = sphere.state->pos - shift;
    vector<int> near, held;
    // A wall that is pressed in comes back as the load leaves it, so all that is inside the unloaded wall
    // takes part; a bridge holds on further out.
    Real reach = radius + largest_displacement_;
    for (auto pair = begin; pair != end; ++pair) {
        const int face = face_of(pair->face->id);
        near.push_back(face);
        const size_t place = known_touch(*pair);
        if (place != nowhere)
            held.push_back(face);
        const auto* phys = dynamic_cast<const GrainPhys*>(pair->contact->phys.get());
        if (phys && bridge_of(*phys))
            reach = std::max(reach, 1.5 * radius);
    }
    const auto pair_of = [&](int face) {
        return std::find_if(begin, end, [&](const FacePair& pair) { return face_of(pair.face->id) == face; });
    };
    const vector<fl::SurfaceContact> found =
        fl::surface_contacts(wall_->surface(), positions_, near, held, centre, reach);
    const auto takes_part = [&](const fl::SurfaceContact& contact, bool is_real) {
        return is_real || contact.distance < radius ||
               (!continuum && wall_->free_overlap(contact, centre, radius) > 0);
    };
    vector<char> placed(found.size(), 0);
    for (size_t k = 0; k < found.size(); ++k) { // where they were
        const auto pair = pair_of(found[k].face);
        const size_t place = known_touch(*pair);
        if (place == nowhere || !takes_part(found[k], pair->contact->isReal()))
            continue;
        follow(place, found[k], *pair);
        placed[k] = 1;
    }
    for (size_t k = 0; k < found.size(); ++k) { // from another face
        for (const size_t i : places_[sphere.id]) {
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
    partner.face = pair.face;
    partner.sphere = pair.sphere;
    partner.found = true;
    touch.free_overlap =
        wall_->free_overlap(found, touch.site, pair.sphere->state->pos - shift, radius_of(place));
}

/// Their stiffness is needed before the loop would have made them. A touch may be no contact: one that has
/// parted from the wall where that is pressed in.
void FemWall::make_new_contacts_real(FunctorLists& lists) {
    for (size_t i = 0; i < touches_.size(); ++i) {
        if (touches_[i].is_empty() || partners_[i].contact->isReal())
            continue;
        Partner& partner = partners_[i];
        Interaction& contact = *partner.contact;
        const auto geometry = lists.geometry(*partner.face->shape, *partner.sphere->shape).functor;
        const auto physics = lists.physics(*partner.face->material, *partner.sphere->material);
        auto& shape = static_cast<FemFace&>(*partner.face->shape);
        shape.touches.assign(1, face_touch(i));
        geometry->go(partner.face->shape, partner.sphere->shape, *partner.face->state, *partner.sphere->state,
                     Vector3r::Zero(), false, partner.contact);
        physics->go(partner.face->material, partner.sphere->material, partner.contact);
        contact.functorCache.geom = geometry;
        contact.functorCache.geomExists = true;
        contact.functorCache.phys = physics;
        contact.iterMadeReal = contact.iterLastSeen = scene->iter;
    }
}

/// `steps`: in which the wall goes where the solution puts it, which the dashpots must know.
fl::LawContact FemWall::law_contact(size_t place, int steps) const {
    fl::LawContact out;
    const fl::WallTouch& touch = touches_[place];
    if (touch.is_empty())
        return out;
    const Partner& partner = partners_[place];
    const Matrix3r& axes = touch.site.axes;
    const Vector3r normal = axes.col(0);
    const State& state = *partner.sphere->state;
    const Vector3r moved =
        scene->dt * (state.vel - velocity - (radius_of(place) * state.angVel).cross(normal));
    const Vector3r shift_seen = -moved - touch.seen_before;
    out.free_overlap = touch.free_overlap;
    out.shift = {shift_seen.dot(axes.col(1)), shift_seen.dot(axes.col(2))};
    const Real span = steps * scene->dt;
    out.relation.rate = 1 / span;
    out.relation.idle_overlap =
        touch.free_overlap + touch.seen_before.dot(normal) + span * (state.vel - velocity).dot(normal);
    Vector3r shear = Vector3r::Zero();
    if (const auto* grain = dynamic_cast<const GrainPhys*>(partner.contact->phys.get())) {
        const auto* law = Law2_ScGeom_GrainPhys_HertzMindlin::acting_in(*scene);
        const bool report = law && law->normalLaw == "report";
        const bool shears = !law || law->tangentialLaw != "none";
        out.relation.coefficient = (report ? 0.5 : 1) * grain->normalCoefficient;
        out.relation.damping = (report ? std::sqrt(0.5) : 1) * grain->normalDamping;
        out.relation.attracts = ContactClass(grain->contactClass).dashpot() == DashpotForm::attractive;
        out.shear_coefficient = shears ? grain->shearCoefficient : 0;
        out.shear_damping = shears ? grain->shearDamping : 0;
        out.loses_on_unloading = !law || law->tangentialLaw != "report";
        out.stiffness_before = grain->ks;
        shear = grain->shearElastic;
        if (ContactClass(grain->contactClass).friction() == FrictionForm::constant)
            out.friction = grain->tangensOfFrictionAngle;
        else
            out.curve = &grain->effects()->curve();
    } else if (const auto* spring = dynamic_cast<const FrictPhys*>(partner.contact->phys.get())) {
        out.relation.linear = true;
        out.relation.coefficient = spring->kn;
        out.shear_coefficient = spring->ks;
        out.friction = spring->tangensOfFrictionAngle;
        shear = spring->shearForce;
    } else {
        throw std::runtime_error("FemWall: a contact on it is a " + partner.contact->phys->getClassName() +
                                 ": must be a FrictPhys, whose stiffness is known");
    }
    shear = turned_into_plane(shear, normal);
    out.shear_before = {shear.dot(axes.col(1)), shear.dot(axes.col(2))};
    return out;
}

/// All contacts together, or, between two such solutions, each alone.
void FemWall::solve(bool together) {
    if (continuum) {
        see_continuum();
        return;
    }
    const bool in_between = coupling == "implicit" && interval > 1;
    const vector<fl::WallTouch> before = together && in_between ? touches_ : vector<fl::WallTouch>();
    vector<fl::LawContact> laws;
    for (size_t i = 0; i < touches_.size(); ++i)
        laws.push_back(law_contact(i, together && in_between ? interval : 1));
    const fl::SolverOptions options{tolerance, maxSweeps};
    if (together) {
        if (coupling == "implicit")
            solve_together(laws, options);
        else
            exchange(laws);
        solvedStep = scene->iter;
        positions_ = wall_->positions();
        largest_displacement_ = std::sqrt(wall_->displacement().colwise().squaredNorm().maxCoeff());
    }
    force = Vector3r::Zero();
    storedEnergy = 0;
    for (size_t i = 0; i < touches_.size(); ++i) {
        fl::WallTouch& touch = touches_[i];
        if (touch.is_empty())
            continue;
        if (together && in_between)
            wall_->approach(touch, before[i], interval);
        else if (together)
            touch.seen = wall_->seen(touch.site);
        if (in_between)
            wall_->solve_alone(touch, together ? law_contact(i) : laws[i], options);
        const Vector3r push = touch.site.axes * touch.force;
        partners_[i].velocity = (touch.seen - touch.seen_before) / scene->dt;
        force -= push;
        storedEnergy -= 0.5 * push.dot(touch.seen);
    }
}

void FemWall::solve_together(const vector<fl::LawContact>& laws, const fl::SolverOptions& options) {
    const fl::SolverReport report = wall_->solve(touches_, laws, options);
    sweeps = report.sweeps;
    lastChange = report.change;
    if (report.converged)
        return;
    if (unfinishedSteps++ == 0)
        LOG_WARN("FemWall: in step " << scene->iter << " forces still change by " << report.change
                                     << " of the largest after maxSweeps = " << maxSweeps
                                     << " sweeps; later steps go on from there (see unfinishedSteps)");
    constexpr Real too_much = 0.2;
    if (!(report.change < too_much))
        throw std::runtime_error("FemWall: in step " + std::to_string(scene->iter) +
                                 " forces still change by " + std::to_string(report.change) +
                                 " of the largest after maxSweeps = " + std::to_string(maxSweeps) +
                                 " sweeps: raise maxSweeps");
}

/// Moves on to the present time. In every `interval`-th step under the mean of the forces since the last; the
/// surface goes there evenly in between.
void FemWall::move_continuum() {
    read_law_forces();
    const fl::Positions loads = wall_->loads_on_nodes(touches_);
    load_sum_ += loads;
    ++loadsSummed;
    fl::ExplicitContinuum& body = continuum->continuum();
    if (glideStep == 0) {
        glide_start_ = wall_->displacement();
        fl::Positions load = load_sum_ / loadsSummed;
        for (size_t i = 0; i < startForces.size(); ++i)
            load.col(static_cast<Eigen::Index>(i)) -= startForces[i];
        body.advance(interval * scene->dt, load);
        if (scene->trackEnergy) {
            const fl::ExplicitEnergies energies = body.energies();
            storedEnergy = energies.kinetic + energies.elastic + energies.hourglass + energies.ground;
            dissipatedEnergy = energies.plastic + energies.absorbed;
        }
        load_sum_.setZero();
        loadsSummed = 0;
    }
    ++glideStep;
    const Real share = static_cast<Real>(glideStep) / interval;
    wall_->put(glide_start_ + share * (body.surface_displacement() - glide_start_), loads);
    if (glideStep >= interval)
        glideStep = 0;
}

/// A contact of stiffness k on a patch of mass m = 1/sum(w^2/m_node) swings with k/m at most.
ExchangeLimit FemWall::exchange_limit() const {
    ExchangeLimit least;
    if (!continuum)
        return least;
    for (size_t i = 0; i < touches_.size(); ++i) {
        const fl::ContactPatch& loaded = touches_[i].site.patch;
        const shared_ptr<Interaction>& touching = partners_[i].contact;
        const auto* phys = touching ? dynamic_cast<const FrictPhys*>(touching->phys.get()) : nullptr;
        if (touches_[i].is_empty() || !phys || !(phys->kn > 0))
            continue;
        Real inverse_mass = 0;
        for (size_t a = 0; a < loaded.nodes.size(); ++a)
            inverse_mass +=
                loaded.weights[a] * loaded.weights[a] / continuum->continuum().surface_mass(loaded.nodes[a]);
        const Real step = 2 / std::sqrt(phys->kn * inverse_mass) / interval;
        if (step < least.step)
            least = {step, {partners_[i].face->id, partners_[i].sphere->id}};
    }
    return least;
}

/// Contacts on the surface as it now lies; the law's forces of this step move it in the next.
void FemWall::see_continuum() {
    force = Vector3r::Zero();
    for (size_t i = 0; i < touches_.size(); ++i) {
        fl::WallTouch& touch = touches_[i];
        if (touch.is_empty())
            continue;
        touch.seen = wall_->seen(touch.site);
        partners_[i].velocity = (touch.seen - touch.seen_before) / scene->dt;
        force -= touch.site.axes * touch.force;
    }
    solvedStep = scene->iter;
    positions_ = wall_->positions();
    largest_displacement_ = std::sqrt(wall_->displacement().colwise().squaredNorm().maxCoeff());
}

/// The report's exchange: the law's forces of the last step displace the wall of this one.
void FemWall::exchange(const vector<fl::LawContact>& laws) {
    read_law_forces();
    const Real gain = wall_->exchange(touches_, laws);
    if (gain >= 1)
        grainfall::laws::reject(
            "FemWall.coupling", "'staggered'",
            "'implicit' here: the contacts' stiffness times the wall's compliance is " +
                std::to_string(gain) +
                ", and exchanging forces step by step diverges from 1 on, whatever the time step");
}

/// Those of the last step into the touches.
void FemWall::read_law_forces() {
    for (size_t i = 0; i < touches_.size(); ++i) {
        if (touches_[i].is_empty())
            continue;
        const shared_ptr<Interaction>& contact = partners_[i].contact;
        const auto* phys = contact ? dynamic_cast<const FrictPhys*>(contact->phys.get()) : nullptr;
        touches_[i].force = Vector3r::Zero();
        if (phys)
            touches_[i].force = touches_[i].site.axes.transpose() * (phys->normalForce + phys->shearForce);
    }
}

FaceTouch FemWall::face_touch(size_t place) const {
    const fl::WallTouch& touch = touches_[place];
    const Partner& partner = partners_[place];
    const Real overlap = touch.overlap();
    const Vector3r& centre = partner.sphere->state->pos;
    return {partner.sphere->id, centre - (radius_of(place) - overlap) * touch.place.normal,
            touch.place.normal, overlap, partner.velocity + velocity};
}

/// What the functors and the collider read.
void FemWall::write_faces() {
    if (positions_.cols() == 0) {
        positions_ = wall_->positions();
        largest_displacement_ = std::sqrt(wall_->displacement().colwise().squaredNorm().maxCoeff());
    }
    const fl::Surface& surface = wall_->surface();
    bool moved = false;
    for (size_t f = 0; f < shapes_.size(); ++f) {
        FemFace& shape = *shapes_[f];
        shape.touches.clear();
        shape.nodes.resize(static_cast<size_t>(surface.faces.rows()));
        shape.unloaded.resize(shape.nodes.size());
        for (size_t k = 0; k < shape.nodes.size(); ++k) {
            const int node = surface.faces(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(f));
            shape.nodes[k] = positions_.col(node) + shift;
            shape.unloaded[k] = wall_->unloaded().col(node) - wall_->datum().col(node) + shift;
        }
        moved |= shape.has_left_bound();
    }
    for (size_t i = 0; i < touches_.size(); ++i)
        if (!touches_[i].is_empty() && partners_[i].contact && partners_[i].contact->isReal())
            shapes_[static_cast<size_t>(touches_[i].place.face)]->touches.push_back(face_touch(i));
    if (moved)
        scene->doSort = true;
}

namespace {

boost::python::list points(const fl::Positions& columns, const Vector3r& offset = Vector3r::Zero()) {
    boost::python::list out;
    for (Eigen::Index i = 0; i < columns.cols(); ++i)
        out.append(Vector3r(columns.col(i) + offset));
    return out;
}

const fl::QuasiStaticWall& loaded(const std::unique_ptr<fl::QuasiStaticWall>& wall) {
    if (!wall)
        throw std::runtime_error("FemWall.file = '': must be a wall file");
    return *wall;
}

} // namespace

boost::python::list FemWall::node_positions() {
    return points(loaded(wall_).positions(), shift);
}

boost::python::list FemWall::node_displacements() {
    return points(loaded(wall_).displacement());
}

boost::python::list FemWall::node_forces() {
    return points(loaded(wall_).nodal_forces());
}

boost::python::list FemWall::face_nodes() {
    boost::python::list out;
    const fl::Surface& surface = loaded(wall_).surface();
    for (int face = 0; face < surface.face_count(); ++face) {
        boost::python::list nodes;
        for (Eigen::Index k = 0; k < surface.faces.rows(); ++k)
            nodes.append(surface.faces(k, face));
        out.append(nodes);
    }
    return out;
}

boost::python::list FemWall::touches_now() {
    boost::python::list out;
    for (size_t i = 0; i < touches_.size(); ++i) {
        const fl::WallTouch& touch = touches_[i];
        if (touch.is_empty() || !partners_[i].sphere)
            continue;
        const FaceTouch seen = face_touch(i);
        boost::python::dict one;
        one["sphere"] = touch.sphere;
        one["face"] = faces[static_cast<size_t>(touch.place.face)];
        one["reference"] = boost::python::make_tuple(touch.place.at[0], touch.place.at[1]);
        one["point"] = seen.point;
        one["normal"] = seen.normal;
        one["overlap"] = seen.overlap;
        one["force"] = Vector3r(touch.site.axes * touch.force);
        one["displacement"] = touch.seen;
        out.append(one);
    }
    return out;
}

} // namespace yade
