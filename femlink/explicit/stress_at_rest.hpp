// SPDX-License-Identifier: GPL-2.0-or-later
// Stress of soil at rest under its own weight: vertical pressure the weight above, by the mean density at
// each height, horizontal pressure K0 = 1 - sin phi of it (Jaky 1944). Soil whose strength depends on
// pressure starts from it. Whatever else holds the soil at rest, as grains in a hole do, holds it as it is.
#pragma once

#include <femlink/core/hex_mesh.hpp>
#include <femlink/explicit/solid_material.hpp>
#include <femlink/explicit/symmetric_functions.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Dense>

namespace grainfall::femlink {

inline double earth_pressure_at_rest(double friction_angle) {
    return 1 - std::sin(friction_angle);
}

class StressAtRest {
public:
    // `gravity`: m/s^2, not zero.
    StressAtRest(const HexMesh& mesh, const SolidMaterials& materials, const Point& gravity)
        : up_(-gravity.normalized()) {
        std::vector<Layer> layers;
        for (std::size_t c = 0; c < mesh.cells.size(); ++c)
            layers.push_back(layer_of(mesh, c, materials.at(mesh.regions[c]).elastic.density));
        for (const Layer& layer : layers) {
            heights_.push_back(layer.low);
            heights_.push_back(layer.high);
        }
        std::sort(heights_.begin(), heights_.end());
        const double same = 1e-9 * (heights_.back() - heights_.front());
        heights_.erase(std::unique(heights_.begin(), heights_.end(),
                                   [same](double a, double b) { return b - a <= same; }),
                       heights_.end());
        std::vector<double> mass(heights_.size(), 0.0), volume(mass); // a length of height, above each
        for (const Layer& layer : layers) {
            for (std::size_t k = place(layer.low + same); heights_[k] < layer.high - same; ++k) {
                mass[k] += layer.density * layer.area;
                volume[k] += layer.area;
            }
        }
        pressures_.assign(heights_.size(), 0.0);
        for (std::size_t k = heights_.size() - 1; k-- > 0;) {
            const double density = volume[k] > 0 ? mass[k] / volume[k] : 0;
            pressures_[k] = pressures_[k + 1] + gravity.norm() * density * (heights_[k + 1] - heights_[k]);
        }
    }

    // Vertical, Pa.
    double pressure(const Point& at) const {
        const double height = up_.dot(at);
        if (height >= heights_.back())
            return 0;
        const std::size_t k = place(height);
        const double share = (height - heights_[k]) / (heights_[k + 1] - heights_[k]);
        return pressures_[k] + share * (pressures_[k + 1] - pressures_[k]);
    }

    // Pa, `ratio` of horizontal over vertical pressure.
    Symmetric stress(const Point& at, double ratio) const {
        const double vertical = -pressure(at), across = ratio * vertical, more = vertical - across;
        return plus_identity(more * Symmetric{up_[0] * up_[0], up_[1] * up_[1], up_[2] * up_[2],
                                              up_[1] * up_[2], up_[0] * up_[2], up_[0] * up_[1]},
                             across);
    }

private:
    struct Layer {
        double low, high, density, area;
    };

    Layer layer_of(const HexMesh& mesh, std::size_t cell, double density) const {
        Layer out{0, 0, density, 0};
        Point low = mesh.vertices[static_cast<std::size_t>(mesh.cells[cell][0])], high = low;
        out.low = out.high = up_.dot(low);
        for (const int node : mesh.cells[cell]) {
            const Point& corner = mesh.vertices[static_cast<std::size_t>(node)];
            low = low.cwiseMin(corner);
            high = high.cwiseMax(corner);
            out.low = std::min(out.low, up_.dot(corner));
            out.high = std::max(out.high, up_.dot(corner));
        }
        out.area = (high - low).prod() / (out.high - out.low);
        return out;
    }

    // Interval of heights that this one is in, the lowest and the highest being without end.
    std::size_t place(double height) const {
        const auto above = std::upper_bound(heights_.begin() + 1, heights_.end() - 1, height);
        return static_cast<std::size_t>(above - heights_.begin()) - 1;
    }

    Point up_;
    std::vector<double> heights_, pressures_; // m; Pa at them
};

} // namespace grainfall::femlink
