// SPDX-License-Identifier: GPL-2.0-or-later
// What deal.II does for the wall: meshes, shape functions, integrals (MR-2629, Eq 18-21), VTU files. Its
// types stay behind this interface, because each file that includes them takes half a minute to compile.
//
// Element stiffness, from the weak form with test function w:
//
//   int 2 mu eps(w) : eps(u) + lambda P(div w) P(div u)
//
// P projects on polynomials of one degree less that are free to jump between cells (constant for degree 1,
// linear for degree 2): mean dilatation (Nagtegaal, Parks & Rice 1974; Hughes 1980). Without it a nearly
// incompressible material locks: every integration point would keep its volume, which the nodes of one cell
// cannot do. A constant strain is unchanged by P, so the patch test holds on any mesh.
#pragma once

#include <femlink/core/material.hpp>
#include <femlink/core/hex_mesh.hpp>
#include <femlink/core/surface.hpp>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace grainfall::femlink {

using CellNodes = std::vector<int>; // (degree + 1)^3 nodes, x running first

class Discretisation {
public:
    Discretisation(const HexMesh& mesh, Materials materials, int degree);
    ~Discretisation();

    int degree() const;
    int node_count() const;
    const Positions& nodes() const;
    const std::vector<CellNodes>& cells() const;
    // Nodes of boundary faces with this id, ordered as in face_shape.hpp, normal out of the continuum.
    std::vector<std::vector<int>> faces(int boundary_id) const;

    // Calls `add(cell, K)` with K of 3 rows a node, N/m.
    void for_each_stiffness(const std::function<void(int, const Eigen::MatrixXd&)>& add) const;
    // N, one column a node: weight, and a traction (Pa) on all faces of a boundary id.
    Positions weight(const Point& gravity) const;
    Positions traction(int boundary_id, const Point& pressure) const;
    // Mean stress of each cell, Pa: xx, yy, zz, yz, xz, xy, one column a cell.
    Eigen::MatrixXd stress(const Positions& displacement) const;
    // For ParaView, with the time (s) that the grains' files of the same instant carry.
    void write_vtu(const std::string& path, const Positions& displacement, double time) const;

private:
    struct Parts; // deal.II's
    std::unique_ptr<Parts> parts_;
};

// Any hexahedral mesh that deal.II's gmsh reader takes (.msh, version 2 or 4). Physical surfaces with these
// numbers become the fixed boundary and the coupling surface; physical volumes are the regions.
HexMesh read_gmsh(const std::string& path, const std::vector<int>& fixed_ids,
                  const std::vector<int>& coupling_ids);

} // namespace grainfall::femlink
