// SPDX-License-Identifier: GPL-2.0-or-later
#include <femlink/explicit/drucker_prager.hpp>
#include <femlink/explicit/j2_plasticity.hpp>

#include <gtest/gtest.h>

#include <random>

namespace {

using namespace grainfall::femlink;

// Copper of the Taylor bar, and a stiff clay.
SolidMaterial copper() {
    SolidMaterial m;
    m.law = SolidLaw::j2;
    m.elastic = {117e9, 0.35, 8930};
    m.yield_stress = 0.4e9;
    m.hardening = 0.1e9;
    return m;
}

SolidMaterial clay() {
    SolidMaterial m;
    m.law = SolidLaw::drucker_prager;
    m.elastic = {20e6, 0.3, 1800};
    m.cohesion = 5e3;
    m.friction_angle = 0.45;
    m.dilatancy = 0.1;
    return m;
}

Eigen::Matrix3d dense(const Symmetric& a) {
    Eigen::Matrix3d out;
    out << a.xx, a.xy, a.xz, a.xy, a.yy, a.yz, a.xz, a.yz, a.zz;
    return out;
}

Symmetric packed(const Eigen::Matrix3d& m) {
    return {m(0, 0), m(1, 1), m(2, 2), m(1, 2), m(0, 2), m(0, 1)};
}

Eigen::Matrix3d random_gradient(double size, unsigned seed) {
    std::mt19937 generator(seed);
    std::uniform_real_distribution<double> uniform(-size, size);
    return Eigen::Matrix3d::Identity() + Eigen::Matrix3d::NullaryExpr([&] { return uniform(generator); });
}

template <class Law>
double energy_of(const Law& law, const Eigen::Matrix3d& f) {
    return law.energy(packed(f * f.transpose()), Law::volume(f.determinant()));
}

template <class Law>
Eigen::Matrix3d stress_of(const Law& law, const Eigen::Matrix3d& f, double* history) {
    Symmetric b = packed(f * f.transpose());
    return dense(law.stress(b, Law::volume(f.determinant()), history));
}

// tau : dF F^-1 against the difference of the energies. Central differences of step 1e-5 err by about 1e-10
// of the modulus, the stress is a tenth of it.
template <class Law>
void expect_stress_is_slope_of_energy(const SolidMaterial& material) {
    const Law law(material);
    double history[3] = {0, 0, 0};
    for (unsigned seed = 1; seed < 20; ++seed) {
        const Eigen::Matrix3d f = random_gradient(0.15, seed);
        const Eigen::Matrix3d direction = random_gradient(1, seed + 100) - Eigen::Matrix3d::Identity();
        const double step = 1e-5;
        const double slope =
            (energy_of(law, f + step * direction) - energy_of(law, f - step * direction)) / (2 * step);
        const double power = stress_of(law, f, history).cwiseProduct(direction * f.inverse()).sum();
        EXPECT_NEAR(slope, power, 1e-8 * material.elastic.young);
    }
}

TEST(ExplicitLaws, elastic_stress_is_the_slope_of_the_energy) {
    SolidMaterial strong = copper();
    strong.yield_stress = 1e14;
    SolidMaterial cohesive = clay();
    cohesive.cohesion = 1e14;
    expect_stress_is_slope_of_energy<StVenantKirchhoff>(copper());
    expect_stress_is_slope_of_energy<NeoHooke>(copper());
    expect_stress_is_slope_of_energy<J2Plasticity>(strong);
    expect_stress_is_slope_of_energy<DruckerPrager>(cohesive);
}

// Linear elasticity at a strain of 1e-6: the difference is of second order.
template <class Law>
void expect_hooke_at_small_strain(const SolidMaterial& material) {
    double history[3] = {0, 0, 0};
    const Eigen::Matrix3d strain_and_turn = 1e-6 * (random_gradient(1, 5) - Eigen::Matrix3d::Identity());
    const Eigen::Matrix3d strain = 0.5 * (strain_and_turn + strain_and_turn.transpose());
    const Eigen::Matrix3d hooke = 2 * material.elastic.mu() * strain +
                                  material.elastic.lambda() * strain.trace() * Eigen::Matrix3d::Identity();
    const Eigen::Matrix3d tau =
        stress_of(Law(material), Eigen::Matrix3d::Identity() + strain_and_turn, history);
    EXPECT_LT((tau - hooke).norm(), 1e-5 * hooke.norm());
}

TEST(ExplicitLaws, all_are_hookes_law_at_small_strain) {
    expect_hooke_at_small_strain<StVenantKirchhoff>(copper());
    expect_hooke_at_small_strain<NeoHooke>(copper());
    expect_hooke_at_small_strain<J2Plasticity>(copper());
    expect_hooke_at_small_strain<DruckerPrager>(clay());
}

TEST(ExplicitLaws, logarithm_and_exponential_are_those_of_the_principal_values) {
    for (const double size : {1e-9, 1e-4, 0.02, 0.1, 0.3, 0.8}) {
        for (unsigned seed = 1; seed < 10; ++seed) {
            const Eigen::Matrix3d f = random_gradient(size, seed);
            const Symmetric b = packed(f * f.transpose());
            if (!(f.determinant() > 0))
                continue;
            const Symmetric log = by_principal_axes(b, [](double x) { return 0.5 * std::log(x); });
            EXPECT_LT((dense(half_logarithm(b)) - dense(log)).norm(), 2e-15 * (1 + dense(log).norm()) * 20);
            EXPECT_LT((dense(exponential(2 * half_logarithm(b))) - dense(b)).norm(),
                      1e-14 * dense(b).norm() * 20);
        }
    }
}

TEST(ExplicitLaws, power_two_thirds_and_extreme_eigenvalues) {
    for (const double x : {1e-3, 0.5, 0.91, 0.999, 1.0, 1.05, 1.0999, 1.2, 30.0})
        EXPECT_NEAR(two_thirds_power(x) / std::pow(x, 2.0 / 3), 1, 4e-15);
    for (unsigned seed = 1; seed < 30; ++seed) {
        const Eigen::Matrix3d f = random_gradient(0.5, seed);
        const Eigen::Vector3d values =
            Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(f * f.transpose()).eigenvalues();
        const auto found = extreme_eigenvalues(packed(f * f.transpose()));
        EXPECT_NEAR(found[0], values[0], 1e-7 * values[2]);
        EXPECT_NEAR(found[1], values[2], 1e-7 * values[2]);
    }
}

// Isochoric stretch exp(e) along x: the equivalent stress is 3 mu e, then (sigma_y + H e)/(1 + H/3mu); turned
// back, it yields at minus what it had reached, and hardens on from there. Radial return is exact on such a
// path.
TEST(ExplicitLaws, j2_follows_the_analytic_path_there_and_back) {
    const SolidMaterial m = copper();
    const double modulus = 3 * m.elastic.mu(), hardening = m.hardening;
    const J2Plasticity law(m);
    Symmetric plastic_metric = Symmetric::identity(); // Cp^-1
    double alpha = 0, expected_alpha = 0, expected = 0, strain = 0;
    const auto move_to = [&](double next) {
        const Eigen::Matrix3d f =
            Eigen::Vector3d(std::exp(next), std::exp(-next / 2), std::exp(-next / 2)).asDiagonal();
        Symmetric b = packed(f * dense(plastic_metric) * f.transpose());
        const Symmetric tau = law.stress(b, J2Plasticity::volume(f.determinant()), &alpha);
        plastic_metric = packed(f.inverse() * dense(b) * f.inverse().transpose());
        const double trial = expected + modulus * (next - strain);
        const double excess = std::abs(trial) - (m.yield_stress + hardening * expected_alpha);
        const double flow = excess > 0 ? excess / (modulus + hardening) : 0;
        expected = trial - std::copysign(modulus * flow, trial);
        expected_alpha += flow;
        strain = next;
        EXPECT_NEAR(tau.xx - tau.yy, expected, 1e-10 * modulus * 1e-2);
        EXPECT_NEAR(tau.trace(), 0, 1e-10 * modulus * 1e-2);
        EXPECT_NEAR(alpha, expected_alpha, 1e-12);
    };
    for (int i = 1; i <= 40; ++i)
        move_to(0.01 * i);
    EXPECT_NEAR(expected, (m.yield_stress + hardening * 0.4) / (1 + hardening / modulus), 1e-6 * expected);
    const double reached = expected;
    const double back = strain - 2 * reached / modulus; // yields again here
    move_to(back + 1e-6);
    EXPECT_NEAR(alpha, 0.4 - reached / modulus, 1e-12);
    for (int i = 1; i <= 60; ++i)
        move_to(back - 0.01 * i);
    EXPECT_NEAR(plastic_metric.determinant(), 1, 1e-12);
}

// Mohr and Coulomb in triaxial compression: s1 = s3 (1 + sin phi)/(1 - sin phi) + 2 c cos phi/(1 - sin phi),
// compression positive.
TEST(ExplicitLaws, drucker_prager_has_mohr_and_coulombs_strength_in_triaxial_compression) {
    const SolidMaterial m = clay();
    const DruckerPrager law(m);
    const double s = std::sin(m.friction_angle), c = std::cos(m.friction_angle);
    for (const double confinement : {0.0, 2e-4, 1e-3}) {
        double history[3] = {0, 0, 0};
        const Eigen::Matrix3d f =
            Eigen::Vector3d(1.01 - confinement, 1.01 - confinement, 0.98 - confinement).asDiagonal();
        const Eigen::Matrix3d tau = stress_of(law, f, history);
        const double strength = -tau(0, 0) * (1 + s) / (1 - s) + 2 * m.cohesion * c / (1 - s);
        EXPECT_GT(history[0], 0);
        EXPECT_NEAR(-tau(2, 2), strength, 1e-9 * strength);
    }
}

TEST(ExplicitLaws, drucker_prager_gives_way_in_tension_at_c_cot_phi) {
    const SolidMaterial m = clay();
    double history[3] = {0, 0, 0};
    const Eigen::Matrix3d f = 1.01 * Eigen::Matrix3d::Identity();
    const Eigen::Matrix3d tau = stress_of(DruckerPrager(m), f, history);
    const Eigen::Matrix3d apex = m.cohesion / std::tan(m.friction_angle) * Eigen::Matrix3d::Identity();
    EXPECT_LT((tau - apex).norm(), 1e-10 * apex.norm());
}

// Flow dilates by eta(psi) for each unit of the multiplier, shears by 1/2 of it in sqrt(J2)'s direction.
TEST(ExplicitLaws, drucker_prager_dilates_by_its_dilatancy) {
    SolidMaterial m = clay();
    for (const double dilatancy : {0.0, 0.1, 0.45}) {
        m.dilatancy = dilatancy;
        double history[3] = {0, 0, 0};
        const Eigen::Matrix3d f = Eigen::Vector3d(1.0098, 1.0098, 0.9798).asDiagonal();
        Symmetric b = packed(f * f.transpose());
        const Symmetric before = half_logarithm(b);
        DruckerPrager(m).stress(b, DruckerPrager::volume(f.determinant()), history);
        const Symmetric plastic = before - half_logarithm(b);
        const Symmetric shape = plastic.deviator();
        const double shear = std::sqrt(2 * contraction(shape, shape)); // the multiplier
        const double eta = 6 * std::sin(dilatancy) / (std::sqrt(3.0) * (3 - std::sin(dilatancy)));
        EXPECT_GT(shear, 1e-3);
        EXPECT_NEAR(plastic.trace(), eta * shear, 1e-10 * shear);
    }
}

TEST(ExplicitLaws, refuse_parameters_in_one_sentence) {
    const auto refusal = [](const SolidMaterial& m) -> std::string {
        try {
            validate(m, "materials[0]");
        } catch (const std::invalid_argument& error) {
            return error.what();
        }
        return "nothing was thrown";
    };
    SolidMaterial m = copper();
    m.yield_stress = 0;
    EXPECT_EQ(refusal(m), "materials[0].yield_stress = 0: must be > 0 and finite");
    m = copper();
    m.elastic.density = 0;
    EXPECT_EQ(refusal(m), "materials[0].density = 0: must be > 0 and finite");
    m = clay();
    m.dilatancy = 0.5;
    EXPECT_EQ(refusal(m),
              "materials[0].dilatancy = 0.5: must be in [0, friction_angle], in rad: above it plastic "
              "flow would create energy");
    EXPECT_EQ(refusal(clay()), "nothing was thrown");
}

} // namespace
