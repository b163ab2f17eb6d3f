// SPDX-License-Identifier: GPL-2.0-or-later
// All that a run needs of a wall, and its file: surface, condensed compliance, displacement under the loads
// that are not grains (gravity, surface loads). Written once; who reads it needs no finite-element library.
//
// File: 8 bytes "GFWALL01", then in the machine's own binary form (little endian): key and description
// (length, bytes), degree, nodes, loose numbers, faces, preload, lower triangle of C by columns, and a
// checksum (FNV-1a, 64 bit) of all before it.
#pragma once

#include <femlink/core/surface.hpp>
#include <femlink/core/wall_key.hpp>

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string>

#include <unistd.h>

namespace grainfall::femlink {

struct WallModel {
    std::string key;         // of mesh, materials and loads: the same key, the same wall
    std::string description; // free text
    Surface surface;
    Eigen::MatrixXd compliance; // m/N, three rows a loose node
    Positions preload;          // m, displacement of the surface's nodes before any grain touches it
};

namespace detail {

inline constexpr char wall_magic[9] = "GFWALL01";

// The same sequence of fields for writing and for reading.
template <class Archive, class Model>
void wall_fields(Archive& archive, Model& model) {
    archive.text(model.key);
    archive.text(model.description);
    archive.number(model.surface.degree);
    archive.matrix(model.surface.nodes);
    archive.list(model.surface.loose);
    archive.matrix(model.surface.faces);
    archive.matrix(model.preload);
    archive.triangle(model.compliance);
}

class WallWriter {
public:
    explicit WallWriter(std::ofstream& file) : file_(file) {}
    void bytes(const void* data, std::size_t size) {
        sum_.add(data, size);
        file_.write(static_cast<const char*>(data), static_cast<std::streamsize>(size));
    }
    template <class Number>
    void number(const Number& value) {
        const std::int64_t wide = value;
        bytes(&wide, sizeof wide);
    }
    void text(const std::string& value) {
        number(value.size());
        bytes(value.data(), value.size());
    }
    void list(const std::vector<int>& value) {
        number(value.size());
        bytes(value.data(), value.size() * sizeof(int));
    }
    template <class Matrix>
    void matrix(const Matrix& value) {
        number(value.rows());
        number(value.cols());
        bytes(value.data(), value.size() * sizeof(typename Matrix::Scalar));
    }
    void triangle(const Eigen::MatrixXd& value) {
        number(value.rows());
        for (Eigen::Index j = 0; j < value.cols(); ++j)
            bytes(value.data() + j * value.rows() + j, (value.rows() - j) * sizeof(double));
    }
    std::uint64_t sum() const { return sum_.value(); }

private:
    std::ofstream& file_;
    Fnv1a sum_;
};

class WallReader {
public:
    WallReader(std::ifstream& file, std::string path, std::uint64_t size)
        : file_(file), path_(std::move(path)), left_(size) {}
    [[noreturn]] void refuse(const std::string& why) const {
        throw std::runtime_error("wall file '" + path_ + "': " + why);
    }
    void bytes(void* data, std::size_t size) {
        if (size > left_ || !file_.read(static_cast<char*>(data), static_cast<std::streamsize>(size)))
            refuse("it ends too early; build the wall anew");
        left_ -= size;
        sum_.add(data, size);
    }
    template <class Number>
    void number(Number& value) {
        std::int64_t wide;
        bytes(&wide, sizeof wide);
        value = static_cast<Number>(wide);
    }
    // A length that the file cannot hold would otherwise be memory asked for in vain.
    std::size_t length(std::size_t element) {
        std::int64_t value;
        number(value);
        if (value < 0 || static_cast<std::uint64_t>(value) > left_ / element)
            refuse("it is damaged; build the wall anew");
        return static_cast<std::size_t>(value);
    }
    void text(std::string& value) {
        value.resize(length(1));
        bytes(value.data(), value.size());
    }
    void list(std::vector<int>& value) {
        value.resize(length(sizeof(int)));
        bytes(value.data(), value.size() * sizeof(int));
    }
    template <class Matrix>
    void matrix(Matrix& value) {
        const std::size_t rows = length(1), columns = length(1);
        constexpr int fixed_rows = Matrix::RowsAtCompileTime;
        if ((fixed_rows != Eigen::Dynamic && rows != static_cast<std::size_t>(fixed_rows)) ||
            (rows > 0 && columns > left_ / rows / sizeof(typename Matrix::Scalar)))
            refuse("it is damaged; build the wall anew");
        value.resize(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns));
        bytes(value.data(), value.size() * sizeof(typename Matrix::Scalar));
    }
    void triangle(Eigen::MatrixXd& value) {
        const std::size_t n = length(1);
        if (n > 0 && (n + 1) / 2 > left_ / n / sizeof(double))
            refuse("it is damaged; build the wall anew");
        value.resize(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(n));
        for (Eigen::Index j = 0; j < value.cols(); ++j)
            bytes(value.data() + j * value.rows() + j, (value.rows() - j) * sizeof(double));
        value.triangularView<Eigen::StrictlyUpper>() = value.transpose();
    }
    std::uint64_t sum() const { return sum_.value(); }

private:
    std::ifstream& file_;
    std::string path_;
    std::uint64_t left_;
    Fnv1a sum_;
};

} // namespace detail

// Throws std::runtime_error. Written beside and moved into place: a run that reads meanwhile sees all or
// nothing.
inline void save_wall(const WallModel& model, const std::string& path) {
    const std::string partial = path + "." + std::to_string(getpid()) + ".partial";
    {
        std::ofstream file(partial, std::ios::binary);
        detail::WallWriter writer(file);
        file.write(detail::wall_magic, 8);
        detail::wall_fields(writer, model);
        const std::uint64_t sum = writer.sum();
        file.write(reinterpret_cast<const char*>(&sum), sizeof sum);
        file.flush();
        if (!file)
            throw std::runtime_error("wall file '" + path + "': cannot be written");
    }
    if (std::rename(partial.c_str(), path.c_str()) != 0)
        throw std::runtime_error("wall file '" + path + "': cannot be written");
}

inline WallModel load_wall(const std::string& path) {
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    if (!file)
        throw std::runtime_error("wall file '" + path + "': cannot be read");
    const auto size = static_cast<std::uint64_t>(file.tellg());
    file.seekg(0);
    char magic[8] = {};
    file.read(magic, 8);
    if (std::memcmp(magic, detail::wall_magic, 8) != 0)
        throw std::runtime_error("wall file '" + path + "': not a wall file of this version");
    detail::WallReader reader(file, path, size - 8);
    WallModel model;
    detail::wall_fields(reader, model);
    std::uint64_t sum = 0;
    file.read(reinterpret_cast<char*>(&sum), sizeof sum);
    if (!file || sum != reader.sum())
        reader.refuse("its checksum is wrong; build the wall anew");
    validate(model.surface);
    if (model.compliance.rows() != 3 * model.surface.loose_count() ||
        model.preload.cols() != model.surface.nodes.cols())
        reader.refuse("its parts do not fit together; build the wall anew");
    model.surface.connect();
    return model;
}

} // namespace grainfall::femlink
