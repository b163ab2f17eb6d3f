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

    /// V* of a bridge between two equal grains of this material [-]; nan where the volume was stated.
    Real relative_bridge_volume() const;
    /// Do contacts with this material have bridges?
    bool has_bridges() const;

    /// The friction curve: `friction`, or constant tan(frictionAngle) where none was given.
    shared_ptr<FrictionCurve> friction_curve() const;

    void pyHandleCustomCtorArgs(boost::python::tuple& args, boost::python::dict& keywords) override;

    // clang-format off
    YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(GrainMat, FrictMat,
        "Elastic material of a grain (or projectile, or wall) with friction that may depend on load and moisture, "
        "restitution independent of impact speed, and water content; with water, contacts have liquid bridges. Used by :yref:`Ip2_GrainMat_GrainMat_GrainPhys`. "
        "Inherited: young [Pa], poisson [-], density [kg/m3], frictionAngle [rad].",
        ((Real, restitution, 1.0, , "coefficient of restitution of a head-on impact with a body of the same material [-], in (0, 1]; 1 leaves the dashpot out. Source: Tsuji et al. 1992, Antypov & Elliott 2011."))
        ((Real, gravimetricMoisture, 0.0, , "mass of water over mass of dry grains [-], >= 0. Source: MR-2629 section 3.3 (0.023 in its moist drops)."))
        ((shared_ptr<FrictionCurve>, friction, , , "friction coefficient as a function of normal load (and moisture): a :yref:`FrictionCurve`, or a number; None means the constant tan(frictionAngle). Source: MR-2629 section 2.2.2 (Cole 2015)."))
        ((Real, referenceRadius, 0.0, , "radius of the real grain that this coarser one stands for [m]; the friction curve is read at the load divided by the square of the coarsening, and bridges carry the real sand's suction stress. 0: the grain stands for itself."))
        ((std::string, bridgeModel, "willett", , "force of liquid bridges: 'willett' (fit, for precision), 'willett-closed' (Eq 12, cheaper) or 'none'. 'none' on either side of a contact rules them out. Source: Willett et al. 2000."))
        ((Real, bridgeVolume, NaN, , "volume of one bridge between real grains [m3], >= 0 (it grows with the cube of the coarsening); nan: each grain gives the water of its gravimetricMoisture shared by bridgesPerGrain; walls and projectiles give none."))
        ((Real, bridgesPerGrain, 6, , "number of bridges among which a grain shares its water [-], >= 1."))
        ((Real, surfaceTension, 0.0728, , "of the liquid [N/m], > 0. Default: water at 20 C."))
        ((Real, contactAngle, 0.0, , "of the liquid on this solid [rad], in [0, 0.8727] (50 degrees, the range of the fit). Default: perfect wetting."))
        ((Real, liquidViscosity, 0.0, , "dynamic viscosity of the liquid [Pa s], >= 0 (water 1e-3); 0 leaves the squeeze film out."))
        ((Real, lubricationCutoff, 1e-6, , "separation below which the squeeze film stiffens no more [m], > 0: roughness of the real grains, about 1e-6 for sand."))
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
            .add("referenceRadius", &GrainMat::referenceRadius)
            .add("bridgeModel", &GrainMat::bridgeModel)
            .add("bridgeVolume", &GrainMat::bridgeVolume)
            .add("bridgesPerGrain", &GrainMat::bridgesPerGrain)
            .add("surfaceTension", &GrainMat::surfaceTension)
            .add("contactAngle", &GrainMat::contactAngle)
            .add("liquidViscosity", &GrainMat::liquidViscosity)
            .add("lubricationCutoff", &GrainMat::lubricationCutoff))
        .add_property("relativeBridgeVolume", &GrainMat::relative_bridge_volume,
            "Volume over radius cubed of a bridge between two equal grains of this material [-]; 0 without water, nan where bridgeVolume is stated.")
        .add_property("hasBridges", &GrainMat::has_bridges, "Do contacts of this material with itself have liquid bridges?")
        .def(FrictionProperty<GrainMat>("GrainMat.friction"))
    );
    // clang-format on
    REGISTER_CLASS_INDEX(GrainMat, FrictMat);
};
REGISTER_SERIALIZABLE(GrainMat);

} // namespace yade
