// SPDX-License-Identifier: GPL-2.0-or-later
// One form for every complaint about input: "PowerLawFriction.muRef = -0.2: must be > 0".
#pragma once

#include <cmath>
#include <cstddef>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace grainfall::laws {

[[noreturn]] inline void reject(const std::string& attribute, const std::string& value,
                                const std::string& allowed) {
    throw std::invalid_argument(attribute + " = " + value + ": must be " + allowed);
}

[[noreturn]] inline void reject(const std::string& attribute, double value, const std::string& allowed) {
    std::ostringstream text;
    text << value;
    reject(attribute, text.str(), allowed);
}

inline void require_finite(const std::string& attribute, double value) {
    if (!std::isfinite(value))
        reject(attribute, value, "a finite number");
}

inline void require_positive(const std::string& attribute, double value) {
    if (!(std::isfinite(value) && value > 0))
        reject(attribute, value, "> 0 and finite");
}

inline void require_not_negative(const std::string& attribute, double value) {
    if (!(std::isfinite(value) && value >= 0))
        reject(attribute, value, ">= 0 and finite");
}

// Both ends belong to the range.
inline void require_between(const std::string& attribute, double value, double low, double high) {
    if (value >= low && value <= high)
        return;
    std::ostringstream text;
    text << "in [" << low << ", " << high << "]";
    reject(attribute, value, text.str());
}

// The support points of a table: at least one, none negative, each above the one before.
inline void require_ascending(const std::string& attribute, const std::vector<double>& points) {
    if (points.empty())
        reject(attribute, "[]", "a list of at least one number");
    for (std::size_t i = 0; i < points.size(); ++i) {
        const std::string element = attribute + "[" + std::to_string(i) + "]";
        require_not_negative(element, points[i]);
        if (i > 0 && points[i] <= points[i - 1]) {
            std::ostringstream text;
            text << "above the element before it (" << points[i - 1] << ")";
            reject(element, points[i], text.str());
        }
    }
}

inline void require_length(const std::string& attribute, std::size_t length, std::size_t expected,
                           const std::string& reason) {
    if (length == expected)
        return;
    reject(attribute, "list of length " + std::to_string(length),
           "of length " + std::to_string(expected) + " (" + reason + ")");
}

} // namespace grainfall::laws
