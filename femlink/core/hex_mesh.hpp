// SPDX-License-Identifier: GPL-2.0-or-later
// Hexahedral meshes of the continuum as plain arrays, and the structured ones: box, half-space block,
// container.
//
// Corners of a cell: (0,0,0), (1,0,0), (0,1,0), (1,1,0), (0,0,1), ... of its reference cube, x running first.
#pragma once

#include <femlink/core/face_shape.hpp>
#include <laws/validation.hpp>

#include <array>
#include <functional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

namespace grainfall::femlink {

// Boundary ids. A face that is given none is free of load.
enum BoundaryId : int { free_surface = 0, outer_fixed = 1, coupling_surface = 2 };

struct HexMesh {
    struct BoundaryFace {
        std::array<int, 4> corners; // (0,0), (1,0), (0,1), (1,1) of the face
        int id;
    };

    std::vector<Point> vertices; // m
    std::vector<std::array<int, 8>> cells;
    std::vector<int> regions; // per cell: which material
    std::vector<BoundaryFace> boundary;
};

namespace detail {

// Corners of the six faces of a cell: x = 0, x = 1, y = 0, ...
inline constexpr int face_corners[6][4] = {{0, 2, 4, 6}, {1, 3, 5, 7}, {0, 1, 4, 5},
                                           {2, 3, 6, 7}, {0, 1, 2, 3}, {4, 5, 6, 7}};

} // namespace detail

// Smallest Jacobian determinant among the corners of a cell, m^3 (the volume of a parallelepiped).
inline double smallest_jacobian(const HexMesh& mesh, std::size_t cell) {
    const auto& c = mesh.cells[cell];
    double smallest = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 8; ++k) {
        const Point& at = mesh.vertices[c[k]];
        Eigen::Matrix3d edges;
        for (int axis = 0; axis < 3; ++axis) {
            const int bit = 1 << axis;
            edges.col(axis) = (k & bit ? -1.0 : 1.0) * (mesh.vertices[c[k ^ bit]] - at);
        }
        smallest = std::min(smallest, edges.determinant());
    }
    return smallest;
}

// Throws std::invalid_argument: cells no continuum can be made of.
inline void validate_cells(const HexMesh& mesh) {
    const int vertices = static_cast<int>(mesh.vertices.size());
    if (mesh.cells.empty())
        laws::reject("cells", "[]", "a list of at least one hexahedron");
    if (mesh.regions.size() != mesh.cells.size())
        laws::require_length("regions", mesh.regions.size(), mesh.cells.size(), "one number a cell");
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
        for (const int corner : mesh.cells[c])
            if (corner < 0 || corner >= vertices)
                laws::reject("cells[" + std::to_string(c) + "]", corner,
                             "an index of a vertex, 0 to " + std::to_string(vertices - 1));
        if (!(smallest_jacobian(mesh, c) > 0))
            laws::reject("cells[" + std::to_string(c) + "]", "an inverted or flat cell",
                         "a convex hexahedron with right-handed corners");
    }
}

// Throws std::invalid_argument: a mesh no wall can be made of.
inline void validate(const HexMesh& mesh) {
    validate_cells(mesh);
    const auto count = [&](int id) {
        return std::count_if(mesh.boundary.begin(), mesh.boundary.end(),
                             [&](const auto& f) { return f.id == id; });
    };
    if (count(outer_fixed) == 0)
        laws::reject("fixed boundary", "no face",
                     "at least one face of the mesh (boundary id 1): the wall would fly away");
    if (count(coupling_surface) == 0)
        laws::reject("coupling surface", "no face",
                     "at least one face of the mesh (boundary id 2): no grain could touch the wall");
}

// Grid lines from `from` to `to` with the spacing growing by `ratio` from one to the next, starting near
// `fine` at `from`; the number of cells is chosen so that they fit.
inline std::vector<double> graded_line(double from, double to, double fine, double ratio) {
    const double length = std::abs(to - from);
    std::vector<double> widths;
    double sum = 0, width = fine;
    while (sum < length * (1 - 1e-9)) {
        widths.push_back(width);
        sum += width;
        width *= ratio;
    }
    // A last cell that sticks out by more than half is left out; the rest is stretched to fit.
    if (widths.size() > 1 && sum - length > 0.5 * widths.back()) {
        sum -= widths.back();
        widths.pop_back();
    }
    std::vector<double> line = {from};
    double at = 0;
    for (const double w : widths) {
        at += w;
        line.push_back(from + (to - from) * at / sum);
    }
    line.back() = to;
    return line;
}

inline std::vector<double> even_line(double from, double to, int cells) {
    std::vector<double> line;
    for (int i = 0; i <= cells; ++i)
        line.push_back(from + (to - from) * i / cells);
    return line;
}

// Coarse - fine - coarse: even between -half and half, graded outside as far as +-reach.
inline std::vector<double> middle_line(double half, double reach, double fine, double ratio) {
    const int inner = std::max(2, 2 * static_cast<int>(std::lround(half / fine)));
    std::vector<double> line = even_line(-half, half, inner);
    if (!(reach > half))
        return line;
    const double first = std::min(2 * half / inner * ratio, reach - half);
    const std::vector<double> outside = graded_line(half, reach, first, ratio);
    std::vector<double> out;
    for (auto x = outside.rbegin(); x + 1 != outside.rend(); ++x)
        out.push_back(-*x);
    out.insert(out.end(), line.begin(), line.end());
    out.insert(out.end(), outside.begin() + 1, outside.end());
    return out;
}

struct GridLines {
    std::array<std::vector<double>, 3> axis;
};

// Cells of a grid for which `is_solid(i, j, k)`; boundary faces get boundary_id(centre, outward normal).
inline HexMesh structured_mesh(const GridLines& lines, const std::function<bool(int, int, int)>& is_solid,
                               const std::function<int(const Point&, const Point&)>& boundary_id) {
    const auto& [xs, ys, zs] = lines.axis;
    const int nx = static_cast<int>(xs.size()), ny = static_cast<int>(ys.size()),
              nz = static_cast<int>(zs.size());
    HexMesh mesh;
    std::vector<int> index(static_cast<std::size_t>(nx) * ny * nz, -1);
    const auto vertex = [&](int i, int j, int k) {
        int& place = index[(static_cast<std::size_t>(k) * ny + j) * nx + i];
        if (place < 0) {
            place = static_cast<int>(mesh.vertices.size());
            mesh.vertices.push_back({xs[i], ys[j], zs[k]});
        }
        return place;
    };
    const auto solid = [&](int i, int j, int k) {
        return i >= 0 && j >= 0 && k >= 0 && i < nx - 1 && j < ny - 1 && k < nz - 1 && is_solid(i, j, k);
    };
    for (int k = 0; k < nz - 1; ++k) {
        for (int j = 0; j < ny - 1; ++j) {
            for (int i = 0; i < nx - 1; ++i) {
                if (!solid(i, j, k))
                    continue;
                std::array<int, 8> cell;
                for (int c = 0; c < 8; ++c)
                    cell[c] = vertex(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2));
                mesh.cells.push_back(cell);
                for (int face = 0; face < 6; ++face) {
                    const int axis = face / 2, side = face % 2 ? 1 : -1;
                    std::array<int, 3> beyond = {i, j, k};
                    beyond[axis] += side;
                    if (solid(beyond[0], beyond[1], beyond[2]))
                        continue;
                    HexMesh::BoundaryFace found{};
                    Point centre = Point::Zero();
                    for (int c = 0; c < 4; ++c) {
                        found.corners[c] = cell[detail::face_corners[face][c]];
                        centre += 0.25 * mesh.vertices[found.corners[c]];
                    }
                    found.id = boundary_id(centre, side * Point::Unit(axis));
                    if (found.id != free_surface)
                        mesh.boundary.push_back(found);
                }
            }
        }
    }
    mesh.regions.assign(mesh.cells.size(), 0);
    return mesh;
}

// Which sides of a box are held: all but the top, or the bottom alone.
enum class Held { all_but_top, bottom };

inline Held held_from_name(const std::string& attribute, const std::string& name) {
    if (name == "all but top")
        return Held::all_but_top;
    if (name == "bottom")
        return Held::bottom;
    laws::reject(attribute, "'" + name + "'", "'all but top' or 'bottom'");
}

// Top at z = 0, centred on the z axis; the top is the coupling surface.
inline HexMesh box(const Point& size, const std::array<int, 3>& divisions, Held held) {
    for (int axis = 0; axis < 3; ++axis) {
        laws::require_positive("size[" + std::to_string(axis) + "]", size[axis]);
        if (divisions[axis] < 1)
            laws::reject("divisions[" + std::to_string(axis) + "]", divisions[axis], ">= 1");
    }
    const GridLines lines = {{even_line(-size[0] / 2, size[0] / 2, divisions[0]),
                              even_line(-size[1] / 2, size[1] / 2, divisions[1]),
                              even_line(-size[2], 0, divisions[2])}};
    return structured_mesh(
        lines, [](int, int, int) { return true; },
        [&](const Point&, const Point& normal) -> int {
            if (normal[2] > 0)
                return coupling_surface;
            return normal[2] < 0 || held == Held::all_but_top ? outer_fixed : free_surface;
        });
}

inline void require_grading(double element, double ratio) {
    laws::require_positive("element", element);
    laws::require_between("ratio", ratio, 1, 3);
}

// Stands for a half-space z < 0: cells of size `element` on |x|, |y| <= patch and as deep, growing by `ratio`
// towards the fixed boundary at `reach`. The coupling surface is the even part of the top (all of it if
// `whole_top`).
inline HexMesh half_space_block(double patch, double reach, double element, double ratio, bool whole_top) {
    laws::require_positive("patch", patch);
    require_grading(element, ratio);
    if (!(std::isfinite(reach) && reach > patch))
        laws::reject("reach", reach, "above patch and finite");
    const std::vector<double> across = middle_line(patch, reach, element, ratio);
    std::vector<double> depth = graded_line(0, -reach, element, ratio);
    std::reverse(depth.begin(), depth.end());
    return structured_mesh(
        {{across, across, depth}}, [](int, int, int) { return true; },
        [&](const Point& centre, const Point& normal) -> int {
            if (normal[2] <= 0)
                return outer_fixed;
            const bool near = std::abs(centre[0]) < patch && std::abs(centre[1]) < patch;
            return near || whole_top ? coupling_surface : free_surface;
        });
}

// A block with a cavity that is open at the top, z = 0: the grains lie in the cavity (its floor and its four
// walls are the coupling surface), the continuum around and below it reaches `thickness` further.
inline HexMesh container(const Point& cavity, double thickness, double element, double ratio) {
    for (int axis = 0; axis < 3; ++axis)
        laws::require_positive("cavity[" + std::to_string(axis) + "]", cavity[axis]);
    laws::require_positive("thickness", thickness);
    require_grading(element, ratio);
    GridLines lines;
    for (int axis = 0; axis < 2; ++axis)
        lines.axis[axis] = middle_line(cavity[axis] / 2, cavity[axis] / 2 + thickness, element, ratio);
    const int deep = std::max(1, static_cast<int>(std::lround(cavity[2] / element)));
    lines.axis[2] = graded_line(-cavity[2], -cavity[2] - thickness, std::min(element, thickness), ratio);
    std::reverse(lines.axis[2].begin(), lines.axis[2].end());
    const std::vector<double> wall = even_line(-cavity[2], 0, deep);
    lines.axis[2].insert(lines.axis[2].end(), wall.begin() + 1, wall.end());

    const auto inside = [&](int axis, int i) {
        const double middle = 0.5 * (lines.axis[axis][i] + lines.axis[axis][i + 1]);
        return axis == 2 ? middle > -cavity[2] : std::abs(middle) < cavity[axis] / 2;
    };
    return structured_mesh(
        lines, [&](int i, int j, int k) { return !(inside(0, i) && inside(1, j) && inside(2, k)); },
        [&](const Point& centre, const Point& normal) -> int {
            const double slack = 1e-9 * cavity.norm();
            if (centre[2] > -slack && normal[2] > 0)
                return free_surface;
            const bool in_cavity = std::abs(centre[0]) < cavity[0] / 2 + slack &&
                                   std::abs(centre[1]) < cavity[1] / 2 + slack &&
                                   centre[2] > -cavity[2] - slack;
            return in_cavity ? coupling_surface : outer_fixed;
        });
}

} // namespace grainfall::femlink
