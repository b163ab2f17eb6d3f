// SPDX-License-Identifier: GPL-2.0-or-later
// Facts: Cell is 1104 bytes. Body 2 of an interaction stands cellDist cells away: its position is shifted by
// hSize*cellDist, its velocity by the (cached) velocity gradient times the previous hSize, times cellDist.
// Verified: tests/abi.
#pragma once

#include <lib/serialization/Serializable.hpp>

namespace yade {

class Cell : public Serializable {
    Matrix3r _invTrsf;
    Matrix3r _trsfInc;
    Matrix3r _vGradTimesPrevH;
    Vector3r _size;
    Vector3r _cos;
    Vector3r _refSize;
    bool _hasShear;
    Matrix3r _shearTrsf;
    Matrix3r _unshearTrsf;
    double _glShearTrsfMatrix[16];

public:
    Matrix3r trsf;
    Matrix3r refHSize;
    Matrix3r hSize;
    Matrix3r prevHSize;
    Matrix3r velGrad;
    Matrix3r nextVelGrad;
    Matrix3r prevVelGrad;
    int homoDeform;
    bool velGradChanged;
    bool flipFlippable;

    Cell();
    const Vector3r& getSize() const { return _size; }
    bool hasShear() const { return _hasShear; }
    Real getVolume() const { return hSize.determinant(); }
    Vector3r shearPt(const Vector3r& point) const { return _shearTrsf * point; }
    Vector3r unshearPt(const Vector3r& point) const { return _unshearTrsf * point; }
    Vector3r intrShiftPos(const Vector3i& cellDist) const { return hSize * cellDist.cast<Real>(); }
    Vector3r intrShiftVel(const Vector3i& cellDist) const { return _vGradTimesPrevH * cellDist.cast<Real>(); }

    YADE_ABI_STOCK_CLASS(Cell)

    friend struct CellLayout;
};

} // namespace yade
