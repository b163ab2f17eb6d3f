// SPDX-License-Identifier: GPL-2.0-or-later
// What limits the time step in a YADE scene, each limit with the bodies that set it.
#pragma once

#include <engines/time_step/contact_network.hpp>

#include <core/Scene.hpp>

#include <string>
#include <vector>

namespace yade {

/// The body that NewtonIntegrator moves: the clump for its members.
inline const Body& mover(const Scene& scene, const Body& body) {
    return body.isClumpMember() ? *(*scene.bodies)[body.clumpId] : body;
}

struct StepLimit {
    Real step = grainfall::time_step::no_limit; // s
    vector<int> bodies;                         // one, or the two of a contact
    std::string reason;
};

/// Leapfrog's limit of stability for all contacts, at the stiffness each will have reached when its bodies
/// stop. `guess`: the last such limit [s]; saves time where dashpots act. `network` is scratch space.
StepLimit contact_limit(const Scene& scene, grainfall::time_step::ContactNetwork& network, Real guess);

/// Eq 7-8 of the report as printed, contact by contact.
StepLimit report_limit(const Scene& scene);

/// What holds without any contact: the Rayleigh step of every sphere, and what two bodies need that may meet
/// next, whichever they are, at the largest speed that any two have relative to each other.
struct FlightLimits {
    StepLimit rayleigh;
    StepLimit impact;       // leapfrog's limit in the impact
    StepLimit displacement; // time to come nearer by the smallest radius
};
FlightLimits flight_limits(const Scene& scene);

} // namespace yade
