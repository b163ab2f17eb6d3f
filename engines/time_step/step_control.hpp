// SPDX-License-Identifier: GPL-2.0-or-later
// From the step that is allowed to the step that is taken.
//
// Shrinks at once, grows slowly, and keeps what is near enough: a leapfrog whose step never changes conserves
// energy better than one whose step always fits.
#pragma once

#include <engines/time_step/step_limits.hpp>

#include <algorithm>

namespace grainfall::time_step {

struct StepControl {
    double dead_band = 0;       // -, margin by which a changed step stays below what is allowed
    double max_growth = 1;      // -, largest ratio of a step to the one before
    double min_step = 0;        // s
    double max_step = no_limit; // s

    // s; `allowed` may be infinite, then the step stays as it is.
    double next(double step, double allowed) const {
        const double target = std::max(min_step, std::min(max_step, allowed));
        if (target == no_limit)
            return step;
        const double chosen = std::max(min_step, target / (1 + dead_band));
        if (target < step)
            return chosen;
        if (chosen > step * (1 + dead_band))
            return std::max(min_step, std::min(chosen, step * max_growth));
        return step;
    }

    // s, of a scene whose step nobody has chosen yet.
    double first(double step, double allowed) const {
        const double target = std::max(min_step, std::min(max_step, allowed));
        return target == no_limit ? step : target;
    }
};

} // namespace grainfall::time_step
