// SPDX-License-Identifier: GPL-2.0-or-later
// Kernels of contacts with a liquid bridge.
#pragma once

#include <laws/yade/Law2_ScGeom_GrainPhys_HertzMindlin.hpp>

namespace yade {

/// Fills the places of the wet classes. One kernel serves all dry classes, which it reaches through the
/// table, so that bridges do not multiply their number.
void put_wet_kernels(Law2_ScGeom_GrainPhys_HertzMindlin::KernelTable& table, bool booking);

} // namespace yade
