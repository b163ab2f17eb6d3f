// SPDX-License-Identifier: GPL-2.0-or-later
// The coupling faces of a continuum as a Surface; the nodes are numbered as the faces meet them.
#pragma once

#include <femlink/core/hex_mesh.hpp>
#include <femlink/core/surface.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <vector>

namespace grainfall::femlink {

struct MeshSurface {
    Surface surface;
    std::vector<int> nodes; // node of the continuum by node of the surface
};

// `faces`: nodes of the continuum, ordered as in face_shape.hpp; `is_held(node)`: it cannot move.
template <class IsHeld>
MeshSurface surface_of_faces(const std::vector<std::vector<int>>& faces, int degree, const Positions& nodes,
                             const IsHeld& is_held) {
    MeshSurface out;
    Surface& surface = out.surface;
    std::vector<int> place(static_cast<std::size_t>(nodes.cols()), -1);
    surface.degree = degree;
    surface.faces.resize((degree + 1) * (degree + 1), static_cast<Eigen::Index>(faces.size()));
    for (std::size_t f = 0; f < faces.size(); ++f) {
        for (std::size_t k = 0; k < faces[f].size(); ++k) {
            int& node = place[faces[f][k]];
            if (node < 0) {
                node = static_cast<int>(out.nodes.size());
                out.nodes.push_back(faces[f][k]);
            }
            surface.faces(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(f)) = node;
        }
    }
    surface.nodes.resize(3, static_cast<Eigen::Index>(out.nodes.size()));
    int loose = 0;
    for (std::size_t k = 0; k < out.nodes.size(); ++k) {
        surface.nodes.col(static_cast<Eigen::Index>(k)) = nodes.col(out.nodes[k]);
        surface.loose.push_back(is_held(out.nodes[k]) ? Surface::fixed : loose++);
    }
    surface.connect();
    return out;
}

struct CellFace {
    int cell;
    std::vector<int> nodes; // first axis times second points out of the cell
};

// Boundary faces with this id, cell by cell.
inline std::vector<CellFace> cell_faces(const HexMesh& mesh, int boundary_id) {
    constexpr int outward[6][4] = {{0, 4, 2, 6}, {1, 3, 5, 7}, {0, 1, 4, 5},
                                   {2, 6, 3, 7}, {0, 2, 1, 3}, {4, 5, 6, 7}};
    std::map<std::array<int, 4>, int> ids;
    const auto sorted = [](std::array<int, 4> corners) {
        std::sort(corners.begin(), corners.end());
        return corners;
    };
    for (const auto& face : mesh.boundary)
        ids[sorted(face.corners)] = face.id;
    std::vector<CellFace> out;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
        for (const auto& corners : outward) {
            std::vector<int> nodes;
            for (const int k : corners)
                nodes.push_back(mesh.cells[c][k]);
            const auto found = ids.find(sorted({nodes[0], nodes[1], nodes[2], nodes[3]}));
            if (found != ids.end() && found->second == boundary_id)
                out.push_back({static_cast<int>(c), nodes});
        }
    }
    return out;
}

} // namespace grainfall::femlink
