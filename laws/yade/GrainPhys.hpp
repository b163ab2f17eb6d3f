// SPDX-License-Identifier: GPL-2.0-or-later
// State of one contact between bodies of GrainMat: what the plain contact needs and no more. What some
// contacts carry besides is in GrainEffectPhys.
#pragma once

#include <laws/yade/ContactClass.hpp>

#include <pkg/dem/FrictPhys.hpp>

namespace yade {

class GrainEffectPhys;

class GrainPhys : public FrictPhys {
public:
    virtual ~GrainPhys();

    /// The contact as one that carries effects; null for a plain one.
    virtual GrainEffectPhys* effects() { return nullptr; }
    const GrainEffectPhys* effects() const { return const_cast<GrainPhys*>(this)->effects(); }

    /// Takes over forces, slip and bridge of the contact that this one replaces. A plain contact has no place
    /// for slip: GrainEffectPhys::of() makes one.
    void go_on_from(const GrainPhys& before);

    // clang-format off
    YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(GrainPhys, FrictPhys,
        "Contact between two bodies of :yref:`GrainMat`. kn [N/m] is the tangent normal stiffness dFn/d(overlap), ks [N/m] the "
        "tangential stiffness, both of the last step; normalForce and shearForce [N] are the forces that acted in it, without that of a "
        "liquid bridge, which bridge tells. A contact with a friction curve, a liquid bridge or a slip history is a :yref:`GrainEffectPhys`.",
        ((Real, normalCoefficient, 0, , "4/3 E* sqrt(R*) [N/m^1.5]: Hertz's force over overlap^1.5. Source: Johnson 1985, eq 4.23."))
        ((Real, shearCoefficient, 0, , "8 G* sqrt(R*) [N/m^1.5]: Mindlin's tangential stiffness over overlap^0.5. Source: Mindlin 1949."))
        ((Real, normalDamping, 0, , "damping coefficient over overlap^0.25 [N s/m^1.25] in the normal direction. Source: Tsuji et al. 1992."))
        ((Real, shearDamping, 0, , "damping coefficient over overlap^0.25 [N s/m^1.25] in the tangential direction."))
        ((Vector3r, shearElastic, Vector3r::Zero(), , "elastic part of the shear force [N], carried from step to step."))
        ((bool, isSliding, false, , "did the contact slide in the last step?"))
        ((int, contactClass, 0, Attr::readonly, "number of the kernel that serves this contact."))
        ,
        createIndex();
        ,
        .add_property("friction", &nothing, "None: friction is constant, tangensOfFrictionAngle.")
        .add_property("moisture", &zero, "0: no curve is read at a moisture [-].")
        .add_property("loadScale", &one, "1: no curve is read at a load [-].")
        .add_property("partialSlip", &nothing, "None: no slip history.")
        .add_property("bridge", &nothing, "None: no liquid bridge.")
    );
    // clang-format on
    REGISTER_CLASS_INDEX(GrainPhys, FrictPhys);

private:
    // What Python sees in place of effects that a plain contact does not have.
    static boost::python::object nothing(const GrainPhys&) { return {}; }
    static Real zero(const GrainPhys&) { return 0; }
    static Real one(const GrainPhys&) { return 1; }
};
REGISTER_SERIALIZABLE(GrainPhys);

} // namespace yade
