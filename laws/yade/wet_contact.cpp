// SPDX-License-Identifier: GPL-2.0-or-later
#include <laws/yade/wet_contact.hpp>

#include <laws/bridge/liquid_bridge.hpp>
#include <laws/yade/LiquidBridge.hpp>
#include <laws/yade/contact_kernels.hpp>

namespace yade {

namespace {

namespace gb = grainfall::laws::bridge;

/// The dry contact while the bodies touch, and in the step in which they part, for its books.
void solid_contact(Law& law, shared_ptr<IGeom>& geometry, shared_ptr<IPhys>& physics, Interaction* contact,
                   bool booking) {
    auto& phys = static_cast<GrainEffectPhys&>(*physics);
    const bool was_touching = phys.kn > 0;
    if (static_cast<const ScGeom&>(*geometry).penetrationDepth < 0 && !was_touching)
        return;
    if (!law.dry_kernel(phys, booking)(law, geometry, physics, contact))
        phys.part();
}

template <class Form, class Film, class Energy>
bool step(LawEntry& entry, shared_ptr<IGeom>& geometry, shared_ptr<IPhys>& physics, Interaction* contact) {
    Law& law = static_cast<Law&>(entry);
    solid_contact(law, geometry, physics, contact, Energy::active);
    const auto& geom = static_cast<const ScGeom&>(*geometry);
    auto& phys = static_cast<GrainEffectPhys&>(*physics);
    Scene& scene = *law.scene;

    const Body::id_t id1 = contact->getId1(), id2 = contact->getId2();
    const State& state1 = *Body::byId(id1, &scene)->state;
    const State& state2 = *Body::byId(id2, &scene)->state;
    Vector3r shift2 = Vector3r::Zero(), shift_velocity = Vector3r::Zero();
    if (scene.isPeriodic) {
        shift2 = scene.cell->intrShiftPos(contact->cellDist);
        shift_velocity = scene.cell->intrShiftVel(contact->cellDist);
    }
    Real normal_velocity = 0;
    if constexpr (Film::active || Energy::active) {
        normal_velocity =
            geom.getIncidentVel(&state1, &state2, scene.dt, shift2, shift_velocity, false).dot(geom.normal);
    }

    LiquidBridge& bridge = *phys.bridge;
    gb::BridgeMemory memory = bridge.memory();
    Energy book;
    const gb::BridgeState state = gb::LiquidBridge<Form, Film, Energy>::step(
        -geom.penetrationDepth, normal_velocity, scene.dt, bridge.parameters(), memory, book);
    bridge.remember(memory);
    if constexpr (Energy::active) {
        if (book.viscous != 0)
            law.book(0, book.viscous, 0, 0);
        if (book.rupture != 0)
            law.book_bridge(book.rupture);
    }
    if (state == gb::BridgeState::holding) {
        kernels::apply_force(scene.forces, bridge.normal_force() * geom.normal, geom, id1, id2, state1,
                             state2, shift2);
    }
    return state != gb::BridgeState::ended;
}

template <class Energy>
void put(Law::KernelTable& table) {
    const std::array<Law::Kernel, ContactClass::bridge_kinds> kernels{
        nullptr, &step<gb::WillettNumeric, gb::NoFilm, Energy>, &step<gb::WillettClosed, gb::NoFilm, Energy>,
        &step<gb::WillettNumeric, gb::SqueezeFilm, Energy>,
        &step<gb::WillettClosed, gb::SqueezeFilm, Energy>};
    for (int index = ContactClass::dry_count; index < ContactClass::count; ++index) {
        const auto place = static_cast<std::size_t>(index);
        table[place] = kernels[static_cast<std::size_t>(ContactClass(index).bridge())];
    }
}

} // namespace

void put_wet_kernels(Law::KernelTable& table, bool booking) {
    if (booking)
        put<gb::BridgeBook>(table);
    else
        put<grainfall::laws::NoEnergy>(table);
}

} // namespace yade
