// SPDX-License-Identifier: GPL-2.0-or-later
// Facts: State is 320 bytes; pos and ori are references into se3, so a State is never copied; meaning of the
// bits of blockedDOFs. Constructor exported. Verified: tests/abi.
#pragma once

#include <lib/multimethods/Indexable.hpp>
#include <lib/serialization/Serializable.hpp>

#include <mutex>

namespace yade {

class State : public Serializable, public Indexable {
public:
    State();

    Vector3r& pos;
    Quaternionr& ori;
    std::mutex updateMutex;
    Se3r se3;
    Vector3r vel;
    Real mass;
    Vector3r angVel;
    Vector3r angMom;
    Vector3r inertia;
    Vector3r refPos;
    Quaternionr refOri;
    unsigned blockedDOFs;
    bool isDamped;
    Real densityScaling;

    enum { DOF_NONE = 0, DOF_X = 1, DOF_Y = 2, DOF_Z = 4, DOF_RX = 8, DOF_RY = 16, DOF_RZ = 32 };
    static const unsigned DOF_XYZ = DOF_X | DOF_Y | DOF_Z;
    static const unsigned DOF_RXRYRZ = DOF_RX | DOF_RY | DOF_RZ;
    static const unsigned DOF_ALL = DOF_XYZ | DOF_RXRYRZ;

    Vector3r displ() const { return pos - refPos; }

    YADE_ABI_STOCK_CLASS(State)
    YADE_ABI_INDEX_FAMILY
};

} // namespace yade

YADE_ABI_STOCK_SERIALIZERS(State)
