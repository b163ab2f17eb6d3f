// SPDX-License-Identifier: GPL-2.0-or-later
// The cells of a mesh as blocks, one a region, each with the element and the law compiled for each other.
#pragma once

#include <femlink/explicit/drucker_prager.hpp>
#include <femlink/explicit/gauss_cells.hpp>
#include <femlink/explicit/j2_plasticity.hpp>
#include <femlink/explicit/one_point_cells.hpp>

#include <optional>

namespace grainfall::femlink {

enum class ElementKind { gauss, one_point };

inline ElementKind element_kind_from_name(const std::string& attribute, const std::string& name) {
    if (name == "gauss")
        return ElementKind::gauss;
    if (name == "one-point")
        return ElementKind::one_point;
    laws::reject(attribute, "'" + name + "'", "'gauss' or 'one-point'");
}

template <class Law>
std::unique_ptr<CellBlock> block_of_law(const HexMesh& mesh, const std::vector<int>& cells,
                                        const SolidMaterial& material, ElementKind kind, double hourglass,
                                        const StressAtRest* at_rest) {
    if (kind == ElementKind::gauss)
        return std::make_unique<GaussCells<Law>>(mesh, cells, material, at_rest);
    return std::make_unique<OnePointCells<Law>>(mesh, cells, material, hourglass, at_rest);
}

inline std::unique_ptr<CellBlock> block_of(const HexMesh& mesh, const std::vector<int>& cells,
                                           const SolidMaterial& material, ElementKind kind, double hourglass,
                                           const StressAtRest* at_rest) {
    switch (material.law) {
    case SolidLaw::st_venant:
        return block_of_law<StVenantKirchhoff>(mesh, cells, material, kind, hourglass, at_rest);
    case SolidLaw::neo_hooke:
        return block_of_law<NeoHooke>(mesh, cells, material, kind, hourglass, at_rest);
    case SolidLaw::j2:
        return block_of_law<J2Plasticity>(mesh, cells, material, kind, hourglass, at_rest);
    default:
        return block_of_law<DruckerPrager>(mesh, cells, material, kind, hourglass, at_rest);
    }
}

inline void validate_region(const SolidMaterials& materials, int region, bool is_heavy) {
    const std::string owner = "materials[" + std::to_string(region) + "]";
    const auto found = materials.find(region);
    if (found == materials.end())
        laws::reject("materials", "no entry " + std::to_string(region), "given for every region of the mesh");
    const SolidMaterial& material = found->second;
    validate(material, owner);
    if (material.law == SolidLaw::drucker_prager && material.cohesion == 0 && !is_heavy)
        laws::reject(owner + ".cohesion", material.cohesion,
                     "> 0 without gravity: without both the soil has no strength");
}

// With gravity (m/s^2) what depends on the stress at rest starts from it.
inline std::vector<std::unique_ptr<CellBlock>> cell_blocks(const HexMesh& mesh,
                                                           const SolidMaterials& materials, ElementKind kind,
                                                           double hourglass, const Point& gravity) {
    std::map<int, std::vector<int>> by_region;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
        by_region[mesh.regions[c]].push_back(static_cast<int>(c));
    const bool is_heavy = !gravity.isZero(0);
    for (const auto& entry : by_region)
        validate_region(materials, entry.first, is_heavy);
    std::optional<StressAtRest> at_rest;
    if (is_heavy) {
        if (std::none_of(by_region.begin(), by_region.end(), [&](const auto& entry) {
                return materials.at(entry.first).law == SolidLaw::drucker_prager;
            }))
            laws::reject("gravity", gravity.norm(),
                         "0 without a region of 'drucker-prager', the only law whose "
                         "strength depends on the stress at rest");
        at_rest.emplace(mesh, materials, gravity);
    }
    std::vector<std::unique_ptr<CellBlock>> out;
    for (const auto& [region, cells] : by_region)
        out.push_back(
            block_of(mesh, cells, materials.at(region), kind, hourglass, at_rest ? &*at_rest : nullptr));
    return out;
}

} // namespace grainfall::femlink
