// SPDX-License-Identifier: GPL-2.0-or-later
// The plain contact in YADE: classes of contacts, and what any law must do.
#pragma once

#include <laws/bridge/liquid_bridge.hpp>
#include <laws/friction/constant.hpp>
#include <laws/friction/power_law.hpp>
#include <laws/hertz_mindlin.hpp>
#include <laws/pair_rules.hpp>
#include <laws/yade/contact_rotation.hpp>

#include <core/Body.hpp>
#include <core/Cell.hpp>
#include <core/Dispatching.hpp>
#include <core/Interaction.hpp>
#include <core/Scene.hpp>
#include <core/State.hpp>
#include <pkg/dem/FrictPhys.hpp>
#include <pkg/dem/ScGeom.hpp>

namespace yade {

namespace gl = grainfall::laws;
namespace gb = grainfall::laws::bridge;

class PlainPhys : public FrictPhys {
public:
    virtual ~PlainPhys() = default;
    // clang-format off
    YADE_CLASS_BASE_DOC_ATTRS_CTOR(PlainPhys, FrictPhys, "Dry contact with constant friction.",
        ((Real, normalCoefficient, 0, , "4/3 E* sqrt(R*) [N/m^1.5]."))
        ((Real, shearCoefficient, 0, , "8 G* sqrt(R*) [N/m^1.5]."))
        ((Real, normalDamping, 0, , "damping coefficient over overlap^0.25 [N s/m^1.25]."))
        ((Real, shearDamping, 0, , "the same in shear [N s/m^1.25]."))
        ((Vector3r, shearElastic, Vector3r::Zero(), , "elastic part of the shear force [N]."))
        ((bool, isSliding, false, , "did the contact slide in the last step?"))
        ,
        createIndex();
    );
    // clang-format on
    REGISTER_CLASS_INDEX(PlainPhys, FrictPhys);
};
REGISTER_SERIALIZABLE(PlainPhys);

class PlainPowerLawPhys : public PlainPhys {
public:
    virtual ~PlainPowerLawPhys() = default;
    gl::friction::PowerLaw curve;
    YADE_CLASS_BASE_DOC_ATTRS_CTOR(PlainPowerLawPhys, PlainPhys, "With friction by a power law.", ,
                                   createIndex(););
    REGISTER_CLASS_INDEX(PlainPowerLawPhys, PlainPhys);
};
REGISTER_SERIALIZABLE(PlainPowerLawPhys);

class PlainWetPhys : public PlainPhys {
public:
    virtual ~PlainWetPhys() = default;
    gb::ForceCurve bridge;
    gb::BridgeMemory memory;
    Real rupture_distance = 0; // m
    YADE_CLASS_BASE_DOC_ATTRS_CTOR(PlainWetPhys, PlainPhys, "With a liquid bridge.", , createIndex(););
    REGISTER_CLASS_INDEX(PlainWetPhys, PlainPhys);
};
REGISTER_SERIALIZABLE(PlainWetPhys);

inline gl::friction::Constant friction_of(const PlainPhys& phys) {
    return {phys.tangensOfFrictionAngle};
}
inline const gl::friction::PowerLaw& friction_of(const PlainPowerLawPhys& phys) {
    return phys.curve;
}

// What any law must do in YADE: gather the motion, keep the result, apply the force.
template <bool sheared, bool damped, class Phys>
[[gnu::always_inline]] inline bool plain_step(Scene* scene, ScGeom& geom, Phys& phys, Interaction& contact) {
    if (geom.penetrationDepth < 0)
        return false;
    const Body::id_t id1 = contact.getId1(), id2 = contact.getId2();
    const State& state1 = *Body::byId(id1, scene)->state;
    const State& state2 = *Body::byId(id2, scene)->state;
    Vector3r shift2 = Vector3r::Zero();
    if (scene->isPeriodic)
        shift2 = scene->cell->intrShiftPos(contact.cellDist);
    gl::ContactGeometry geometry;
    geometry.overlap = geom.penetrationDepth;
    geometry.normal = geom.normal;
    geometry.shear_increment = geom.shearIncrement();
    geometry.tilt = contact_tilt(geom);
    geometry.twist = contact_twist(geom);
    geometry.time_step = scene->dt;
    if constexpr (damped) {
        Vector3r shift_velocity = Vector3r::Zero();
        if (scene->isPeriodic)
            shift_velocity = scene->cell->intrShiftVel(contact.cellDist);
        geometry.normal_velocity =
            geom.getIncidentVel(&state1, &state2, scene->dt, shift2, shift_velocity, false).dot(geom.normal);
    }
    const gl::ContactParameters parameters{phys.normalCoefficient, phys.shearCoefficient, phys.normalDamping,
                                           phys.shearDamping};
    gl::ContactMemory memory;
    memory.shear_force = phys.shearElastic;
    memory.shear_stiffness = phys.ks;
    using Tangential = std::conditional_t<sheared, gl::IncrementalTangential, gl::NoTangential>;
    using Damping = std::conditional_t<damped, gl::RepulsiveDashpot, gl::NoDamping>;
    gl::NoEnergy none;
    const gl::ContactForce force =
        gl::HertzMindlin<gl::Hertz, Tangential, Damping, std::decay_t<decltype(friction_of(phys))>,
                         gl::NoEnergy>::step(geometry, parameters, friction_of(phys), memory, none);
    phys.kn = force.normal_stiffness;
    phys.ks = force.shear_stiffness;
    phys.normalForce = force.normal * geom.normal;
    phys.shearForce = force.shear;
    phys.shearElastic = memory.shear_force;
    phys.isSliding = force.sliding;

    Vector3r on_2;
    if constexpr (sheared)
        on_2 = phys.normalForce + phys.shearForce;
    else
        on_2 = phys.normalForce;
    ForceContainer& forces = scene->forces;
    forces.addForce(id1, -on_2);
    forces.addForce(id2, on_2);
    forces.addTorque(id1, -(geom.contactPoint - state1.pos).cross(on_2));
    forces.addTorque(id2, (geom.contactPoint - state2.pos - shift2).cross(on_2));
    return true;
}

#define PLAIN_LAW(name, phys_class, step)                                                                    \
    class name : public LawFunctor {                                                                         \
    public:                                                                                                  \
        virtual ~name() = default;                                                                           \
        bool go(shared_ptr<IGeom>& geometry, shared_ptr<IPhys>& physics, Interaction* contact) override {    \
            return (step)(scene, static_cast<ScGeom&>(*geometry), static_cast<phys_class&>(*physics),        \
                          *contact);                                                                         \
        }                                                                                                    \
        FUNCTOR2D(ScGeom, phys_class);                                                                       \
        YADE_CLASS_BASE_DOC_ATTRS(name, LawFunctor, "The plain contact and nothing else.", );                \
    };                                                                                                       \
    REGISTER_SERIALIZABLE(name)

} // namespace yade
