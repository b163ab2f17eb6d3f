// SPDX-License-Identifier: GPL-2.0-or-later
#include <laws/yade/Law2_ScGeom_GrainPhys_HertzMindlin.hpp>

#include <laws/yade/contact_kernels.hpp>
#include <laws/yade/effects.hpp>
#include <laws/yade/stored_energy.hpp>
#include <laws/yade/tangential_choice.hpp>
#include <laws/yade/water_budget.hpp>

#include <core/EnergyTracker.hpp>
#include <core/Omega.hpp>

#include <algorithm>
#include <vector>

namespace yade {

YADE_PLUGIN((Law2_ScGeom_GrainPhys_HertzMindlin));
CREATE_LOGGER(Law2_ScGeom_GrainPhys_HertzMindlin);

namespace {
// All laws alive in the order in which they were made, so that whoever makes contacts finds the one that will
// serve them.
std::mutex laws_mutex;
std::vector<const Law2_ScGeom_GrainPhys_HertzMindlin*> laws;
} // namespace

Law2_ScGeom_GrainPhys_HertzMindlin::~Law2_ScGeom_GrainPhys_HertzMindlin() {
    const std::lock_guard<std::mutex> lock(laws_mutex);
    laws.erase(std::remove(laws.begin(), laws.end(), this), laws.end());
}

const Law2_ScGeom_GrainPhys_HertzMindlin* Law2_ScGeom_GrainPhys_HertzMindlin::acting_in(const Scene& where) {
    const std::lock_guard<std::mutex> lock(laws_mutex);
    // The youngest: a law left over from an earlier scene may point to where this one stands now.
    const auto found =
        std::find_if(laws.rbegin(), laws.rend(), [&where](const auto* law) { return law->scene == &where; });
    return found == laws.rend() ? nullptr : *found;
}

bool Law2_ScGeom_GrainPhys_HertzMindlin::go(shared_ptr<IGeom>& geometry, shared_ptr<IPhys>& physics,
                                            Interaction* interaction) {
    const auto& phys = static_cast<const GrainPhys&>(*physics);
    return kernel_of(phys.contactClass, scene->trackEnergy)(*this, geometry, physics, interaction);
}

void Law2_ScGeom_GrainPhys_HertzMindlin::validate() const {
    using grainfall::laws::reject;
    if (normalLaw != "hertz" && normalLaw != "report")
        reject("Law2_ScGeom_GrainPhys_HertzMindlin.normalLaw", "'" + normalLaw + "'", "'hertz' or 'report'");
    if (tangentialLaw != "incremental" && tangentialLaw != "mindlin-deresiewicz" &&
        tangentialLaw != "report" && tangentialLaw != "secant" && tangentialLaw != "none")
        reject("Law2_ScGeom_GrainPhys_HertzMindlin.tangentialLaw", "'" + tangentialLaw + "'",
               "'incremental', 'mindlin-deresiewicz', 'report', 'secant' or 'none'");
}

void Law2_ScGeom_GrainPhys_HertzMindlin::postLoad(Law2_ScGeom_GrainPhys_HertzMindlin&) {
    validate();
    choose_kernels();
}

void Law2_ScGeom_GrainPhys_HertzMindlin::choose_kernels() {
    const KernelTables& tables = by_tangential_law(tangentialLaw, &incremental_kernels, &partial_slip_kernels,
                                                   &secant_kernels, &report_kernels, &frictionless_kernels)();
    const KernelTables::Pair& pair = normalLaw == "report" ? tables.report : tables.hertz;
    kernels_ = {&pair.plain, &pair.booking};
    const std::lock_guard<std::mutex> lock(laws_mutex);
    if (std::find(laws.begin(), laws.end(), this) == laws.end())
        laws.push_back(this);
}

void Law2_ScGeom_GrainPhys_HertzMindlin::name_energies() {
    // All names first and by one thread: adding a name may move the accumulators under another thread's
    // feet.
    const std::lock_guard<std::mutex> lock(energy_mutex_);
    EnergyTracker& energy = *scene->energy;
    energy.findId("grainFriction", frictionIx, false, true);
    energy.findId("grainViscous", viscousIx, false, true);
    energy.findId("grainRescaling", rescalingIx, false, true);
    energy.findId("grainBridge", bridgeIx, false, true);
    energy.findId("grainShearKinematics", kinematicsIx, false, true);
    energy_named_.store(true, std::memory_order_release);
}

void Law2_ScGeom_GrainPhys_HertzMindlin::book_bridge(Real work) {
    if (!energy_named_.load(std::memory_order_acquire))
        name_energies();
    scene->energy->add(work, "grainBridge", bridgeIx, false);
}

void Law2_ScGeom_GrainPhys_HertzMindlin::book(Real friction, Real viscous, Real rescaling, Real kinematics) {
    EnergyTracker& energy = *scene->energy;
    if (!energy_named_.load(std::memory_order_acquire))
        name_energies();
    if (friction != 0)
        energy.add(friction, "grainFriction", frictionIx, false);
    if (viscous != 0)
        energy.add(viscous, "grainViscous", viscousIx, false);
    if (rescaling != 0)
        energy.add(rescaling, "grainRescaling", rescalingIx, false);
    if (kinematics != 0)
        energy.add(kinematics, "grainShearKinematics", kinematicsIx, false);
}

boost::python::dict Law2_ScGeom_GrainPhys_HertzMindlin::elastic_energy() const {
    const StoredEnergy stored = stored_energy(*Omega::instance().getScene());
    boost::python::dict energies;
    energies["normal"] = stored.normal;
    energies["shear"] = stored.shear;
    energies["bridge"] = stored.bridge;
    return energies;
}

boost::python::dict Law2_ScGeom_GrainPhys_HertzMindlin::water() const {
    return water_budget(*Omega::instance().getScene());
}

boost::python::dict Law2_ScGeom_GrainPhys_HertzMindlin::effects() const {
    return describe_effects(*this, *Omega::instance().getScene());
}

boost::python::dict Law2_ScGeom_GrainPhys_HertzMindlin::kernels_in_use() const {
    return describe_kernels(*this, *Omega::instance().getScene());
}

} // namespace yade
