// SPDX-License-Identifier: GPL-2.0-or-later
#include <engines/time_step/yade/HertzTimeStepper.hpp>

#include <engines/time_step/step_control.hpp>
#include <engines/time_step/yade/scene_limits.hpp>
#include <engines/time_step/yade/velocity_correction.hpp>

#include <femlink/yade/scene_walls.hpp>
#include <laws/validation.hpp>

namespace yade {

YADE_PLUGIN((HertzTimeStepper));

namespace ts = grainfall::time_step;

void HertzTimeStepper::validate() const {
    using namespace grainfall::laws;
    const std::string name = "HertzTimeStepper.";
    require_positive(name + "safety", safety);
    if (equation != "summed" && equation != "report")
        reject(name + "equation", "'" + equation + "'", "'summed' or 'report'");
    require_positive(name + "maxApproach", maxApproach);
    if (!(std::isfinite(maxGrowth) && maxGrowth > 1))
        reject(name + "maxGrowth", maxGrowth, "> 1 and finite");
    require_not_negative(name + "deadBand", deadBand);
    require_not_negative(name + "minStep", minStep);
    require_not_negative(name + "maxStep", maxStep);
    if (maxStep > 0 && maxStep < minStep)
        reject(name + "maxStep", maxStep, "0 or not below minStep");
    if (timeStepUpdateInterval == 0)
        reject(name + "timeStepUpdateInterval", 0.0, "at least 1");
}

bool HertzTimeStepper::isActivated() {
    return is_due(scene->iter);
}

StepLimit HertzTimeStepper::critical(const Scene& in) {
    if (equation == "report")
        return report_limit(in);
    StepLimit least = contact_limit(in, network_, stabilityStep > 0 ? stabilityStep : ts::no_limit);
    stabilityStep = std::isfinite(least.step) ? least.step : 0;
    FlightLimits flight = flight_limits(in);
    // Not a matter of stability: already the way that is allowed, so safety must not count twice.
    flight.displacement.step *= maxApproach / safety;
    for (StepLimit* limit : {&flight.rayleigh, &flight.impact, &flight.displacement})
        if (limit->step < least.step)
            std::swap(least, *limit);
    const ExchangeLimit exchange = exchange_limit(in);
    if (exchange.step < least.step)
        return {exchange.step, exchange.contact, "a contact on the nodes of a wall with inertia"};
    return least;
}

void HertzTimeStepper::computeTimeStep(Scene* in) {
    const StepLimit limit = critical(*in);
    const bool first = criticalStep == 0;
    const ts::StepControl control{deadBand, maxGrowth, minStep, maxStep > 0 ? maxStep : ts::no_limit};
    const Real allowed = safety * limit.step;
    const Real before = in->dt,
               after = first ? control.first(before, allowed) : control.next(before, allowed);
    const bool bounded = limit.step < ts::no_limit;
    decidingContact = limit.bodies;
    reason = bounded ? limit.reason : "nothing limits the step";
    if (bounded)
        criticalStep = limit.step;
    if (bounded && (smallestStep == 0 || after < smallestStep)) {
        smallestStep = after;
        smallestReason = reason;
    }
    if (after == before)
        return;
    // The velocities of a scene at its start belong to no step yet.
    if (correctVelocity && !first)
        correct_velocities(*in, before, after);
    in->dt = after;
    ++changes;
}

} // namespace yade
