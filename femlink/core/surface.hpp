// SPDX-License-Identifier: GPL-2.0-or-later
// The wall's surface towards the grains: quadrilateral faces of degree 1 or 2 and how they hang together.
#pragma once

#include <femlink/core/face_shape.hpp>
#include <laws/validation.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace grainfall::femlink {

using Positions = Eigen::Matrix<double, 3, Eigen::Dynamic>; // m, one column a node

struct Surface {
    static constexpr int fixed = -1;

    int degree = 1;
    Positions nodes;        // at rest
    std::vector<int> loose; // per node: its place among the nodes that move, or `fixed`
    Eigen::MatrixXi faces;  // nodes of each face, one column a face, ordered as in face_shape.hpp
    std::vector<std::array<int, 4>>
        neighbours; // face across the edges X1 = -1, X1 = 1, X2 = -1, X2 = 1, or -1

    int face_count() const { return static_cast<int>(faces.cols()); }
    int node_count() const { return static_cast<int>(nodes.cols()); }
    int loose_count() const { return loose.empty() ? 0 : 1 + *std::max_element(loose.begin(), loose.end()); }

    template <int face_degree>
    FaceNodes<face_degree> face(int index, const Positions& positions) const {
        FaceNodes<face_degree> out;
        for (int k = 0; k < nodes_per_face<face_degree>; ++k)
            out.col(k) = positions.col(faces(k, index));
        return out;
    }

    // Corner nodes of the four edges, in the order of `neighbours`.
    std::array<std::pair<int, int>, 4> edges(int face) const {
        const int n = degree + 1;
        const int a = faces(0, face), b = faces(n - 1, face), c = faces(n * degree, face),
                  d = faces(n * n - 1, face);
        return {{{a, c}, {b, d}, {a, b}, {c, d}}};
    }

    void connect() {
        std::map<std::pair<int, int>, std::pair<int, int>> open;
        neighbours.assign(face_count(), {-1, -1, -1, -1});
        for (int f = 0; f < face_count(); ++f) {
            const auto corners = edges(f);
            for (int e = 0; e < 4; ++e) {
                const std::pair<int, int> key = std::minmax(corners[e].first, corners[e].second);
                const auto [other, is_new] = open.emplace(key, std::make_pair(f, e));
                if (is_new)
                    continue;
                neighbours[f][e] = other->second.first;
                neighbours[other->second.first][other->second.second] = f;
            }
        }
    }
};

// What a surface given by a user must satisfy; throws std::invalid_argument.
inline void validate(const Surface& surface) {
    if (surface.degree != 1 && surface.degree != 2)
        laws::reject("degree", surface.degree, "1 or 2");
    const int n = (surface.degree + 1) * (surface.degree + 1);
    if (surface.faces.cols() == 0)
        laws::reject("faces", "[]", "a list of at least one face");
    if (surface.faces.rows() != n)
        laws::reject("faces", std::to_string(surface.faces.rows()) + " nodes a face",
                     std::to_string(n) + " nodes a face (degree " + std::to_string(surface.degree) + ")");
    if (surface.faces.minCoeff() < 0 || surface.faces.maxCoeff() >= surface.node_count())
        laws::reject("faces",
                     surface.faces.minCoeff() < 0 ? surface.faces.minCoeff() : surface.faces.maxCoeff(),
                     "indices of nodes, 0 to " + std::to_string(surface.node_count() - 1));
    if (!surface.nodes.allFinite())
        laws::reject("nodes", "an infinite or undefined coordinate", "finite numbers");
    if (surface.loose.size() != static_cast<std::size_t>(surface.node_count()))
        laws::require_length("loose", surface.loose.size(), surface.node_count(), "one number a node");
}

} // namespace grainfall::femlink
