// SPDX-License-Identifier: GPL-2.0-or-later
// Plain contacts with one effect each and without those that may come on top of it: friction by a power law
// without moisture and load scaling, a liquid bridge without a viscous film. A file of its own: together with
// them the compiler makes the laws of plain_law.cpp slower.
#include "plain_law.hpp"

namespace yade {

[[gnu::noinline]] bool dry_step(Scene* scene, ScGeom& geom, PlainPhys& phys, Interaction& contact) {
    return plain_step<true, true>(scene, geom, phys, contact);
}

// A dry contact, and a bridge on top of it.
inline bool wet_step(Scene* scene, ScGeom& geom, PlainWetPhys& phys, Interaction& contact) {
    if ((geom.penetrationDepth >= 0 || phys.kn > 0) && !dry_step(scene, geom, phys, contact)) {
        phys.kn = phys.ks = 0;
        phys.normalForce = phys.shearForce = phys.shearElastic = Vector3r::Zero();
    }
    const Body::id_t id1 = contact.getId1(), id2 = contact.getId2();
    const State& state1 = *Body::byId(id1, scene)->state;
    const State& state2 = *Body::byId(id2, scene)->state;
    Vector3r shift2 = Vector3r::Zero();
    if (scene->isPeriodic)
        shift2 = scene->cell->intrShiftPos(contact.cellDist);
    gl::NoEnergy none;
    const gb::BridgeState state = gb::LiquidBridge<gb::WillettNumeric, gb::NoFilm, gl::NoEnergy>::step(
        -geom.penetrationDepth, 0, scene->dt, {phys.bridge, {}, phys.rupture_distance}, phys.memory, none);
    if (state == gb::BridgeState::holding) {
        const Vector3r on_2 = -phys.memory.attraction * geom.normal;
        ForceContainer& forces = scene->forces;
        forces.addForce(id1, -on_2);
        forces.addForce(id2, on_2);
        forces.addTorque(id1, -(geom.contactPoint - state1.pos).cross(on_2));
        forces.addTorque(id2, (geom.contactPoint - state2.pos - shift2).cross(on_2));
    }
    return state != gb::BridgeState::ended;
}

PLAIN_LAW(Law2_ScGeom_PlainPowerLawPhys_Damped, PlainPowerLawPhys,
          (plain_step<true, true, PlainPowerLawPhys>));
PLAIN_LAW(Law2_ScGeom_PlainWetPhys_Damped, PlainWetPhys, (wet_step));

YADE_PLUGIN((Law2_ScGeom_PlainPowerLawPhys_Damped)(Law2_ScGeom_PlainWetPhys_Damped));

} // namespace yade
