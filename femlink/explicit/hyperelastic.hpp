// SPDX-License-Identifier: GPL-2.0-or-later
// Elastic solids at finite strain: Kirchhoff stress tau from the left Cauchy-Green tensor b = F F^T and
// J = det F, energy psi per volume at rest, Pa.
//
// What all laws of this folder have in common:
//   volume(J)                    the functions of J that it needs
//   stress(b, volume, history)   tau; a law that flows gives back the elastic b after flow
//   energy(b, volume)            elastic, recoverable
//   b_at_rest(rest, point)       b that the stress of rest there asks for; only of laws that depend on it
//   plastic_work(history)        work done on plastic strain
//   wave_factor(least, largest, log_volume)   bound on the growth of (wave speed / length at rest)^2 when the
//                                principal stretches lie between these two
#pragma once

#include <femlink/explicit/solid_material.hpp>
#include <femlink/explicit/symmetric_functions.hpp>

namespace grainfall::femlink {

// Of a cell as a whole (mean dilatation).
struct Volume {
    double ratio = 1;      // J
    double logarithm = 0;  // ln J
    double unimodular = 1; // J^(-2/3)
};

// psi = lambda/2 (tr E)^2 + mu E : E,  E = (F^T F - I)/2. Softens in compression; at a stretch of 0.58 in one
// direction it gives way: for large rotations with moderate strain.
class StVenantKirchhoff {
public:
    static constexpr int history = 0;
    static constexpr bool knows_stress_at_rest = false;

    explicit StVenantKirchhoff(const SolidMaterial& m) : mu_(m.elastic.mu()), lambda_(m.elastic.lambda()) {}

    static Volume volume(double ratio) { return {ratio}; }
    Symmetric stress(Symmetric& b, const Volume&, double*) const {
        return (0.5 * lambda_ * (b.trace() - 3) - mu_) * b + mu_ * coaxial_product(b, b);
    }
    double energy(const Symmetric& b, const Volume&) const {
        const Symmetric strain = 0.5 * plus_identity(b, -1); // of the same eigenvalues as E
        return 0.5 * lambda_ * strain.trace() * strain.trace() + mu_ * contraction(strain, strain);
    }
    double plastic_work(const double*) const { return 0; }
    double wave_factor(double, double largest, double) const {
        const double square = largest * largest;
        return std::max(1.0, square + 1.5 * (square - 1));
    }

private:
    double mu_, lambda_;
};

// psi = mu/2 (tr b - 3) - mu ln J + lambda/2 (ln J)^2 (Bonet & Wood 2008, section 6.4.3).
class NeoHooke {
public:
    static constexpr int history = 0;
    static constexpr bool knows_stress_at_rest = false;

    explicit NeoHooke(const SolidMaterial& m) : mu_(m.elastic.mu()), lambda_(m.elastic.lambda()) {}

    static Volume volume(double ratio) { return {ratio, std::log(ratio)}; }
    Symmetric stress(Symmetric& b, const Volume& j, double*) const {
        return plus_identity(mu_ * b, lambda_ * j.logarithm - mu_);
    }
    double energy(const Symmetric& b, const Volume& j) const {
        return 0.5 * mu_ * (b.trace() - 3) - mu_ * j.logarithm + 0.5 * lambda_ * j.logarithm * j.logarithm;
    }
    double plastic_work(const double*) const { return 0; }
    double wave_factor(double least, double, double log_volume) const {
        const double square = least * least;
        const double modulus = lambda_ + mu_ + lambda_ * std::max(0.0, -log_volume) + mu_ * square;
        return modulus / (square * (lambda_ + 2 * mu_));
    }

private:
    double mu_, lambda_;
};

} // namespace grainfall::femlink
