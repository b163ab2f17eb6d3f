// SPDX-License-Identifier: GPL-2.0-or-later
#include <engines/projectile/yade/ProjectileLoad.hpp>

#include <laws/yade/GrainEffectPhys.hpp>

#include <core/Interaction.hpp>
#include <core/Scene.hpp>
#include <pkg/common/NormShearPhys.hpp>
#include <pkg/common/Sphere.hpp>
#include <pkg/dem/ScGeom.hpp>

#include <engines/projectile/closest_point.hpp>

#include <array>
#include <stdexcept>
#include <string>

namespace yade {

YADE_PLUGIN((ProjectileLoad));

namespace {

struct ZoneLoad {
    Vector3r force = Vector3r::Zero(), torque = Vector3r::Zero();
    int contacts = 0;
};

Body& projectile(Scene* scene, Body::id_t id) {
    const bool exists = id >= 0 && id < static_cast<Body::id_t>(scene->bodies->size());
    const shared_ptr<Body> body = exists ? (*scene->bodies)[id] : shared_ptr<Body>();
    if (!body || !dynamic_cast<SolidOfRevolution*>(body->shape.get()))
        throw std::runtime_error("ProjectileLoad.body = " + std::to_string(id) +
                                 "; allowed: id of a body whose shape is a SolidOfRevolution");
    return *body;
}

} // namespace

void ProjectileLoad::action() {
    const Body& self = projectile(scene, body);
    const SolidOfRevolution& solid = static_cast<const SolidOfRevolution&>(*self.shape);
    const State& state = *self.state;
    if (solid.hasTurned(state.ori)) // grains may be near that the collider has not seen yet
        scene->doSort = true;

    std::array<ZoneLoad, 3> loads;
    for (const auto& [other, interaction] : self.intrs) {
        if (!interaction->isReal())
            continue;
        const ScGeom* geom = dynamic_cast<const ScGeom*>(interaction->geom.get());
        const NormShearPhys* phys = dynamic_cast<const NormShearPhys*>(interaction->phys.get());
        if (!geom || !phys)
            continue;
        // Points of a contact are given beside body 1; body 2 stands cellDist cells away from its own
        // position.
        const bool isFirst = interaction->getId1() == body;
        const Vector3r shift =
            scene->isPeriodic ? scene->cell->intrShiftPos(interaction->cellDist) : Vector3r(Vector3r::Zero());
        const Vector3r centroid = isFirst ? state.pos : Vector3r(state.pos + shift);
        Vector3r probe = geom->contactPoint;
        const Body& partner = *(*scene->bodies)[other];
        if (isFirst && dynamic_cast<const Sphere*>(partner.shape.get()))
            probe = partner.state->pos + shift; // the point that the contact was found from
        const auto place =
            grainfall::geometry::closest_point(solid.body(), state.ori.conjugate() * (probe - centroid));

        Vector3r onSecond = phys->normalForce + phys->shearForce;
        const GrainPhys* grain = dynamic_cast<const GrainPhys*>(phys);
        if (const LiquidBridge* bridge = grain ? bridge_of(*grain) : nullptr)
            onSecond += bridge->normal_force() * geom->normal;
        const Vector3r force = isFirst ? Vector3r(-onSecond) : onSecond;
        ZoneLoad& load = loads[static_cast<std::size_t>(place.zone)];
        load.force += force;
        load.torque += (geom->contactPoint - centroid).cross(force);
        ++load.contacts;
    }
    noseForce = loads[0].force;
    shaftForce = loads[1].force;
    baseForce = loads[2].force;
    noseTorque = loads[0].torque;
    shaftTorque = loads[1].torque;
    baseTorque = loads[2].torque;
    if (impulseStep != scene->iter) { // a call from Python in between is no step
        impulseStep = scene->iter;
        noseImpulse += noseForce * scene->dt;
        shaftImpulse += shaftForce * scene->dt;
        baseImpulse += baseForce * scene->dt;
    }
    noseContacts = loads[0].contacts;
    shaftContacts = loads[1].contacts;
    baseContacts = loads[2].contacts;
}

} // namespace yade
