// SPDX-License-Identifier: GPL-2.0-or-later
#include <laws/yade/GrainEffectPhys.hpp>

#include <core/Interaction.hpp>

namespace yade {

YADE_PLUGIN((GrainPhys)(GrainEffectPhys));

// Defined here so that virtual tables and Python registration are compiled once.
GrainPhys::~GrainPhys() = default;
GrainEffectPhys::~GrainEffectPhys() = default;

PairFriction::PairFriction(const shared_ptr<FrictionCurve>& of_pair, Real moisture, Real load_scale)
    : curve(of_pair), resolved(curve->resolve(moisture, load_scale)) {
    namespace friction = grainfall::laws::friction;
    form = form_of(*resolved);
    const auto* pair = std::get_if<friction::Any::Pair>(&resolved->curve());
    // Two constants combine to a constant.
    if (pair && form_of(*pair->first.curve) == FrictionForm::constant &&
        form_of(*pair->second.curve) == FrictionForm::constant)
        form = FrictionForm::constant;
    if (form == FrictionForm::constant) {
        constant = resolved->coefficient(1);
        curve.reset();
        resolved.reset();
    }
}

void GrainPhys::go_on_from(const GrainPhys& before) {
    kn = before.kn;
    ks = before.ks;
    normalForce = before.normalForce;
    shearForce = before.shearForce;
    shearElastic = before.shearElastic;
    isSliding = before.isSliding;
    GrainEffectPhys* own = effects();
    if (!own)
        return;
    if (const GrainEffectPhys* carried = before.effects())
        own->partialSlip = carried->partialSlip;
    if (!own->bridge)
        return;
    if (const LiquidBridge* bridge = bridge_of(before))
        own->bridge->remember(bridge->memory());
    else
        own->bridge->formed = kn > 0;
}

GrainEffectPhys& GrainEffectPhys::of(Interaction& contact) {
    auto& plain = static_cast<GrainPhys&>(*contact.phys);
    if (GrainEffectPhys* effects = plain.effects())
        return *effects;
    const auto roomy = shared_ptr<GrainEffectPhys>(new GrainEffectPhys);
    static_cast<GrainPhys&>(*roomy) = plain;
    contact.phys = roomy;
    return *roomy;
}

void GrainEffectPhys::set_friction(const PairFriction& read) {
    friction = read.curve;
    resolved_ = read.resolved;
}

void GrainEffectPhys::keep_slip(const grainfall::laws::SlipHistory& history) {
    if (!partialSlip)
        partialSlip = shared_ptr<PartialSlip>(new PartialSlip);
    partialSlip->keep(history);
}

void GrainEffectPhys::part() {
    kn = ks = 0;
    normalForce = shearForce = shearElastic = Vector3r::Zero();
    partialSlip.reset();
    isSliding = false;
}

void GrainEffectPhys::postLoad(GrainEffectPhys&) {
    resolved_ = friction ? friction->resolve(moisture, loadScale) : ResolvedFriction();
}

} // namespace yade
