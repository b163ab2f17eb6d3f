// SPDX-License-Identifier: GPL-2.0-or-later
// Facts: NewtonIntegrator is 432 bytes with these members in this order; its first member lies in the tail of
// FieldApplier. The size of threadMaxVelocitySq is the number of threads. The constructor is exported.
// Verified: tests/abi.
#pragma once

#include <pkg/common/FieldApplier.hpp>

namespace yade {

class NewtonIntegrator : public FieldApplier {
    bool syncEnsured;
    bool cellChanged;
    int homoDeform;
    bool bodySelected;
    Matrix3r dVelGrad;
    Vector3r dSpin;

public:
    bool densityScaling;
    Real updatingDispFactor;
    vector<Real> threadMaxVelocitySq;
    Real damping;
    Vector3r gravity;
    Real maxVelocitySq;
    bool exactAsphericalRot;
    Matrix3r prevVelGrad;
    Vector3r prevCellSize;
    bool warnNoForceReset;
    int nonviscDampIx;
    bool kinSplit;
    bool dampGravity;
    int kinEnergyIx;
    int kinEnergyTransIx;
    int kinEnergyRotIx;
    int mask;

    NewtonIntegrator();
    void action() override;

    YADE_ABI_STOCK_CLASS(NewtonIntegrator)

    friend struct NewtonIntegratorLayout;
};

} // namespace yade

YADE_ABI_STOCK_SERIALIZERS(NewtonIntegrator)
