// SPDX-License-Identifier: GPL-2.0-or-later
// A wall whose continuum has inertia, step by step.
#include <femlink/yade/FemWall.hpp>

#include <femlink/explicit/explicit_continuum.hpp>

#include <core/Scene.hpp>
#include <pkg/dem/FrictPhys.hpp>

#include <algorithm>
#include <cmath>

namespace yade {

namespace fl = grainfall::femlink;

/// Moves on to the present time. In every `interval`-th step under the mean of the forces since the last; the
/// surface goes there evenly in between.
void FemWall::move_continuum() {
    read_pulls();
    read_law_forces();
    const fl::Positions loads = wall_->loads_on_nodes(touches_);
    load_sum_ += loads;
    ++loadsSummed;
    fl::ExplicitContinuum& body = continuum->continuum();
    if (glideStep == 0) {
        glide_start_ = wall_->displacement();
        fl::Positions load = load_sum_ / loadsSummed;
        for (size_t i = 0; i < startForces.size(); ++i)
            load.col(static_cast<Eigen::Index>(i)) -= startForces[i];
        body.advance(interval * scene->dt, load);
        if (scene->trackEnergy) {
            const fl::ExplicitEnergies energies = body.energies();
            storedEnergy = energies.kinetic + energies.elastic + energies.hourglass + energies.ground;
            // What the forces that it came to rest under have done to it, which its own books do not hold.
            for (size_t i = 0; i < startForces.size(); ++i)
                storedEnergy +=
                    startForces[i].dot(body.surface_displacement().col(static_cast<Eigen::Index>(i)));
            dissipatedEnergy = energies.plastic + energies.absorbed;
        }
        load_sum_.setZero();
        loadsSummed = 0;
    }
    ++glideStep;
    const Real share = static_cast<Real>(glideStep) / interval;
    wall_->put(glide_start_ + share * (body.surface_displacement() - glide_start_), loads);
    if (glideStep >= interval)
        glideStep = 0;
}

/// A contact of stiffness k on a patch of mass m = 1/sum(w^2/m_node) swings with k/m at most.
ExchangeLimit FemWall::exchange_limit() const {
    ExchangeLimit least;
    if (!continuum)
        return least;
    for (size_t i = 0; i < touches_.size(); ++i) {
        const fl::ContactPatch& loaded = touches_[i].site.patch;
        const shared_ptr<Interaction>& touching = partners_[i].contact;
        const auto* phys = touching ? dynamic_cast<const FrictPhys*>(touching->phys.get()) : nullptr;
        if (touches_[i].is_empty() || !phys || !(phys->kn > 0))
            continue;
        Real inverse_mass = 0;
        for (size_t a = 0; a < loaded.nodes.size(); ++a)
            inverse_mass +=
                loaded.weights[a] * loaded.weights[a] / continuum->continuum().surface_mass(loaded.nodes[a]);
        const Real step = 2 / std::sqrt(phys->kn * inverse_mass) / interval;
        if (step < least.step)
            least = {step, {partners_[i].face->id, partners_[i].sphere->id}};
    }
    return least;
}

/// Contacts on the surface as it now lies; the law's forces of this step move it in the next.
void FemWall::see_continuum() {
    force = Vector3r::Zero();
    for (size_t i = 0; i < touches_.size(); ++i) {
        fl::WallTouch& touch = touches_[i];
        if (touch.is_empty())
            continue;
        touch.seen = wall_->seen(touch.site);
        partners_[i].velocity = (touch.seen - touch.seen_before) / scene->dt;
        force -= touch.site.axes * touch.whole_force();
    }
    solvedStep = scene->iter;
    see_surface();
}

} // namespace yade
