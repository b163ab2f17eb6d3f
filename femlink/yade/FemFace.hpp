// SPDX-License-Identifier: GPL-2.0-or-later
// A face of the deformable wall as a YADE shape.
#pragma once

#include <lib/base/Math.hpp>
#include <core/Body.hpp>
#include <core/Shape.hpp>

namespace yade {

/// What FemWall found for one sphere on this face in this step.
struct FaceTouch {
    Body::id_t sphere;
    Vector3r point, normal; // m; unit vector towards the sphere
    Real overlap;           // m
    Vector3r velocity;      // m/s, of the wall at the contact
};

class FemFace : public Shape {
public:
    virtual ~FemFace() = default;
    void postLoad(FemFace&);

    vector<FaceTouch> touches;

    const FaceTouch* touch_of(Body::id_t sphere) const {
        for (const FaceTouch& touch : touches)
            if (touch.sphere == sphere)
                return &touch;
        return nullptr;
    }

    // A collider runs again when bodies have moved, not when their shape changes: the box that it was given
    // is noted, with room, and whoever sees the face outside asks for a run.
    void note_bound(const Vector3r& low, const Vector3r& high) {
        low_ = low;
        high_ = high;
    }
    bool has_left_bound() const;

    // clang-format off
    YADE_CLASS_BASE_DOC_ATTRS_CTOR(FemFace, Shape,
        "Face of a :yref:`FemWall`, four or nine nodes, its normal towards the grains. The wall moves the nodes; the body stands still. "
        "Needs :yref:`Bo1_FemFace_Aabb`, :yref:`Ig2_FemFace_Sphere_ScGeom` and, for GrainPhys, "
        ":yref:`Law2_FemGeom_GrainPhys_HertzMindlin`. Made by grainfall.femlink.add_wall.",
        ((int, index, -1, Attr::readonly, "Number of the face in its wall."))
        ((vector<Vector3r>, nodes, , , "Nodes [m] as they now lie, the first coordinate running first: 4 (degree 1) or 9 (degree 2)."))
        ((vector<Vector3r>, unloaded, , , "The same nodes [m] as they lie without contacts: where the face comes back to as soon as a grain leaves it."))
        , createIndex();
    );
    // clang-format on
    REGISTER_CLASS_INDEX(FemFace, Shape);

private:
    Vector3r low_ = Vector3r::Constant(-NaN), high_ = Vector3r::Constant(NaN);
};
REGISTER_SERIALIZABLE(FemFace);

} // namespace yade
