// SPDX-License-Identifier: GPL-2.0-or-later
#include <engines/flat/yade/flat_kernels.hpp>
#include <laws/yade/contact_rotation.hpp>

#include <laws/bridge/liquid_bridge.hpp>
#include <laws/yade/LiquidBridge.hpp>

namespace yade {
namespace flat {

void publish_geometry(const FlatLoop& loop, const gf::ContactState& state, const ContactOwner& owner,
                      const FlatTouch& at, const gl::ContactGeometry& geometry) {
    ScGeom& geom = *owner.geom;
    geom.normal = at.touch.normal;
    geom.contactPoint =
        loop.bodies.places[static_cast<size_t>(state.second)].centre - at.arm2 * at.touch.normal;
    geom.penetrationDepth = at.touch.overlap;
    geom.radius1 = at.touch.radius1;
    geom.radius2 = at.touch.radius2;
    geom.shearInc = geometry.shear_increment;
    geom.*contact_tilt_member() = geometry.tilt;
    geom.*contact_twist_member() = geometry.twist;
}

void publish_force(const gf::ContactState& state, const ContactOwner& owner, const gl::ContactForce& force,
                   bool has_shear) {
    GrainPhys& phys = *owner.phys;
    phys.kn = force.normal_stiffness;
    phys.ks = force.shear_stiffness;
    phys.normalForce = force.normal * state.normal;
    if (has_shear) {
        phys.shearForce = force.shear;
        phys.shearElastic = state.shear_force;
        phys.isSliding = force.sliding;
    } else {
        // Another law may have acted before.
        phys.shearForce = phys.shearElastic = Vector3r::Zero();
    }
}

void publish_slip(ContactOwner& owner, const gl::SlipHistory& history) {
    GrainEffectPhys& phys = GrainEffectPhys::of(*owner.contact);
    owner.phys = &phys;
    phys.keep_slip(history);
}

namespace {

namespace gb = grainfall::laws::bridge;

GrainEffectPhys& effects_of(const ContactOwner& owner) {
    return static_cast<GrainEffectPhys&>(*owner.phys);
}

/// The bodies have parted; the bridge may still hold them.
void open(gf::ContactState& state, GrainEffectPhys& phys) {
    phys.part();
    state.shear_force = Vector3r::Zero();
    state.shear_stiffness = 0;
}

template <class Form, class Film, class Energy>
void run_wet(FlatLoop& loop, FlatContacts& contacts, FlatKernel dry, size_t begin, size_t end) {
    // The solid contacts of all, and which have none.
    vector<size_t> apart;
    FlatLoop solid{loop.bodies, loop.loads, loop.time_step, loop.publish, loop.book, apart};
    dry(solid, contacts, begin, end);
    auto next_apart = apart.begin();
    for (size_t i = begin; i < end; ++i) {
        gf::ContactState& state = contacts.states[i];
        gf::Bridge& bridge = contacts.bridges[i];
        const bool touching = next_apart == apart.end() || *next_apart != i;
        if (!touching) {
            ++next_apart;
            if (bridge.memory.separation <= 0 || state.shear_stiffness > 0) {
                open(state, effects_of(contacts.owners[i]));
                if (contacts.books)
                    contacts.dashpots[i] = gf::DashpotMemory();
                if (contacts.slips)
                    contacts.slip[i] = gl::SlipHistory();
            }
        }
        const gf::ContactBlock<Real> pair(loop.bodies, contacts.states.data(), i, i + 1);
        const FlatTouch at =
            contacts.on_obstacles() ? pair.touch_of_obstacles(contacts.partner) : pair.touch_of_spheres();
        Energy book;
        const gb::BridgeState held = gb::LiquidBridge<Form, Film, Energy>::step(
            -at.touch.overlap, pair.normal_velocity(at, contacts.partner), loop.time_step, bridge.parameters,
            bridge.memory, book);
        if constexpr (Energy::active) {
            loop.book.viscous += book.viscous;
            loop.book.bridge += book.rupture;
        }
        state.normal = at.touch.normal;
        if (held == gb::BridgeState::holding)
            apply(loop, contacts.on_obstacles(), state, at,
                  gb::normal_force<Film>(bridge.memory) * at.touch.normal, Vector3r::Zero());
        else if (held == gb::BridgeState::ended)
            loop.opened.push_back(i);
        if (!loop.publish)
            continue;
        effects_of(contacts.owners[i]).bridge->remember(bridge.memory);
        if (!touching) {
            gl::ContactGeometry geometry;
            gl::put_motion<Real>(geometry, at.touch, pair.velocity(), pair.spin1(), pair.spin2(),
                                 loop.time_step);
            if (gf::has_surface_motion(contacts.partner))
                pair.put_surface_motion(at, contacts.partner, geometry);
            publish_geometry(loop, state, contacts.owners[i], at, geometry);
        }
    }
}

} // namespace

template <class Energy>
static void run_wet_class(FlatLoop& loop, FlatContacts& contacts, FlatKernel dry, size_t begin, size_t end) {
    using namespace gb;
    switch (ContactClass(contacts.contact_class).bridge()) {
    case BridgeKind::none:
        return;
    case BridgeKind::willett:
        return run_wet<WillettNumeric, NoFilm, Energy>(loop, contacts, dry, begin, end);
    case BridgeKind::willett_closed:
        return run_wet<WillettClosed, NoFilm, Energy>(loop, contacts, dry, begin, end);
    case BridgeKind::willett_viscous:
        return run_wet<WillettNumeric, SqueezeFilm, Energy>(loop, contacts, dry, begin, end);
    case BridgeKind::willett_closed_viscous:
        return run_wet<WillettClosed, SqueezeFilm, Energy>(loop, contacts, dry, begin, end);
    }
}

} // namespace flat

void run_wet_flat(const FlatTable& table, bool booking, FlatLoop& loop, FlatContacts& contacts, size_t begin,
                  size_t end) {
    const int dry_class = ContactClass(contacts.contact_class).dry().index;
    const FlatKernel dry = table[static_cast<size_t>(dry_class)];
    if (booking)
        flat::run_wet_class<grainfall::laws::bridge::BridgeBook>(loop, contacts, dry, begin, end);
    else
        flat::run_wet_class<grainfall::laws::NoEnergy>(loop, contacts, dry, begin, end);
}

} // namespace yade
