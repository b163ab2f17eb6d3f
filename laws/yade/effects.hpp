// SPDX-License-Identifier: GPL-2.0-or-later
// What of the contact law a scene asks for, in words.
#pragma once

#include <boost/python/dict.hpp>

namespace yade {

class Scene;
class Law2_ScGeom_GrainPhys_HertzMindlin;

/// {effect: reason} for everything that the law computes in this scene; what is off is not listed.
boost::python::dict describe_effects(const Law2_ScGeom_GrainPhys_HertzMindlin& law, const Scene& scene);

/// {kernel in words: number of contacts that it serves at this moment}.
boost::python::dict describe_kernels(const Law2_ScGeom_GrainPhys_HertzMindlin& law, const Scene& scene);

} // namespace yade
