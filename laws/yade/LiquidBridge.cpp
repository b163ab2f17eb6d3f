// SPDX-License-Identifier: GPL-2.0-or-later
#include <laws/yade/LiquidBridge.hpp>

#include <laws/bridge/water.hpp>
#include <laws/yade/GrainMat.hpp>

#include <core/Body.hpp>
#include <core/Shape.hpp>
#include <core/State.hpp>

namespace yade {

YADE_PLUGIN((LiquidBridge));

// Defined here so that virtual tables and Python registration are compiled once.
LiquidBridge::~LiquidBridge() = default;

namespace gb = grainfall::laws::bridge;

bool carries_water(const Body& body) {
    if (!body.shape || body.isClump())
        return false;
    const std::string shape = body.shape->getClassName();
    return shape != "Wall" && shape != "Box" && shape != "Facet" && shape != "SolidOfRevolution";
}

namespace {

gb::WaterSource source(const BridgeSide& side, Real coarsening) {
    const GrainMat& mat = side.material;
    const Real share =
        carries_water(side.body)
            ? gb::carried_water(mat.gravimetricMoisture, side.body.state->mass) / mat.bridgesPerGrain
            : 0;
    return {mat.bridgeVolume * coarsening * coarsening * coarsening, share, mat.surfaceTension,
            mat.liquidViscosity, mat.contactAngle};
}

} // namespace

shared_ptr<LiquidBridge> LiquidBridge::between(const BridgeSide& first, const BridgeSide& second,
                                               Real coarsening) {
    const GrainMat& mat1 = first.material;
    const GrainMat& mat2 = second.material;
    const Real radius = gb::equal_sphere_radius(first.radius, second.radius);
    if (mat1.bridgeModel == "none" || mat2.bridgeModel == "none" || std::isinf(radius))
        return nullptr;
    const gb::BridgeWater water = gb::bridge_water(source(first, coarsening), source(second, coarsening));
    const Real volume = water.volume();
    if (!(volume > 0))
        return nullptr;

    auto bridge = shared_ptr<LiquidBridge>(new LiquidBridge);
    bridge->volume = volume;
    bridge->volumeFromFirst = water.from_first;
    bridge->relativeVolume = volume / (radius * radius * radius);
    bridge->ruptureDistance = gb::rupture_distance(radius, volume, water.contact_angle);
    // The law of the body that gives more; the better one where both give the same.
    const bool closed1 = mat1.bridgeModel == "willett-closed", closed2 = mat2.bridgeModel == "willett-closed";
    bridge->closedForm = water.from_first > water.from_second   ? closed1
                         : water.from_first < water.from_second ? closed2
                                                                : closed1 && closed2;
    // Grains k times larger carry the same stress with k^2 times the force. V* and s/R are those of the real
    // grains; the force goes with R once, so one factor k is left, which the surface tension takes.
    const Real tension = coarsening * water.surface_tension;
    const gb::ForceCurve curve =
        bridge->closedForm ? gb::WillettClosed::curve(radius, volume, tension, water.contact_angle)
                           : gb::WillettNumeric::curve(radius, volume, tension, water.contact_angle);
    bridge->contactForce = curve.contact_force;
    bridge->inverseLength = curve.inverse_length;
    bridge->decay = Vector3r(curve.f2, curve.f3, curve.f4);
    // The viscous force goes with R^2 and v/s: it scales by itself, but for the cutoff.
    const Real cutoff = coarsening * std::max(mat1.lubricationCutoff, mat2.lubricationCutoff);
    const gb::FilmParameters film = gb::SqueezeFilm::parameters(
        radius, volume, water.viscosity, cutoff, grainfall::laws::effective_mass(first.mass, second.mass));
    bridge->filmStrength = film.strength;
    bridge->filmCutoff = film.cutoff;
    bridge->filmArea = film.area;
    bridge->filmMass = film.mass;
    return bridge;
}

BridgeKind LiquidBridge::kind() const {
    if (filmStrength > 0)
        return closedForm ? BridgeKind::willett_closed_viscous : BridgeKind::willett_viscous;
    return closedForm ? BridgeKind::willett_closed : BridgeKind::willett;
}

} // namespace yade
