// SPDX-License-Identifier: GPL-2.0-or-later
// The contact loop over packed arrays: geometry, the law's kernel, forces. One loop for each contact class.
#pragma once

#include <engines/flat/contact_block.hpp>

#include <laws/hertz_mindlin.hpp>
#include <laws/yade/ContactClass.hpp>
#include <laws/yade/GrainEffectPhys.hpp>
#include <laws/yade/kernel_table.hpp>

#include <core/Interaction.hpp>
#include <pkg/dem/ScGeom.hpp>

#include <array>
#include <vector>

namespace yade {

/// YADE's objects of a contact.
struct ContactOwner {
    shared_ptr<Interaction> contact;
    ScGeom* geom;
    GrainPhys* phys;
    bool in_scene; // does the scene's container hold it?
};
using FlatContacts = grainfall::flat::Segment<ContactOwner>;

/// J that went in the steps of one thread; as in Law2_ScGeom_GrainPhys_HertzMindlin::book().
struct FlatBook {
    Real friction = 0, viscous = 0, rescaling = 0, kinematics = 0, bridge = 0;
};

/// Contacts that YADE sees in every step, for the engines that sum up the load on a projectile.
inline bool is_exposed(grainfall::flat::Partner partner) {
    return partner == grainfall::flat::Partner::solid;
}

struct FlatLoop {
    const grainfall::flat::Bodies& bodies;
    grainfall::flat::Load* loads; // of all bodies, for this thread
    Real time_step;
    bool publish; // write YADE's objects too?
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
        bool slips; // do they remember partial slip?
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

using FlatTouch = gf::TouchAt<Real>;

/// From the centre of an obstacle, wherever that is, to the contact point.
inline Vector3r obstacle_lever(const gf::Bodies& bodies, const gf::ContactState& state, const FlatTouch& at) {
    return bodies.places[static_cast<size_t>(state.second)].centre - at.arm2 * at.touch.normal -
           bodies.places[static_cast<size_t>(state.first)].centre;
}

/// `turn`: normal x shear force. The normal force has no arm about the centre of a sphere.
[[gnu::always_inline]] inline void apply(const FlatLoop& loop, bool on_obstacle,
                                         const gf::ContactState& state, const FlatTouch& at,
                                         const Vector3r& force_on_2, const Vector3r& turn) {
    gf::Load& load1 = loop.loads[state.first];
    gf::Load& load2 = loop.loads[state.second];
    load1.force -= force_on_2;
    load2.force += force_on_2;
    load2.torque -= at.arm2 * turn;
    if (on_obstacle)
        load1.torque -= obstacle_lever(loop.bodies, state, at).cross(force_on_2);
    else
        load1.torque -= at.arm1 * turn;
}

/// YADE's objects as the general path leaves them after this step.
void publish_geometry(const FlatLoop& loop, const gf::ContactState& state, const ContactOwner& owner,
                      const FlatTouch& at, const gl::ContactGeometry& geometry);
void publish_force(const gf::ContactState& state, const ContactOwner& owner, const gl::ContactForce& force,
                   bool has_shear);
void publish_slip(ContactOwner& owner, const gl::SlipHistory& history);

/// Of the contact at `i`; the other laws remember no slip.
template <class Scalar>
inline void recall_slip(const FlatContacts&, size_t, gl::ContactMemoryOf<Scalar>&) {}
inline void recall_slip(const FlatContacts& contacts, size_t i, gl::PartialSlipMemory& memory) {
    memory.history = contacts.slip[i];
}
template <class Scalar>
inline void keep_slip(FlatContacts&, size_t, const gl::ContactMemoryOf<Scalar>&, bool) {}
inline void keep_slip(FlatContacts& contacts, size_t i, const gl::PartialSlipMemory& memory, bool publish) {
    contacts.slip[i] = memory.history;
    if (publish)
        publish_slip(contacts.owners[i], memory.history);
}

/// What the law has made of a block of contacts.
template <class Scalar>
struct Outcome {
    gl::MaskOf<Scalar> idle; // the bodies are apart, or the lane has no contact
    gf::TouchAt<Scalar> at;
    gl::ContactGeometryOf<Scalar> geometry;
    gl::ContactForceOf<Scalar> force;
    gl::ContactMemoryOf<Scalar> memory;
};

/// Contacts whose bodies have parted drop what their tangential springs still held.
template <class Scalar>
[[gnu::noinline]] void drop_opened(FlatLoop& loop, const gf::ContactBlock<Scalar>& block,
                                   const gl::MaskOf<Scalar>& idle, const Scalar& spring_energy) {
    for (int lane = 0; lane < block.count(); ++lane)
        if (gl::lane_of(idle, lane)) {
            loop.opened.push_back(block[lane]);
            loop.book.rescaling += gl::lane_of(spring_energy, lane);
        }
}

/// Lane by lane: where not all bodies touch, or YADE's objects are to be written.
template <class Scalar>
[[gnu::noinline]] void finish_each(const FlatLoop& loop, FlatContacts& contacts,
                                   const gf::ContactBlock<Scalar>& block, const Outcome<Scalar>& outcome,
                                   bool has_shear) {
    for (int lane = 0; lane < block.count(); ++lane) {
        if (gl::lane_of(outcome.idle, lane))
            continue;
        gf::ContactState& state = contacts.states[block[lane]];
        const FlatTouch at = gf::lane_of(outcome.at, lane);
        const gl::ContactForce force = gf::lane_of(outcome.force, lane);
        state.normal = at.touch.normal;
        state.shear_force = gf::lane_of(outcome.memory.shear_force, lane);
        state.shear_stiffness = gl::lane_of(outcome.memory.shear_stiffness, lane);
        apply(loop, contacts.on_obstacles(), state, at, force.normal * at.touch.normal + force.shear,
              at.touch.normal.cross(force.shear));
        if (loop.publish) {
            const ContactOwner& owner = contacts.owners[block[lane]];
            publish_geometry(loop, state, owner, at, gf::lane_of(outcome.geometry, lane));
            publish_force(state, owner, force, has_shear);
        }
    }
}

/// Books of one step; idle lanes do not count.
template <class Scalar>
inline void settle(FlatBook& sum, const gl::DissipationBookOf<Scalar>& book, const Scalar& kinematics,
                   const gl::MaskOf<Scalar>& idle) {
    sum.friction += gl::sum_of_lanes(gl::where(idle, 0, book.friction));
    sum.viscous += gl::sum_of_lanes(gl::where(idle, 0, book.viscous));
    sum.rescaling += gl::sum_of_lanes(gl::where(idle, 0, book.rescaling));
    sum.kinematics += gl::sum_of_lanes(gl::where(idle, 0, kinematics));
}

template <class Scalar, class Normal, class Tangential, class Damping, class Friction, class Energy>
inline void run(FlatLoop& loop, FlatContacts& contacts, size_t begin, size_t end) {
    using Vectors = gl::VectorOf<Scalar>;
    using Book = std::conditional_t<Energy::active, gl::DissipationBookOf<Scalar>, gl::NoEnergy>;
    using Curve = gf::BlockFriction<Friction, Scalar>;
    using ContactLaw = gl::HertzMindlin<Normal, Tangential, Damping, Curve, Book>;
    for (size_t i = begin; i < end; i += gl::width_of<Scalar>) {
        const gf::ContactBlock<Scalar> block(loop.bodies, contacts.states.data(), i, end);
        const gf::TouchAt<Scalar> at =
            contacts.on_obstacles() ? block.touch_of_obstacles(contacts.partner) : block.touch_of_spheres();
        typename ContactLaw::template MemoryOf<Scalar> memory;
        block.recall(memory);
        recall_slip(contacts, i, memory);
        const auto idle = at.touch.overlap < 0 || block.empty();
        if (gl::any(idle)) {
            const bool keeps_energy = Energy::active && Tangential::active;
            drop_opened<Scalar>(loop, block, idle, keeps_energy ? gl::shear_elastic_energy(memory) : 0);
            if (!gl::any(!idle))
                continue;
        }
        gl::ContactGeometryOf<Scalar> geometry;
        const Vectors spin1 = block.spin1(), spin2 = block.spin2();
        gl::put_motion<Scalar>(geometry, at.touch, block.velocity(), spin1, spin2, loop.time_step);
        if (gf::has_surface_motion(contacts.partner))
            block.put_surface_motion(at, contacts.partner, geometry);
        gl::put_rotation<Scalar>(geometry, block.normal_before(), spin1, spin2);

        Book book;
        Vectors shear_before;
        if constexpr (Energy::active) {
            block.recall(contacts.dashpots, book);
            const Vectors applied = memory.shear_force + book.shear_viscous_force;
            shear_before = gl::rotated_with_contact<Scalar>(applied, geometry);
        }
        const gl::ContactForceOf<Scalar> force = ContactLaw::step(
            geometry, block.parameters(contacts.constants),
            gf::friction_of<Friction>(block, contacts.constants, contacts.curves), memory, book);
        if constexpr (Energy::active) {
            Scalar kinematics = 0;
            if constexpr (Tangential::active) {
                // Forces lie in the contact plane: the normal part of the velocity does not count.
                const Vectors moved =
                    Scalar(loop.time_step) * block.velocity_at_contact(at, contacts.partner);
                kinematics = -0.5 * (shear_before + force.shear).dot(geometry.shear_increment - moved);
            }
            settle<Scalar>(loop.book, book, kinematics, idle);
            block.keep(book, idle, contacts.dashpots);
        }
        if constexpr (Tangential::active)
            keep_slip(contacts, i, memory, loop.publish);
        if (gl::any(idle) || loop.publish || contacts.on_obstacles())
            finish_each<Scalar>(loop, contacts, block, {idle, at, geometry, force, memory},
                                Tangential::active);
        else {
            block.keep(at.touch.normal, memory, contacts.states.data());
            block.push(at, force, loop.loads);
        }
    }
}

/// Flattened, because the compiler else keeps sums of vectors out of line and passes them through memory. The
/// first version is taken by processors with AVX2 and FMA (arch=haswell would ask for that very model).
template <class Scalar, class Normal, class Tangential, class Damping, class Friction, class Energy>
[[gnu::flatten, gnu::target_clones("arch=x86-64-v3", "default")]] void
run_inlined(FlatLoop& loop, FlatContacts& contacts, size_t begin, size_t end) {
    run<Scalar, Normal, Tangential, Damping, Friction, Energy>(loop, contacts, begin, end);
}

struct RunMaker {
    template <class Normal, class Tangential, class Damping, class Friction, class Energy>
    static FlatKernel kernel() {
        // The laws for comparison are not worth the time that the compiler takes to write them side by side;
        // the history of partial slip differs from contact to contact in its length.
        constexpr bool usual =
            std::is_same_v<Tangential, gl::IncrementalTangential> && std::is_same_v<Normal, gl::Hertz>;
        if constexpr (std::is_same_v<Tangential, gl::PartialSlipTangential>)
            return &run<Real, Normal, Tangential, Damping, Friction, Energy>;
        else
            return &run_inlined<std::conditional_t<usual, gl::Lanes, Real>, Normal, Tangential, Damping,
                                Friction, Energy>;
    }
};

template <class Normal, class Tangential, class Energy>
FlatTable make_table() {
    FlatTable table{};
    DryKernels<RunMaker, Normal, Tangential, Energy, FlatTable>::put(table);
    return table;
}

template <class Normal, class Tangential>
FlatTables::Pair both() {
    return {make_table<Normal, Tangential, gl::NoEnergy>(),
            make_table<Normal, Tangential, gl::DissipationBook>(),
            std::is_same_v<Tangential, gl::PartialSlipTangential>};
}

template <class Tangential>
const FlatTables& make_tables() {
    static const FlatTables tables{both<gl::Hertz, Tangential>(), both<gl::ReportNormal, Tangential>()};
    return tables;
}

} // namespace flat
} // namespace yade
