// SPDX-License-Identifier: GPL-2.0-or-later
// Forces and displacement of a quasi-static wall, by the contacts' own laws.
#include <femlink/yade/FemWall.hpp>

#include <laws/yade/GrainEffectPhys.hpp>
#include <laws/yade/Law2_ScGeom_GrainPhys_HertzMindlin.hpp>

#include <core/Scene.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace yade {

namespace fl = grainfall::femlink;

namespace {

/// Elastic shear force of the last step, turned into the contact plane of this one.
Vector3r turned_into_plane(const Vector3r& force, const Vector3r& normal) {
    const Vector3r inside = force - normal.dot(force) * normal;
    const Real length = inside.norm();
    return length > 0 ? Vector3r(inside * (force.norm() / length)) : Vector3r::Zero();
}

} // namespace

/// Before the forces of the last step are overwritten.
void FemWall::compare_with_law() {
    if (coupling != "implicit" || continuum)
        return;
    Real largest = 0, difference = 0;
    for (size_t i = 0; i < touches_.size(); ++i) {
        if (touches_[i].is_empty() || !partners_[i].contact || !partners_[i].contact->isReal())
            continue;
        const auto* phys = dynamic_cast<const FrictPhys*>(partners_[i].contact->phys.get());
        if (!phys)
            continue;
        const Vector3r law = phys->normalForce + phys->shearForce;
        largest = std::max(largest, law.norm());
        difference = std::max(difference, (law - touches_[i].site.axes * touches_[i].force).norm());
    }
    disagreement = largest > 0 ? difference / largest : 0;
}

/// `steps`: in which the wall goes where the solution puts it, which the dashpots must know.
fl::LawContact FemWall::law_contact(size_t place, int steps) const {
    fl::LawContact out;
    const fl::WallTouch& touch = touches_[place];
    if (touch.is_empty())
        return out;
    const Partner& partner = partners_[place];
    const Matrix3r& axes = touch.site.axes;
    const Vector3r normal = axes.col(0);
    const State& state = *partner.sphere->state;
    const Vector3r moved =
        scene->dt * (state.vel - velocity - (radius_of(place) * state.angVel).cross(normal));
    const Vector3r shift_seen = -moved - touch.seen_before;
    out.free_overlap = touch.free_overlap;
    out.shift = {shift_seen.dot(axes.col(1)), shift_seen.dot(axes.col(2))};
    const Real span = steps * scene->dt;
    out.relation.rate = 1 / span;
    out.relation.idle_overlap =
        touch.free_overlap + touch.seen_before.dot(normal) + span * (state.vel - velocity).dot(normal);
    Vector3r shear = Vector3r::Zero();
    const IPhys* physics = (partner.contact->isReal() ? partner.contact : partner.trial)->phys.get();
    if (const auto* grain = dynamic_cast<const GrainPhys*>(physics)) {
        const bool report = law_ && law_->normalLaw == "report";
        const bool shears = !law_ || law_->tangentialLaw != "none";
        out.relation.coefficient = (report ? 0.5 : 1) * grain->normalCoefficient;
        out.relation.damping = (report ? std::sqrt(0.5) : 1) * grain->normalDamping;
        out.relation.attracts = ContactClass(grain->contactClass).dashpot() == DashpotForm::attractive;
        out.shear_coefficient = shears ? grain->shearCoefficient : 0;
        out.shear_damping = shears ? grain->shearDamping : 0;
        out.loses_on_unloading = !law_ || law_->tangentialLaw != "report";
        out.stiffness_before = grain->ks;
        shear = grain->shearElastic;
        if (ContactClass(grain->contactClass).friction() == FrictionForm::constant)
            out.friction = grain->tangensOfFrictionAngle;
        else
            out.curve = &grain->effects()->curve();
    } else if (const auto* spring = dynamic_cast<const FrictPhys*>(physics)) {
        out.relation.linear = true;
        out.relation.coefficient = spring->kn;
        out.shear_coefficient = spring->ks;
        out.friction = spring->tangensOfFrictionAngle;
        shear = spring->shearForce;
    } else {
        throw std::runtime_error("FemWall: a contact on it is a " + physics->getClassName() +
                                 ": must be a FrictPhys, whose stiffness is known");
    }
    shear = turned_into_plane(shear, normal);
    out.shear_before = {shear.dot(axes.col(1)), shear.dot(axes.col(2))};
    return out;
}

/// All contacts together, or, between two such solutions, each alone.
void FemWall::solve(bool together) {
    if (continuum) {
        see_continuum();
        return;
    }
    const bool in_between = coupling == "implicit" && interval > 1;
    const vector<fl::WallTouch> before = together && in_between ? touches_ : vector<fl::WallTouch>();
    vector<fl::LawContact> laws;
    laws.reserve(touches_.size());
    for (size_t i = 0; i < touches_.size(); ++i)
        laws.push_back(law_contact(i, together && in_between ? interval : 1));
    const fl::SolverOptions options{tolerance, maxSweeps};
    if (together) {
        if (coupling == "implicit")
            solve_together(laws, options);
        else
            exchange(laws);
        solvedStep = scene->iter;
        see_surface();
    }
    force = Vector3r::Zero();
    storedEnergy = 0;
    for (size_t i = 0; i < touches_.size(); ++i) {
        fl::WallTouch& touch = touches_[i];
        if (touch.is_empty())
            continue;
        if (together && in_between)
            wall_->approach(touch, before[i], interval);
        else if (together)
            wall_->arrive(touch);
        if (coupling == "implicit")
            wall_->solve_alone(touch, together && in_between ? law_contact(i) : laws[i], options);
        const Vector3r push = touch.site.axes * touch.whole_force();
        partners_[i].velocity = (touch.seen - touch.seen_before) / scene->dt;
        force -= push;
        storedEnergy -= 0.5 * push.dot(touch.seen);
    }
}

void FemWall::solve_together(const vector<fl::LawContact>& laws, const fl::SolverOptions& options) {
    const fl::SolverReport report = wall_->solve(touches_, laws, options);
    sweeps = report.sweeps;
    lastChange = report.change;
    if (report.converged)
        return;
    if (unfinishedSteps++ == 0)
        LOG_WARN("FemWall: in step " << scene->iter << " forces still change by " << report.change
                                     << " of the largest after maxSweeps = " << maxSweeps
                                     << " sweeps; later steps go on from there (see unfinishedSteps)");
    constexpr Real too_much = 0.2;
    if (!(report.change < too_much))
        throw std::runtime_error("FemWall: in step " + std::to_string(scene->iter) +
                                 " forces still change by " + std::to_string(report.change) +
                                 " of the largest after maxSweeps = " + std::to_string(maxSweeps) +
                                 " sweeps: raise maxSweeps");
}

/// The report's exchange: the law's forces of the last step displace the wall of this one.
void FemWall::exchange(const vector<fl::LawContact>& laws) {
    read_law_forces();
    const Real gain = wall_->exchange(touches_, laws);
    if (gain >= 1)
        grainfall::laws::reject(
            "FemWall.coupling", "'staggered'",
            "'implicit' here: the contacts' stiffness times the wall's compliance is " +
                std::to_string(gain) +
                ", and exchanging forces step by step diverges from 1 on, whatever the time step");
}

/// Those of the last step: a bridge's attraction changes little in one. Its film's force follows the velocity
/// at once; that is not passed on to the wall.
void FemWall::read_pulls() {
    for (size_t i = 0; has_bridges_ && i < touches_.size(); ++i) {
        const shared_ptr<Interaction>& contact = partners_[i].contact;
        const auto* phys = contact ? dynamic_cast<const GrainPhys*>(contact->phys.get()) : nullptr;
        const LiquidBridge* bridge = phys ? bridge_of(*phys) : nullptr;
        touches_[i].pull = bridge && bridge->formed ? bridge->attraction : 0;
    }
}

/// Those of the last step into the touches.
void FemWall::read_law_forces() {
    for (size_t i = 0; i < touches_.size(); ++i) {
        if (touches_[i].is_empty())
            continue;
        const shared_ptr<Interaction>& contact = partners_[i].contact;
        const auto* phys = contact ? dynamic_cast<const FrictPhys*>(contact->phys.get()) : nullptr;
        touches_[i].force = Vector3r::Zero();
        if (phys)
            touches_[i].force = touches_[i].site.axes.transpose() * (phys->normalForce + phys->shearForce);
    }
}

} // namespace yade
