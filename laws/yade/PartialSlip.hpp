// SPDX-License-Identifier: GPL-2.0-or-later
// What a contact under tangentialLaw='mindlin-deresiewicz' remembers.
#pragma once

#include <laws/partial_slip.hpp>

#include <lib/serialization/Serializable.hpp>

namespace yade {

class PartialSlip : public Serializable {
public:
    virtual ~PartialSlip();

    void recall(grainfall::laws::SlipHistory& history) const;
    void keep(const grainfall::laws::SlipHistory& history);

    void postLoad(PartialSlip&);

    // clang-format off
    YADE_CLASS_BASE_DOC_ATTRS(PartialSlip, Serializable,
        "Slip history of one contact: the tangential stretch tau [m] of the springs of Popov & Hess's method over the overlap y [m] at "
        "which they came into touch, in straight pieces tau = mean + slope (y - centre). Made and kept by the law.",
        ((vector<Real>, pieces, , Attr::readonly, "seven numbers a piece, from the centre outwards: square root of y at the outer end [m^0.5], mean (two components) [m], slope (two components) [-], residual of joining [m^2.5], that with the next piece (negative: not known)."))
        ((Vector3r, axis, Vector3r::Zero(), Attr::readonly, "unit vector in the contact plane, the first axis of the components; the second is normal x axis."))
        ((Vector2r, pending, Vector2r::Zero(), Attr::readonly, "shear [m] since the pieces were brought up to date, by which all are stretched besides."))
        ((Real, limitSlope, 0, Attr::readonly, "slip limit of tau over (overlap - y) [-] at that time."))
        ((bool, slides, false, Attr::readonly, "did the whole contact slip at that time?"))
        ((Real, coefficient, 0, Attr::readonly, "8 G* sqrt(R*) [N/m^1.5] of the law that kept the pieces: half of it times the integral of tau^2 over the square root of y is the energy they hold."))
        ((Real, forceSquared, 0, Attr::readonly, "square of the elastic force that this history gave last [N^2]; another law's force shows by it."))
    );
    // clang-format on
};
REGISTER_SERIALIZABLE(PartialSlip);

} // namespace yade
