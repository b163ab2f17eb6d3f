// SPDX-License-Identifier: GPL-2.0-or-later
// A build in which the effects do not exist: the plain contact of handwritten_law.hpp as YADE functors of its
// own, with a contact class that has no member for any effect. A module beside grainfall, which it does not
// need.
//
// It also tells callgrind when to count.
#include "../../python/module/register_classes.hpp"

#include <laws/friction/constant.hpp>
#include <laws/hertz_mindlin.hpp>
#include <laws/pair_rules.hpp>
#include <laws/yade/contact_rotation.hpp>

#include <core/Body.hpp>
#include <core/Cell.hpp>
#include <core/Dispatching.hpp>
#include <core/Interaction.hpp>
#include <core/Scene.hpp>
#include <core/State.hpp>
#include <pkg/dem/FrictPhys.hpp>
#include <pkg/dem/ScGeom.hpp>

#include <malloc.h>
#include <valgrind/callgrind.h>

namespace yade {

namespace gl = grainfall::laws;

class PlainPhys : public FrictPhys {
public:
    virtual ~PlainPhys() = default;
    // clang-format off
    YADE_CLASS_BASE_DOC_ATTRS_CTOR(PlainPhys, FrictPhys, "Dry contact with constant friction.",
        ((Real, normalCoefficient, 0, , "4/3 E* sqrt(R*) [N/m^1.5]."))
        ((Real, shearCoefficient, 0, , "8 G* sqrt(R*) [N/m^1.5]."))
        ((Real, normalDamping, 0, , "damping coefficient over overlap^0.25 [N s/m^1.25]."))
        ((Real, shearDamping, 0, , "the same in shear [N s/m^1.25]."))
        ((Vector3r, shearElastic, Vector3r::Zero(), , "elastic part of the shear force [N]."))
        ((bool, isSliding, false, , "did the contact slide in the last step?"))
        ,
        createIndex();
    );
    // clang-format on
    REGISTER_CLASS_INDEX(PlainPhys, FrictPhys);
};
REGISTER_SERIALIZABLE(PlainPhys);

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
        auto phys = shared_ptr<PlainPhys>(new PlainPhys);
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
    );
    // clang-format on
};
REGISTER_SERIALIZABLE(Ip2_FrictMat_FrictMat_PlainPhys);

// What any law must do in YADE: gather the motion, keep the result, apply the force.
template <bool sheared, bool damped>
[[gnu::always_inline]] inline bool plain_step(Scene* scene, ScGeom& geom, PlainPhys& phys,
                                              Interaction& contact) {
    if (geom.penetrationDepth < 0)
        return false;
    const Body::id_t id1 = contact.getId1(), id2 = contact.getId2();
    const State& state1 = *Body::byId(id1, scene)->state;
    const State& state2 = *Body::byId(id2, scene)->state;
    Vector3r shift2 = Vector3r::Zero();
    if (scene->isPeriodic)
        shift2 = scene->cell->intrShiftPos(contact.cellDist);
    gl::ContactGeometry geometry;
    geometry.overlap = geom.penetrationDepth;
    geometry.normal = geom.normal;
    geometry.shear_increment = geom.shearIncrement();
    geometry.tilt = contact_tilt(geom);
    geometry.twist = contact_twist(geom);
    geometry.time_step = scene->dt;
    if constexpr (damped) {
        Vector3r shift_velocity = Vector3r::Zero();
        if (scene->isPeriodic)
            shift_velocity = scene->cell->intrShiftVel(contact.cellDist);
        geometry.normal_velocity =
            geom.getIncidentVel(&state1, &state2, scene->dt, shift2, shift_velocity, false).dot(geom.normal);
    }
    const gl::ContactParameters parameters{phys.normalCoefficient, phys.shearCoefficient, phys.normalDamping,
                                           phys.shearDamping};
    gl::ContactMemory memory;
    memory.shear_force = phys.shearElastic;
    memory.shear_stiffness = phys.ks;
    using Tangential = std::conditional_t<sheared, gl::IncrementalTangential, gl::NoTangential>;
    using Damping = std::conditional_t<damped, gl::RepulsiveDashpot, gl::NoDamping>;
    gl::NoEnergy none;
    const gl::ContactForce force =
        gl::HertzMindlin<gl::Hertz, Tangential, Damping, gl::friction::Constant, gl::NoEnergy>::step(
            geometry, parameters, gl::friction::Constant{phys.tangensOfFrictionAngle}, memory, none);
    phys.kn = force.normal_stiffness;
    phys.ks = force.shear_stiffness;
    phys.normalForce = force.normal * geom.normal;
    phys.shearForce = force.shear;
    phys.shearElastic = memory.shear_force;
    phys.isSliding = force.sliding;

    Vector3r on_2;
    if constexpr (sheared)
        on_2 = phys.normalForce + phys.shearForce;
    else
        on_2 = phys.normalForce;
    ForceContainer& forces = scene->forces;
    forces.addForce(id1, -on_2);
    forces.addForce(id2, on_2);
    forces.addTorque(id1, -(geom.contactPoint - state1.pos).cross(on_2));
    forces.addTorque(id2, (geom.contactPoint - state2.pos - shift2).cross(on_2));
    return true;
}

#define PLAIN_LAW(name, sheared, damped)                                                                     \
    class name : public LawFunctor {                                                                         \
    public:                                                                                                  \
        virtual ~name() = default;                                                                           \
        bool go(shared_ptr<IGeom>& geometry, shared_ptr<IPhys>& physics, Interaction* contact) override {    \
            return plain_step<sheared, damped>(scene, static_cast<ScGeom&>(*geometry),                       \
                                               static_cast<PlainPhys&>(*physics), *contact);                 \
        }                                                                                                    \
        FUNCTOR2D(ScGeom, PlainPhys);                                                                        \
        YADE_CLASS_BASE_DOC_ATTRS(name, LawFunctor, "The plain contact and nothing else.", );                \
    };                                                                                                       \
    REGISTER_SERIALIZABLE(name)

PLAIN_LAW(Law2_ScGeom_PlainPhys_Damped, true, true);
PLAIN_LAW(Law2_ScGeom_PlainPhys_Elastic, true, false);
PLAIN_LAW(Law2_ScGeom_PlainPhys_Frictionless, false, true);

YADE_PLUGIN((
    PlainPhys)(Ip2_FrictMat_FrictMat_PlainPhys)(Law2_ScGeom_PlainPhys_Damped)(Law2_ScGeom_PlainPhys_Elastic)(Law2_ScGeom_PlainPhys_Frictionless));

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
