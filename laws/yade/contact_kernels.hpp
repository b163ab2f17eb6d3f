// SPDX-License-Identifier: GPL-2.0-or-later
// From YADE's contact objects to the kernels of laws/hertz_mindlin.hpp and back: translation only.
#pragma once

#include <laws/hertz_mindlin.hpp>
#include <laws/yade/GrainEffectPhys.hpp>
#include <laws/yade/Law2_ScGeom_GrainPhys_HertzMindlin.hpp>
#include <laws/yade/contact_rotation.hpp>
#include <laws/yade/kernel_table.hpp>
#include <laws/yade/wet_contact.hpp>

#include <core/Body.hpp>
#include <core/Cell.hpp>
#include <core/Interaction.hpp>
#include <core/State.hpp>

#include <cmath>

namespace yade {

using Law = Law2_ScGeom_GrainPhys_HertzMindlin;

/// The kernels of one tangential law, for each normal law plain and with energy booking. Each tangential law
/// is a translation unit of its own (contact_kernels_*.cpp), to keep compilation short.
struct KernelTables {
    struct Pair {
        Law::KernelTable plain;
        Law::KernelTable booking;
    };
    Pair hertz;
    Pair report;
};
const KernelTables& incremental_kernels();
const KernelTables& partial_slip_kernels();
const KernelTables& secant_kernels();
const KernelTables& report_kernels();
const KernelTables& frictionless_kernels();

namespace kernels {

namespace gl = grainfall::laws;

/// The dashpots' forces of the last step, which the energy book needs and which follow from what the contact
/// keeps anyway: the force applied less its elastic part.
template <class Normal>
void recall_viscous_forces(const GrainPhys& phys, const Vector3r& normal, gl::DissipationBook& book) {
    const Real root_overlap = phys.kn / Normal::stiffness(phys.normalCoefficient, 1.0);
    const Real elastic = Normal::force(phys.normalCoefficient, root_overlap * root_overlap, root_overlap);
    // The normal has turned since: it gives the sign, not the length.
    book.normal_viscous_force =
        std::copysign(phys.normalForce.norm(), phys.normalForce.dot(normal)) - elastic;
    book.shear_viscous_force = phys.shearForce - phys.shearElastic;
}

inline void recall(const GrainPhys& phys, gl::ContactMemory& memory) {
    memory.shear_force = phys.shearElastic;
    memory.shear_stiffness = phys.ks;
}
inline void recall(const GrainPhys& phys, gl::PartialSlipMemory& memory) {
    recall(phys, static_cast<gl::ContactMemory&>(memory));
    if (const PartialSlip* slip = slip_of(phys))
        slip->recall(memory.history);
}
inline void keep(GrainPhys& phys, const gl::ContactMemory& memory) {
    phys.shearElastic = memory.shear_force;
}
inline void keep(GrainPhys& phys, const gl::PartialSlipMemory& memory) {
    keep(phys, static_cast<const gl::ContactMemory&>(memory));
    phys.effects()->keep_slip(memory.history);
}

/// The contact with room for what the kernel keeps in it.
template <class Memory>
GrainPhys& with_room(GrainPhys& phys, Interaction& contact) {
    if constexpr (std::is_same_v<Memory, gl::PartialSlipMemory>)
        return GrainEffectPhys::of(contact);
    else
        return phys;
}

[[gnu::always_inline]] inline void apply_force(ForceContainer& forces, const Vector3r& force_on_2,
                                               const ScGeom& geom, Body::id_t id1, Body::id_t id2,
                                               const State& state1, const State& state2,
                                               const Vector3r& shift2) {
    forces.addForce(id1, -force_on_2);
    forces.addForce(id2, force_on_2);
    forces.addTorque(id1, -(geom.contactPoint - state1.pos).cross(force_on_2));
    forces.addTorque(id2, (geom.contactPoint - state2.pos - shift2).cross(force_on_2));
}

/// Constant friction is a number that every YADE law keeps in the same place; the other curves are held by
/// the contact, and its class, which chose this kernel, tells of which form it is.
template <class Friction>
decltype(auto) friction_of(const GrainPhys& phys) {
    if constexpr (std::is_same_v<Friction, gl::friction::Constant>) {
        return gl::friction::Constant{phys.tangensOfFrictionAngle};
    } else if constexpr (std::is_same_v<Friction, gl::friction::Any>) {
        return (static_cast<const GrainEffectPhys&>(phys).curve());
    } else {
        const auto* curve = std::get_if<Friction>(&static_cast<const GrainEffectPhys&>(phys).curve().curve());
        if (!curve)
            __builtin_unreachable();
        return (*curve);
    }
}

template <class Normal, class Tangential, class Damping, class Friction, class Energy>
[[gnu::always_inline]] inline bool inlined_step(Law& law, const ScGeom& geom, GrainPhys& given,
                                                Interaction& contact) {
    using ContactLaw = gl::HertzMindlin<Normal, Tangential, Damping, Friction, Energy>;
    if (geom.penetrationDepth < 0) {
        if constexpr (Energy::active && Tangential::active) {
            typename ContactLaw::Memory memory;
            recall(given, memory);
            law.book(0, 0, gl::shear_elastic_energy(memory), 0);
        }
        return false;
    }
    Scene& scene = *law.scene;
    GrainPhys& phys = with_room<typename ContactLaw::Memory>(given, contact);
    const Body::id_t id1 = contact.getId1(), id2 = contact.getId2();
    const State& state1 = *Body::byId(id1, &scene)->state;
    const State& state2 = *Body::byId(id2, &scene)->state;
    Vector3r shift2 = Vector3r::Zero();
    if (scene.isPeriodic)
        shift2 = scene.cell->intrShiftPos(contact.cellDist);

    gl::ContactGeometry geometry;
    geometry.overlap = geom.penetrationDepth;
    geometry.normal = geom.normal;
    geometry.shear_increment = geom.shearIncrement();
    geometry.tilt = contact_tilt(geom);
    geometry.twist = contact_twist(geom);
    geometry.time_step = scene.dt;
    Vector3r velocity_at_contact;
    if constexpr (Damping::active || Energy::active) {
        Vector3r shift_velocity = Vector3r::Zero();
        if (scene.isPeriodic)
            shift_velocity = scene.cell->intrShiftVel(contact.cellDist);
        velocity_at_contact = geom.getIncidentVel(&state1, &state2, scene.dt, shift2, shift_velocity, false);
        geometry.normal_velocity = velocity_at_contact.dot(geom.normal);
    }

    const gl::ContactParameters parameters{phys.normalCoefficient, phys.shearCoefficient, phys.normalDamping,
                                           phys.shearDamping};
    typename ContactLaw::Memory memory;
    recall(phys, memory);

    Energy book;
    Vector3r shear_before;
    if constexpr (Energy::active) {
        recall_viscous_forces<Normal>(phys, geom.normal, book);
        shear_before = gl::rotated_with_contact(phys.shearForce, geometry);
    }
    const gl::ContactForce force =
        ContactLaw::step(geometry, parameters, friction_of<Friction>(phys), memory, book);
    if constexpr (Energy::active) {
        // Forces lie in the contact plane: the normal part of the velocity does not count.
        const Vector3r excess = geometry.shear_increment - scene.dt * velocity_at_contact;
        const Real kinematics = Tangential::active ? -0.5 * (shear_before + force.shear).dot(excess) : 0;
        law.book(book.friction, book.viscous, book.rescaling, kinematics);
    }

    phys.kn = force.normal_stiffness;
    phys.ks = force.shear_stiffness;
    phys.normalForce = force.normal * geom.normal;
    phys.isSliding = force.sliding;
    if constexpr (Tangential::active) {
        phys.shearForce = force.shear;
        keep(phys, memory);
        const Vector3r force_on_2 = phys.normalForce + phys.shearForce;
        apply_force(scene.forces, force_on_2, geom, id1, id2, state1, state2, shift2);
    } else {
        // Another law may have acted before.
        phys.shearForce = Vector3r::Zero();
        phys.shearElastic = Vector3r::Zero();
        apply_force(scene.forces, phys.normalForce, geom, id1, id2, state1, state2, shift2);
    }
    return true;
}

template <class Normal, class Tangential, class Damping, class Friction, class Energy>
bool step(LawEntry& entry, shared_ptr<IGeom>& geometry, shared_ptr<IPhys>& physics, Interaction* contact) {
    return inlined_step<Normal, Tangential, Damping, Friction, Energy>(
        static_cast<Law&>(entry), static_cast<const ScGeom&>(*geometry), static_cast<GrainPhys&>(*physics),
        *contact);
}

/// Left to itself, the compiler passes some vectors of the contact through memory. It does so with this order
/// too where the same translation unit has kernels without it.
template <class Normal, class Tangential, class Damping, class Friction, class Energy>
[[gnu::flatten]] bool flat_step(LawEntry& entry, shared_ptr<IGeom>& geometry, shared_ptr<IPhys>& physics,
                                Interaction* contact) {
    return inlined_step<Normal, Tangential, Damping, Friction, Energy>(
        static_cast<Law&>(entry), static_cast<const ScGeom&>(*geometry), static_cast<GrainPhys&>(*physics),
        *contact);
}

struct StepMaker {
    template <class Normal, class Tangential, class Damping, class Friction, class Energy>
    static Law::Kernel kernel() {
        // The history of partial slip is too long a code to be worth it.
        if constexpr (std::is_same_v<Tangential, gl::PartialSlipTangential>)
            return &step<Normal, Tangential, Damping, Friction, Energy>;
        else
            return &flat_step<Normal, Tangential, Damping, Friction, Energy>;
    }
};

template <class Normal, class Tangential, class Energy>
Law::KernelTable make_table() {
    Law::KernelTable table{};
    DryKernels<StepMaker, Normal, Tangential, Energy, Law::KernelTable>::put(table);
    put_wet_kernels(table, Energy::active);
    return table;
}

template <class Normal, class Tangential>
KernelTables::Pair both() {
    return {make_table<Normal, Tangential, gl::NoEnergy>(),
            make_table<Normal, Tangential, gl::DissipationBook>()};
}

template <class Tangential>
const KernelTables& make_tables() {
    static const KernelTables tables{both<gl::Hertz, Tangential>(), both<gl::ReportNormal, Tangential>()};
    return tables;
}

} // namespace kernels
} // namespace yade
