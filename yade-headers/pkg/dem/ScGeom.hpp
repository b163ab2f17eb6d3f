// SPDX-License-Identifier: GPL-2.0-or-later
// Facts: ScGeom is 192 bytes: rotation caches 96 and 120, radius1/2 are references to refR1/2 (144, 152),
// penetrationDepth (positive in contact) 160, shearInc 168. precompute stores the new normal and what rotate
// needs to turn a tangential vector with the contact. All functions and the constructor are exported.
// Verified: tests/abi.
#pragma once

#include <core/IGeom.hpp>
#include <core/Interaction.hpp>
#include <core/State.hpp>
#include <pkg/dem/DemXDofGeom.hpp>

namespace yade {

class Scene;

class ScGeom : public GenericSpheresContact {
    Vector3r twist_axis;
    Vector3r orthonormal_axis;

public:
    Real& radius1;
    Real& radius2;
    Real penetrationDepth;
    Vector3r shearInc;

    ScGeom();
    void precompute(const State& state1, const State& state2, const Scene*, const shared_ptr<Interaction>&,
                    const Vector3r& currentNormal, bool isNew, const Vector3r& shift2,
                    bool avoidGranularRatcheting = true);
    Vector3r& rotate(Vector3r& tangential) const;
    const Vector3r& shearIncrement() const { return shearInc; }
    Vector3r getIncidentVel(const State* state1, const State* state2, Real dt, const Vector3r& shiftVel,
                            const Vector3r& shift2, bool avoidGranularRatcheting = true) const;
    Vector3r getIncidentVel(const State* state1, const State* state2, Real dt,
                            bool avoidGranularRatcheting = true) const;
    Vector3r getRelAngVel(const State* state1, const State* state2, Real dt) const;

    YADE_ABI_STOCK_CLASS(ScGeom)
    YADE_ABI_INDEX

    friend struct ScGeomLayout;
};

} // namespace yade

YADE_ABI_STOCK_SERIALIZERS(ScGeom)
