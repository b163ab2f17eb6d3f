// SPDX-License-Identifier: GPL-2.0-or-later
// Facts: NormPhys is 64 bytes: kn 32, normalForce 40; NormShearPhys is 96: ks 64, shearForce 72; constructors
// exported. Verified: tests/abi.
#pragma once

#include <core/IPhys.hpp>

namespace yade {

class NormPhys : public IPhys {
public:
    NormPhys();
    Real kn;
    Vector3r normalForce;
    YADE_ABI_STOCK_CLASS(NormPhys)
    YADE_ABI_INDEX
};

class NormShearPhys : public NormPhys {
public:
    NormShearPhys();
    Real ks;
    Vector3r shearForce;
    YADE_ABI_STOCK_CLASS(NormShearPhys)
    YADE_ABI_INDEX
};

} // namespace yade

YADE_ABI_STOCK_SERIALIZERS(NormPhys)
YADE_ABI_STOCK_SERIALIZERS(NormShearPhys)
