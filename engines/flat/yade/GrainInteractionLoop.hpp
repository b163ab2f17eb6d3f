// SPDX-License-Identifier: GPL-2.0-or-later
// Drop-in for InteractionLoop: contacts of grains in packed arrays wherever the scene allows it.
#pragma once

#include <engines/flat/yade/FlatGrains.hpp>
#include <engines/flat/yade/lookers.hpp>

#include <atomic>
#include <memory>
#include <thread>

#include <core/InteractionLoop.hpp>

namespace yade {

class GrainInteractionLoop : public InteractionLoop {
public:
    virtual ~GrainInteractionLoop();

    void action() override;
    void validate() const;
    void postLoad(GrainInteractionLoop&) { validate(); }

    /// The arrays, while this step runs on the flat path.
    FlatGrains* grains() { return flat_step_ ? grains_.get() : nullptr; }
    const Look& look() const { return look_; }
    /// By the integrator, at the end of a step.
    void step_done();
    /// After Python or an engine may have changed everything between the loop and the integrator.
    void take_over_between();

    /// Ends the run at the next step that can publish, and waits for it; not from the run's own thread.
    void request_stop() { stop_requested_.store(true); }
    bool is_run_thread() const { return run_thread_.load() == std::this_thread::get_id(); }
    /// The next step sorts the grains as after loading, so that a file saved now continues to the last bit.
    void sort_anew() { changed_ = Changed::anything; }

    std::string path() const { return path_; }
    boost::python::dict statistics() const;

    // clang-format off
    YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(GrainInteractionLoop, InteractionLoop,
        "Drop-in for :yref:`InteractionLoop`, with the same three lists of functors; together with :yref:`GrainIntegrator` it runs the motion "
        "of spheres of :yref:`GrainMat` and their contacts with each other, with walls, boxes and solids of revolution in packed arrays (the flat path), with the "
        "same kernels. It finds neighbours itself: the collider in O.engines lends its bounding functors and rests (dead = True). Other pairs are computed by "
        "their own functors in the same step. State, forces and interactions are written whenever another engine or Python is about to look; engines "
        "that look at grains in every step make it slow. What cannot run flat (a periodic cell, another law, hundreds of clumps) runs as in "
        "InteractionLoop; :yref:`path<GrainInteractionLoop.path>` says why.",
        ((bool, flat, true, , "use the flat path where the scene allows it? False: as InteractionLoop."))
        ((Real, skin, 0.05, , "room that a search for neighbours leaves each grain, as part of the smallest grain's radius [-], > 0. Larger: fewer searches, more pairs to look at in each step."))
        ((Real, horizon, 60, , "steps for which a moving grain gets room besides [-], >= 0, at its present speed."))
        ((vector<string>, blindEngines, , , "labels of engines that look at no grain and no contact between grains, such as a PyRunner that shows the time or records the projectile: for them nothing is published."))
        ((bool, restsCollider, false, (Attr::hidden), "has the collider been put to rest by this loop?"))
        ,
        ,
        .def(CheckedAttributes<GrainInteractionLoop>()
            .add("skin", &GrainInteractionLoop::skin)
            .add("horizon", &GrainInteractionLoop::horizon))
        .add_property("path", &GrainInteractionLoop::path, "'flat', or 'general: ' and the reason, in the last step.")
        .def("statistics", &GrainInteractionLoop::statistics,
            "{'steps', 'searches' for neighbours, 'takeovers' of YADE's objects, 'publications' to them, 'born' and 'parted' contacts since "
            "the flat path began; 'spheres', 'contacts', 'near' (pairs without contact that are looked at), 'general' (pairs of other shapes) now}.")
        .def("requestStop", &GrainInteractionLoop::request_stop, "End a run in the background after its next step, with everything published. O.pause() does it.")
        .def("isRunThread", &GrainInteractionLoop::is_run_thread, "Is this called from within the run?")
        .def("sortAnew", &GrainInteractionLoop::sort_anew, "Let the next step sort the grains as after loading. O.save() does it.")
    );
    // clang-format on
    DECLARE_LOGGER;

private:
    std::unique_ptr<FlatGrains> grains_;
    std::string path_ = "not yet run";
    bool flat_step_ = false;
    bool wanted_flat_ = true; // `flat` when the path was chosen
    Changed changed_ = Changed::anything;
    size_t body_count_ = 0;
    Look look_;
    Real step_seconds_ = 0, last_clock_ = 0, last_shown_ = 0;
    std::atomic<bool> stop_requested_{false};
    std::atomic<std::thread::id> run_thread_{};

    shared_ptr<Engine> find_engine(const char* class_name) const;
    bool can_run_flat();
    void leave_flat_path(const std::string& reason);
    void rest_collider(bool rest);
    FlatGrains::Reach reach() const;
    const FlatTables::Pair& tables() const;
    int threads() const;
    void take_the_time();
};
REGISTER_SERIALIZABLE(GrainInteractionLoop);

/// The first engine of this class; null where there is none.
template <class Kind>
Kind* engine_of(const Scene& scene) {
    for (const auto& engine : scene.engines)
        if (auto* found = dynamic_cast<Kind*>(engine.get()))
            return found;
    return nullptr;
}

/// The packed grains of a scene in this step; null on the general path.
FlatGrains* flat_grains(const Scene& scene);

} // namespace yade
