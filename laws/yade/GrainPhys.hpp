// SPDX-License-Identifier: GPL-2.0-or-later
// State of one contact between bodies of GrainMat.
#pragma once

#include <laws/yade/ContactClass.hpp>
#include <laws/yade/FrictionCurve.hpp>
#include <laws/yade/PartialSlip.hpp>
#include <laws/yade/LiquidBridge.hpp>

#include <pkg/dem/FrictPhys.hpp>

namespace yade {

class GrainPhys : public FrictPhys {
public:
    virtual ~GrainPhys();

    /// The friction curve with moisture and load scale folded in; meaningless where friction is constant
    /// (then tangensOfFrictionAngle says it all).
    const grainfall::laws::friction::Any& curve() const { return *resolved_; }

    /// Form of the resolved curve. Where that is constant, keeps the number in tangensOfFrictionAngle and
    /// lets the curve go, so that the contact carries nothing that it does not read.
    FrictionForm simplified_friction();

    /// The bodies have parted but stay in touch through a liquid bridge: the next touch starts afresh.
    void part();

    /// Takes over forces, slip and bridge of the contact that this one replaces.
    void go_on_from(const GrainPhys& before);

    /// Rebuilds what is not saved.
    void resolve_friction();
    void postLoad(GrainPhys&) { resolve_friction(); }

private:
    ResolvedFriction resolved_;

public:
    // clang-format off
    YADE_CLASS_BASE_DOC_ATTRS_CTOR(GrainPhys, FrictPhys,
        "Contact between two bodies of :yref:`GrainMat`. kn [N/m] is the tangent normal stiffness dFn/d(overlap), ks [N/m] the "
        "tangential stiffness, both of the last step; normalForce and shearForce [N] are the forces that acted in it, without that of a "
        "liquid bridge, which bridge tells.",
        ((Real, normalCoefficient, 0, , "4/3 E* sqrt(R*) [N/m^1.5]: Hertz's force over overlap^1.5. Source: Johnson 1985, eq 4.23."))
        ((Real, shearCoefficient, 0, , "8 G* sqrt(R*) [N/m^1.5]: Mindlin's tangential stiffness over overlap^0.5. Source: Mindlin 1949."))
        ((Real, normalDamping, 0, , "damping coefficient over overlap^0.25 [N s/m^1.25] in the normal direction. Source: Tsuji et al. 1992."))
        ((Real, shearDamping, 0, , "damping coefficient over overlap^0.25 [N s/m^1.25] in the tangential direction."))
        ((Vector3r, shearElastic, Vector3r::Zero(), , "elastic part of the shear force [N], carried from step to step."))
        ((shared_ptr<FrictionCurve>, friction, , , "friction curve of this pair of materials; None where friction is constant."))
        ((Real, moisture, 0, , "gravimetric moisture at which the curve is read [-]."))
        ((Real, loadScale, 1, , "square of the coarsening [-]: the curve is read at the normal force divided by this number."))
        ((shared_ptr<PartialSlip>, partialSlip, , , "slip history under tangentialLaw='mindlin-deresiewicz'; None until that law acts."))
        ((shared_ptr<LiquidBridge>, bridge, , , "liquid bridge; None for a dry contact."))
        ((bool, isSliding, false, , "did the contact slide in the last step?"))
        ((int, contactClass, 0, Attr::readonly, "number of the kernel that serves this contact."))
        ,
        createIndex();
    );
    // clang-format on
    REGISTER_CLASS_INDEX(GrainPhys, FrictPhys);
};
REGISTER_SERIALIZABLE(GrainPhys);

} // namespace yade
