// SPDX-License-Identifier: GPL-2.0-or-later
// What a scene asks for in vain: effects that were given parameters but that cannot act in it.
#pragma once

#include <string>
#include <vector>

namespace yade {

class Scene;
class Ip2_GrainMat_GrainMat_GrainPhys;
class Law2_ScGeom_GrainPhys_HertzMindlin;

/// One sentence each. `law` may be null: then nothing is said about what depends on it.
std::vector<std::string> idle_effects(const Scene& scene, const Ip2_GrainMat_GrainMat_GrainPhys& maker,
                                      const Law2_ScGeom_GrainPhys_HertzMindlin* law);

} // namespace yade
