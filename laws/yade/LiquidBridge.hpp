// SPDX-License-Identifier: GPL-2.0-or-later
// Liquid between two bodies of GrainMat.
#pragma once

#include <laws/bridge/liquid_bridge.hpp>
#include <laws/yade/ContactClass.hpp>

#include <lib/base/Math.hpp>
#include <lib/serialization/Serializable.hpp>

namespace yade {

class Body;
class GrainMat;

/// Does a body of this kind carry water of its own? Flat bodies and projectiles do not.
bool carries_water(const Body& body);

/// One side of a contact, as far as a bridge is concerned.
struct BridgeSide {
    const GrainMat& material;
    const Body& body;
    Real radius; // m, infinite for a flat body
    Real mass;   // kg that resists a push, infinite for a held body
};

class LiquidBridge : public Serializable {
public:
    virtual ~LiquidBridge();

    /// The bridge that these two bodies will have when they touch; null where there is none. `coarsening` is
    /// the factor by which the grains are larger than the real ones.
    static shared_ptr<LiquidBridge> between(const BridgeSide& first, const BridgeSide& second,
                                            Real coarsening);
    /// Kernel that serves it.
    BridgeKind kind() const;

    grainfall::laws::bridge::BridgeParameters parameters() const {
        return {{contactForce, inverseLength, decay[0], decay[1], decay[2]},
                {filmStrength, filmCutoff, filmArea, filmMass},
                ruptureDistance};
    }
    grainfall::laws::bridge::BridgeMemory memory() const {
        return {formed, separation, attraction, viscousForce, work};
    }
    /// What a kernel with this film and these books has changed; without them all of it.
    template <class Film = grainfall::laws::bridge::SqueezeFilm,
              class Energy = grainfall::laws::bridge::BridgeBook>
    void remember(const grainfall::laws::bridge::BridgeMemory& state) {
        formed = state.formed;
        separation = state.separation;
        attraction = state.attraction;
        if (Film::active)
            viscousForce = state.viscous_force;
        if (Energy::active || !state.formed)
            work = state.work;
    }
    /// N, on body 2 along the normal; without the film's part where it is known to be none.
    template <class Film = grainfall::laws::bridge::SqueezeFilm>
    Real normal_force() const {
        return grainfall::laws::bridge::normal_force<Film>(memory());
    }

    // clang-format off
    YADE_CLASS_BASE_DOC_ATTRS_CTOR(LiquidBridge, Serializable,
        "Liquid bridge of a contact; see :yref:`GrainMat.bridgeModel`. It exists from the touch to the rupture (formed); lengths and "
        "volumes are those of the simulated grains.",
        ((Real, volume, 0, Attr::readonly, "liquid in the bridge [m3]."))
        ((Real, volumeFromFirst, 0, Attr::readonly, "part of it that body 1 gave [m3]."))
        ((Real, relativeVolume, 0, Attr::readonly, "volume over R^3, R = 2 R1 R2/(R1 + R2) [-]."))
        ((Real, ruptureDistance, 0, Attr::readonly, "separation at which the bridge ruptures [m]. Source: Willett et al. 2000, Eq 15."))
        ((Real, contactForce, 0, Attr::readonly, "attraction at contact and on overlap [N]. Source: Willett et al. 2000."))
        ((Real, inverseLength, 0, Attr::readonly, "S = separation*inverseLength [1/m], sqrt(R/V)/2."))
        ((bool, closedForm, false, Attr::readonly, "force by Eq 12 of Willett et al. 2000 rather than by their fit."))
        ((Vector3r, decay, Vector3r::Zero(), Attr::readonly, "f2, f3, f4 of the fit [-]. Source: Willett et al. 2000, appendix."))
        ((Real, filmStrength, 0, Attr::readonly, "6 pi eta R*^2 [N s]; 0: no viscous force."))
        ((Real, filmCutoff, 0, Attr::readonly, "separation below which the viscous force grows no more [m]."))
        ((Real, filmArea, 0, Attr::readonly, "2 V/(pi R) [m2]. Source: Pitois et al. 2000."))
        ((Real, filmMass, 0, Attr::readonly, "effective mass of the pair [kg]; the viscous force is held at what stops a quarter of the approach in a step."))
        ((bool, formed, false, , "have the bodies touched since the last rupture? Only then does the bridge act."))
        ((Real, separation, NaN, Attr::readonly, "distance of the surfaces in the last step [m], negative on overlap."))
        ((Real, attraction, 0, Attr::readonly, "capillary force of the last step [N]; not part of normalForce."))
        ((Real, viscousForce, 0, Attr::readonly, "viscous force of the last step, on body 2 along the normal [N]; not part of normalForce."))
        ((Real, work, 0, Attr::readonly, "work done against the attraction since the bridge formed [J]; kept with O.trackEnergy only."))
        ,
    );
    // clang-format on
};
REGISTER_SERIALIZABLE(LiquidBridge);

} // namespace yade
