// SPDX-License-Identifier: GPL-2.0-or-later
// Facts: GenericSpheresContact is 96 bytes: normal (from body 1 to body 2) 32, contactPoint 56, refR1 80,
// refR2 88, none initialised to a useful value. Verified: tests/abi.
#pragma once

#include <core/IGeom.hpp>

namespace yade {

class GenericSpheresContact : public IGeom {
public:
    GenericSpheresContact() : normal(Vector3r::Zero()), contactPoint(Vector3r::Zero()), refR1(0), refR2(0) {
        createIndex();
    }
    Vector3r normal;
    Vector3r contactPoint;
    Real refR1;
    Real refR2;
    YADE_ABI_STOCK_CLASS(GenericSpheresContact)
    YADE_ABI_INDEX
};

} // namespace yade

YADE_ABI_STOCK_SERIALIZERS(GenericSpheresContact)
