// SPDX-License-Identifier: GPL-2.0-or-later
#include <laws/yade/wet_contact.hpp>

#include <laws/bridge/liquid_bridge.hpp>
#include <laws/yade/LiquidBridge.hpp>
#include <laws/yade/contact_kernels.hpp>

namespace yade {

namespace {

namespace gb = grainfall::laws::bridge;

template <BridgeKind kind>
using FormOf = std::conditional_t<kind == BridgeKind::willett || kind == BridgeKind::willett_viscous,
                                  gb::WillettNumeric, gb::WillettClosed>;
template <BridgeKind kind>
using FilmOf =
    std::conditional_t<kind == BridgeKind::willett_viscous || kind == BridgeKind::willett_closed_viscous,
                       gb::SqueezeFilm, gb::NoFilm>;

/// The dry contact while the bodies touch, and in the step in which they part, for its books.
template <BridgeKind kind>
void solid_contact(Law& law, shared_ptr<IGeom>& geometry, shared_ptr<IPhys>& physics, Interaction* contact,
                   bool booking) {
    auto& phys = static_cast<GrainEffectPhys&>(*physics);
    const bool was_touching = phys.kn > 0;
    if (static_cast<const ScGeom&>(*geometry).penetrationDepth < 0 && !was_touching)
        return;
    // The dry classes come first.
    const int dry_class =
        phys.contactClass - ContactClass(FrictionForm::constant, DashpotForm::none, kind).index;
    if (!law.kernel_of(dry_class, booking)(law, geometry, physics, contact))
        phys.part();
}

template <BridgeKind kind, class Energy>
bool step(LawEntry& entry, shared_ptr<IGeom>& geometry, shared_ptr<IPhys>& physics, Interaction* contact) {
    using Form = FormOf<kind>;
    using Film = FilmOf<kind>;
    Law& law = static_cast<Law&>(entry);
    solid_contact<kind>(law, geometry, physics, contact, Energy::active);
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
    bridge.remember<Film, Energy>(memory);
    if constexpr (Energy::active) {
        if (book.viscous != 0)
            law.book(0, book.viscous, 0, 0);
        if (book.rupture != 0)
            law.book_bridge(book.rupture);
    }
    if (state == gb::BridgeState::holding) {
        kernels::apply_force(scene.forces, bridge.normal_force<Film>() * geom.normal, geom, id1, id2, state1,
                             state2, shift2);
    }
    return state != gb::BridgeState::ended;
}

template <class Energy>
void put(Law::KernelTable& table) {
    const std::array<Law::Kernel, ContactClass::bridge_kinds> kernels{
        nullptr, &step<BridgeKind::willett, Energy>, &step<BridgeKind::willett_closed, Energy>,
        &step<BridgeKind::willett_viscous, Energy>, &step<BridgeKind::willett_closed_viscous, Energy>};
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
