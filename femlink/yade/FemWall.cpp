// SPDX-License-Identifier: GPL-2.0-or-later
#include <femlink/yade/FemWall.hpp>

#include <engines/flat/yade/GrainInteractionLoop.hpp>
#include <femlink/yade/Ig2_FemFace_Sphere_ScGeom.hpp>
#include <laws/yade/GrainEffectPhys.hpp>
#include <laws/yade/Law2_ScGeom_GrainPhys_HertzMindlin.hpp>

#include <core/InteractionContainer.hpp>
#include <core/Scene.hpp>
#include <pkg/common/Sphere.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace yade {

YADE_PLUGIN((FemWall));
CREATE_LOGGER(FemWall);

namespace fl = grainfall::femlink;

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
    surface_moved_ = true;
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
    sort_pairs(pairs);
    return pairs;
}

void FemWall::prepare(const vector<FacePair>& pairs, FunctorLists& lists) {
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
    law_ = Law2_ScGeom_GrainPhys_HertzMindlin::acting_in(*scene);
    compare_with_law();
    if (preparedStep >= 0)
        shift += scene->dt * velocity;
    if (continuum && preparedStep >= 0)
        move_continuum();
    const Vector3r force_before = force;
    for (fl::WallTouch& touch : touches_)
        touch.seen_before = touch.seen;
    find_touches(pairs);
    if (!continuum)
        find_physics(lists);
    read_pulls();
    solve(solvedStep < 0 || scene->iter - solvedStep >= interval);
    boundaryWork -= 0.5 * scene->dt * velocity.dot(force + force_before);
    preparedStep = scene->iter;
    write_faces();
}

FaceTouch FemWall::face_touch(size_t place) const {
    const fl::WallTouch& touch = touches_[place];
    const Partner& partner = partners_[place];
    const Real overlap = touch.overlap();
    const Vector3r& centre = partner.sphere->state->pos;
    return {partner.sphere->id, centre - (radius_of(place) - overlap) * touch.place.normal,
            touch.place.normal, overlap, partner.velocity + velocity};
}

/// Where the nodes are, for the next look for contacts.
void FemWall::see_surface() {
    positions_ = wall_->positions();
    largest_displacement_ = std::sqrt(wall_->displacement().colwise().squaredNorm().maxCoeff());
    surface_moved_ = true;
}

/// What the functors and the collider read.
void FemWall::write_faces() {
    if (positions_.cols() == 0)
        see_surface();
    for (FemFace* shape : shapes_)
        shape->touches.clear();
    if (surface_moved_ || velocity != Vector3r::Zero())
        move_faces();
    for (size_t i = 0; i < touches_.size(); ++i)
        if (touches_wall(i))
            shapes_[static_cast<size_t>(touches_[i].place.face)]->touches.push_back(face_touch(i));
}

void FemWall::move_faces() {
    const fl::Surface& surface = wall_->surface();
    bool moved = false;
    for (size_t f = 0; f < shapes_.size(); ++f) {
        FemFace& shape = *shapes_[f];
        shape.nodes.resize(static_cast<size_t>(surface.faces.rows()));
        shape.unloaded.resize(shape.nodes.size());
        for (size_t k = 0; k < shape.nodes.size(); ++k) {
            const int node = surface.faces(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(f));
            shape.nodes[k] = positions_.col(node) + shift;
            shape.unloaded[k] = wall_->unloaded().col(node) - wall_->datum().col(node) + shift;
        }
        moved |= shape.has_left_bound();
    }
    if (moved)
        scene->doSort = true;
    surface_moved_ = false;
}

} // namespace yade
