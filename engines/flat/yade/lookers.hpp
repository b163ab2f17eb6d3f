// SPDX-License-Identifier: GPL-2.0-or-later
// Who is about to look at YADE's objects, and so needs them true.
#pragma once

#include <core/Engine.hpp>
#include <core/Scene.hpp>

namespace yade {

/// What may have been changed by others, in rising order.
enum class Changed { nothing, states, anything };

struct Look {
    bool between = false;  // after the contact loop, before the integrator
    bool after = false;    // after the integrator, until the next contact loop
    bool contacts = false; // at contacts and forces too
    Changed changes_between = Changed::nothing;
    Changed changes_after = Changed::nothing;

    /// Everyone may look at everything, and change it, before the next step.
    void let_all_look() {
        after = contacts = true;
        changes_after = Changed::anything;
    }
};

/// What will be looked at in this step. Engines whose label is in `blind` are said to look at nothing.
Look who_looks(const Scene& scene, const Engine& loop, const Engine& integrator, const vector<string>& blind,
               Real step_seconds);

/// Is this the last step before Python gets its turn?
bool last_step(const Scene& scene);

} // namespace yade
