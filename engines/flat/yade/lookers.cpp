// SPDX-License-Identifier: GPL-2.0-or-later
#include <engines/flat/yade/lookers.hpp>

#include <engines/energy/yade/EnergyLedger.hpp>
#include <engines/projectile/yade/ProjectileLoad.hpp>
#include <engines/time_step/yade/HertzTimeStepper.hpp>
#include <femlink/yade/scene_walls.hpp>

#include <core/Omega.hpp>
#include <pkg/common/PeriodicEngines.hpp>

#include <algorithm>

namespace yade {

namespace {

/// When an engine is asked: those before the loop act in the next step.
struct Moment {
    long step;
    Real time;
    Real clock; // s, the latest at which it may be asked
};

/// YADE's own rule, without its side effects.
bool is_due(const PeriodicEngine& engine, const Moment& moment) {
    if (engine.nDo >= 0 && engine.nDone >= engine.nDo && moment.step >= engine.iterLast)
        return false;
    if (engine.nDone == 0) // the first time follows other rules
        return engine.firstIterRun <= 0 || engine.firstIterRun == moment.step;
    return (engine.virtPeriod > 0 && moment.time - engine.virtLast >= engine.virtPeriod * (1 - 1e-9)) ||
           (engine.realPeriod > 0 && moment.clock - engine.realLast >= engine.realPeriod) ||
           (engine.iterPeriod > 0 && moment.step - engine.iterLast >= engine.iterPeriod);
}

bool is_idle(const Engine& engine, const vector<string>& blind) {
    if (engine.dead || dynamic_cast<const ProjectileLoad*>(&engine) || is_wall(engine))
        return true;
    const string name = engine.getClassName();
    return name == "ForceResetter" || name == "InsertionSortCollider" ||
           (!engine.label.empty() && std::find(blind.begin(), blind.end(), engine.label) != blind.end());
}

void add_look(Look& look, const Engine& engine, bool between, const Moment& moment) {
    Changed change = Changed::anything;
    if (const auto* ledger = dynamic_cast<const EnergyLedger*>(&engine)) {
        change = Changed::nothing;
        if (!ledger->needs_every_body(*engine.scene))
            return;
    } else if (const auto* stepper = dynamic_cast<const HertzTimeStepper*>(&engine)) {
        if (!stepper->is_due(moment.step))
            return;
        change = stepper->correctVelocity ? Changed::states : Changed::nothing;
        look.after = true; // a ledger counts every body when the step changes
    } else if (const auto* periodic = dynamic_cast<const PeriodicEngine*>(&engine)) {
        if (!is_due(*periodic, moment))
            return;
    }
    (between ? look.between : look.after) = true;
    look.contacts = true;
    Changed& changes = between ? look.changes_between : look.changes_after;
    changes = std::max(changes, change);
}

} // namespace

bool last_step(const Scene& scene) {
    return scene.subStepping || !Omega::instance().isRunning() || scene.stopAtIter == scene.iter + 1 ||
           (scene.stopAtTime > 0 && scene.time + 1.5 * scene.dt >= scene.stopAtTime);
}

Look who_looks(const Scene& scene, const Engine& loop, const Engine& integrator, const vector<string>& blind,
               Real step_seconds) {
    Look look;
    if (last_step(scene)) {
        look.let_all_look();
        if (scene.subStepping) {
            look.between = true;
            look.changes_between = Changed::anything;
        }
    }
    const Real late = PeriodicEngine::getClock() + 3 * step_seconds + 0.01;
    const Moment now{scene.iter, scene.time, late}, next{scene.iter + 1, scene.time + scene.dt, late};
    enum { before, between, after } place = before;
    for (const auto& engine : scene.engines) {
        if (engine.get() == &loop)
            place = between;
        else if (engine.get() == &integrator)
            place = after;
        else if (!is_idle(*engine, blind))
            add_look(look, *engine, place == between, place == before ? next : now);
    }
    return look;
}

} // namespace yade
