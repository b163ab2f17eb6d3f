// SPDX-License-Identifier: GPL-2.0-or-later
#include <engines/time_step/contact_network.hpp>

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <cmath>
#include <random>
#include <vector>

namespace {

using namespace grainfall::time_step;
using Dense = Eigen::MatrixXd;

constexpr int held = ContactNetwork::held;

Mobility sphere(double mass, double radius) {
    Mobility free;
    free.translation.setConstant(1 / std::sqrt(mass));
    free.rotation = Matrix::Identity() / std::sqrt(0.4 * mass * radius * radius);
    return free;
}

Spring spring(int first, int second, const Vector& normal, double first_radius, double second_radius,
              double normal_stiffness, double shear_stiffness) {
    Spring s;
    s.first = first;
    s.second = second;
    s.normal = normal;
    s.first_lever = first_radius * normal;
    s.second_lever = -second_radius * normal;
    s.stiffness = {normal_stiffness, shear_stiffness};
    return s;
}

// The twelve directions of a face-centred cubic packing.
std::vector<Vector> twelve_neighbours() {
    std::vector<Vector> directions;
    for (int hole = 0; hole < 3; ++hole)
        for (double a : {-1., 1.})
            for (double b : {-1., 1.}) {
                Vector d = Vector::Zero();
                d[(hole + 1) % 3] = a;
                d[(hole + 2) % 3] = b;
                directions.push_back(d.normalized());
            }
    return directions;
}

// A heap of bodies and springs with its mass, stiffness and damping matrices, assembled here without the
// class that is tested: virtual displacement by virtual displacement.
struct System {
    ContactNetwork network;
    std::vector<Mobility> bodies;
    std::vector<Spring> springs;

    int body(const Mobility& free) {
        bodies.push_back(free);
        return network.add_body(free);
    }
    void join(const Spring& s) {
        springs.push_back(s);
        network.add(s);
    }
    // Displacement in the contact over that of all bodies, in coordinates in which the mass matrix is one.
    Eigen::Matrix<double, 3, Eigen::Dynamic> jacobian(const Spring& s) const {
        Eigen::Matrix<double, 3, Eigen::Dynamic> j =
            Eigen::Matrix<double, 3, Eigen::Dynamic>::Zero(3, 6 * static_cast<long>(bodies.size()));
        const auto add = [&](int b, const Vector& lever, double sign) {
            if (b == held)
                return;
            for (int i = 0; i < 3; ++i) {
                const Vector unit = Vector::Unit(i);
                j.col(6 * b + i) = sign * bodies[b].translation[i] * unit;
                j.col(6 * b + 3 + i) = sign * Vector(bodies[b].rotation * unit).cross(lever);
            }
        };
        add(s.first, s.first_lever, -1);
        add(s.second, s.second_lever, 1);
        return j;
    }
    Dense matrix(Stiffness Spring::*of) const {
        Dense sum = Dense::Zero(6 * bodies.size(), 6 * bodies.size());
        for (const Spring& s : springs) {
            const auto j = jacobian(s);
            const Stiffness k = s.*of;
            const Matrix local =
                k.shear * Matrix::Identity() + (k.normal - k.shear) * s.normal * s.normal.transpose();
            sum += j.transpose() * local * j;
        }
        return sum;
    }
    // s, at which the stiffest mode of the true system becomes unstable: the dashpots lag half a step.
    double true_limit() const {
        const Dense k = matrix(&Spring::stiffness), c = matrix(&Spring::damping);
        const auto largest = [](const Dense& symmetric) {
            return Eigen::SelfAdjointEigenSolver<Dense>(symmetric, Eigen::EigenvaluesOnly)
                .eigenvalues()
                .maxCoeff();
        };
        double low = 0, high = 2 / std::sqrt(largest(k)); // dashpots only lower it
        if (c.isZero())
            return high;
        for (int i = 0; i < 40; ++i) {
            const double dt = 0.5 * (low + high);
            (largest(dt * dt * k + 2 * dt * c) < 4 ? low : high) = dt;
        }
        return low;
    }
};

TEST(ContactNetwork, two_unequal_bodies_have_the_limit_of_their_reduced_mass) {
    const double k = 3e5;
    for (double heavy : {1.0, 7.0, 1e6}) {
        System pair;
        pair.body(sphere(1e-3, 5e-3));
        pair.body(sphere(1e-3 * heavy, 5e-3));
        pair.join(spring(0, 1, Vector::UnitZ(), 5e-3, 5e-3, k, 0));
        const double reduced = 1e-3 * heavy / (1 + heavy);
        EXPECT_NEAR(pair.network.limit().step / (2 * std::sqrt(reduced / k)), 1, 1e-12) << heavy;
        EXPECT_FALSE(pair.network.limit().rotation);
    }
}

TEST(ContactNetwork, light_grain_between_two_heavy_ones_feels_both_springs) {
    const double k = 3e5, mass = 1e-6;
    System three;
    const int light = three.body(sphere(mass, 1e-3)), left = three.body(sphere(1, 0.1)),
              right = three.body(sphere(1, 0.1));
    three.join(spring(light, left, -Vector::UnitX(), 1e-3, 0.1, k, 0));
    three.join(spring(light, right, Vector::UnitX(), 1e-3, 0.1, k, 0));
    EXPECT_NEAR(three.network.limit().step / three.true_limit(), 1, 2e-6);
    EXPECT_NEAR(three.network.limit().step / (2 * std::sqrt(mass / (2 * k))), 1, 2e-6);
}

TEST(ContactNetwork, grain_with_twelve_held_neighbours_has_its_exact_limit_and_rotation_decides) {
    const double mass = 1e-3, radius = 5e-3, kn = 3e5, kt = 0.82 * kn;
    System cluster;
    cluster.body(sphere(mass, radius));
    for (const Vector& n : twelve_neighbours())
        cluster.join(spring(0, held, n, radius, radius, kn, kt));
    // The springs' shear adds up to 8 k_t R^2 about each axis, the inertia is 2/5 m R^2.
    const StabilityLimit limit = cluster.network.limit();
    EXPECT_NEAR(limit.step / (2 / std::sqrt(20 * kt / mass)), 1, 1e-12);
    EXPECT_NEAR(limit.step / cluster.true_limit(), 1, 1e-9);
    EXPECT_TRUE(limit.rotation);
}

TEST(ContactNetwork, eq_7_and_8_as_printed_leave_no_margin_for_twelve_contacts) {
    // Grains of one size and material, nu = 0.31, all rolling against each other: lambda = 40 k_t/m.
    const double nu = 0.31, mass = 1, coefficient = 1, overlap = 1;
    const double tangent = 1.5 * coefficient;                 // k_n of Hertz
    const double mindlin = tangent * 2 * (1 - nu) / (2 - nu); // k_t
    const double reports_shear = tangent * 1.2599 * 2 * (1 - nu) / (2 - nu);
    const double allowed = report_step(mass, coefficient, overlap);
    for (const auto& [kt, least] : {std::pair{mindlin, 1.19}, std::pair{reports_shear, 1.34}}) {
        System pair;
        Spring s = spring(pair.body(sphere(mass, 1)), held, Vector::UnitX(), 1, 1, tangent, kt);
        pair.springs.clear();
        for (const Vector& n : twelve_neighbours()) {
            s.normal = n;
            s.first_lever = n;
            pair.join(s);
        }
        const double critical = pair.network.limit().step / std::sqrt(2); // the neighbours roll too
        EXPECT_GT(allowed / critical, least);
    }
}

// Random heaps of unlike bodies with true levers that are not along the normals, some held, some dashpots.
class RandomHeap : public ::testing::TestWithParam<int> {};

System random_heap(int seed, bool damped) {
    std::mt19937 generator(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const auto vector = [&] { return Vector(uniform(generator), uniform(generator), uniform(generator)); };
    System heap;
    for (int i = 0; i < 12; ++i) {
        Mobility free = sphere(std::pow(10, 3 * uniform(generator)), 1);
        if (i % 4 == 0)
            free.translation[i % 3] = 0; // a blocked degree of freedom
        const Matrix turn = Eigen::Quaterniond::UnitRandom().toRotationMatrix();
        free.rotation = turn * Vector(0.5, 1.5, 3).asDiagonal() * turn.transpose() * free.rotation(0, 0);
        heap.body(free);
    }
    for (int i = 0; i < 40; ++i) {
        Spring s;
        s.first = static_cast<int>(generator() % 12);
        s.second = i % 7 == 0 ? held : static_cast<int>((s.first + 1 + generator() % 11) % 12);
        s.normal = vector().normalized();
        s.first_lever = vector();
        s.second_lever = vector();
        s.stiffness = {std::pow(10, 4 * uniform(generator)), 0};
        s.stiffness.shear = 0.8 * s.stiffness.normal;
        if (damped && i % 2)
            s.damping = {std::sqrt(s.stiffness.normal), std::sqrt(s.stiffness.shear)};
        heap.join(s);
    }
    return heap;
}

TEST_P(RandomHeap, the_limit_is_never_above_the_true_one_and_above_two_thirds_of_it) {
    System heap = random_heap(GetParam(), false);
    const double ratio = heap.network.limit().step / heap.true_limit();
    EXPECT_LE(ratio, 1 + 1e-9);
    EXPECT_GT(ratio, 1 / std::sqrt(2.0) - 1e-9); // lambda1 + lambda2 <= 2 lambda_max <= 2 omega_max^2
}

TEST_P(RandomHeap, the_limit_with_dashpots_is_never_above_the_true_one_whatever_the_guess) {
    System heap = random_heap(GetParam(), true);
    const double exact = heap.true_limit();
    for (double guess : {no_limit, 1e-3 * exact, exact, 1e3 * exact}) {
        const double ratio = heap.network.limit(guess).step / exact;
        EXPECT_LE(ratio, 1 + 1e-9) << guess;
        EXPECT_GT(ratio, 0.5 * 0.99) << guess; // f is at most twice too large, and grows at least with dt
    }
}

INSTANTIATE_TEST_SUITE_P(seeds, RandomHeap, ::testing::Range(1, 25));

TEST(ContactNetwork, one_damped_oscillator_has_the_limit_of_a_dashpot_that_lags_half_a_step) {
    const double mass = 2e-3, k = 5e4;
    for (double zeta : {0.0, 0.05, 0.3, 1.0, 3.0}) {
        System one;
        Spring s = spring(one.body(sphere(mass, 1)), held, Vector::UnitY(), 1, 1, k, 0);
        s.damping.normal = 2 * zeta * std::sqrt(mass * k);
        one.join(s);
        const double omega = std::sqrt(k / mass);
        const double expected = 2 / omega * (std::sqrt(1 + zeta * zeta) - zeta);
        EXPECT_NEAR(one.network.limit().step / expected, 1, 0.01) << zeta;
        EXPECT_LE(one.network.limit().step / expected, 1 + 1e-12) << zeta;
    }
}

// v, x of one damped oscillator in YADE's order after many steps.
double amplitude(double step, double zeta) {
    double x = 1, v = 0;
    for (int i = 0; i < 400; ++i) {
        v += step * (-x - 2 * zeta * v);
        x += step * v;
    }
    return std::abs(x) + std::abs(v);
}

TEST(ContactNetwork, that_limit_is_where_the_oscillator_begins_to_grow) {
    for (double zeta : {0.0, 0.05, 0.3, 1.0}) {
        const double limit = 2 * (std::sqrt(1 + zeta * zeta) - zeta);
        EXPECT_LT(amplitude(0.99 * limit, zeta), 10) << zeta;
        EXPECT_GT(amplitude(1.01 * limit, zeta), 1e4) << zeta;
    }
}

TEST(ContactNetwork, without_springs_there_is_no_limit) {
    ContactNetwork empty;
    EXPECT_EQ(empty.limit().step, no_limit);
    empty.add_body(sphere(1, 1));
    EXPECT_EQ(empty.limit().step, no_limit);
    EXPECT_EQ(empty.limit().spring, -1);
}

TEST(ContactNetwork, spring_between_held_bodies_limits_nothing) {
    ContactNetwork network;
    network.add(spring(held, held, Vector::UnitX(), 1, 1, 1e9, 1e9));
    EXPECT_EQ(network.limit().step, no_limit);
}

TEST(ContactNetwork, stiffest_of_many_springs_is_named) {
    System chain;
    for (int i = 0; i < 100; ++i)
        chain.body(sphere(1, 1));
    for (int i = 0; i + 1 < 100; ++i)
        chain.join(spring(i, i + 1, Vector::UnitX(), 1, 1, i == 37 ? 1e4 : 1, 0));
    EXPECT_EQ(chain.network.limit().spring, 37);
}

} // namespace
