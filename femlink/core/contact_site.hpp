// SPDX-License-Identifier: GPL-2.0-or-later
// A contact's place on the wall: nodes and weights (found by contact_patch.hpp), and the directions of its
// forces.
#pragma once

#include <femlink/core/surface.hpp>

#include <cstddef>
#include <vector>

#include <Eigen/Geometry>

namespace grainfall::femlink {

struct ContactPatch {
    std::vector<int> nodes; // of the surface
    std::vector<double> weights;
    std::vector<Eigen::Matrix3d> blocks; // B_a; empty on a flat patch, where B_a = w_a I

    bool is_flat() const { return blocks.empty(); }
    Eigen::Matrix3d block(std::size_t a) const {
        return is_flat() ? Eigen::Matrix3d(weights[a] * Eigen::Matrix3d::Identity()) : blocks[a];
    }
};

// B F, node by node: add(node, its part).
template <class Add>
void spread(const ContactPatch& patch, const Point& force, const Add& add) {
    for (std::size_t a = 0; a < patch.nodes.size(); ++a)
        add(patch.nodes[a],
            patch.is_flat() ? Point(patch.weights[a] * force) : Point(patch.blocks[a] * force));
}

// B^T u, with of(node) the displacement of a node.
template <class Of>
Point gathered(const ContactPatch& patch, const Of& of) {
    Point sum = Point::Zero();
    for (std::size_t a = 0; a < patch.nodes.size(); ++a) {
        if (patch.is_flat())
            sum += patch.weights[a] * of(patch.nodes[a]);
        else
            sum += patch.blocks[a].transpose() * of(patch.nodes[a]);
    }
    return sum;
}

struct ContactSite {
    ContactPatch patch;
    Eigen::Matrix3d axes = Eigen::Matrix3d::Identity(); // Q: normal towards the grain, two tangents by column

    bool operator==(const ContactSite& other) const {
        return patch.nodes == other.patch.nodes && patch.weights == other.patch.weights &&
               patch.blocks == other.patch.blocks && axes == other.axes;
    }
};

using Sites = std::vector<const ContactSite*>;

inline Sites listed(const std::vector<ContactSite>& sites) {
    Sites out;
    for (const ContactSite& site : sites)
        out.push_back(&site);
    return out;
}

inline Eigen::Matrix3d contact_axes(const Point& normal) {
    Eigen::Matrix3d axes;
    axes.col(0) = normal;
    axes.col(1) = normal.unitOrthogonal();
    axes.col(2) = normal.cross(axes.col(1));
    return axes;
}

// What the contact at a site sees of the surface's displacement, in its own axes.
inline Eigen::Vector3d seen_displacement(const ContactSite& site, const Positions& displacement) {
    const Point sum = gathered(site.patch, [&](int node) { return displacement.col(node); });
    return site.axes.transpose() * sum;
}

} // namespace grainfall::femlink
