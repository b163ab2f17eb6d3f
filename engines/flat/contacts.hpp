// SPDX-License-Identifier: GPL-2.0-or-later
// Contacts of the flat path in packed arrays, those of one kernel together.
#pragma once

#include <engines/flat/bodies.hpp>

#include <laws/contact.hpp>
#include <laws/friction/any.hpp>

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
    union {
        double coefficient;               // friction, where it is constant
        const laws::friction::Any* curve; // elsewhere; the owner keeps it alive
    };
};

// Forces of the dashpots in the last step; kept only where energies are booked.
struct DashpotMemory {
    double normal = 0;
    Vector shear = Vector::Zero();
};

// Contacts of one class of spheres with one kind of partner. Owner: what else belongs to a contact, for the
// caller.
template <class Owner>
struct Segment {
    int contact_class = 0;
    Partner partner = Partner::sphere;
    std::vector<ContactState> states;
    std::vector<ContactConstants> constants;
    std::vector<DashpotMemory> dashpots; // empty where energies are not booked
    std::vector<Owner> owners;

    bool on_obstacles() const { return partner != Partner::sphere; }
    std::size_t size() const { return states.size(); }

    void add(const ContactState& state, const ContactConstants& constant, Owner owner,
             const DashpotMemory* dashpot) {
        states.push_back(state);
        constants.push_back(constant);
        owners.push_back(std::move(owner));
        if (dashpot)
            dashpots.push_back(*dashpot);
    }

    // The last contact takes the place of the one removed.
    void remove(std::size_t i) {
        take_last(states, i);
        take_last(constants, i);
        take_last(owners, i);
        if (!dashpots.empty())
            take_last(dashpots, i);
    }

private:
    template <class Vector>
    static void take_last(Vector& values, std::size_t i) {
        values[i] = std::move(values.back());
        values.pop_back();
    }
};

} // namespace grainfall::flat
