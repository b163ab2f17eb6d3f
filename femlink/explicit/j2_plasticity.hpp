// SPDX-License-Identifier: GPL-2.0-or-later
// J2 plasticity with linear isotropic hardening in logarithmic elastic strain e = (1/2) ln b_e (Simo & Hughes
// 1998, chapter 9; de Souza Neto, Peric & Owen 2008, section 14.4), Kirchhoff stress
//
//   tau = K ln J I + 2 mu dev e,   sqrt(3/2) |dev tau| <= sigma_y + H alpha
//
// alpha: equivalent plastic strain. The step is implicit (radial return along dev e, closed form) and keeps
// plastic flow free of volume change to rounding. Rate independent, no kinematic hardening.
#pragma once

#include <femlink/explicit/hyperelastic.hpp>

namespace grainfall::femlink {

class J2Plasticity {
public:
    static constexpr int history = 1; // alpha
    static constexpr bool knows_stress_at_rest = false;

    explicit J2Plasticity(const SolidMaterial& m)
        : mu_(m.elastic.mu()), bulk_(m.elastic.lambda() + 2 * m.elastic.mu() / 3),
          yield_stress_(m.yield_stress), hardening_(m.hardening) {}

    static Volume volume(double ratio) { return {ratio, std::log(ratio), 1 / two_thirds_power(ratio)}; }
    Symmetric stress(Symmetric& b, const Volume& j, double* alpha) const {
        Symmetric strain = half_logarithm(j.unimodular * b).deviator();
        const double size = std::sqrt(contraction(strain, strain));
        const double excess = root_6 * mu_ * size - (yield_stress_ + hardening_ * *alpha);
        if (excess > 0) {
            const double flow = excess / (3 * mu_ + hardening_); // increment of alpha
            const Symmetric plastic = (flow / (root_2_3 * size)) * strain;
            strain = strain - plastic;
            b = coaxial_product(b, exponential(-2 * plastic));
            *alpha += flow;
        }
        return plus_identity(2 * mu_ * strain, bulk_ * j.logarithm);
    }

    double energy(const Symmetric& b, const Volume& j) const {
        const Symmetric strain = half_logarithm(j.unimodular * b).deviator();
        return 0.5 * bulk_ * j.logarithm * j.logarithm + mu_ * contraction(strain, strain);
    }
    // Integral of the yield stress over alpha.
    double plastic_work(const double* alpha) const {
        return (yield_stress_ + 0.5 * hardening_ * *alpha) * *alpha;
    }
    // Elastic strain is small but for its volume; the stress adds to the stiffness by at most itself.
    double wave_factor(double least, double, double log_volume) const {
        return (1 + std::abs(log_volume) + yield_stress_ / bulk_) / (least * least);
    }

private:
    static constexpr double root_6 = 2.449489742783178, root_2_3 = 0.816496580927726;
    double mu_, bulk_, yield_stress_, hardening_;
};

} // namespace grainfall::femlink
