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
