// SPDX-License-Identifier: GPL-2.0-or-later
// Energy that the contacts of a scene hold.
#pragma once

#include <lib/base/Math.hpp>

namespace yade {

class Scene;
class Interaction;

/// J, by what holds it.
struct StoredEnergy {
    Real normal = 0;
    Real shear = 0;
    Real bridge = 0; // work done against liquid bridges since they formed; negative on overlap

    Real total() const { return normal + shear + bridge; }
};

/// Of one contact, for the overlap at which its forces acted last; zero for one that is not of GrainPhys.
StoredEnergy stored_energy(const Interaction& contact);

/// Of all contacts of the scene.
StoredEnergy stored_energy(const Scene& scene);

} // namespace yade
