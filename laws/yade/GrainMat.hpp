// SPDX-License-Identifier: GPL-2.0-or-later
// Material of grains, projectiles and walls: what of the contact depends on one body alone.
#pragma once

#include <laws/yade/FrictionCurve.hpp>

#include <pkg/common/ElastMat.hpp>

namespace yade {

class GrainMat : public FrictMat {
public:
    virtual ~GrainMat();

    /// Throws std::invalid_argument naming the attribute, its value and the allowed range.
    void validate() const;
    void postLoad(GrainMat&) { validate(); }

    /// The friction curve: `friction`, or constant tan(frictionAngle) where none was given.
    shared_ptr<FrictionCurve> friction_curve() const;

    void pyHandleCustomCtorArgs(boost::python::tuple& args, boost::python::dict& keywords) override;

    // clang-format off
    YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(GrainMat, FrictMat,
        "Elastic material of a grain (or projectile, or wall) with friction that may depend on load and moisture, "
        "restitution independent of impact speed, and water content. Used by :yref:`Ip2_GrainMat_GrainMat_GrainPhys`. "
        "Inherited: young [Pa], poisson [-], density [kg/m3], frictionAngle [rad].",
        ((Real, restitution, 1.0, , "coefficient of restitution of a head-on impact with a body of the same material [-], in (0, 1]; 1 leaves the dashpot out. Source: Tsuji et al. 1992, Antypov & Elliott 2011."))
        ((Real, gravimetricMoisture, 0.0, , "mass of water over mass of dry grains [-], >= 0. Source: MR-2629 section 3.3 (0.023 in its moist drops)."))
        ((shared_ptr<FrictionCurve>, friction, , , "friction coefficient as a function of normal load (and moisture): a :yref:`FrictionCurve`, or a number; None means the constant tan(frictionAngle). Source: MR-2629 section 2.2.2 (Cole 2015)."))
        ((Real, referenceRadius, 0.0, , "radius of the real grain that this coarser one stands for [m]; the friction curve is read at the load divided by the square of the coarsening. 0: the grain stands for itself."))
        ,
        createIndex();
        ,
        .def(CheckedAttributes<GrainMat>()
            .add("young", &GrainMat::young)
            .add("poisson", &GrainMat::poisson)
            .add("density", &GrainMat::density)
            .add("frictionAngle", &GrainMat::frictionAngle)
            .add("restitution", &GrainMat::restitution)
            .add("gravimetricMoisture", &GrainMat::gravimetricMoisture)
            .add("referenceRadius", &GrainMat::referenceRadius))
        .def(FrictionProperty<GrainMat>("GrainMat.friction"))
    );
    // clang-format on
    REGISTER_CLASS_INDEX(GrainMat, FrictMat);
};
REGISTER_SERIALIZABLE(GrainMat);

} // namespace yade
