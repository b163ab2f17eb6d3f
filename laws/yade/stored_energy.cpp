// SPDX-License-Identifier: GPL-2.0-or-later
#include <laws/yade/stored_energy.hpp>

#include <laws/partial_slip.hpp>
#include <laws/yade/GrainEffectPhys.hpp>

#include <core/Interaction.hpp>
#include <core/InteractionContainer.hpp>
#include <core/Scene.hpp>
#include <pkg/dem/ScGeom.hpp>

#include <cmath>

namespace yade {

StoredEnergy stored_energy(const Interaction& contact) {
    StoredEnergy energy;
    if (!contact.isReal())
        return energy;
    const auto* phys = dynamic_cast<const GrainPhys*>(contact.phys.get());
    const auto* geom = dynamic_cast<const ScGeom*>(contact.geom.get());
    if (!phys || !geom)
        return energy;
    if (const LiquidBridge* bridge = bridge_of(*phys))
        energy.bridge = bridge->work;
    // YADE does not save the overlap: in a scene just loaded it follows from F = 2/3 kn d, dashpot neglected.
    const bool loaded = std::isnan(geom->penetrationDepth) && phys->kn > 0;
    const Real overlap = loaded ? 1.5 * phys->normalForce.norm() / phys->kn : geom->penetrationDepth;
    if (!(overlap > 0))
        return energy;
    // F = 2/3 kn d and E = 2/5 F d for a force that goes with d^1.5, whatever its coefficient.
    energy.normal = 4.0 / 15.0 * phys->kn * overlap * overlap;
    grainfall::laws::PartialSlipMemory memory;
    memory.shear_force = phys->shearElastic;
    memory.shear_stiffness = phys->ks;
    if (const PartialSlip* slip = slip_of(*phys))
        slip->recall(memory.history);
    energy.shear = grainfall::laws::shear_elastic_energy(memory);
    return energy;
}

StoredEnergy stored_energy(const Scene& scene) {
    StoredEnergy sum;
    for (const auto& contact : *scene.interactions) {
        const StoredEnergy one = stored_energy(*contact);
        sum.normal += one.normal;
        sum.shear += one.shear;
        sum.bridge += one.bridge;
    }
    return sum;
}

} // namespace yade
