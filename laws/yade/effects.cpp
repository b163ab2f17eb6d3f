// SPDX-License-Identifier: GPL-2.0-or-later
#include <laws/yade/effects.hpp>

#include <laws/yade/ContactClass.hpp>
#include <laws/yade/GrainMat.hpp>
#include <laws/yade/GrainPhys.hpp>
#include <laws/yade/Law2_ScGeom_GrainPhys_HertzMindlin.hpp>

#include <core/Interaction.hpp>
#include <core/InteractionContainer.hpp>
#include <core/Scene.hpp>

#include <array>
#include <cmath>
#include <sstream>

namespace yade {

namespace {

std::string number(Real value) {
    std::ostringstream text;
    text << value;
    return text.str();
}

const char* name_of(FrictionForm form) {
    switch (form) {
    case FrictionForm::constant:
        return "friction: constant";
    case FrictionForm::power_law:
        return "friction: power law of the load";
    case FrictionForm::exponential:
        return "friction: exponential in the load";
    case FrictionForm::asperity:
        return "friction: asperity";
    case FrictionForm::table:
        return "friction: table of load and moisture";
    case FrictionForm::combined:
        return "friction: combined curves";
    }
    return "friction";
}

const char* name_of(BridgeKind kind) {
    const bool closed = kind == BridgeKind::willett_closed || kind == BridgeKind::willett_closed_viscous;
    return closed ? "liquid bridges: willett-closed" : "liquid bridges: willett";
}

/// Collects effects; several materials that ask for one effect share its line.
class EffectList {
public:
    void add(const std::string& effect, const std::string& reason) {
        if (!effects_.has_key(effect))
            effects_[effect] = reason;
        else
            effects_[effect] += "; " + reason;
    }
    boost::python::dict result() const { return effects_; }

private:
    boost::python::dict effects_;
};

void add_bridges(EffectList& list, const GrainMat& material, const std::string& name) {
    const std::string source = std::isnan(material.bridgeVolume)
                                   ? "gravimetricMoisture " + number(material.gravimetricMoisture)
                                   : "bridgeVolume " + number(material.bridgeVolume) + " m3";
    list.add("liquid bridges: " + material.bridgeModel, name + ": " + source);
    if (material.liquidViscosity > 0)
        list.add("viscous film in bridges",
                 name + ": liquidViscosity " + number(material.liquidViscosity) + " Pa s");
}

void add_material(EffectList& list, const GrainMat& material, const std::string& name, bool frictional) {
    const auto curve = material.friction_curve();
    if (material.restitution < 1)
        list.add("viscous damping", name + ": restitution " + number(material.restitution));
    if (material.has_bridges())
        add_bridges(list, material, name);
    if (!frictional)
        return;
    list.add(name_of(form_of(curve->at_moisture(material.gravimetricMoisture))), name);
    if (material.gravimetricMoisture > 0 && curve->depends_on_moisture())
        list.add("moisture in friction",
                 name + ": gravimetricMoisture " + number(material.gravimetricMoisture));
    if (material.referenceRadius > 0 && (curve->depends_on_load() || material.has_bridges()))
        list.add("load scaling", name + ": referenceRadius " + number(material.referenceRadius) + " m");
}

/// What the contacts of this moment run, which includes curves of explicit pairs and combinations.
void add_contacts(EffectList& list, const Scene& scene, bool frictional) {
    std::array<int, ContactClass::count> counts{};
    for (const auto& interaction : *scene.interactions) {
        if (!interaction->isReal())
            continue;
        if (const auto* phys = dynamic_cast<const GrainPhys*>(interaction->phys.get()))
            ++counts[static_cast<std::size_t>(phys->contactClass)];
    }
    for (int index = 0; index < ContactClass::count; ++index) {
        const int contacts = counts[static_cast<std::size_t>(index)];
        if (contacts == 0)
            continue;
        const std::string reason = std::to_string(contacts) + " contacts now";
        const ContactClass kind(index);
        if (frictional)
            list.add(name_of(kind.friction()), reason);
        if (kind.dashpot() != DashpotForm::none)
            list.add("viscous damping", reason);
        if (kind.bridge() != BridgeKind::none)
            list.add(name_of(kind.bridge()), reason);
    }
}

} // namespace

boost::python::dict describe_effects(const Law2_ScGeom_GrainPhys_HertzMindlin& law, const Scene& scene) {
    EffectList list;
    list.add("normal force: " + law.normalLaw, "normalLaw");
    const bool frictional = law.tangentialLaw != "none";
    if (frictional)
        list.add("tangential force: " + law.tangentialLaw, "tangentialLaw");
    for (const auto& material : scene.materials) {
        const auto* grain = dynamic_cast<const GrainMat*>(material.get());
        if (!grain)
            continue;
        const std::string name =
            grain->label.empty() ? "material " + std::to_string(grain->id) : grain->label;
        add_material(list, *grain, name, frictional);
    }
    add_contacts(list, scene, frictional);
    if (scene.trackEnergy)
        list.add("energy booking", "O.trackEnergy");
    return list.result();
}

} // namespace yade
