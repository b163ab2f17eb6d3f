// SPDX-License-Identifier: GPL-2.0-or-later
#include <femlink/yade/FemFace.hpp>

#include <laws/validation.hpp>

namespace yade {

YADE_PLUGIN((FemFace));

void FemFace::postLoad(FemFace&) {
    if (!nodes.empty() && nodes.size() != 4 && nodes.size() != 9)
        grainfall::laws::reject("FemFace.nodes", static_cast<double>(nodes.size()), "4 or 9 points");
}

bool FemFace::has_left_bound() const {
    for (const Vector3r& node : nodes)
        if (!((node.array() >= low_.array()).all() && (node.array() <= high_.array()).all()))
            return true;
    return false;
}

} // namespace yade
