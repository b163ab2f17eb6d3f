// SPDX-License-Identifier: GPL-2.0-or-later
// Makes the contact of two bodies of GrainMat: elastic coefficients, damping, friction curve.
#pragma once

#include <laws/yade/GrainMat.hpp>
#include <laws/yade/GrainEffectPhys.hpp>

#include <atomic>

#include <core/Dispatching.hpp>

namespace yade {

/// What holds between two named materials, in place of the rules.
class GrainPair : public Serializable {
public:
    virtual ~GrainPair();

    void validate() const;
    void postLoad(GrainPair&) { validate(); }
    bool joins(const std::string& a, const std::string& b) const {
        return (a == first && b == second) || (a == second && b == first);
    }
    void pyHandleCustomCtorArgs(boost::python::tuple& args, boost::python::dict& keywords) override;

    // clang-format off
    YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(GrainPair, Serializable,
        "Friction and restitution between two materials, named by their labels; positional arguments: first, second.",
        ((std::string, first, "", , "label of one material."))
        ((std::string, second, "", , "label of the other material."))
        ((shared_ptr<FrictionCurve>, friction, , , "friction curve of this pair, or a number; None: by frictionRule."))
        ((Real, restitution, NaN, , "coefficient of restitution of this pair [-], in (0, 1]; nan: by restitutionRule."))
        ,
        ,
        .def(CheckedAttributes<GrainPair>().add("restitution", &GrainPair::restitution))
        .def(FrictionProperty<GrainPair>("GrainPair.friction"))
    );
    // clang-format on
};
REGISTER_SERIALIZABLE(GrainPair);

class Ip2_GrainMat_GrainMat_GrainPhys : public IPhysFunctor {
public:
    virtual ~Ip2_GrainMat_GrainMat_GrainPhys();

    void go(const shared_ptr<Material>& m1, const shared_ptr<Material>& m2,
            const shared_ptr<Interaction>& interaction) override;

    void validate() const;
    void postLoad(Ip2_GrainMat_GrainMat_GrainPhys&) { validate(); }

    /// Sentences on what was asked for but cannot act. Whoever asks is told, so that no log warns again. The
    /// law is the one that serves the scene, or None.
    boost::python::list idle_effects(const boost::python::object& law);
    /// Gives all contacts of the scene in hand the parameters that their materials have now.
    int renew_contacts();

    FUNCTOR2D(GrainMat, GrainMat);
    // clang-format off
    YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(Ip2_GrainMat_GrainMat_GrainPhys, IPhysFunctor,
        "Creates :yref:`GrainPhys` or :yref:`GrainEffectPhys` from two :yref:`GrainMat`. Walls, boxes and facets count as flat (infinite radius) whatever "
        "radius their geometry functor reports, so that they have Hertz's full stiffness; non-spherical grains (level sets, "
        "polyhedra) count with the radius of the sphere of equal volume (MR-2629, below Eq 3). A contact is as wet as the wetter "
        "of its materials. Where there is water the contact gets a :yref:`LiquidBridge`.",
        ((vector<shared_ptr<Serializable>>, pairs, , , "list of :yref:`GrainPair`: explicit values for named pairs of materials."))
        ((std::string, frictionRule, "min", , "friction of unlike materials without a GrainPair: 'min', 'max', 'mean' or 'geometric' of the two coefficients at the contact's load."))
        ((std::string, restitutionRule, "mean", , "restitution of unlike materials without a GrainPair: 'min', 'max', 'mean' or 'geometric'."))
        ((bool, dashpotAttraction, false, , "may the dashpot pull the bodies together while they part? If not, the normal force is cut at zero. Restitution is met either way (contact ends at zero overlap or at zero force)."))
        ,
        ,
        .def(CheckedAttributes<Ip2_GrainMat_GrainMat_GrainPhys>()
            .add("pairs", &Ip2_GrainMat_GrainMat_GrainPhys::pairs)
            .add("frictionRule", &Ip2_GrainMat_GrainMat_GrainPhys::frictionRule)
            .add("restitutionRule", &Ip2_GrainMat_GrainMat_GrainPhys::restitutionRule))
        .def("idleEffects", &Ip2_GrainMat_GrainMat_GrainPhys::idle_effects, (boost::python::arg("law") = boost::python::object()),
            "Effects that the scene asks for but that cannot act, a sentence each; law: the one that serves the contacts. Logged once, with "
            "the first contact, unless this was called before.")
        .def("renewContacts", &Ip2_GrainMat_GrainMat_GrainPhys::renew_contacts,
            "Give all contacts the parameters that their materials have now (a contact keeps those it was made with); forces, slip and "
            "bridges stay. Returns their number.")
    );
    // clang-format on

    DECLARE_LOGGER;

private:
    std::atomic<bool> warned_{false};
    std::atomic<bool> scene_checked_{false};

    /// Logs once what cannot act in this scene.
    void check_scene();

    /// Says once that the scene is too wet for bridges of their own.
    void warn_beyond_pendular(const LiquidBridge& bridge, const GrainMat& mat1, const GrainMat& mat2);
    const GrainPair* explicit_pair(const GrainMat& m1, const GrainMat& m2) const;
    shared_ptr<FrictionCurve> pair_friction(const GrainMat& m1, const GrainMat& m2,
                                            const GrainPair* pair) const;
    Real pair_restitution(const GrainMat& m1, const GrainMat& m2, const GrainPair* pair) const;
};
REGISTER_SERIALIZABLE(Ip2_GrainMat_GrainMat_GrainPhys);

} // namespace yade
