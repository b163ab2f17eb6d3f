// SPDX-License-Identifier: GPL-2.0-or-later
#include <laws/yade/GrainMat.hpp>

#include <laws/bridge/geometry.hpp>
#include <laws/bridge/water.hpp>
#include <laws/pair_rules.hpp>

namespace yade {

YADE_PLUGIN((GrainMat));

// Defined here so that virtual tables and Python registration are compiled once.
GrainMat::~GrainMat() = default;

void GrainMat::validate() const {
    namespace gl = grainfall::laws;
    gl::validate(gl::ElasticMaterial{young, poisson}, "GrainMat");
    gl::require_positive("GrainMat.density", density);
    if (!(frictionAngle >= 0 && frictionAngle < M_PI / 2))
        gl::reject("GrainMat.frictionAngle", frictionAngle, "in [0, pi/2) (radians)");
    gl::require_between("GrainMat.restitution", restitution, gl::smallest_restitution, 1);
    gl::require_between("GrainMat.gravimetricMoisture", gravimetricMoisture, 0, 1);
    gl::require_not_negative("GrainMat.referenceRadius", referenceRadius);
    if (bridgeModel != "none" && bridgeModel != "willett" && bridgeModel != "willett-closed")
        gl::reject("GrainMat.bridgeModel", "'" + bridgeModel + "'", "'none', 'willett' or 'willett-closed'");
    if (!std::isnan(bridgeVolume))
        gl::require_not_negative("GrainMat.bridgeVolume", bridgeVolume);
    if (!(std::isfinite(bridgesPerGrain) && bridgesPerGrain >= 1))
        gl::reject("GrainMat.bridgesPerGrain", bridgesPerGrain, ">= 1 and finite");
    gl::require_positive("GrainMat.surfaceTension", surfaceTension);
    gl::require_between("GrainMat.contactAngle", contactAngle, 0, gl::bridge::largest_contact_angle);
    gl::require_not_negative("GrainMat.liquidViscosity", liquidViscosity);
    gl::require_positive("GrainMat.lubricationCutoff", lubricationCutoff);
    if (friction)
        friction->validate();
}

Real GrainMat::relative_bridge_volume() const {
    if (!has_bridges())
        return 0;
    if (!std::isnan(bridgeVolume))
        return NaN;
    return grainfall::laws::bridge::relative_volume_of_equal_grains(gravimetricMoisture, density,
                                                                    bridgesPerGrain);
}

bool GrainMat::has_bridges() const {
    return bridgeModel != "none" && (std::isnan(bridgeVolume) ? gravimetricMoisture > 0 : bridgeVolume > 0);
}

shared_ptr<FrictionCurve> GrainMat::friction_curve() const {
    return friction ? friction : make_constant_friction(std::tan(frictionAngle));
}

void GrainMat::pyHandleCustomCtorArgs(boost::python::tuple&, boost::python::dict& keywords) {
    if (keywords.has_key("friction"))
        keywords["friction"] = to_friction_curve(keywords["friction"], "GrainMat.friction");
}

} // namespace yade
