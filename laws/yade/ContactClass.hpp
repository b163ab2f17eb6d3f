// SPDX-License-Identifier: GPL-2.0-or-later
// What distinguishes the contacts of one scene: each class is served by a kernel of its own.
#pragma once

#include <laws/friction/any.hpp>

namespace yade {

/// In the order of the alternatives of grainfall::laws::friction::Any::Curve.
enum class FrictionForm { constant, power_law, exponential, asperity, table, combined };
enum class DashpotForm { none, repulsive, attractive };
enum class BridgeKind { none, willett, willett_closed, willett_viscous, willett_closed_viscous };

struct ContactClass {
    static constexpr int friction_forms = 6;
    static constexpr int dashpot_forms = 3;
    static constexpr int bridge_kinds = 5;
    static constexpr int dry_count = friction_forms * dashpot_forms;
    static constexpr int count = dry_count * bridge_kinds; // dry classes first

    int index;
    explicit constexpr ContactClass(int i) : index(i) {}
    constexpr ContactClass(FrictionForm friction, DashpotForm dashpot, BridgeKind bridge = BridgeKind::none)
        : index((static_cast<int>(bridge) * friction_forms + static_cast<int>(friction)) * dashpot_forms +
                static_cast<int>(dashpot)) {}

    constexpr FrictionForm friction() const { return static_cast<FrictionForm>(dry().index / dashpot_forms); }
    constexpr DashpotForm dashpot() const { return static_cast<DashpotForm>(index % dashpot_forms); }
    constexpr BridgeKind bridge() const { return static_cast<BridgeKind>(index / dry_count); }
    /// The same contact without liquid.
    constexpr ContactClass dry() const { return ContactClass(index % dry_count); }
};
static_assert(std::variant_size_v<grainfall::laws::friction::Any::Curve> == ContactClass::friction_forms);

inline FrictionForm form_of(const grainfall::laws::friction::Any& curve) {
    return static_cast<FrictionForm>(curve.curve().index());
}

} // namespace yade
