// SPDX-License-Identifier: GPL-2.0-or-later
// Leapfrog with a step that changes.
//
//   x_m = x_(m-1) + v_(m-1/2) dt_m,     v_(m+1/2) = v_(m-1/2) + a_m (dt_m + dt_(m+1))/2
//
// NewtonIntegrator adds a_m dt_(m+1) instead, which is first order in time and gains energy where steps grow
// as a contact opens. What is missing, a_m (dt_m - dt_(m+1))/2, is added here before it runs.
#pragma once

#include <core/Scene.hpp>

namespace yade {

/// To be called with all forces of the step present, in a step that changes the time step from `before` to
/// `after` [s]; free degrees of freedom only. Nothing is done where NewtonIntegrator does more than
/// integrate: with numerical damping or density scaling.
void correct_velocities(Scene& scene, Real before, Real after);

} // namespace yade
