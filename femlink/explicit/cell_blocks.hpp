// SPDX-License-Identifier: GPL-2.0-or-later
// The cells of a mesh as blocks, one a region, each with the element and the law compiled for each other.
#pragma once

#include <femlink/explicit/drucker_prager.hpp>
#include <femlink/explicit/gauss_cells.hpp>
#include <femlink/explicit/j2_plasticity.hpp>
#include <femlink/explicit/one_point_cells.hpp>

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
                                        const SolidMaterial& material, ElementKind kind, double hourglass) {
    if (kind == ElementKind::gauss)
        return std::make_unique<GaussCells<Law>>(mesh, cells, material);
    return std::make_unique<OnePointCells<Law>>(mesh, cells, material, hourglass);
}

inline std::unique_ptr<CellBlock> block_of(const HexMesh& mesh, const std::vector<int>& cells,
                                           const SolidMaterial& material, ElementKind kind,
                                           double hourglass) {
    switch (material.law) {
    case SolidLaw::st_venant:
        return block_of_law<StVenantKirchhoff>(mesh, cells, material, kind, hourglass);
    case SolidLaw::neo_hooke:
        return block_of_law<NeoHooke>(mesh, cells, material, kind, hourglass);
    case SolidLaw::j2:
        return block_of_law<J2Plasticity>(mesh, cells, material, kind, hourglass);
    default:
        return block_of_law<DruckerPrager>(mesh, cells, material, kind, hourglass);
    }
}

inline std::vector<std::unique_ptr<CellBlock>>
cell_blocks(const HexMesh& mesh, const SolidMaterials& materials, ElementKind kind, double hourglass) {
    std::map<int, std::vector<int>> by_region;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
        by_region[mesh.regions[c]].push_back(static_cast<int>(c));
    std::vector<std::unique_ptr<CellBlock>> out;
    for (const auto& [region, cells] : by_region) {
        const std::string owner = "materials[" + std::to_string(region) + "]";
        const auto found = materials.find(region);
        if (found == materials.end())
            laws::reject("materials", "no entry " + std::to_string(region),
                         "given for every region of the mesh");
        validate(found->second, owner);
        out.push_back(block_of(mesh, cells, found->second, kind, hourglass));
    }
    return out;
}

} // namespace grainfall::femlink
