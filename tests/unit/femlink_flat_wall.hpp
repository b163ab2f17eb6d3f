// SPDX-License-Identifier: GPL-2.0-or-later
// A flat wall whose compliance is known in closed form: no finite elements.
//
// Nodes on a square grid of spacing h; under a unit force at a node every node moves as the surface of a
// half-space does at that distance (Boussinesq and Cerruti, Johnson 1985, section 3.2 and 3.6), and at the
// node itself as under a uniformly loaded disc of radius 0.51 h.
#pragma once

#include <femlink/core/compliance.hpp>

#include <cmath>
#include <stdexcept>

namespace grainfall::femlink {

struct HalfSpace {
    double young = 20e6, poisson = 0.3; // loose sand at small strain: 20 MPa

    Eigen::Matrix3d surface_response(const Point& from) const {
        constexpr double pi = 3.14159265358979323846;
        const double r = from.norm(), x = from[0] / r, y = from[1] / r;
        const double factor = (1 + poisson) / (pi * young * r);
        const double k = 0.5 * (1 - 2 * poisson);
        Eigen::Matrix3d response;
        response << 1 - poisson + poisson * x * x, poisson * x * y, k * x, //
            poisson * x * y, 1 - poisson + poisson * y * y, k * y,         //
            -k * x, -k * y, 1 - poisson;
        return factor * response;
    }
};

struct FlatWall {
    Surface surface;
    Eigen::MatrixXd compliance;

    FlatWall(int cells, double spacing, const HalfSpace& ground = {}) {
        const int n = cells + 1;
        surface.nodes.resize(3, n * n);
        surface.faces.resize(4, cells * cells);
        for (int j = 0; j < n; ++j) {
            for (int i = 0; i < n; ++i) {
                surface.nodes.col(i + n * j) << spacing * (i - 0.5 * cells), spacing * (j - 0.5 * cells), 0;
                surface.loose.push_back(i + n * j);
                if (i < cells && j < cells)
                    surface.faces.col(i + cells * j) << i + n * j, i + 1 + n * j, i + n * (j + 1),
                        i + 1 + n * (j + 1);
            }
        }
        surface.connect();
        compliance.resize(3 * n * n, 3 * n * n);
        for (int b = 0; b < n * n; ++b)
            for (int a = 0; a < n * n; ++a)
                compliance.block<3, 3>(3 * a, 3 * b) = response(a, b, spacing, ground);
    }

    // Contact at a place of the plane.
    ContactSite site(double x, double y, double patch) const {
        for (int face = 0; face < surface.face_count(); ++face) {
            const FaceNodes<1> nodes = surface.face<1>(face, surface.nodes);
            const Point low = nodes.col(0), high = nodes.col(3);
            if (x < low[0] - 1e-12 || x > high[0] + 1e-12 || y < low[1] - 1e-12 || y > high[1] + 1e-12)
                continue;
            const Reference at(2 * (x - low[0]) / (high[0] - low[0]) - 1,
                               2 * (y - low[1]) / (high[1] - low[1]) - 1);
            return {contact_patch(surface, surface.nodes, face, at.cwiseMax(-1.0).cwiseMin(1.0), patch),
                    contact_axes(Point::UnitZ())};
        }
        throw std::logic_error("no face there");
    }

private:
    Eigen::Matrix3d response(int a, int b, double spacing, const HalfSpace& ground) const {
        const Point from = surface.nodes.col(a) - surface.nodes.col(b);
        if (a != b)
            return ground.surface_response(from);
        // A disc of radius r sinks by as much as a point at a distance of 0.59 r; mean over directions.
        Eigen::Matrix3d own =
            ground.surface_response({0.3 * spacing, 0, 0}) + ground.surface_response({0, 0.3 * spacing, 0});
        return Eigen::Matrix3d((0.5 * own).diagonal().asDiagonal());
    }
};

} // namespace grainfall::femlink
