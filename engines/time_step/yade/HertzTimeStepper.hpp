// SPDX-License-Identifier: GPL-2.0-or-later
// Engine that sets the time step from the contacts (MR-2629, Eq 7-8, and what they lack).
#pragma once

#include <engines/time_step/contact_network.hpp>

#include <laws/yade/attribute_checks.hpp>

#include <core/TimeStepper.hpp>

namespace yade {

struct StepLimit;

class HertzTimeStepper : public TimeStepper {
public:
    virtual ~HertzTimeStepper() = default;

    bool isActivated() override;
    /// Will it act in this step?
    bool is_due(long step) const {
        return active && (criticalStep == 0 || step % timeStepUpdateInterval == 0);
    }
    void computeTimeStep(Scene*) override;

    void validate() const;
    void postLoad(HertzTimeStepper&) { validate(); }

    // clang-format off
    YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(HertzTimeStepper, TimeStepper,
        "Sets O.dt to safety times the largest stable step, which it finds from the stiffness and damping of all contacts of each body, "
        "from the speeds at which bodies approach each other, and from the Rayleigh step of each sphere. Place it after the "
        ":yref:`InteractionLoop` and before the :yref:`NewtonIntegrator`. Looks at the scene every "
        ":yref:`timeStepUpdateInterval<TimeStepper.timeStepUpdateInterval>` steps (default 10 here). O.dynDt = False switches it off, so "
        "that O.dt can be written. Source: MR-2629, section 3.1; docs/physics/time_step.md.",
        ((Real, safety, 0.1, , "part of the critical step that is taken [-], > 0. 0.1 makes 20 steps or more of an impact of two grains."))
        ((std::string, equation, "summed", , "'summed': largest eigenvalue of each body's contacts, approach, Rayleigh; 'report': MR-2629 Eq 7-8 as printed, contact by contact and nothing else (as printed needs safety=1)."))
        ((Real, maxApproach, 0.05, , "largest way that two bodies may come nearer in one step, as part of the smallest grain's radius [-], > 0: bounds the overlap at first touch."))
        ((Real, maxGrowth, 1.1, , "largest factor by which the step grows at an update [-], > 1. It shrinks at once."))
        ((Real, deadBand, 0.05, , "relative change of the allowed step that is let pass [-], >= 0: a step that stays the same conserves energy best."))
        ((Real, minStep, 0, , "smallest step [s], >= 0; taken even where it is unstable."))
        ((Real, maxStep, 0, , "largest step [s], >= minStep; 0 for no such bound."))
        ((bool, correctVelocity, true, , "make leapfrog second order where the step changes? NewtonIntegrator alone is first order there. No effect with numerical damping."))
        ((Real, criticalStep, 0, Attr::readonly, "largest stable step found at the last update [s], before safety; 0 before the first."))
        ((vector<int>, decidingContact, , Attr::readonly, "ids of the two bodies, or the one, that decided criticalStep."))
        ((std::string, reason, "", Attr::readonly, "what decided criticalStep, in words."))
        ((Real, smallestStep, 0, Attr::readonly, "smallest step set so far [s]; 0 before the first."))
        ((std::string, smallestReason, "", Attr::readonly, "what decided smallestStep."))
        ((long, changes, 0, Attr::readonly, "how often O.dt has been changed."))
        ((Real, stabilityStep, 0, (Attr::hidden | Attr::readonly), "the contacts' part of criticalStep: where the next search starts."))
        ,
        timeStepUpdateInterval = 10;
        ,
        .def(CheckedAttributes<HertzTimeStepper>()
            .add("safety", &HertzTimeStepper::safety)
            .add("equation", &HertzTimeStepper::equation)
            .add("maxApproach", &HertzTimeStepper::maxApproach)
            .add("maxGrowth", &HertzTimeStepper::maxGrowth)
            .add("deadBand", &HertzTimeStepper::deadBand)
            .add("minStep", &HertzTimeStepper::minStep)
            .add("maxStep", &HertzTimeStepper::maxStep)
            .add("timeStepUpdateInterval", &HertzTimeStepper::timeStepUpdateInterval))
    );
    // clang-format on

private:
    grainfall::time_step::ContactNetwork network_;

    StepLimit critical(const Scene& scene);
};
REGISTER_SERIALIZABLE(HertzTimeStepper);

} // namespace yade
