// SPDX-License-Identifier: GPL-2.0-or-later
// What distinguishes the contacts of one scene: each class is served by a kernel of its own.
#pragma once

#include <laws/friction/any.hpp>

namespace yade {

/// In the order of the alternatives of grainfall::laws::friction::Any::Curve.
enum class FrictionForm { constant, power_law, exponential, asperity, table, combined };
enum class DashpotForm { none, repulsive, attractive };

struct ContactClass {
    static constexpr int friction_forms = 6;
    static constexpr int dashpot_forms = 3;
    static constexpr int count = friction_forms * dashpot_forms;

    int index;
    explicit constexpr ContactClass(int i) : index(i) {}
    constexpr ContactClass(FrictionForm friction, DashpotForm dashpot)
        : index(static_cast<int>(friction) * dashpot_forms + static_cast<int>(dashpot)) {}

    constexpr FrictionForm friction() const { return static_cast<FrictionForm>(index / dashpot_forms); }
    constexpr DashpotForm dashpot() const { return static_cast<DashpotForm>(index % dashpot_forms); }
};
static_assert(std::variant_size_v<grainfall::laws::friction::Any::Curve> == ContactClass::friction_forms);

inline FrictionForm form_of(const grainfall::laws::friction::Any& curve) {
    return static_cast<FrictionForm>(curve.curve().index());
}

} // namespace yade
