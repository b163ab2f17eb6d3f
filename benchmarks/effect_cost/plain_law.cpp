// SPDX-License-Identifier: GPL-2.0-or-later
// A build in which the effects do not exist: the plain contact of handwritten_law.hpp as YADE functors of its
// own, with a contact class that has no member for any effect. A module beside grainfall, which it does not
// need.
//
// It also tells callgrind when to count.
#include "plain_law.hpp"

#include "../../python/module/register_classes.hpp"

#include <malloc.h>
#include <valgrind/callgrind.h>

namespace yade {

class Ip2_FrictMat_FrictMat_PlainPhys : public IPhysFunctor {
public:
    virtual ~Ip2_FrictMat_FrictMat_PlainPhys() = default;
    void go(const shared_ptr<Material>& m1, const shared_ptr<Material>& m2,
            const shared_ptr<Interaction>& interaction) override {
        if (interaction->phys)
            return;
        const auto& mat1 = static_cast<const FrictMat&>(*m1);
        const auto& mat2 = static_cast<const FrictMat&>(*m2);
        const auto& geom = static_cast<const GenericSpheresContact&>(*interaction->geom);
        const auto mass = [this](Body::id_t id) { return Body::byId(id, scene)->state->mass; };
        const gl::ElasticMaterial elastic1{mat1.young, mat1.poisson}, elastic2{mat2.young, mat2.poisson};
        const gl::ContactParameters parameters = gl::contact_parameters(
            gl::effective_modulus(elastic1, elastic2), gl::effective_shear_modulus(elastic1, elastic2),
            gl::effective_radius(geom.refR1, geom.refR2),
            gl::effective_mass(mass(interaction->getId1()), mass(interaction->getId2())),
            gl::damping_ratio_from_restitution(restitution, false));
        const auto phys = make(gl::effective_radius(geom.refR1, geom.refR2));
        phys->normalCoefficient = parameters.normal_coefficient;
        phys->shearCoefficient = parameters.shear_coefficient;
        phys->normalDamping = parameters.normal_damping;
        phys->shearDamping = parameters.shear_damping;
        phys->tangensOfFrictionAngle = std::tan(std::min(mat1.frictionAngle, mat2.frictionAngle));
        interaction->phys = phys;
    }
    FUNCTOR2D(FrictMat, FrictMat);
    // clang-format off
    YADE_CLASS_BASE_DOC_ATTRS(Ip2_FrictMat_FrictMat_PlainPhys, IPhysFunctor, "Makes plain contacts.",
        ((Real, restitution, 1, , "coefficient of restitution [-]."))
        ((vector<Real>, powerLaw, , , "muRef [-], loadRef [N], exponent, muMin, muMax [-]; empty: constant friction."))
        ((vector<Real>, bridge, , , "volume [m3], surface tension [N/m] of a bridge at contact angle 0; empty: dry."))
    );
    // clang-format on
private:
    shared_ptr<PlainPhys> make(Real radius) const {
        if (powerLaw.size() == 5) {
            const auto phys = shared_ptr<PlainPowerLawPhys>(new PlainPowerLawPhys);
            phys->curve = {powerLaw[0], powerLaw[1], powerLaw[2], powerLaw[3], powerLaw[4]};
            return phys;
        }
        if (bridge.size() == 2) {
            const auto phys = shared_ptr<PlainWetPhys>(new PlainWetPhys);
            phys->bridge = gb::WillettNumeric::curve(2 * radius, bridge[0], bridge[1], 0);
            phys->rupture_distance = gb::rupture_distance(2 * radius, bridge[0], 0);
            return phys;
        }
        return shared_ptr<PlainPhys>(new PlainPhys);
    }
};
REGISTER_SERIALIZABLE(Ip2_FrictMat_FrictMat_PlainPhys);

PLAIN_LAW(Law2_ScGeom_PlainPhys_Damped, PlainPhys, (plain_step<true, true, PlainPhys>));
PLAIN_LAW(Law2_ScGeom_PlainPhys_Elastic, PlainPhys, (plain_step<true, false, PlainPhys>));
PLAIN_LAW(Law2_ScGeom_PlainPhys_Frictionless, PlainPhys, (plain_step<false, true, PlainPhys>));

YADE_PLUGIN((
    PlainPhys)(PlainPowerLawPhys)(PlainWetPhys)(Ip2_FrictMat_FrictMat_PlainPhys)(Law2_ScGeom_PlainPhys_Damped)(Law2_ScGeom_PlainPhys_Elastic)(Law2_ScGeom_PlainPhys_Frictionless));

} // namespace yade

namespace {

boost::python::list register_classes() {
    boost::python::list names;
    for (const std::string& name : grainfall::register_new_classes())
        names.append(name);
    return names;
}

void start_counting() {
    CALLGRIND_START_INSTRUMENTATION;
    CALLGRIND_ZERO_STATS;
}

void stop_counting(const std::string& name) {
    CALLGRIND_DUMP_STATS_AT(name.c_str());
    CALLGRIND_STOP_INSTRUMENTATION;
}

/// Bytes in use on the heap, of the one arena that MALLOC_ARENA_MAX=1 leaves.
std::size_t heap_bytes() {
    return mallinfo2().uordblks;
}

} // namespace

BOOST_PYTHON_MODULE(plain_law) {
    using boost::python::def;
    def("register_classes", &register_classes, "Register the classes of this module in the running YADE.");
    def("start_counting", &start_counting, "Let callgrind count from here.");
    def("stop_counting", &stop_counting, "Let callgrind write what it counted, under a name.");
    def("heap_bytes", &heap_bytes, "Bytes in use on the heap.");
}
