// SPDX-License-Identifier: GPL-2.0-or-later
// A contact that reads or remembers more than the plain one: a friction curve, a slip history, a liquid
// bridge. A class of its own, so that the plain contact has no empty places for them.
#pragma once

#include <laws/yade/FrictionCurve.hpp>
#include <laws/yade/GrainPhys.hpp>
#include <laws/yade/LiquidBridge.hpp>
#include <laws/yade/PartialSlip.hpp>

namespace yade {

class Interaction;

/// A pair's friction as its contact reads it, moisture and load scale folded in.
struct PairFriction {
    PairFriction(const shared_ptr<FrictionCurve>& curve, Real moisture, Real load_scale);

    FrictionForm form;
    Real constant = 0;               // where the form is constant
    shared_ptr<FrictionCurve> curve; // null where the form is constant
    ResolvedFriction resolved;       // likewise
};

class GrainEffectPhys : public GrainPhys {
public:
    virtual ~GrainEffectPhys();

    GrainEffectPhys* effects() override { return this; }
    using GrainPhys::effects;

    /// This contact with room for effects: its GrainPhys is replaced where it has none. The former object is
    /// gone unless somebody else holds it.
    static GrainEffectPhys& of(Interaction& contact);

    const grainfall::laws::friction::Any& curve() const { return *resolved_; }
    void set_friction(const PairFriction& read);

    void keep_slip(const grainfall::laws::SlipHistory& history);

    /// The bodies have parted but stay in touch through the bridge: the next touch starts afresh.
    void part();

    /// Rebuilds what is not saved.
    void postLoad(GrainEffectPhys&);

private:
    ResolvedFriction resolved_;

public:
    // clang-format off
    YADE_CLASS_BASE_DOC_ATTRS_CTOR(GrainEffectPhys, GrainPhys,
        ":yref:`GrainPhys` of a contact with a friction curve, a liquid bridge or a slip history.",
        ((shared_ptr<FrictionCurve>, friction, , , "friction curve of this pair of materials; None where friction is constant."))
        ((Real, moisture, 0, , "gravimetric moisture at which the curve is read [-]."))
        ((Real, loadScale, 1, , "square of the coarsening [-]: the curve is read at the normal force divided by this number."))
        ((shared_ptr<PartialSlip>, partialSlip, , , "slip history under tangentialLaw='mindlin-deresiewicz'; None until that law acts."))
        ((shared_ptr<LiquidBridge>, bridge, , , "liquid bridge; None for a dry contact."))
        ,
        createIndex();
    );
    // clang-format on
    REGISTER_CLASS_INDEX(GrainEffectPhys, GrainPhys);
};
REGISTER_SERIALIZABLE(GrainEffectPhys);

/// Bridge of a contact; null where there is none.
inline const LiquidBridge* bridge_of(const GrainPhys& phys) {
    const GrainEffectPhys* effects = phys.effects();
    return effects ? effects->bridge.get() : nullptr;
}
/// Slip history of a contact; null where there is none.
inline const PartialSlip* slip_of(const GrainPhys& phys) {
    const GrainEffectPhys* effects = phys.effects();
    return effects ? effects->partialSlip.get() : nullptr;
}

} // namespace yade
