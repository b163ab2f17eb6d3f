// SPDX-License-Identifier: GPL-2.0-or-later
#include "femlink_flat_wall.hpp"

#include <femlink/core/hex_mesh.hpp>
#include <femlink/core/wall_model.hpp>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace {

using namespace grainfall::femlink;

class WallFile : public ::testing::Test {
protected:
    WallFile()
        : folder(std::filesystem::temp_directory_path() /
                 ("grainfall_wall_file_" + std::to_string(getpid()))),
          path((folder / "wall.gfw").string()) {
        std::filesystem::create_directories(folder);
        const FlatWall flat(3, 0.01);
        model.key = "0123456789abcdef";
        model.description = "flat";
        model.surface = flat.surface;
        model.compliance = flat.compliance;
        model.preload = 1e-6 * flat.surface.nodes;
        save_wall(model, path);
    }
    ~WallFile() override { std::filesystem::remove_all(folder); }

    std::string refusal() const {
        try {
            load_wall(path);
        } catch (const std::exception& error) {
            const std::string text = error.what();
            return text.substr(text.find("': ") + 3);
        }
        return "nothing was thrown";
    }

    std::filesystem::path folder;
    std::string path;
    WallModel model;
};

TEST_F(WallFile, gives_back_what_was_saved_to_the_last_bit) {
    const WallModel again = load_wall(path);
    EXPECT_EQ(again.key, model.key);
    EXPECT_EQ(again.description, model.description);
    EXPECT_EQ(again.surface.degree, 1);
    EXPECT_EQ(again.surface.nodes, model.surface.nodes);
    EXPECT_EQ(again.surface.loose, model.surface.loose);
    EXPECT_EQ(again.surface.faces, model.surface.faces);
    EXPECT_EQ(again.surface.neighbours, model.surface.neighbours);
    EXPECT_EQ(again.preload, model.preload);
    EXPECT_EQ(again.compliance.triangularView<Eigen::Lower>().toDenseMatrix(),
              model.compliance.triangularView<Eigen::Lower>().toDenseMatrix());
    EXPECT_EQ(again.compliance, again.compliance.transpose());
}

TEST_F(WallFile, keeps_half_of_the_compliance_and_leaves_nothing_else_behind) {
    const auto values =
        static_cast<std::uintmax_t>(model.compliance.rows()) * (model.compliance.rows() + 1) / 2;
    EXPECT_LT(std::filesystem::file_size(path), values * sizeof(double) + 3000);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1);
}

TEST_F(WallFile, damaged_anywhere_is_refused) {
    const auto size = std::filesystem::file_size(path);
    for (std::uintmax_t at = 8; at < size; at += size / 40) {
        std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
        file.seekg(static_cast<std::streamoff>(at));
        const char before = static_cast<char>(file.get());
        file.seekp(static_cast<std::streamoff>(at));
        file.put(static_cast<char>(before ^ 0x55));
        file.close();
        EXPECT_NE(refusal(), "nothing was thrown") << at;
        std::fstream mend(path, std::ios::in | std::ios::out | std::ios::binary);
        mend.seekp(static_cast<std::streamoff>(at));
        mend.put(before);
    }
    EXPECT_EQ(refusal(), "nothing was thrown");
}

TEST_F(WallFile, cut_short_foreign_or_missing_is_refused_in_one_sentence) {
    std::filesystem::resize_file(path, std::filesystem::file_size(path) - 100);
    EXPECT_EQ(refusal(), "it ends too early; build the wall anew");
    std::ofstream(path) << "something else";
    EXPECT_EQ(refusal(), "not a wall file of this version");
    std::filesystem::remove(path);
    EXPECT_EQ(refusal(), "cannot be read");
}

double volume(const HexMesh& mesh) {
    double sum = 0;
    for (const auto& cell : mesh.cells)
        sum += (mesh.vertices[cell[7]] - mesh.vertices[cell[0]]).prod();
    return sum;
}

double area(const HexMesh& mesh, int id) {
    double sum = 0;
    for (const auto& face : mesh.boundary) {
        if (face.id != id)
            continue;
        const Point a = mesh.vertices[face.corners[1]] - mesh.vertices[face.corners[0]];
        const Point b = mesh.vertices[face.corners[2]] - mesh.vertices[face.corners[0]];
        sum += a.cross(b).norm();
    }
    return sum;
}

TEST(HexMesh, box_has_its_volume_and_its_boundaries) {
    const HexMesh held = box({0.3, 0.2, 0.1}, {6, 4, 3}, Held::all_but_top);
    EXPECT_NO_THROW(validate(held));
    EXPECT_NEAR(volume(held), 0.006, 1e-15);
    EXPECT_NEAR(area(held, coupling_surface), 0.06, 1e-15);
    EXPECT_NEAR(area(held, outer_fixed), 0.06 + 2 * 0.1 * 0.5, 1e-15);
    EXPECT_NEAR(area(box({0.3, 0.2, 0.1}, {6, 4, 3}, Held::bottom), outer_fixed), 0.06, 1e-15);
}

TEST(HexMesh, half_space_block_is_even_under_its_patch_and_graded_beyond) {
    const HexMesh mesh = half_space_block(0.02, 1, 0.005, 1.4, false);
    EXPECT_NO_THROW(validate(mesh));
    EXPECT_NEAR(volume(mesh), 4, 1e-12);
    EXPECT_NEAR(area(mesh, coupling_surface), 0.04 * 0.04, 1e-15);
    EXPECT_NEAR(area(half_space_block(0.02, 1, 0.005, 1.4, true), coupling_surface), 4, 1e-12);
    EXPECT_NEAR(area(mesh, outer_fixed), 4 + 4 * 2, 1e-12);
    EXPECT_LT(mesh.cells.size(), 20000u); // an even mesh would have 32 million
}

TEST(HexMesh, container_has_a_cavity_whose_floor_and_walls_couple) {
    const HexMesh mesh = container({0.3, 0.15, 0.2}, 0.25, 0.05, 1.5);
    EXPECT_NO_THROW(validate(mesh));
    EXPECT_NEAR(volume(mesh), 0.8 * 0.65 * 0.45 - 0.3 * 0.15 * 0.2, 1e-14);
    EXPECT_NEAR(area(mesh, coupling_surface), 0.3 * 0.15 + 2 * 0.2 * (0.3 + 0.15), 1e-14);
    EXPECT_NEAR(area(mesh, outer_fixed), 0.8 * 0.65 + 2 * 0.45 * (0.8 + 0.65), 1e-14);
}

template <class Action>
std::string complaint(Action&& action) {
    try {
        action();
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "nothing was thrown";
}

TEST(HexMesh, that_no_wall_can_be_made_of_is_refused_in_one_sentence) {
    const HexMesh good = box({1, 1, 1}, {2, 2, 2}, Held::bottom);
    HexMesh mesh = good;
    std::swap(mesh.cells[3][0], mesh.cells[3][1]);
    EXPECT_EQ(complaint([&] { validate(mesh); }),
              "cells[3] = an inverted or flat cell: must be a convex hexahedron with right-handed corners");
    mesh = good;
    for (auto& face : mesh.boundary)
        face.id = coupling_surface;
    EXPECT_EQ(complaint([&] { validate(mesh); }), "fixed boundary = no face: must be at least one face of "
                                                  "the mesh (boundary id 1): the wall would fly away");
    for (auto& face : mesh.boundary)
        face.id = outer_fixed;
    EXPECT_EQ(complaint([&] { validate(mesh); }), "coupling surface = no face: must be at least one face of "
                                                  "the mesh (boundary id 2): no grain could touch "
                                                  "the wall");
    mesh = good;
    mesh.cells[0][2] = 99;
    EXPECT_EQ(complaint([&] { validate(mesh); }), "cells[0] = 99: must be an index of a vertex, 0 to 26");
    EXPECT_EQ(complaint([] {
                  box({1, -1, 1}, {2, 2, 2}, Held::bottom);
              }),
              "size[1] = -1: must be > 0 and finite");
    EXPECT_EQ(complaint([] { half_space_block(1, 0.5, 0.1, 1.2, false); }),
              "reach = 0.5: must be above patch and finite");
}

TEST(WallKey, changes_with_mesh_material_degree_and_loads_and_with_nothing_else) {
    const HexMesh mesh = box({1, 1, 1}, {2, 2, 2}, Held::bottom);
    const Materials sand = {{0, {20e6, 0.3, 1600}}};
    const auto key = [](const HexMesh& m, const Materials& materials, int degree, double g) {
        return wall_key(hash_of(m, materials, degree), {0, 0, g}, Point::Zero());
    };
    const std::string plain = key(mesh, sand, 1, 0);
    EXPECT_EQ(plain, key(box({1, 1, 1}, {2, 2, 2}, Held::bottom), sand, 1, 0));
    EXPECT_NE(plain, key(box({1, 1, 1}, {2, 2, 2}, Held::all_but_top), sand, 1, 0));
    EXPECT_NE(plain, key(box({1, 1, 1.001}, {2, 2, 2}, Held::bottom), sand, 1, 0));
    EXPECT_NE(plain, key(mesh, {{0, {20e6, 0.31, 1600}}}, 1, 0));
    EXPECT_NE(plain, key(mesh, sand, 2, 0));
    EXPECT_NE(plain, key(mesh, sand, 1, -9.81));
}

} // namespace
