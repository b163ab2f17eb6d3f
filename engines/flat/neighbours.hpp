// SPDX-License-Identifier: GPL-2.0-or-later
// Which spheres are near each other: linked cells over margins that follow the speed.
//
// Sphere i may move by its margin before the list is out of date, so a pair is listed while the gap is below
// the sum of both margins. A sphere at rest gets the least margin, a fast one what it travels until the next
// search is due: one flying grain does not make the list of a whole bed longer, nor shorter-lived.
#pragma once

#include <engines/flat/touch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace grainfall::flat {

struct Pair {
    int first, second; // second > first, or first an obstacle
};

// Cells no smaller than the reach of any sphere, in the order of their numbers along the longest axis last,
// so that a range of numbers is a slab of the bed.
class CellGrid {
public:
    // `reach` is the largest radius plus margin. The cells cover the bulk of the spheres; those far out count
    // with the outermost cell, which keeps neighbours neighbours.
    CellGrid(const std::vector<Place>& places, int spheres, double reach) {
        Vector high;
        cover_bulk(places, spheres, high);
        const Vector extent = high - low_;
        extent.maxCoeff(&slab_);
        row_ = (slab_ + 1) % 3;
        column_ = (slab_ + 2) % 3;
        size_ = 2 * reach;
        // A loose scene must not make more cells than grains.
        const double most = 4.0 * std::max(spheres, 1000);
        const auto cells_of = [&](int axis) { return std::floor(extent[axis] / size_) + 1; };
        while (cells_of(0) * cells_of(1) * cells_of(2) > most)
            size_ *= 1.26;
        for (int axis = 0; axis < 3; ++axis)
            counts_[axis] = static_cast<int>(cells_of(axis));
    }

    int cells() const { return counts_[0] * counts_[1] * counts_[2]; }

    int cell(const Vector& point) const {
        int at[3];
        for (int axis = 0; axis < 3; ++axis)
            at[axis] = coordinate(point, axis);
        return number(at);
    }

    // Calls visit(begin, end) with ranges of cell numbers around the cell of a point, each once; `whole` also
    // those of lower numbers than the cell's own.
    template <class Visit>
    void around(const Vector& point, const Visit& visit) const {
        int at[3];
        for (int axis = 0; axis < 3; ++axis)
            at[axis] = coordinate(point, axis);
        for (int s = std::max(at[slab_] - 1, 0); s <= std::min(at[slab_] + 1, counts_[slab_] - 1); ++s) {
            for (int r = std::max(at[row_] - 1, 0); r <= std::min(at[row_] + 1, counts_[row_] - 1); ++r) {
                int lowest[3], highest[3];
                lowest[slab_] = highest[slab_] = s;
                lowest[row_] = highest[row_] = r;
                lowest[column_] = std::max(at[column_] - 1, 0);
                highest[column_] = std::min(at[column_] + 1, counts_[column_] - 1);
                visit(number(lowest), number(highest) + 1);
            }
        }
    }

    // Cells from which a sphere could reach into a box.
    template <class Visit>
    void inside(const Vector& low, const Vector& high, const Visit& visit) const {
        int from[3], to[3];
        for (int axis = 0; axis < 3; ++axis) {
            from[axis] = coordinate(low - Vector::Constant(0.5 * size_), axis);
            to[axis] = coordinate(high + Vector::Constant(0.5 * size_), axis);
        }
        for (int s = from[slab_]; s <= to[slab_]; ++s) {
            for (int r = from[row_]; r <= to[row_]; ++r) {
                int lowest[3], highest[3];
                lowest[slab_] = highest[slab_] = s;
                lowest[row_] = highest[row_] = r;
                lowest[column_] = from[column_];
                highest[column_] = to[column_];
                visit(number(lowest), number(highest) + 1);
            }
        }
    }

private:
    Vector low_;
    double size_;
    int counts_[3];
    int slab_, row_, column_;

    // Box of all spheres, less what few of them stretch it beyond twice the bulk's extent.
    void cover_bulk(const std::vector<Place>& places, int spheres, Vector& high) {
        low_ = high = Vector::Zero();
        if (spheres == 0)
            return;
        const std::size_t count = static_cast<std::size_t>(spheres), step = 1 + count / 2000;
        std::vector<double> sample;
        for (int axis = 0; axis < 3; ++axis) {
            sample.clear();
            double least = places[0].centre[axis], most = least;
            for (std::size_t i = 0; i < count; ++i) {
                const double at = places[i].centre[axis];
                least = std::min(least, at);
                most = std::max(most, at);
                if (i % step == 0)
                    sample.push_back(at);
            }
            std::sort(sample.begin(), sample.end());
            const double lower = sample[sample.size() / 50],
                         upper = sample[sample.size() - 1 - sample.size() / 50];
            const double room = 0.5 * (upper - lower);
            low_[axis] = std::max(least, lower - room);
            high[axis] = std::min(most, upper + room);
        }
    }

    int coordinate(const Vector& point, int axis) const {
        const double place = (point[axis] - low_[axis]) / size_;
        return std::clamp(static_cast<int>(std::min(std::max(place, 0.0), 1e9)), 0, counts_[axis] - 1);
    }
    int number(const int* at) const {
        return (at[slab_] * counts_[row_] + at[row_]) * counts_[column_] + at[column_];
    }
};

// For each cell the range of spheres in it, once these are sorted by cell.
struct CellTable {
    CellGrid grid;
    std::vector<int> starts; // size cells + 1
    std::vector<int> order;  // sphere now -> index before sorting

    CellTable(const std::vector<Place>& places, int spheres, double reach) : grid(places, spheres, reach) {
        const auto count = static_cast<std::size_t>(spheres);
        std::vector<int> cell(count);
        starts.assign(static_cast<std::size_t>(grid.cells()) + 1, 0);
        for (std::size_t i = 0; i < count; ++i) {
            cell[i] = grid.cell(places[i].centre);
            ++starts[static_cast<std::size_t>(cell[i]) + 1];
        }
        std::partial_sum(starts.begin(), starts.end(), starts.begin());
        order.resize(count);
        std::vector<int> next(starts.begin(), starts.end() - 1);
        for (std::size_t i = 0; i < count; ++i)
            order[static_cast<std::size_t>(next[static_cast<std::size_t>(cell[i])]++)] = static_cast<int>(i);
    }
};

// m/s, at most, of an obstacle's surface because it turns. The surface of a solid of revolution does not move
// when it spins about its axis.
inline double turning_speed(const Obstacle& obstacle, const Vector& spin) {
    switch (obstacle.kind) {
    case Partner::box:
        return obstacle.half_edges.norm() * spin.norm();
    case Partner::solid:
        return obstacle.profile->reach() * spin.cross(obstacle.axes.col(2)).norm();
    default:
        return 0;
    }
}

// m, at most, that an obstacle's surface has gone by turning.
inline double turned_by(const Obstacle& obstacle, const Eigen::Quaterniond& before,
                        const Eigen::Quaterniond& now) {
    switch (obstacle.kind) {
    case Partner::box:
        return 2 * obstacle.half_edges.norm() * (before.conjugate() * now).vec().norm();
    case Partner::solid:
        return obstacle.profile->reach() * (now * Vector::UnitZ() - before * Vector::UnitZ()).norm();
    default:
        return 0;
    }
}

} // namespace grainfall::flat
