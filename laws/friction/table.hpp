// SPDX-License-Identifier: GPL-2.0-or-later
// Friction measured over load and moisture: bilinear between the points, constant beyond the outermost.
//
// TableGrid is what the user gives. The moisture of a contact does not change, so when it is made the grid is
// reduced to one row, Table, linear in the load. Contacts of one pair of materials share that row.
#pragma once

#include <laws/validation.hpp>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace grainfall::laws::friction {

// Where a value lies among ascending points: between `lower` and `lower + 1` (or on `lower`), at this
// fraction.
struct Bracket {
    std::size_t lower = 0;
    double fraction = 0;
};

inline Bracket bracket(const std::vector<double>& points, double value) {
    if (!(value > points.front()))
        return {0, 0.0};
    if (value >= points.back())
        return {points.size() - 1, 0.0};
    const auto above = std::upper_bound(points.begin(), points.end(), value);
    const auto lower = static_cast<std::size_t>(above - points.begin()) - 1;
    return {lower, (value - points[lower]) / (points[lower + 1] - points[lower])};
}

inline double interpolate(const std::vector<double>& values, const Bracket& at, std::size_t stride = 1,
                          std::size_t offset = 0) {
    const double low = values[at.lower * stride + offset];
    if (at.fraction == 0)
        return low;
    return low + at.fraction * (values[(at.lower + 1) * stride + offset] - low);
}

class Table {
public:
    Table(std::vector<double> loads, std::vector<double> mu)
        : row_(std::make_shared<const Row>(Row{std::move(loads), std::move(mu)})),
          lowest_(*std::min_element(row_->mu.begin(), row_->mu.end())) {}

    double coefficient(double load) const {
        return factor_ * interpolate(row_->mu, bracket(row_->loads, load * inverse_load_scale_));
    }
    double lower_bound() const { return factor_ * lowest_; }
    // A shared row cannot take factors in, so a table carries them; they are read only where the contact
    // may slide.
    Table scaled(double factor) const {
        Table result = *this;
        result.factor_ *= factor;
        return result;
    }
    Table with_load_scale(double scale) const {
        Table result = *this;
        result.inverse_load_scale_ /= scale;
        return result;
    }

private:
    struct Row {
        std::vector<double> loads, mu;
    };
    std::shared_ptr<const Row> row_;
    double lowest_;
    double factor_ = 1;
    double inverse_load_scale_ = 1;
};

struct TableGrid {
    std::vector<double> loads;     // N, ascending
    std::vector<double> moistures; // kg water per kg dry sand, ascending
    std::vector<double> mu;        // -, mu[i * moistures.size() + j] at loads[i], moistures[j]

    void validate() const {
        require_ascending("TableFriction.loads", loads);
        require_ascending("TableFriction.moistures", moistures);
        require_length("TableFriction.mu", mu.size(), loads.size() * moistures.size(),
                       "one value for each load and moisture");
        for (std::size_t i = 0; i < mu.size(); ++i) {
            require_not_negative("TableFriction.mu[" + std::to_string(i) + "]", mu[i]);
        }
    }

    Table at_moisture(double moisture) const {
        const Bracket at = bracket(moistures, moisture);
        std::vector<double> row(loads.size());
        for (std::size_t i = 0; i < loads.size(); ++i) {
            row[i] = interpolate(mu, at, 1, i * moistures.size());
        }
        return Table(loads, std::move(row));
    }
};

} // namespace grainfall::laws::friction
