// SPDX-License-Identifier: GPL-2.0-or-later
// Anderson's mixing on iterations whose fixed point is known.
#include <femlink/core/mixing.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace {

using grainfall::femlink::Mixing;

// f(x) = rates * (fixed - x): each component by itself, one of them away from the fixed point.
struct Iteration {
    Eigen::Vector4d rates{1.9, 0.5, 0.05, 2.5}, fixed{1, -2, 3, 0.5};

    Eigen::VectorXd step(const Eigen::VectorXd& x) const { return rates.cwiseProduct(fixed - x); }
    double off(const Eigen::VectorXd& x) const { return (x - fixed).norm() / fixed.norm(); }
};

// One mixed step of x += f(x).
template <class Function>
void advance(Mixing& mixing, const Function& f, Eigen::VectorXd& x) {
    Eigen::VectorXd step = f(x);
    mixing.improve(x, step);
    x += step;
}

// Without mixing the last component grows 1.5 times a step, and the third needs 270 steps to 1e-6.
TEST(Mixing, ends_a_linear_iteration_in_one_step_more_than_it_has_unknowns) {
    const Iteration iteration;
    Mixing mixing;
    Eigen::VectorXd x = Eigen::VectorXd::Zero(4);
    for (int i = 0; i < 5; ++i)
        advance(
            mixing, [&](const Eigen::VectorXd& at) { return iteration.step(at); }, x);
    EXPECT_LT(iteration.off(x), 1e-5); // the products are taken 1e-10 larger than they are
}

TEST(Mixing, takes_the_plain_step_first_and_after_it_has_forgotten) {
    const Iteration iteration;
    Mixing mixing;
    Eigen::VectorXd x = Eigen::VectorXd::Zero(4);
    for (int i = 0; i < 3; ++i) {
        Eigen::VectorXd step = iteration.step(x);
        const Eigen::VectorXd plain = step;
        mixing.improve(x, step);
        EXPECT_EQ(step == plain, i != 1);
        x += step;
        if (i == 1)
            mixing.forget();
    }
}

// x = cos x, and y one of another length afterwards: what was seen of x says nothing of it.
TEST(Mixing, solves_what_is_not_linear_and_starts_anew_for_another_number_of_unknowns) {
    Mixing mixing;
    const auto to_cosine = [](const Eigen::VectorXd& at) -> Eigen::VectorXd {
        return at.array().cos().matrix() - at;
    };
    for (const int size : {1, 2}) {
        Eigen::VectorXd x = Eigen::VectorXd::Zero(size);
        for (int i = 0; i < 7; ++i)
            advance(mixing, to_cosine, x);
        EXPECT_NEAR(x[size - 1], 0.7390851332151607, 1e-8); // 7 plain steps: 0.04 off
    }
}

} // namespace
