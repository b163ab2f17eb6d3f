// SPDX-License-Identifier: GPL-2.0-or-later
#include <laws/yade/idle_effects.hpp>

#include <laws/bridge/geometry.hpp>
#include <laws/yade/GrainMat.hpp>
#include <laws/yade/Ip2_GrainMat_GrainMat_GrainPhys.hpp>
#include <laws/yade/Law2_ScGeom_GrainPhys_HertzMindlin.hpp>

#include <core/Scene.hpp>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace yade {

namespace {

using Sentences = std::vector<std::string>;

/// A friction curve of the scene and who bears it.
struct NamedCurve {
    std::string owner;
    const FrictionCurve* curve;
};

/// The parts of a scene that say which effects can act.
struct Asked {
    std::vector<const GrainMat*> materials;
    std::vector<const GrainPair*> pairs;
    std::vector<NamedCurve> curves; // those that were given, not tan(frictionAngle)
    bool wet = false;
    bool bridges = false;
};

std::string name_of(const GrainMat& material) {
    return material.label.empty() ? "material " + std::to_string(material.id) : material.label;
}

Asked what_is_asked(const Scene& scene, const Ip2_GrainMat_GrainMat_GrainPhys& maker) {
    Asked asked;
    for (const auto& material : scene.materials) {
        const auto* grain = dynamic_cast<const GrainMat*>(material.get());
        if (!grain)
            continue;
        asked.materials.push_back(grain);
        asked.wet = asked.wet || grain->gravimetricMoisture > 0;
        asked.bridges = asked.bridges || grain->has_bridges();
        if (grain->friction)
            asked.curves.push_back({name_of(*grain), grain->friction.get()});
    }
    for (const auto& entry : maker.pairs) {
        const auto& pair = static_cast<const GrainPair&>(*entry);
        asked.pairs.push_back(&pair);
        if (pair.friction)
            asked.curves.push_back({pair.first + "-" + pair.second, pair.friction.get()});
    }
    return asked;
}

bool is_zero(const FrictionCurve& curve, Real moisture) {
    const auto resolved = curve.resolve(moisture, 1);
    return form_of(*resolved) == FrictionForm::constant && resolved->coefficient(1) == 0;
}

/// Who bears a curve of this kind, separated by commas.
template <class Kind>
std::string owners_of(const Asked& asked, const Kind& kind) {
    std::string owners;
    for (const NamedCurve& named : asked.curves)
        if (kind(*named.curve))
            owners += (owners.empty() ? "" : ", ") + named.owner;
    return owners;
}

void check_moisture(const Asked& asked, Sentences& sentences) {
    const bool read = std::any_of(asked.curves.begin(), asked.curves.end(),
                                  [](const NamedCurve& c) { return c.curve->depends_on_moisture(); });
    if (!asked.wet) {
        const std::string owners =
            owners_of(asked, [](const FrictionCurve& curve) { return curve.depends_on_moisture(); });
        if (!owners.empty())
            sentences.push_back(owners + ": friction depends on moisture, but the scene has no water");
    } else if (!read && !asked.bridges) {
        for (const GrainMat* m : asked.materials)
            if (m->gravimetricMoisture > 0)
                sentences.push_back(name_of(*m) + ": gravimetricMoisture has no effect: there are no bridges "
                                                  "and no friction depends on moisture");
    }
}

void check_bridges(const Asked& asked, Sentences& sentences) {
    namespace gb = grainfall::laws::bridge;
    for (const GrainMat* m : asked.materials) {
        const std::string name = name_of(*m);
        if (m->bridgeModel == "none" && m->bridgeVolume > 0)
            sentences.push_back(name + ": bridgeVolume has no effect with bridgeModel 'none'");
        if (m->liquidViscosity > 0 && !asked.bridges)
            sentences.push_back(name + ": liquidViscosity has no effect: the scene has no liquid bridges");
        if (m->relative_bridge_volume() > gb::largest_pendular_volume) {
            std::ostringstream text;
            text << std::setprecision(3) << name << ": bridges hold " << m->relative_bridge_volume()
                 << " R^3; above " << gb::largest_pendular_volume
                 << " R^3 those of neighbouring contacts merge, so that separate (pendular) bridges are an "
                    "approximation";
            sentences.push_back(text.str());
        }
    }
}

void check_load_scaling(const Asked& asked, Sentences& sentences) {
    const auto on_load = [](const FrictionCurve* curve) { return curve && curve->depends_on_load(); };
    for (const GrainMat* m : asked.materials) {
        if (!(m->referenceRadius > 0) || m->has_bridges() || on_load(m->friction.get()))
            continue;
        const bool by_pair = std::any_of(asked.pairs.begin(), asked.pairs.end(), [&](const GrainPair* pair) {
            return (pair->first == m->label || pair->second == m->label) && on_load(pair->friction.get());
        });
        if (!by_pair)
            sentences.push_back(name_of(*m) + ": referenceRadius has no effect on constant friction");
    }
}

void check_damping(const Asked& asked, bool attraction, Sentences& sentences) {
    const bool damped = std::any_of(asked.materials.begin(), asked.materials.end(),
                                    [](const GrainMat* m) { return m->restitution < 1; }) ||
                        std::any_of(asked.pairs.begin(), asked.pairs.end(),
                                    [](const GrainPair* pair) { return pair->restitution < 1; });
    if (attraction && !damped)
        sentences.push_back("Ip2_GrainMat_GrainMat_GrainPhys.dashpotAttraction has no effect: no restitution "
                            "is below 1, so that there is no dashpot");
}

void check_friction(const Asked& asked, const std::string& tangential_law, Sentences& sentences) {
    if (tangential_law == "none") {
        const std::string owners =
            owners_of(asked, [](const FrictionCurve& curve) { return !is_zero(curve, 0); });
        if (!owners.empty())
            sentences.push_back(owners + ": friction has no effect with tangentialLaw 'none'");
        return;
    }
    if (tangential_law == "incremental" || asked.materials.empty())
        return; // the default: nobody asked for it
    const bool frictionless = std::all_of(asked.materials.begin(), asked.materials.end(),
                                          [](const GrainMat* m) {
                                              return is_zero(*m->friction_curve(), m->gravimetricMoisture);
                                          }) &&
                              std::all_of(asked.pairs.begin(), asked.pairs.end(), [](const GrainPair* pair) {
                                  return !pair->friction || is_zero(*pair->friction, 0);
                              });
    if (frictionless)
        sentences.push_back("tangentialLaw '" + tangential_law +
                            "' has no effect: friction is 0 everywhere; 'none' costs less");
}

} // namespace

std::vector<std::string> idle_effects(const Scene& scene, const Ip2_GrainMat_GrainMat_GrainPhys& maker,
                                      const Law2_ScGeom_GrainPhys_HertzMindlin* law) {
    const Asked asked = what_is_asked(scene, maker);
    Sentences sentences;
    check_moisture(asked, sentences);
    check_load_scaling(asked, sentences);
    check_bridges(asked, sentences);
    check_damping(asked, maker.dashpotAttraction, sentences);
    if (law)
        check_friction(asked, law->tangentialLaw, sentences);
    return sentences;
}

} // namespace yade
