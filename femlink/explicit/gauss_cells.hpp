// SPDX-License-Identifier: GPL-2.0-or-later
// Cells with eight Gauss points and mean dilatation, total Lagrangian.
//
// The volume change in the law is the cell's mean (Simo, Taylor & Pister 1985; Nagtegaal, Parks & Rice 1974):
//
//   Fbar = (theta/J)^(1/3) F,   theta = (1/V) sum_q w_q J_q,   tau_q = tau(Fbar_q)
//
// and the forces are the derivative of sum_q w_q psi(Fbar_q), so that an elastic wall keeps its energy:
//
//   P_q = (dev tau_q / J_q + p I) cof F_q,   p theta V = sum_q w_q tr tau_q / 3
//
// Of the rest only A = (dX/d xi)^-1 Cp^-1 (dX/d xi)^-T is kept at a point (Cp: plastic right Cauchy-Green
// tensor): b_e = H A H^T with H = dx/d xi, and the force on the node a is sum_q w_q P_q (dX/d xi)^-T dN_a/d
// xi with w_q P_q (dX/d xi)^-T = (dev tau_q / J_q + p I) cof H_q.
#pragma once

#include <femlink/explicit/hyperelastic.hpp>
#include <femlink/explicit/rest_cells.hpp>

namespace grainfall::femlink {

inline CellStiffness gauss_stiffness(const CellGradients& corners, const Material& elastic) {
    CellStiffness out = CellStiffness::Zero();
    CellGradients mean = CellGradients::Zero();
    double volume = 0;
    for (const GaussGeometry& point : gauss_geometry(corners)) {
        add_stiffness(point.gradients, point.volume, elastic.mu(), 0, out);
        mean += point.volume * point.gradients;
        volume += point.volume;
    }
    const Eigen::Map<const Eigen::Matrix<double, 24, 1>> divergence(mean.data());
    const double bulk = elastic.lambda() + 2 * elastic.mu() / 3;
    out += bulk / volume * divergence * divergence.transpose();
    return out;
}

template <class Law>
class GaussCells final : public CellBlock {
public:
    GaussCells(const HexMesh& mesh, const std::vector<int>& cells, const SolidMaterial& material,
               const StressAtRest* at_rest)
        : law_(material),
          rest_(rest_cells(mesh, cells, material.elastic.density, [&](const CellGradients& corners) {
              return gauss_stiffness(corners, material.elastic);
          })) {
        for (const int c : cells) {
            const CellGradients corners = corners_of(mesh, c);
            const auto geometry = gauss_geometry(corners);
            for (int q = 0; q < 8; ++q) {
                const GaussGeometry& point = geometry[q];
                const Eigen::Matrix3d inverse = point.jacobian.inverse();
                const Symmetric b = elastic_b_at_rest(law_, at_rest, corners * shape_values(gauss_point(q)));
                const Symmetric a = symmetric_part(inverse * as_eigen(b) * inverse.transpose());
                weights_.push_back(point.volume);
                points_.insert(points_.end(), {a.xx, a.yy, a.zz, a.yz, a.xz, a.xy});
                points_.insert(points_.end(), Law::history, 0.0);
            }
        }
    }

    void add_forces(const double* positions, double* forces) override {
        for (int c = 0; c < rest_.count(); ++c) {
            Deformation now;
            deform(c, positions, now);
            Modes flux{};
            double pressure = 0;
            Symmetric shear[8];
            for (int q = 0; q < 8; ++q) {
                const double weight = weights_[8 * c + q];
                const Symmetric tau = stress(c, q, now, point(c, q));
                pressure += weight * tau.trace();
                shear[q] = (weight / now.determinant[q]) * tau.deviator();
            }
            pressure /= 3 * rest_.volume[c] * now.volume.ratio;
            for (int q = 0; q < 8; ++q)
                add_flux_at(product(plus_identity(shear[q], pressure), now.cofactor[q]), gauss_point(q),
                            flux);
            subtract_scattered(flux, rest_.nodes[c], forces);
        }
    }

    void add_mass(std::vector<double>& mass) const override { add_lumped_mass(rest_, mass); }

    CellEnergies energies(const double* positions) const override {
        CellEnergies out;
        for (int c = 0; c < rest_.count(); ++c) {
            Deformation now;
            deform(c, positions, now);
            for (int q = 0; q < 8; ++q) {
                const double* at = &points_[stride * (8 * c + q)];
                out.elastic += weights_[8 * c + q] * law_.energy(elastic_b(c, q, now, at), now.volume);
                out.plastic += weights_[8 * c + q] * law_.plastic_work(at + 6);
            }
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
            Symmetric sum;
            double plastic = 0, volume = 0;
            for (int q = 0; q < 8; ++q) {
                std::array<double, stride> copy;
                std::copy_n(&points_[stride * (8 * c + q)], stride, copy.begin());
                const double weight = weights_[8 * c + q];
                sum = sum + weight * stress(c, q, now, copy.data());
                volume += now.determinant[q];
                if constexpr (Law::history > 0)
                    plastic += weight * copy[6];
            }
            of_mesh[rest_.in_mesh[c]] = {(1 / volume) * sum, plastic / rest_.volume[c]};
        }
    }

    std::vector<double>& memory() override { return Law::history > 0 ? points_ : nothing_; }

private:
    static constexpr int stride = 6 + Law::history; // A, then the law's own

    struct Deformation {
        Matrix3 gradient[8], cofactor[8]; // of dx/d xi
        double determinant[8];
        Volume volume;
    };

    double* point(int c, int q) { return &points_[static_cast<std::size_t>(stride) * (8 * c + q)]; }

    void deform(int c, const double* positions, Deformation& now) const {
        Modes modes;
        gather_modes(positions, rest_.nodes[c], modes);
        double volume = 0;
        for (int q = 0; q < 8; ++q) {
            now.gradient[q] = gradient_at(modes, gauss_point(q));
            now.cofactor[q] = cofactors(now.gradient[q]);
            now.determinant[q] = determinant(now.gradient[q], now.cofactor[q]);
            if (!(now.determinant[q] > 0))
                report_turned_over(rest_.in_mesh[c], now.determinant[q] / weights_[8 * c + q]);
            volume += now.determinant[q];
        }
        now.volume = Law::volume(volume / rest_.volume[c]);
    }

    // (theta/J)^(2/3), what Fbar Fbar^T has over F F^T.
    double dilation(int c, int q, const Deformation& now) const {
        return two_thirds_power(now.volume.ratio * weights_[8 * c + q] / now.determinant[q]);
    }

    Symmetric elastic_b(int c, int q, const Deformation& now, const double* a) const {
        return dilation(c, q, now) * push(now.gradient[q], {a[0], a[1], a[2], a[3], a[4], a[5]});
    }

    // Kirchhoff stress; what flows at the point is written to it.
    Symmetric stress(int c, int q, const Deformation& now, double* at) const {
        const double scale = dilation(c, q, now);
        Symmetric b = scale * push(now.gradient[q], {at[0], at[1], at[2], at[3], at[4], at[5]});
        if constexpr (Law::history == 0) {
            return law_.stress(b, now.volume, nullptr);
        } else {
            const double before = at[6];
            const Symmetric tau = law_.stress(b, now.volume, at + 6);
            if (at[6] != before) {
                const Symmetric a = (1 / scale) * pull(now.cofactor[q], now.determinant[q], b);
                at[0] = a.xx, at[1] = a.yy, at[2] = a.zz, at[3] = a.yz, at[4] = a.xz, at[5] = a.xy;
            }
            return tau;
        }
    }

    Law law_;
    RestCells rest_;
    std::vector<double> weights_; // m^3 a point: det dX/d xi
    std::vector<double> points_;  // by point
    std::vector<double> nothing_; // of laws without history
};

} // namespace grainfall::femlink
