// SPDX-License-Identifier: GPL-2.0-or-later
// What stands for the ground beyond the outer boundary: held, or dashpots that take up waves (Lysmer &
// Kuhlemeyer 1969), traction -rho c_p v_n - rho c_s v_t, with springs that carry a static load.
//
// Dashpots alone let the wall drift under a lasting load. The springs, k per area in all directions, carry a
// force on a half-space's surface at the mean displacement that Boussinesq's solution has on the hemisphere
// of the face's distance R from the middle of the coupling surface:
//
//   k = 2 G / (R (1/3 + 2 (1 - nu)))
//
// They reflect waves longer than about R.
#pragma once

#include <femlink/core/face_shape.hpp>
#include <femlink/core/mesh_surface.hpp>
#include <femlink/explicit/solid_material.hpp>

#include <Eigen/Dense>

namespace grainfall::femlink {

enum class OuterBoundary { fixed, absorbing, dashpots };

inline OuterBoundary outer_boundary_from_name(const std::string& attribute, const std::string& name) {
    if (name == "fixed")
        return OuterBoundary::fixed;
    if (name == "absorbing")
        return OuterBoundary::absorbing;
    if (name == "dashpots")
        return OuterBoundary::dashpots;
    laws::reject(attribute, "'" + name + "'", "'fixed', 'absorbing' or 'dashpots'");
}

struct GroundNode {
    int node;
    Eigen::Matrix3d damping; // N s/m
    double spring;           // N/m
};

// Forces per area go to the nodes by the integrals of their shape functions.
inline std::vector<GroundNode> absorbing_nodes(const HexMesh& mesh, const SolidMaterials& materials,
                                               const Point& load_centre, bool with_springs) {
    std::map<int, GroundNode> nodes;
    constexpr double g = 0.5773502691896258;
    for (const CellFace& face : cell_faces(mesh, outer_fixed)) {
        const SolidMaterial& solid = materials.at(mesh.regions[face.cell]);
        const double shear = solid.elastic.mu(), density = solid.elastic.density;
        const double normal_wave = std::sqrt(density * (solid.elastic.lambda() + 2 * shear));
        const double shear_wave = std::sqrt(density * shear);
        FaceNodes<1> corners;
        for (int k = 0; k < 4; ++k)
            corners.col(k) = mesh.vertices[face.nodes[k]];
        const double distance = (face_point<1>(corners, Reference::Zero()) - load_centre).norm();
        const double spring =
            with_springs ? 2 * shear / (distance * (1.0 / 3 + 2 * (1 - solid.elastic.poisson))) : 0;
        for (int q = 0; q < 4; ++q) {
            const Reference at(q & 1 ? g : -g, q & 2 ? g : -g);
            const FaceFrame frame = face_frame<1>(corners, at);
            const Point area = frame.y1.cross(frame.y2);
            const Point n = area.normalized();
            const Eigen::Matrix3d across = n * n.transpose();
            const Eigen::Matrix3d impedance =
                normal_wave * across + shear_wave * (Eigen::Matrix3d::Identity() - across);
            const auto shape = shape_values<1>(at);
            for (int k = 0; k < 4; ++k) {
                const GroundNode fresh{face.nodes[k], Eigen::Matrix3d::Zero(), 0.0};
                GroundNode& node = nodes.emplace(face.nodes[k], fresh).first->second;
                node.damping += shape[k] * area.norm() * impedance;
                node.spring += shape[k] * area.norm() * spring;
            }
        }
    }
    std::vector<GroundNode> out;
    for (const auto& entry : nodes)
        out.push_back(entry.second);
    return out;
}

} // namespace grainfall::femlink
