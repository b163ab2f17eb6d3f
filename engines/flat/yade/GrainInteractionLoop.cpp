// SPDX-License-Identifier: GPL-2.0-or-later
#include <engines/flat/yade/GrainInteractionLoop.hpp>

#include <engines/flat/yade/GrainIntegrator.hpp>
#include <femlink/yade/scene_walls.hpp>
#include <laws/yade/Law2_ScGeom_GrainPhys_HertzMindlin.hpp>
#include <laws/yade/tangential_choice.hpp>

#include <core/InteractionContainer.hpp>
#include <core/Omega.hpp>
#include <pkg/common/PeriodicEngines.hpp>

#include <omp.h>

namespace yade {

YADE_PLUGIN((GrainInteractionLoop));
CREATE_LOGGER(GrainInteractionLoop);

GrainInteractionLoop::~GrainInteractionLoop() = default;

namespace {

/// s between two looks at a run in the background, as a viewer's.
constexpr Real viewer_period = 0.5;

} // namespace

void GrainInteractionLoop::validate() const {
    grainfall::laws::require_positive("GrainInteractionLoop.skin", skin);
    grainfall::laws::require_not_negative("GrainInteractionLoop.horizon", horizon);
}

shared_ptr<Engine> GrainInteractionLoop::find_engine(const char* class_name) const {
    for (const auto& engine : scene->engines)
        if (engine->getClassName() == class_name)
            return engine;
    return {};
}

void GrainInteractionLoop::action() {
    run_thread_.store(std::this_thread::get_id());
    if (stop_requested_.exchange(false))
        scene->stopAtIter = scene->iter + 1;
    take_the_time();
    // From the flat path another one is taken only when all stands with YADE again.
    if (changed_ == Changed::anything || (flat != wanted_flat_ && !flat_step_) ||
        scene->bodies->body.size() != body_count_) {
        flat_step_ = can_run_flat();
        wanted_flat_ = flat;
        if (flat_step_)
            grains_->take_over(*scene, threads(), tables().slips);
        body_count_ = scene->bodies->body.size();
    } else if (flat_step_ && changed_ == Changed::states) {
        grains_->take_over_states();
    }
    if (!flat_step_) {
        // What stands in the way is not looked for anew in every step.
        changed_ = last_step(*scene) ? Changed::anything : Changed::nothing;
        prepare_walls(*scene);
        InteractionLoop::action();
        return;
    }
    grains_->functors.set_scene(scene);
    look_ = who_looks(*scene, *this, *engine_of<GrainIntegrator>(*scene), blindEngines, step_seconds_);
    const Real clock = PeriodicEngine::getClock();
    const bool shows = clock - last_shown_ > viewer_period;
    if (shows) {
        last_shown_ = clock;
        look_.after = true;
    }
    if (flat != wanted_flat_)
        look_.let_all_look();
    if (grains_->must_search())
        grains_->search(reach());
    grains_->contacts(*scene, tables(), look_.contacts);
    // Not their numbers: a step that writes them rounds differently, and the clock must not change a run.
    if (shows && !look_.contacts)
        grains_->list_contacts(*scene);
    if (look_.between && !grains_->states_are_published())
        grains_->publish_states();
}

void GrainInteractionLoop::step_done() {
    changed_ = look_.changes_after;
}

void GrainInteractionLoop::take_over_between() {
    if (scene->bodies->body.size() == body_count_ && scene->bodies->erasedBodies.empty()) {
        grains_->take_over_states();
        return;
    }
    throw std::runtime_error(
        "bodies were added or erased between GrainInteractionLoop and GrainIntegrator: do it "
        "before the loop or after the integrator, or set GrainInteractionLoop.flat = False");
}

bool GrainInteractionLoop::can_run_flat() {
    std::string reason;
    const auto* newton = engine_of<GrainIntegrator>(*scene);
    if (!flat)
        reason = "flat = False";
    else if (!newton || newton->dead)
        reason = "no GrainIntegrator in O.engines";
    else if (newton->densityScaling)
        reason = "GrainIntegrator.densityScaling";
    else if (newton->mask > 0)
        reason = "GrainIntegrator.mask";
    else if (!callbacks.empty())
        reason = "callbacks";
    if (reason.empty()) {
        if (!grains_)
            grains_ = std::make_unique<FlatGrains>();
        const auto self = boost::dynamic_pointer_cast<Engine>(shared_from_this());
        grains_->functors.read(self, find_engine("InsertionSortCollider"));
        reason = grains_->obstacle(*scene);
    }
    if (!reason.empty()) {
        leave_flat_path(reason);
        return false;
    }
    rest_collider(true);
    path_ = "flat";
    return true;
}

void GrainInteractionLoop::leave_flat_path(const std::string& reason) {
    const std::string now = "general: " + reason;
    if (path_ != now && flat)
        LOG_INFO(now);
    path_ = now;
    grains_.reset();
    rest_collider(false);
}

void GrainInteractionLoop::rest_collider(bool rest) {
    const shared_ptr<Engine> collider = find_engine("InsertionSortCollider");
    if (!collider || (!rest && !restsCollider))
        return;
    collider->dead = rest;
    restsCollider = rest;
    if (rest)
        return;
    // It stands before this loop and has not looked at the scene for long: begin anew, and in this step
    // already.
    scene->interactions->dirty = true;
    collider->scene = scene;
    if (collider->isActivated())
        collider->action();
}

FlatGrains::Reach GrainInteractionLoop::reach() const {
    return {skin * grains_->smallest_radius(), horizon * scene->dt};
}

const FlatTables::Pair& GrainInteractionLoop::tables() const {
    const Law2_ScGeom_GrainPhys_HertzMindlin& law = *grains_->functors.grain_law;
    const FlatTables& tables =
        by_tangential_law(law.tangentialLaw, &incremental_flat_kernels, &partial_slip_flat_kernels,
                          &secant_flat_kernels, &report_flat_kernels, &frictionless_flat_kernels)();
    return law.normalLaw == "report" ? tables.report : tables.hertz;
}

int GrainInteractionLoop::threads() const {
    const int most = omp_get_max_threads();
    return ompThreads > 0 ? std::min(ompThreads, most) : most;
}

void GrainInteractionLoop::take_the_time() {
    const Real clock = PeriodicEngine::getClock();
    step_seconds_ = last_clock_ > 0 ? std::min(clock - last_clock_, 1.0) : 0;
    last_clock_ = clock;
}

boost::python::dict GrainInteractionLoop::statistics() const {
    boost::python::dict result;
    if (!grains_)
        return result;
    const FlatGrains::Census& census = grains_->census;
    result["steps"] = census.steps;
    result["searches"] = census.searches;
    result["takeovers"] = census.takeovers;
    result["publications"] = census.publications;
    result["born"] = census.born;
    result["parted"] = census.parted;
    result["spheres"] = grains_->sphere_count();
    result["contacts"] = grains_->contact_count();
    result["near"] = grains_->near_count();
    result["general"] = grains_->general_count();
    return result;
}

FlatGrains* flat_grains(const Scene& scene) {
    auto* loop = engine_of<GrainInteractionLoop>(scene);
    return loop && !loop->dead ? loop->grains() : nullptr;
}

} // namespace yade
