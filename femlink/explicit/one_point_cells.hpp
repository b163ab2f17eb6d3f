// SPDX-License-Identifier: GPL-2.0-or-later
// Cells with one integration point and hourglass control, total Lagrangian (Flanagan & Belytschko 1981).
//
// F is the cell's mean gradient, exact for the patch test on any cell. Motions of the nodes that leave F
// alone (hourglass) are held by springs on their amplitudes
//
//   q_k = m_k(x) - F m_k(X),   k = XY, XZ, YZ, XYZ (modes of trilinear.hpp)
//
// which vanish in every homogeneous deformation, rotations among them. Stiffness: `hourglass` mu (8/3) V s
// with s the squared inverse length of the cell; with hourglass = 1 a cube resists the modes that are pure
// shear as the exact integral does.
#pragma once

#include <femlink/explicit/hyperelastic.hpp>
#include <femlink/explicit/rest_cells.hpp>

namespace grainfall::femlink {

struct OnePointGeometry {
    double gradient[Modes::count][3]; // F = sum_k m_k(x) gradient_k
    double offset[4][3];              // m_k(X) of the hourglass modes, m
    double stiffness;                 // of the hourglass springs, N/m
};

inline constexpr int hourglass_modes[4] = {Modes::xy, Modes::xz, Modes::yz, Modes::xyz};

inline CellGradients mean_gradients(const CellGradients& corners) {
    CellGradients mean = CellGradients::Zero();
    double volume = 0;
    for (const GaussGeometry& point : gauss_geometry(corners)) {
        mean += point.volume * point.gradients;
        volume += point.volume;
    }
    return mean / volume;
}

// Sign of a mode at a corner.
inline double mode_sign(int mode, int corner) {
    const double x = corner & 1 ? 1 : -1, y = corner & 2 ? 1 : -1, z = corner & 4 ? 1 : -1;
    const double signs[Modes::count] = {x, y, z, x * y, x * z, y * z, x * y * z};
    return signs[mode];
}

inline OnePointGeometry one_point_geometry(const CellGradients& corners, double mu, double hourglass) {
    const CellGradients mean = mean_gradients(corners);
    OnePointGeometry out{};
    for (int mode = 0; mode < Modes::count; ++mode)
        for (int d = 0; d < 3; ++d)
            for (int k = 0; k < 8; ++k)
                out.gradient[mode][d] += mode_sign(mode, k) * mean(d, k);
    for (int h = 0; h < 4; ++h)
        for (int d = 0; d < 3; ++d)
            for (int k = 0; k < 8; ++k)
                out.offset[h][d] += 0.125 * mode_sign(hourglass_modes[h], k) * corners(d, k);
    double volume = 0;
    for (const double part : nodal_volumes(corners))
        volume += part;
    out.stiffness = hourglass * mu * (8.0 / 3) * volume * mean.squaredNorm() / 1.5;
    return out;
}

inline CellStiffness one_point_stiffness(const CellGradients& corners, const Material& elastic,
                                         double hourglass) {
    CellStiffness out = CellStiffness::Zero();
    const CellGradients mean = mean_gradients(corners);
    const OnePointGeometry geometry = one_point_geometry(corners, elastic.mu(), hourglass);
    double volume = 0;
    for (const double part : nodal_volumes(corners))
        volume += part;
    add_stiffness(mean, volume, elastic.mu(), elastic.lambda() + 2 * elastic.mu() / 3, out);
    for (int h = 0; h < 4; ++h) {
        const Eigen::Vector3d offset(geometry.offset[h][0], geometry.offset[h][1], geometry.offset[h][2]);
        Eigen::Matrix<double, 8, 1> shape;
        for (int k = 0; k < 8; ++k)
            shape[k] = 0.125 * mode_sign(hourglass_modes[h], k) - mean.col(k).dot(offset);
        for (int b = 0; b < 8; ++b)
            for (int a = 0; a < 8; ++a)
                out.block<3, 3>(3 * a, 3 * b).diagonal().array() += geometry.stiffness * shape[a] * shape[b];
    }
    return out;
}

template <class Law>
class OnePointCells final : public CellBlock {
public:
    OnePointCells(const HexMesh& mesh, const std::vector<int>& cells, const SolidMaterial& material,
                  double hourglass, const StressAtRest* at_rest)
        : law_(material),
          rest_(rest_cells(mesh, cells, material.elastic.density, [&](const CellGradients& corners) {
              return one_point_stiffness(corners, material.elastic, hourglass);
          })) {
        for (const int c : cells) {
            geometry_.push_back(one_point_geometry(corners_of(mesh, c), material.elastic.mu(), hourglass));
            const Symmetric b = elastic_b_at_rest(law_, at_rest, corners_of(mesh, c).rowwise().mean());
            points_.insert(points_.end(), {b.xx, b.yy, b.zz, b.yz, b.xz, b.xy});
            points_.insert(points_.end(), Law::history, 0.0);
        }
    }

    void add_forces(const double* positions, double* forces) override {
        for (int c = 0; c < rest_.count(); ++c) {
            const OnePointGeometry& g = geometry_[c];
            Deformation now;
            deform(c, positions, now);
            const Symmetric tau = stress(now, &points_[static_cast<std::size_t>(stride) * c]);
            // V P = V tau F^-T, less what the springs do on the gradient.
            Matrix3 first = product((rest_.volume[c] / now.volume.ratio) * tau, now.cofactor);
            Modes flux{};
            for (int h = 0; h < 4; ++h) {
                for (int d = 0; d < 3; ++d) {
                    const double force = g.stiffness * now.hourglass[h][d];
                    flux.m[hourglass_modes[h]][d] = force;
                    for (int j = 0; j < 3; ++j)
                        first.c[j][d] -= force * g.offset[h][j];
                }
            }
            for (int mode = 0; mode < Modes::count; ++mode)
                for (int d = 0; d < 3; ++d)
                    flux.m[mode][d] += first.c[0][d] * g.gradient[mode][0] +
                                       first.c[1][d] * g.gradient[mode][1] +
                                       first.c[2][d] * g.gradient[mode][2];
            subtract_scattered(flux, rest_.nodes[c], forces);
        }
    }

    void add_mass(std::vector<double>& mass) const override { add_lumped_mass(rest_, mass); }

    CellEnergies energies(const double* positions) const override {
        CellEnergies out;
        for (int c = 0; c < rest_.count(); ++c) {
            Deformation now;
            deform(c, positions, now);
            const double* at = &points_[static_cast<std::size_t>(stride) * c];
            out.elastic += rest_.volume[c] * law_.energy(push(now.gradient, symmetric(at)), now.volume);
            out.plastic += rest_.volume[c] * law_.plastic_work(at + 6);
            for (const auto& amplitude : now.hourglass)
                for (const double component : amplitude)
                    out.hourglass += 0.5 * geometry_[c].stiffness * component * component;
        }
        return out;
    }

    double largest_frequency(const double* positions) const override {
        return femlink::largest_frequency(rest_, law_, positions);
    }

    void states(const double* positions, std::vector<CellState>& of_mesh) const override {
        for (int c = 0; c < rest_.count(); ++c) {
            Deformation now;
            deform(c, positions, now);
            std::array<double, stride> copy;
            std::copy_n(&points_[static_cast<std::size_t>(stride) * c], stride, copy.begin());
            const Symmetric tau = stress(now, copy.data());
            double plastic = 0;
            if constexpr (Law::history > 0)
                plastic = copy[6];
            of_mesh[rest_.in_mesh[c]] = {(1 / now.volume.ratio) * tau, plastic};
        }
    }

    std::vector<double>& memory() override { return Law::history > 0 ? points_ : nothing_; }

private:
    static constexpr int stride = 6 + Law::history; // Cp^-1, then the law's own

    struct Deformation {
        Matrix3 gradient, cofactor; // of F
        Volume volume;
        double hourglass[4][3];
    };

    static Symmetric symmetric(const double* a) { return {a[0], a[1], a[2], a[3], a[4], a[5]}; }

    void deform(int c, const double* positions, Deformation& now) const {
        const OnePointGeometry& g = geometry_[c];
        Modes modes;
        gather_modes(positions, rest_.nodes[c], modes);
        for (int j = 0; j < 3; ++j) {
            for (int d = 0; d < 3; ++d) {
                double sum = 0;
                for (int mode = 0; mode < Modes::count; ++mode)
                    sum += modes.m[mode][d] * g.gradient[mode][j];
                now.gradient.c[j][d] = sum;
            }
        }
        for (int h = 0; h < 4; ++h)
            for (int d = 0; d < 3; ++d)
                now.hourglass[h][d] = modes.m[hourglass_modes[h]][d] - now.gradient.c[0][d] * g.offset[h][0] -
                                      now.gradient.c[1][d] * g.offset[h][1] -
                                      now.gradient.c[2][d] * g.offset[h][2];
        now.cofactor = cofactors(now.gradient);
        const double ratio = determinant(now.gradient, now.cofactor);
        if (!(ratio > 0))
            report_turned_over(rest_.in_mesh[c], ratio);
        now.volume = Law::volume(ratio);
    }

    Symmetric stress(const Deformation& now, double* at) const {
        Symmetric b = push(now.gradient, symmetric(at));
        if constexpr (Law::history == 0) {
            return law_.stress(b, now.volume, nullptr);
        } else {
            const double before = at[6];
            const Symmetric tau = law_.stress(b, now.volume, at + 6);
            if (at[6] != before) {
                const Symmetric a = pull(now.cofactor, now.volume.ratio, b);
                at[0] = a.xx, at[1] = a.yy, at[2] = a.zz, at[3] = a.yz, at[4] = a.xz, at[5] = a.xy;
            }
            return tau;
        }
    }

    Law law_;
    RestCells rest_;
    std::vector<OnePointGeometry> geometry_;
    std::vector<double> points_;  // by cell
    std::vector<double> nothing_; // of laws without history
};

} // namespace grainfall::femlink
