// SPDX-License-Identifier: GPL-2.0-or-later
// The place of the ledger among the engines.
#pragma once

#include <core/Engine.hpp>
#include <pkg/dem/NewtonIntegrator.hpp>

namespace yade {

/// The one NewtonIntegrator, which stands before `ledger` with nothing in between that changes forces or
/// step; throws with a sentence on what is wrong otherwise.
shared_ptr<const NewtonIntegrator> integrator_before(const Engine& ledger,
                                                     const vector<shared_ptr<Engine>>& engines);

} // namespace yade
