// SPDX-License-Identifier: GPL-2.0-or-later
// Arrays of Python (one row a node) and of the kernels (one column a node).
#pragma once

#include <femlink/core/material.hpp>
#include <femlink/core/surface.hpp>

#include <pybind11/eigen.h>
#include <pybind11/functional.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <map>
#include <string>

namespace grainfall::femlink {

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using IntegerRows = Eigen::Matrix<int, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

template <class Matrix>
void require_columns(const std::string& attribute, const Matrix& rows, int columns) {
    if (rows.cols() != columns)
        laws::reject(attribute, std::to_string(rows.cols()) + " numbers a row",
                     std::to_string(columns) + " numbers a row");
}

using Triples = std::map<int, std::array<double, 3>>; // young, poisson, density by region

inline Materials materials_from(const Triples& triples) {
    Materials out;
    for (const auto& [region, values] : triples)
        out[region] = {values[0], values[1], values[2]};
    return out;
}

// An empty array stands for none given.
inline Positions positions_from(const std::string& attribute, const Rows& rows) {
    if (rows.size() == 0)
        return {};
    require_columns(attribute, rows, 3);
    return rows.transpose();
}

} // namespace grainfall::femlink
