// SPDX-License-Identifier: GPL-2.0-or-later
#include <laws/yade/effects.hpp>

#include <laws/yade/ContactClass.hpp>
#include <laws/yade/GrainMat.hpp>
#include <laws/yade/GrainEffectPhys.hpp>
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

bool has_film(BridgeKind kind) {
    return kind == BridgeKind::willett_viscous || kind == BridgeKind::willett_closed_viscous;
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

using Counts = std::array<int, ContactClass::count>;

/// Contacts of this moment by class; `visit` sees each of them.
template <class Visit>
Counts count_contacts(const Scene& scene, const Visit& visit) {
    Counts counts{};
    for (const auto& interaction : *scene.interactions) {
        if (!interaction->isReal())
            continue;
        if (const auto* phys = dynamic_cast<const GrainPhys*>(interaction->phys.get())) {
            ++counts[static_cast<std::size_t>(phys->contactClass)];
            visit(*phys);
        }
    }
    return counts;
}

std::string contacts_now(int contacts) {
    return std::to_string(contacts) + " contacts now";
}

/// What the contacts of this moment run, which includes curves of explicit pairs and combinations.
void add_contacts(EffectList& list, const Scene& scene, bool frictional) {
    int moist = 0, scaled = 0;
    const Counts counts = count_contacts(scene, [&](const GrainPhys& phys) {
        const GrainEffectPhys* carried = phys.effects();
        if (!carried)
            return;
        const shared_ptr<FrictionCurve>& curve = carried->friction;
        moist += curve && carried->moisture > 0 && curve->depends_on_moisture();
        scaled += carried->loadScale != 1 && ((frictional && curve) || carried->bridge);
    });
    for (int index = 0; index < ContactClass::count; ++index) {
        const int contacts = counts[static_cast<std::size_t>(index)];
        if (contacts == 0)
            continue;
        const ContactClass kind(index);
        if (frictional)
            list.add(name_of(kind.friction()), contacts_now(contacts));
        if (kind.dashpot() != DashpotForm::none)
            list.add("viscous damping", contacts_now(contacts));
        if (kind.bridge() != BridgeKind::none)
            list.add(name_of(kind.bridge()), contacts_now(contacts));
        if (has_film(kind.bridge()))
            list.add("viscous film in bridges", contacts_now(contacts));
    }
    if (frictional && moist > 0)
        list.add("moisture in friction", contacts_now(moist));
    if (scaled > 0)
        list.add("load scaling", contacts_now(scaled));
}

std::string kernel_name(const Law2_ScGeom_GrainPhys_HertzMindlin& law, ContactClass kind, bool booking) {
    std::string name = "normal " + law.normalLaw;
    if (law.tangentialLaw != "none")
        name += "; tangential " + law.tangentialLaw + "; " + name_of(kind.friction());
    if (kind.dashpot() != DashpotForm::none)
        name += kind.dashpot() == DashpotForm::attractive ? "; attractive dashpot" : "; dashpot";
    if (kind.bridge() != BridgeKind::none)
        name += std::string("; ") + name_of(kind.bridge());
    if (has_film(kind.bridge()))
        name += " with viscous film";
    return booking ? name + "; energy booking" : name;
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

boost::python::dict describe_kernels(const Law2_ScGeom_GrainPhys_HertzMindlin& law, const Scene& scene) {
    const Counts counts = count_contacts(scene, [](const GrainPhys&) {});
    boost::python::dict kernels;
    for (int index = 0; index < ContactClass::count; ++index) {
        const int contacts = counts[static_cast<std::size_t>(index)];
        if (contacts == 0)
            continue;
        // Without a tangential force one kernel serves all curves.
        const std::string name = kernel_name(law, ContactClass(index), scene.trackEnergy);
        kernels[name] = contacts + boost::python::extract<int>(kernels.get(name, 0))();
    }
    return kernels;
}

} // namespace yade
