// SPDX-License-Identifier: GPL-2.0-or-later
// Cells of one material and one kind of element: what the stepper asks of them.
#pragma once

#include <femlink/core/hex_mesh.hpp>
#include <femlink/explicit/trilinear.hpp>

#include <memory>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace grainfall::femlink {

struct CellEnergies { // J
    double elastic = 0, plastic = 0, hourglass = 0;
};

struct CellState {
    Symmetric stress;      // Pa, Cauchy's, mean of the cell
    double plastic_strain; // equivalent, mean of the cell
};

class CellBlock {
public:
    virtual ~CellBlock() = default;
    // Adds the internal forces (N, 3 numbers a node) at these positions (m); plastic strain moves on.
    virtual void add_forces(const double* positions, double* forces) = 0;
    virtual void add_mass(std::vector<double>& mass) const = 0; // kg a node
    virtual CellEnergies energies(const double* positions) const = 0;
    // Bound on the largest angular frequency of the cells as they are deformed now, 1/s.
    virtual double largest_frequency(const double* positions) const = 0;
    // Of the cells at their places in the mesh; history stays.
    virtual void states(const double* positions, std::vector<CellState>& of_mesh) const = 0;
    // Numbers that positions do not tell: elastic deformation and plastic strain.
    virtual std::vector<double>& memory() = 0;
};

[[noreturn]] inline void report_turned_over(int cell, double ratio) {
    std::ostringstream text;
    text << "cell " << cell << " of the wall has turned over (volume at one point " << ratio
         << " of that at rest): the load is too strong for its material or for cells of this size, or the "
            "step "
            "too long";
    throw std::runtime_error(text.str());
}

} // namespace grainfall::femlink
