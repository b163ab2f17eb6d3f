// SPDX-License-Identifier: GPL-2.0-or-later
// Fills a table with one kernel for each dry contact class.
#pragma once

#include <laws/hertz_mindlin.hpp>
#include <laws/yade/ContactClass.hpp>

#include <cstddef>
#include <type_traits>

namespace yade {

/// Maker::kernel<Normal, Tangential, Damping, Friction, Energy>() gives the kernel put into the table.
template <class Maker, class Normal, class Tangential, class Energy, class Table>
class DryKernels {
    template <class Damping, class Friction>
    static void put(Table& table, FrictionForm friction, DashpotForm dashpot) {
        // Without a tangential force the curve is never read: one kernel serves all.
        using Read = std::conditional_t<Tangential::active, Friction, grainfall::laws::friction::Constant>;
        table[static_cast<std::size_t>(ContactClass(friction, dashpot).index)] =
            Maker::template kernel<Normal, Tangential, Damping, Read, Energy>();
    }
    template <class Damping>
    static void put(Table& table, DashpotForm dashpot) {
        namespace friction = grainfall::laws::friction;
        put<Damping, friction::Constant>(table, FrictionForm::constant, dashpot);
        put<Damping, friction::PowerLaw>(table, FrictionForm::power_law, dashpot);
        put<Damping, friction::Exponential>(table, FrictionForm::exponential, dashpot);
        put<Damping, friction::Asperity>(table, FrictionForm::asperity, dashpot);
        put<Damping, friction::Table>(table, FrictionForm::table, dashpot);
        put<Damping, friction::Any>(table, FrictionForm::combined, dashpot);
    }

public:
    static void put(Table& table) {
        put<grainfall::laws::NoDamping>(table, DashpotForm::none);
        put<grainfall::laws::RepulsiveDashpot>(table, DashpotForm::repulsive);
        put<grainfall::laws::AttractiveDashpot>(table, DashpotForm::attractive);
    }
};

} // namespace yade
