// SPDX-License-Identifier: GPL-2.0-or-later
#include <laws/yade/Ip2_GrainMat_GrainMat_GrainPhys.hpp>

#include <laws/pair_rules.hpp>
#include <laws/yade/FrictionCurves.hpp>
#include <laws/yade/Law2_ScGeom_GrainPhys_HertzMindlin.hpp>
#include <laws/yade/idle_effects.hpp>

#include <core/Body.hpp>
#include <core/Interaction.hpp>
#include <core/InteractionContainer.hpp>
#include <core/Omega.hpp>
#include <core/Scene.hpp>
#include <core/Shape.hpp>
#include <core/State.hpp>
#include <pkg/dem/ScGeom.hpp>

namespace yade {

YADE_PLUGIN((GrainPair)(Ip2_GrainMat_GrainMat_GrainPhys));
CREATE_LOGGER(Ip2_GrainMat_GrainMat_GrainPhys);

// Defined here so that virtual tables and Python registration are compiled once.
GrainPair::~GrainPair() = default;
Ip2_GrainMat_GrainMat_GrainPhys::~Ip2_GrainMat_GrainMat_GrainPhys() = default;

namespace gl = grainfall::laws;

namespace {

/// Radius of curvature [m] that a body shows to a contact.
Real contact_radius(const Body& body, Real geometry_radius, Real density) {
    const std::string shape = body.shape->getClassName();
    if (shape == "Wall" || shape == "Box" || shape == "Facet")
        return gl::infinite;
    if (shape == "LevelSet" || shape == "Polyhedra")
        return std::cbrt(3 * body.state->mass / (4 * M_PI * density)); // the sphere of equal volume
    return geometry_radius;
}

/// Mass [kg] that resists a push at the contact: the clump's for its members, infinite for a held body.
Real contact_mass(const Body& body, Scene* scene) {
    const Body& mover = body.isClumpMember() ? *Body::byId(body.clumpId, scene) : body;
    return mover.isDynamic() && mover.state->mass > 0 ? mover.state->mass : gl::infinite;
}

} // namespace

void GrainPair::validate() const {
    // Neither label: an object that unpickling has made and is about to fill.
    if (first.empty() && !second.empty())
        gl::reject("GrainPair.first", "''", "the label of a material");
    if (second.empty() && !first.empty())
        gl::reject("GrainPair.second", "''", "the label of a material");
    if (!std::isnan(restitution))
        gl::require_between("GrainPair.restitution", restitution, gl::smallest_restitution, 1);
    if (friction)
        friction->validate();
}

void GrainPair::pyHandleCustomCtorArgs(boost::python::tuple& args, boost::python::dict& keywords) {
    take_positional(args, keywords, {"first", "second"});
    if (keywords.has_key("friction"))
        keywords["friction"] = to_friction_curve(keywords["friction"], "GrainPair.friction");
}

void Ip2_GrainMat_GrainMat_GrainPhys::validate() const {
    const std::string owner = "Ip2_GrainMat_GrainMat_GrainPhys.";
    gl::combination_rule_from_name(owner + "frictionRule", frictionRule);
    gl::combination_rule_from_name(owner + "restitutionRule", restitutionRule);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const auto* pair = dynamic_cast<const GrainPair*>(pairs[i].get());
        const std::string name = owner + "pairs[" + std::to_string(i) + "]";
        if (!pair)
            gl::reject(name, pairs[i] ? pairs[i]->getClassName() : "None", "a GrainPair");
        pair->validate();
    }
}

const GrainPair* Ip2_GrainMat_GrainMat_GrainPhys::explicit_pair(const GrainMat& m1,
                                                                const GrainMat& m2) const {
    for (const auto& entry : pairs) {
        const auto& pair = static_cast<const GrainPair&>(*entry);
        if (pair.joins(m1.label, m2.label))
            return &pair;
    }
    return nullptr;
}

shared_ptr<FrictionCurve> Ip2_GrainMat_GrainMat_GrainPhys::pair_friction(const GrainMat& m1,
                                                                         const GrainMat& m2,
                                                                         const GrainPair* pair) const {
    if (pair && pair->friction)
        return pair->friction;
    if (&m1 == &m2 || (m1.friction && m1.friction == m2.friction))
        return m1.friction_curve();
    auto combined = shared_ptr<CombinedFriction>(new CombinedFriction);
    combined->first = m1.friction_curve();
    combined->second = m2.friction_curve();
    combined->rule = frictionRule;
    return combined;
}

Real Ip2_GrainMat_GrainMat_GrainPhys::pair_restitution(const GrainMat& m1, const GrainMat& m2,
                                                       const GrainPair* pair) const {
    if (pair && !std::isnan(pair->restitution))
        return pair->restitution;
    return gl::combine(gl::combination_rule_from_name("restitutionRule", restitutionRule), m1.restitution,
                       m2.restitution);
}

void Ip2_GrainMat_GrainMat_GrainPhys::warn_beyond_pendular(const LiquidBridge& bridge, const GrainMat& mat1,
                                                           const GrainMat& mat2) {
    namespace gb = gl::bridge;
    // Of grains that are too wet beside their like the check of the scene tells.
    const bool told = mat1.relative_bridge_volume() > gb::largest_pendular_volume ||
                      mat2.relative_bridge_volume() > gb::largest_pendular_volume;
    if (told || bridge.relativeVolume <= gb::largest_pendular_volume || warned_.exchange(true))
        return;
    LOG_WARN("liquid bridge of relative volume "
             << bridge.relativeVolume << ": above " << gl::bridge::largest_pendular_volume
             << " neighbouring bridges merge (beyond the pendular regime), and "
             << gl::bridge::largest_fitted_volume
             << " ends the range of the force; law.water() tells the share.");
}

void Ip2_GrainMat_GrainMat_GrainPhys::check_scene() {
    const auto* law = Law2_ScGeom_GrainPhys_HertzMindlin::acting_in(*scene);
    for (const std::string& sentence : yade::idle_effects(*scene, *this, law))
        LOG_WARN(sentence);
}

boost::python::list Ip2_GrainMat_GrainMat_GrainPhys::idle_effects(const boost::python::object& law) {
    scene_checked_ = true;
    const auto serving =
        law.is_none() ? shared_ptr<Law2_ScGeom_GrainPhys_HertzMindlin>()
                      : shared_ptr<Law2_ScGeom_GrainPhys_HertzMindlin>(
                            boost::python::extract<shared_ptr<Law2_ScGeom_GrainPhys_HertzMindlin>>(law));
    boost::python::list sentences;
    for (const std::string& sentence :
         yade::idle_effects(*Omega::instance().getScene(), *this, serving.get()))
        sentences.append(sentence);
    return sentences;
}

int Ip2_GrainMat_GrainMat_GrainPhys::renew_contacts() {
    scene = Omega::instance().getScene().get();
    int renewed = 0;
    for (const auto& interaction : *scene->interactions) {
        if (!interaction->isReal() || !dynamic_cast<GrainPhys*>(interaction->phys.get()))
            continue;
        const auto before = boost::static_pointer_cast<GrainPhys>(interaction->phys);
        interaction->phys.reset();
        go(Body::byId(interaction->getId1(), scene)->material,
           Body::byId(interaction->getId2(), scene)->material, interaction);
        GrainPhys& renewed_phys = slip_of(*before) ? GrainEffectPhys::of(*interaction)
                                                   : static_cast<GrainPhys&>(*interaction->phys);
        renewed_phys.go_on_from(*before);
        ++renewed;
    }
    return renewed;
}

void Ip2_GrainMat_GrainMat_GrainPhys::go(const shared_ptr<Material>& m1, const shared_ptr<Material>& m2,
                                         const shared_ptr<Interaction>& interaction) {
    if (interaction->phys)
        return;
    if (!scene_checked_.exchange(true))
        check_scene();
    const auto& mat1 = static_cast<const GrainMat&>(*m1);
    const auto& mat2 = static_cast<const GrainMat&>(*m2);
    const auto& geom = static_cast<const GenericSpheresContact&>(*interaction->geom);
    const Body& body1 = *Body::byId(interaction->getId1(), scene);
    const Body& body2 = *Body::byId(interaction->getId2(), scene);

    const Real radius1 = contact_radius(body1, geom.refR1, mat1.density);
    const Real radius2 = contact_radius(body2, geom.refR2, mat2.density);
    const gl::ElasticMaterial elastic1{mat1.young, mat1.poisson};
    const gl::ElasticMaterial elastic2{mat2.young, mat2.poisson};
    const GrainPair* pair = explicit_pair(mat1, mat2);
    const Real restitution = pair_restitution(mat1, mat2, pair);
    const gl::ContactParameters parameters = gl::contact_parameters(
        gl::effective_modulus(elastic1, elastic2), gl::effective_shear_modulus(elastic1, elastic2),
        gl::effective_radius(radius1, radius2),
        gl::effective_mass(contact_mass(body1, scene), contact_mass(body2, scene)),
        gl::damping_ratio_from_restitution(restitution, dashpotAttraction));

    const Real moisture = std::max(mat1.gravimetricMoisture, mat2.gravimetricMoisture);
    const Real load_scale = gl::load_scale(radius1, mat1.referenceRadius, radius2, mat2.referenceRadius);
    const PairFriction friction(pair_friction(mat1, mat2, pair), moisture, load_scale);
    const shared_ptr<LiquidBridge> bridge =
        LiquidBridge::between({mat1, body1, radius1, contact_mass(body1, scene)},
                              {mat2, body2, radius2, contact_mass(body2, scene)}, std::sqrt(load_scale));

    shared_ptr<GrainPhys> phys;
    if (friction.curve || bridge) {
        const auto effects = shared_ptr<GrainEffectPhys>(new GrainEffectPhys);
        effects->moisture = moisture;
        effects->loadScale = load_scale;
        effects->set_friction(friction);
        effects->bridge = bridge;
        phys = effects;
    } else {
        phys = shared_ptr<GrainPhys>(new GrainPhys);
    }
    phys->normalCoefficient = parameters.normal_coefficient;
    phys->shearCoefficient = parameters.shear_coefficient;
    phys->normalDamping = parameters.normal_damping;
    phys->shearDamping = parameters.shear_damping;
    phys->tangensOfFrictionAngle = friction.constant;

    const DashpotForm dashpot = restitution == 1    ? DashpotForm::none
                                : dashpotAttraction ? DashpotForm::attractive
                                                    : DashpotForm::repulsive;
    if (bridge)
        warn_beyond_pendular(*bridge, mat1, mat2);
    const BridgeKind kind = bridge ? bridge->kind() : BridgeKind::none;
    phys->contactClass = ContactClass(friction.form, dashpot, kind).index;
    interaction->phys = phys;
}

} // namespace yade
