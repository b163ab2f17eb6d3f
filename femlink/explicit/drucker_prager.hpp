// SPDX-License-Identifier: GPL-2.0-or-later
// Drucker & Prager's soil in logarithmic elastic strain e = (1/2) ln b_e, without hardening (de Souza Neto,
// Peric & Owen 2008, sections 6.4.2, 8.3.3 and 14.4): Kirchhoff stress tau = K tr e I + 2 mu dev e,
//
//   sqrt(J2) + eta p <= xi c,   p = tr tau / 3 (tension positive),   J2 = dev tau : dev tau / 2
//
//   eta = 6 sin phi / (sqrt 3 (3 - sin phi)),   xi = 6 cos phi / (sqrt 3 (3 - sin phi))
//
// which is Mohr and Coulomb's strength in triaxial compression; flow with the dilatancy psi in the place of
// phi. Where the return to the cone overshoots its axis the stress is the apex, p = xi c / eta.
#pragma once

#include <femlink/explicit/hyperelastic.hpp>
#include <femlink/explicit/stress_at_rest.hpp>

namespace grainfall::femlink {

class DruckerPrager {
public:
    static constexpr int history = 3; // equivalent plastic strain; plastic work, Pa; its rate over the flow
                                      // while the point flows, else 0, Pa
    static constexpr bool knows_stress_at_rest = true;

    explicit DruckerPrager(const SolidMaterial& m)
        : mu_(m.elastic.mu()), bulk_(m.elastic.lambda() + 2 * m.elastic.mu() / 3),
          eta_(slope(m.friction_angle)), flow_eta_(slope(m.dilatancy)),
          strength_(6 * std::cos(m.friction_angle) / denominator(m.friction_angle) * m.cohesion),
          rest_ratio_(earth_pressure_at_rest(m.friction_angle)) {}

    static Volume volume(double ratio) { return {ratio}; }
    // b that goes with the stress of rest there.
    Symmetric b_at_rest(const StressAtRest& rest, const Point& at) const {
        const Symmetric tau = rest.stress(at, rest_ratio_);
        return exponential(plus_identity((1 / mu_) * tau.deviator(), 2 * tau.trace() / (9 * bulk_)));
    }

    Symmetric stress(Symmetric& b, const Volume&, double* at) const {
        const Symmetric strain = half_logarithm(b);
        const Symmetric shape = strain.deviator();
        const double pressure = bulk_ * strain.trace();
        const double root_j2 = mu_ * std::sqrt(2 * contraction(shape, shape));
        const double excess = root_j2 + eta_ * pressure - strength_;
        if (!(excess > 0)) {
            at[2] = 0;
            return plus_identity(2 * mu_ * shape, pressure);
        }

        const double flow = excess / (mu_ + bulk_ * eta_ * flow_eta_);
        const bool on_cone = root_j2 - mu_ * flow >= 0 || eta_ == 0;
        const double kept = on_cone ? 1 - mu_ * flow / root_j2 : 0;
        const double new_pressure = on_cone ? pressure - bulk_ * flow_eta_ * flow : strength_ / eta_;
        const Symmetric plastic = plus_identity((1 - kept) * shape, (pressure - new_pressure) / (3 * bulk_));
        const Symmetric tau = plus_identity((2 * mu_ * kept) * shape, new_pressure);
        b = coaxial_product(b, exponential(-2 * plastic));
        at[0] += root_2_3 * std::sqrt(contraction(plastic, plastic));
        add_work(at, contraction(tau, plastic), flow);
        return tau;
    }

    double energy(const Symmetric& b, const Volume&) const {
        const Symmetric strain = half_logarithm(b);
        const Symmetric shape = strain.deviator();
        return 0.5 * bulk_ * strain.trace() * strain.trace() + mu_ * contraction(shape, shape);
    }
    double plastic_work(const double* at) const { return at[1]; }
    double wave_factor(double least, double, double log_volume) const {
        return (1 + std::abs(log_volume)) / (least * least);
    }

private:
    // The strength follows the pressure, so that the work of a step is that of the mean strength in it.
    static void add_work(double* at, double work, double flow) {
        const double strength = work / flow;
        at[1] += (at[2] > 0 ? 0.5 * (strength + at[2]) : strength) * flow;
        at[2] = strength;
    }

    static constexpr double root_2_3 = 0.816496580927726;
    static double denominator(double angle) { return std::sqrt(3.0) * (3 - std::sin(angle)); }
    static double slope(double angle) { return 6 * std::sin(angle) / denominator(angle); }

    double mu_, bulk_, eta_, flow_eta_, strength_, rest_ratio_;
};

} // namespace grainfall::femlink
