// SPDX-License-Identifier: GPL-2.0-or-later
#include <laws/yade/GrainPhys.hpp>

namespace yade {

YADE_PLUGIN((GrainPhys));

// Defined here so that virtual tables and Python registration are compiled once.
GrainPhys::~GrainPhys() = default;

void GrainPhys::resolve_friction() {
    resolved_ = friction ? friction->resolve(moisture, loadScale) : ResolvedFriction();
}

void GrainPhys::part() {
    kn = ks = 0;
    normalForce = shearForce = shearElastic = Vector3r::Zero();
    partialSlip.reset();
    isSliding = false;
}

void GrainPhys::go_on_from(const GrainPhys& before) {
    kn = before.kn;
    ks = before.ks;
    normalForce = before.normalForce;
    shearForce = before.shearForce;
    shearElastic = before.shearElastic;
    partialSlip = before.partialSlip;
    isSliding = before.isSliding;
    if (!bridge)
        return;
    if (before.bridge)
        bridge->remember(before.bridge->memory());
    else
        bridge->formed = kn > 0;
}

FrictionForm GrainPhys::simplified_friction() {
    namespace friction_kernels = grainfall::laws::friction;
    FrictionForm form = form_of(*resolved_);
    const auto* pair = std::get_if<friction_kernels::Any::Pair>(&resolved_->curve());
    // Two constants combine to a constant.
    if (pair && form_of(*pair->first.curve) == FrictionForm::constant &&
        form_of(*pair->second.curve) == FrictionForm::constant)
        form = FrictionForm::constant;
    if (form == FrictionForm::constant) {
        tangensOfFrictionAngle = resolved_->coefficient(1);
        friction.reset();
        resolved_.reset();
    }
    return form;
}

} // namespace yade
