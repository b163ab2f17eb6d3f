// SPDX-License-Identifier: GPL-2.0-or-later
// Where the water of a scene is: in bridges or on the grains.
#pragma once

#include <boost/python/dict.hpp>

namespace yade {

class Scene;

/// For Law2_ScGeom_GrainPhys_HertzMindlin.water(), whose documentation names the entries. Volumes in m3.
boost::python::dict water_budget(const Scene& scene);

} // namespace yade
