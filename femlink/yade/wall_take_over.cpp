// SPDX-License-Identifier: GPL-2.0-or-later
// A wall put where grains have come to rest: it was there when they were poured, so it lies where it is under
// their forces, and nothing moves when it takes the place of a rigid container.
#include <femlink/yade/FemWall.hpp>

#include <femlink/yade/Ig2_FemFace_Sphere_ScGeom.hpp>
#include <laws/yade/GrainPhys.hpp>
#include <laws/yade/Law2_ScGeom_GrainPhys_HertzMindlin.hpp>

#include <core/InteractionContainer.hpp>
#include <core/Omega.hpp>
#include <core/Scene.hpp>
#include <pkg/common/Sphere.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace yade {

namespace fl = grainfall::femlink;

namespace {

Body& sphere_of(Scene& scene, int id) {
    const bool there = id >= 0 && static_cast<size_t>(id) < scene.bodies->size();
    Body* body = there ? Body::byId(id, &scene).get() : nullptr;
    if (!body || !dynamic_cast<const Sphere*>(body->shape.get()))
        throw std::runtime_error("FemWall.takeOver: spheres: body " + std::to_string(id) +
                                 " is no sphere: must be one");
    return *body;
}

void require_equal_lengths(size_t faces, size_t spheres, size_t shear) {
    if (spheres != faces || shear != faces)
        throw std::runtime_error("FemWall.takeOver: " + std::to_string(faces) + " faces, " +
                                 std::to_string(spheres) + " spheres, " + std::to_string(shear) +
                                 " shear forces: must be as many of each");
}

} // namespace

void FemWall::take_over(const vector<int>& face_ids, const vector<int>& spheres,
                        const vector<Vector3r>& shear) {
    require_equal_lengths(face_ids.size(), spheres.size(), shear.size());
    scene = Omega::instance().getScene().get();
    if (preparedStep >= 0)
        throw std::runtime_error("FemWall.takeOver: the wall has been solved already: must come before the "
                                 "first step");
    lists_.read(interaction_loop(), {});
    lists_.set_scene(scene);
    set_up();
    check_functors(lists_);
    law_ = Law2_ScGeom_GrainPhys_HertzMindlin::acting_in(*scene);
    std::map<std::pair<int, int>, Vector3r> shear_of;
    vector<FacePair> pairs;
    for (size_t i = 0; i < spheres.size(); ++i) {
        Body& sphere = sphere_of(*scene, spheres[i]);
        if (face_of(face_ids[i]) < 0)
            throw std::runtime_error("FemWall.takeOver: faces: body " + std::to_string(face_ids[i]) +
                                     " is no face of this wall");
        const shared_ptr<Interaction> contact(new Interaction(face_ids[i], sphere.id));
        scene->interactions->insert(contact);
        pairs.push_back({contact, Body::byId(face_ids[i], scene).get(), &sphere});
        shear_of[{face_ids[i], sphere.id}] = shear[i];
    }
    sort_pairs(pairs);
    find_touches(pairs);
    for (size_t i = 0; i < partners_.size(); ++i) {
        const Partner& partner = partners_[i];
        make(partner.contact, i, lists_);
        auto* phys = dynamic_cast<GrainPhys*>(partner.contact->phys.get());
        if (!phys)
            throw std::runtime_error("FemWall.takeOver: a contact is a " +
                                     partner.contact->phys->getClassName() + ": must be a GrainPhys");
        const Real overlap = static_cast<const ScGeom&>(*partner.contact->geom).penetrationDepth;
        phys->shearElastic = shear_of.at({partner.face->id, partner.sphere->id});
        // Without the stiffness that belongs to it, the law would take the spring's energy for new.
        phys->ks = phys->shearCoefficient * std::sqrt(std::max(overlap, Real(0)));
    }
    settle();
}

/// The forces that the touches have where the wall now is are those that the datum belongs to.
void FemWall::settle() {
    const fl::SolverOptions options{tolerance, maxSweeps};
    for (size_t i = 0; i < touches_.size(); ++i) {
        fl::WallTouch& touch = touches_[i];
        const Matrix3r own = touch.own;
        touch.own.setZero(); // the wall held
        wall_->solve_alone(touch, law_contact(i), options);
        touch.own = own;
        touch.forget_course();
    }
    if (continuum) { // its stress at rest is not known, only that it balances these forces
        const fl::Positions still = fl::Positions::Zero(3, wall_->surface().node_count());
        wall_->put(still, wall_->loads_on_nodes(touches_));
        startForces = by_node(wall_->nodal_forces());
        return;
    }
    wall_->settle_under(touches_);
    datum = by_node(wall_->datum());
    for (fl::WallTouch& touch : touches_)
        touch.seen = touch.seen_before = wall_->seen(touch.site);
    see_surface();
}

} // namespace yade
