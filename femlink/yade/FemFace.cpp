// SPDX-License-Identifier: GPL-2.0-or-later
#include <femlink/yade/FemFace.hpp>

#include <laws/validation.hpp>

#include <algorithm>

namespace yade {

YADE_PLUGIN((FemFace));

void FemFace::postLoad(FemFace&) {
    if (!nodes.empty() && nodes.size() != 4 && nodes.size() != 9)
        grainfall::laws::reject("FemFace.nodes", static_cast<double>(nodes.size()), "4 or 9 points");
}

bool FemFace::has_left_bound() const {
    const auto is_outside = [&](const Vector3r& node) {
        return !((node.array() >= low_.array()).all() && (node.array() <= high_.array()).all());
    };
    return std::any_of(nodes.begin(), nodes.end(), is_outside) ||
           std::any_of(unloaded.begin(), unloaded.end(), is_outside);
}

} // namespace yade
