// SPDX-License-Identifier: GPL-2.0-or-later
// Contacts of the flat path in packed arrays, those of one kernel together.
#pragma once

#include <engines/flat/bodies.hpp>

#include <laws/bridge/liquid_bridge.hpp>
#include <laws/contact.hpp>
#include <laws/friction/any.hpp>
#include <laws/partial_slip.hpp>

#include <utility>
#include <vector>

namespace grainfall::flat {

// What changes from step to step: one cache line.
struct alignas(64) ContactState {
    int first, second; // indices into Bodies; an obstacle is always the first
    Vector normal;     // of the last step
    Vector shear_force;
    double shear_stiffness; // 0 before the first step
};
static_assert(sizeof(ContactState) == 64);

// What was fixed when the contact was made.
struct ContactConstants {
    laws::ContactParameters parameters;
    double friction; // its coefficient, where that is constant
};

// Forces of the dashpots in the last step; kept only where energies are booked.
struct DashpotMemory {
    double normal = 0;
    Vector shear = Vector::Zero();
};

// The liquid between two bodies.
struct Bridge {
    laws::bridge::BridgeParameters parameters;
    laws::bridge::BridgeMemory memory;
};

// All that belongs to one contact. Owner: what else does, for the caller.
template <class Owner>
struct Contact {
    ContactState state;
    ContactConstants constants;
    Owner owner;
    laws::friction::Any curve;
    DashpotMemory dashpot;
    Bridge bridge;
    laws::SlipHistory slip;
};

// Contacts of one class of spheres with one kind of partner.
template <class Owner>
struct Segment {
    int contact_class = 0;
    Partner partner = Partner::sphere;
    bool curved = false; // do they have friction curves?
    bool wet = false;    // do they have bridges?
    bool books = false;  // are energies booked?
    bool slips = false;  // does the law remember partial slip?
    std::vector<ContactState> states;
    std::vector<ContactConstants> constants;
    std::vector<Owner> owners;
    std::vector<laws::friction::Any> curves; // empty where friction is constant
    std::vector<DashpotMemory> dashpots;     // empty where nothing is booked
    std::vector<Bridge> bridges;             // empty where contacts are dry
    std::vector<laws::SlipHistory> slip;     // empty where the law has none

    bool on_obstacles() const { return partner != Partner::sphere; }
    std::size_t size() const { return states.size(); }

    void add(Contact<Owner>&& contact) {
        states.push_back(contact.state);
        constants.push_back(contact.constants);
        owners.push_back(std::move(contact.owner));
        if (curved)
            curves.push_back(std::move(contact.curve));
        if (books)
            dashpots.push_back(contact.dashpot);
        if (wet)
            bridges.push_back(contact.bridge);
        if (slips)
            slip.push_back(contact.slip);
    }

    // From a segment of the same kind, which is left without the contact's owner and curve.
    void take(Segment& from, std::size_t i) {
        states.push_back(from.states[i]);
        constants.push_back(from.constants[i]);
        owners.push_back(std::move(from.owners[i]));
        if (curved)
            curves.push_back(std::move(from.curves[i]));
        if (books)
            dashpots.push_back(from.dashpots[i]);
        if (wet)
            bridges.push_back(from.bridges[i]);
        if (slips)
            slip.push_back(from.slip[i]);
    }

    // The last contact takes the place of the one removed.
    void remove(std::size_t i) {
        take_last(states, i);
        take_last(constants, i);
        take_last(owners, i);
        if (curved)
            take_last(curves, i);
        if (books)
            take_last(dashpots, i);
        if (wet)
            take_last(bridges, i);
        if (slips)
            take_last(slip, i);
    }

private:
    template <class Vector>
    static void take_last(Vector& values, std::size_t i) {
        values[i] = std::move(values.back());
        values.pop_back();
    }
};

} // namespace grainfall::flat
