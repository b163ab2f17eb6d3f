// SPDX-License-Identifier: GPL-2.0-or-later
// The contact loop over packed arrays: geometry, the law's kernel, forces. One loop for each contact class.
#pragma once

#include <engines/flat/contacts.hpp>

#include <laws/hertz_mindlin.hpp>
#include <laws/sphere_kinematics.hpp>
#include <laws/yade/ContactClass.hpp>
#include <laws/yade/GrainEffectPhys.hpp>
#include <laws/yade/kernel_table.hpp>

#include <core/Interaction.hpp>
#include <pkg/dem/ScGeom.hpp>

#include <array>
#include <vector>

namespace yade {

/// YADE's objects of a contact; the scene's container keeps them alive.
struct ContactOwner {
    Interaction* contact;
    ScGeom* geom;
    GrainPhys* phys;
};
using FlatContacts = grainfall::flat::Segment<ContactOwner>;

/// J that went in the steps of one thread; as in Law2_ScGeom_GrainPhys_HertzMindlin::book().
struct FlatBook {
    Real friction = 0, viscous = 0, rescaling = 0, kinematics = 0, bridge = 0;
};

struct FlatLoop {
    const grainfall::flat::Bodies& bodies;
    grainfall::flat::Load* loads; // of all bodies, for this thread
    Real time_step;
    bool publish; // write YADE's objects too
    FlatBook& book;
    std::vector<size_t>& opened; // contacts whose bodies have parted, ascending
};

using FlatKernel = void (*)(FlatLoop&, FlatContacts&, size_t begin, size_t end);
/// One loop for each dry class.
using FlatTable = std::array<FlatKernel, ContactClass::dry_count>;

/// As KernelTables, for the loops.
struct FlatTables {
    struct Pair {
        FlatTable plain, booking;
    };
    Pair hertz, report;
};
const FlatTables& incremental_flat_kernels();
const FlatTables& partial_slip_flat_kernels();
const FlatTables& secant_flat_kernels();
const FlatTables& report_flat_kernels();
const FlatTables& frictionless_flat_kernels();

/// Contacts with a liquid bridge; the dry part goes through the table.
void run_wet_flat(const FlatTable& table, bool booking, FlatLoop& loop, FlatContacts& contacts, size_t begin,
                  size_t end);

namespace flat {

namespace gf = grainfall::flat;
namespace gl = grainfall::laws;

/// The contact point lies at arm1 n from the centre of a first sphere, at -arm2 n from that of the second.
struct FlatTouch {
    gl::Touch touch;
    Real arm1, arm2;
};

/// From the centre of a plane, wherever that is, to the contact point.
inline Vector3r plane_lever(const gf::Bodies& bodies, const gf::ContactState& state, const FlatTouch& at) {
    return bodies.places[static_cast<size_t>(state.second)].centre - at.arm2 * at.touch.normal -
           bodies.places[static_cast<size_t>(state.first)].centre;
}

[[gnu::always_inline]] inline FlatTouch plane_touch(const gf::Bodies& bodies, int plane, int sphere) {
    const gf::Plane& wall = bodies.plane(plane);
    const gf::Place& at = bodies.places[static_cast<size_t>(plane)];
    const gf::Place& ball = bodies.places[static_cast<size_t>(sphere)];
    const Real distance = ball.centre[wall.axis] - at.centre[wall.axis];
    FlatTouch result;
    result.touch.normal = Vector3r::Zero();
    result.touch.normal[wall.axis] = wall.sense ? wall.sense : distance > 0 ? 1 : -1;
    result.touch.overlap = ball.radius - std::abs(distance);
    result.touch.radius1 = at.radius * ball.radius;
    result.touch.radius2 = ball.radius;
    result.arm1 = 0;
    result.arm2 = distance * result.touch.normal[wall.axis];
    return result;
}

[[gnu::always_inline]] inline FlatTouch touch_of(const gf::Bodies& bodies, const gf::ContactState& state) {
    if (bodies.is_plane(state.first))
        return plane_touch(bodies, state.first, state.second);
    const gf::Place& a = bodies.places[static_cast<size_t>(state.first)];
    const gf::Place& b = bodies.places[static_cast<size_t>(state.second)];
    const Vector3r branch = b.centre - a.centre;
    FlatTouch result;
    result.touch = gl::touch_of_spheres(branch, branch.norm(), a.radius, b.radius);
    result.arm1 = a.radius - 0.5 * result.touch.overlap;
    result.arm2 = b.radius - 0.5 * result.touch.overlap;
    return result;
}

[[gnu::always_inline]] inline void apply(const FlatLoop& loop, const gf::ContactState& state,
                                         const FlatTouch& at, Real normal_force, const Vector3r& shear) {
    gf::Load& load1 = loop.loads[state.first];
    gf::Load& load2 = loop.loads[state.second];
    const Vector3r force_on_2 = normal_force * at.touch.normal + shear;
    // The normal force has no arm about the centre of a sphere.
    const Vector3r turn = at.touch.normal.cross(shear);
    load1.force -= force_on_2;
    load2.force += force_on_2;
    load2.torque -= at.arm2 * turn;
    if (loop.bodies.is_plane(state.first))
        load1.torque -= plane_lever(loop.bodies, state, at).cross(force_on_2);
    else
        load1.torque -= at.arm1 * turn;
}

/// YADE's objects as the general path leaves them after this step.
void publish_geometry(const FlatLoop& loop, const gf::ContactState& state, const ContactOwner& owner,
                      const FlatTouch& at, const gl::ContactGeometry& geometry);
void publish_force(const gf::ContactState& state, const ContactOwner& owner, const gl::ContactForce& force,
                   bool has_shear);

template <class Friction>
[[gnu::always_inline]] inline decltype(auto) friction_of(const gf::ContactConstants& constants) {
    if constexpr (std::is_same_v<Friction, gl::friction::Constant>)
        return gl::friction::Constant{constants.coefficient};
    else if constexpr (std::is_same_v<Friction, gl::friction::Any>)
        return (*constants.curve);
    else
        return (*std::get_if<Friction>(&constants.curve->curve()));
}

/// The slip history stays with YADE's object.
inline void recall_history(const ContactOwner&, gl::ContactMemory&) {}
inline void recall_history(const ContactOwner& owner, gl::PartialSlipMemory& memory) {
    if (const PartialSlip* slip = slip_of(*owner.phys))
        slip->recall(memory.history);
}
inline void keep_history(ContactOwner&, const gl::ContactMemory&) {}
inline void keep_history(ContactOwner& owner, const gl::PartialSlipMemory& memory) {
    GrainEffectPhys& phys = GrainEffectPhys::of(*owner.contact);
    owner.phys = &phys;
    phys.keep_slip(memory.history);
}

template <class Normal, class Tangential, class Damping, class Friction, class Energy>
inline void run(FlatLoop& loop, FlatContacts& contacts, size_t begin, size_t end) {
    using ContactLaw = gl::HertzMindlin<Normal, Tangential, Damping, Friction, Energy>;
    const gf::Bodies& bodies = loop.bodies;
    for (size_t i = begin; i < end; ++i) {
        gf::ContactState& state = contacts.states[i];
        const gf::ContactConstants& constants = contacts.constants[i];
        const FlatTouch at = touch_of(bodies, state);
        typename ContactLaw::Memory memory;
        memory.shear_force = state.shear_force;
        memory.shear_stiffness = state.shear_stiffness;
        if (at.touch.overlap < 0) {
            if constexpr (Energy::active && Tangential::active) {
                recall_history(contacts.owners[i], memory);
                loop.book.rescaling += gl::shear_elastic_energy(memory);
            }
            loop.opened.push_back(i);
            continue;
        }
        const gf::Motion& motion1 = bodies.motions[static_cast<size_t>(state.first)];
        const gf::Motion& motion2 = bodies.motions[static_cast<size_t>(state.second)];
        const Vector3r velocity = motion2.velocity - motion1.velocity;
        gl::ContactGeometry geometry;
        gl::put_motion(geometry, at.touch, velocity, motion1.spin, motion2.spin, loop.time_step);
        if (state.shear_stiffness > 0)
            gl::put_rotation(geometry, state.normal, motion1.spin, motion2.spin);
        recall_history(contacts.owners[i], memory);

        Energy book;
        Vector3r shear_before;
        if constexpr (Energy::active) {
            book.normal_viscous_force = contacts.dashpots[i].normal;
            book.shear_viscous_force = contacts.dashpots[i].shear;
            shear_before =
                gl::rotated_with_contact(memory.shear_force + contacts.dashpots[i].shear, geometry);
        }
        const gl::ContactForce force =
            ContactLaw::step(geometry, constants.parameters, friction_of<Friction>(constants), memory, book);
        if constexpr (Energy::active) {
            contacts.dashpots[i] = {book.normal_viscous_force, book.shear_viscous_force};
            loop.book.friction += book.friction;
            loop.book.viscous += book.viscous;
            loop.book.rescaling += book.rescaling;
            if constexpr (Tangential::active) {
                // Forces lie in the contact plane: the normal part of the velocity does not count.
                Vector3r at_contact = velocity - at.arm2 * motion2.spin.cross(at.touch.normal);
                if (bodies.is_plane(state.first))
                    at_contact -= motion1.spin.cross(plane_lever(bodies, state, at));
                else
                    at_contact -= at.arm1 * motion1.spin.cross(at.touch.normal);
                const Vector3r excess = geometry.shear_increment - loop.time_step * at_contact;
                loop.book.kinematics -= 0.5 * (shear_before + force.shear).dot(excess);
            }
        }
        state.normal = at.touch.normal;
        if constexpr (Tangential::active) {
            state.shear_force = memory.shear_force;
            state.shear_stiffness = memory.shear_stiffness;
            keep_history(contacts.owners[i], memory);
        }
        apply(loop, state, at, force.normal, force.shear);
        if (loop.publish) {
            publish_geometry(loop, state, contacts.owners[i], at, geometry);
            publish_force(state, contacts.owners[i], force, Tangential::active);
        }
    }
}

/// Left to itself, the compiler keeps some sums of vectors out of line and passes them through memory. The
/// second version, taken where the processor has these instructions, is a sixth faster.
template <class Normal, class Tangential, class Damping, class Friction, class Energy>
[[gnu::flatten, gnu::target_clones("arch=haswell", "default")]] void
run_inlined(FlatLoop& loop, FlatContacts& contacts, size_t begin, size_t end) {
    run<Normal, Tangential, Damping, Friction, Energy>(loop, contacts, begin, end);
}

struct RunMaker {
    template <class Normal, class Tangential, class Damping, class Friction, class Energy>
    static FlatKernel kernel() {
        // The history of partial slip is too long a code to be worth it.
        if constexpr (std::is_same_v<Tangential, gl::PartialSlipTangential>)
            return &run<Normal, Tangential, Damping, Friction, Energy>;
        else
            return &run_inlined<Normal, Tangential, Damping, Friction, Energy>;
    }
};

template <class Normal, class Tangential, class Energy>
FlatTable make_table() {
    FlatTable table{};
    DryKernels<RunMaker, Normal, Tangential, Energy, FlatTable>::put(table);
    return table;
}

template <class Tangential>
const FlatTables& make_tables() {
    static const FlatTables tables{{make_table<gl::Hertz, Tangential, gl::NoEnergy>(),
                                    make_table<gl::Hertz, Tangential, gl::DissipationBook>()},
                                   {make_table<gl::ReportNormal, Tangential, gl::NoEnergy>(),
                                    make_table<gl::ReportNormal, Tangential, gl::DissipationBook>()}};
    return tables;
}

} // namespace flat
} // namespace yade
