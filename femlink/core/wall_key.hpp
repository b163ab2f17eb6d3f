// SPDX-License-Identifier: GPL-2.0-or-later
// What a kept wall is known by: the same mesh, materials, degree and loads give the same key.
#pragma once

#include <femlink/core/hex_mesh.hpp>
#include <femlink/core/material.hpp>

#include <cstdint>
#include <cstdio>
#include <string>
#include <type_traits>

namespace grainfall::femlink {

class Fnv1a {
public:
    void add(const void* data, std::size_t size) {
        const auto* bytes = static_cast<const unsigned char*>(data);
        for (std::size_t i = 0; i < size; ++i)
            hash_ = (hash_ ^ bytes[i]) * 1099511628211ull;
    }
    template <class Number>
    void add(const Number& value) {
        static_assert(std::is_arithmetic_v<Number>);
        add(&value, sizeof value);
    }
    std::uint64_t value() const { return hash_; }
    std::string hex() const {
        char text[17];
        std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash_));
        return text;
    }

private:
    std::uint64_t hash_ = 14695981039346656037ull;
};

inline Fnv1a hash_of(const HexMesh& mesh, const Materials& materials, int degree) {
    Fnv1a hash;
    hash.add(degree);
    for (const Point& v : mesh.vertices)
        hash.add(v.data(), 3 * sizeof(double));
    for (const auto& cell : mesh.cells)
        hash.add(cell.data(), sizeof cell);
    hash.add(mesh.regions.data(), mesh.regions.size() * sizeof(int));
    for (const auto& face : mesh.boundary) {
        hash.add(face.corners.data(), sizeof face.corners);
        hash.add(face.id);
    }
    for (const auto& [region, material] : materials) {
        hash.add(region);
        hash.add(material.young);
        hash.add(material.poisson);
        hash.add(material.density);
    }
    return hash;
}

// gravity in m/s^2, load on the coupling surface in Pa.
inline std::string wall_key(Fnv1a continuum, const Point& gravity, const Point& surface_load) {
    continuum.add(gravity.data(), 3 * sizeof(double));
    continuum.add(surface_load.data(), 3 * sizeof(double));
    return continuum.hex();
}

} // namespace grainfall::femlink
