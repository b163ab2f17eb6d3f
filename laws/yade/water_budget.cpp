// SPDX-License-Identifier: GPL-2.0-or-later
#include <laws/yade/water_budget.hpp>

#include <laws/bridge/geometry.hpp>
#include <laws/bridge/water.hpp>
#include <laws/yade/GrainMat.hpp>
#include <laws/yade/GrainEffectPhys.hpp>

#include <core/Body.hpp>
#include <core/BodyContainer.hpp>
#include <core/Interaction.hpp>
#include <core/InteractionContainer.hpp>
#include <core/Scene.hpp>
#include <core/State.hpp>

#include <algorithm>

namespace yade {

namespace gb = grainfall::laws::bridge;

namespace {

struct Bridges {
    int count = 0, beyond_pendular = 0, beyond_fit = 0;
    Real volume = 0, relative_volume = 0;
    vector<Real> drawn; // m3, by body
};

Bridges take_stock(const Scene& scene) {
    Bridges sum;
    sum.drawn.assign(scene.bodies->size(), 0);
    for (const auto& contact : *scene.interactions) {
        if (!contact->isReal())
            continue;
        const auto* phys = dynamic_cast<const GrainPhys*>(contact->phys.get());
        const LiquidBridge* held = phys ? bridge_of(*phys) : nullptr;
        if (!held || !held->formed)
            continue;
        const LiquidBridge& bridge = *held;
        ++sum.count;
        sum.beyond_pendular += bridge.relativeVolume > gb::largest_pendular_volume;
        sum.beyond_fit += bridge.relativeVolume > gb::largest_fitted_volume;
        sum.volume += bridge.volume;
        sum.relative_volume += bridge.relativeVolume;
        sum.drawn[static_cast<std::size_t>(contact->getId1())] += bridge.volumeFromFirst;
        sum.drawn[static_cast<std::size_t>(contact->getId2())] += bridge.volume - bridge.volumeFromFirst;
    }
    return sum;
}

Real water_of(const Body& body) {
    const auto* material = dynamic_cast<const GrainMat*>(body.material.get());
    return material && carries_water(body)
               ? gb::carried_water(material->gravimetricMoisture, body.state->mass)
               : 0;
}

} // namespace

boost::python::dict water_budget(const Scene& scene) {
    const Bridges bridges = take_stock(scene);
    Real total = 0, films = 0, external = 0, deficit = 0;
    int overdrawn = 0;
    for (const auto& body : *scene.bodies) {
        if (!body)
            continue;
        const Real carried = water_of(*body);
        const Real drawn = bridges.drawn[static_cast<std::size_t>(body->getId())];
        if (carried == 0) {
            external += drawn;
            continue;
        }
        total += carried;
        films += carried - drawn;
        // A grain whose shares add up to all it has is not overdrawn by their rounding.
        if (drawn > carried * (1 + 1e-12)) {
            ++overdrawn;
            deficit += drawn - carried;
        }
    }
    const Real count = std::max(bridges.count, 1);
    boost::python::dict result;
    result["total"] = total;
    result["external"] = external;
    result["inBridges"] = bridges.volume;
    result["onGrains"] = films;
    result["bridges"] = bridges.count;
    result["meanRelativeVolume"] = bridges.relative_volume / count;
    result["beyondPendular"] = bridges.beyond_pendular / count;
    result["beyondFit"] = bridges.beyond_fit / count;
    result["overdrawnGrains"] = overdrawn;
    result["deficit"] = deficit;
    return result;
}

} // namespace yade
