// SPDX-License-Identifier: GPL-2.0-or-later
// Largest stable step of leapfrog for bodies joined by linear springs and dashpots.
//
// The displacement in a contact is the difference of what its two bodies do there, and for every a > 0
// |u1 - u2|^2 <= (1 + a)|u1|^2 + (1 + 1/a)|u2|^2. With a = lambda2/lambda1, lambda_b the largest squared
// frequency of body b between held neighbours (body_stiffness.hpp), the bodies come apart:
//
//   omega_max^2 <= max over contacts of (lambda1 + lambda2)
//
// A held body has lambda = 0. This is exact for two bodies alone, for one between held ones, and for
// a regular packing whose grains all roll against each other, and it never errs to the unsafe side.
//
// YADE's dashpots see the speed of half a step before. M(v+ - v-)/dt = -K x - C v- is stable while
// 4M - 2 dt C - dt^2 K is positive, for one oscillator dt < 2/omega (sqrt(1 + zeta^2) - zeta). So a dashpot c
// counts as a spring of 2c/dt.
#pragma once

#include <engines/time_step/body_stiffness.hpp>
#include <engines/time_step/step_limits.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace grainfall::time_step {

// One contact. Bodies are numbers from ContactNetwork::add_body, `held` for one that does not move.
struct Spring {
    int first = -1, second = -1;
    Vector normal = Vector::UnitX();
    Vector first_lever = Vector::Zero(), second_lever = Vector::Zero(); // m, contact point - centre of mass
    Stiffness stiffness;                                                // N/m
    Stiffness damping;                                                  // N s/m
};

// What decides: the spring, and whether a rotation does.
struct StabilityLimit {
    double step = no_limit; // s
    int spring = -1;        // in the order of add()
    bool rotation = false;
};

class ContactNetwork {
public:
    static constexpr int held = -1;

    void clear() {
        mobility_.clear();
        springs_.clear();
        damped_ = false;
    }
    int add_body(const Mobility& mobility) {
        mobility_.push_back(mobility);
        return static_cast<int>(mobility_.size()) - 1;
    }
    void add(const Spring& spring) {
        springs_.push_back(spring);
        damped_ = damped_ || spring.damping.normal > 0 || spring.damping.shear > 0;
    }
    const Mobility& mobility(int body) const { return mobility_[body]; }

    // `guess`: a step [s] from which to start, such as the last answer; it changes the price only, and the
    // answer by less than `tolerance`.
    StabilityLimit limit(double guess = no_limit) {
        double step = damped_ ? guess : no_limit;
        StabilityLimit found;
        for (int pass = 0; pass < most_passes; ++pass) {
            assemble(step);
            const Decision decision = search();
            const double next = improved(step, decision.squared_frequency);
            found = {next, decision.spring, decision.rotation};
            if (!damped_ || next == step || (step < no_limit && std::abs(next - step) <= tolerance * step))
                break;
            step = next;
        }
        return found;
    }

private:
    static constexpr int most_passes = 20;
    static constexpr double tolerance = 0.01;
    struct Decision {
        double squared_frequency = 0;
        int spring = -1;
        bool rotation = false;
    };

    std::vector<Mobility> mobility_;
    std::vector<Spring> springs_;
    std::vector<BodyStiffness> stiffness_;
    std::vector<double> bound_; // of each body's lambda, exact where known to be
    std::vector<char> exact_;
    bool damped_ = false;

    // Both branches end on the stable side: f = dt^2 lambda grows at most with dt^2 upwards, and falls at
    // least with dt downwards.
    static double improved(double step, double squared_frequency) {
        if (step == no_limit || squared_frequency == 0)
            return leapfrog_limit(squared_frequency);
        const double f = step * step * squared_frequency;
        return f <= 4 ? step * std::sqrt(4 / f) : step * (4 / f);
    }

    void assemble(double step) {
        stiffness_.assign(mobility_.size(), BodyStiffness());
        for (const Spring& s : springs_) {
            const double c = 2 / step;
            const Stiffness k{s.stiffness.normal + c * s.damping.normal,
                              s.stiffness.shear + c * s.damping.shear};
            if (s.first != held)
                stiffness_[s.first].add(k, s.normal, s.first_lever);
            if (s.second != held)
                stiffness_[s.second].add(k, s.normal, s.second_lever);
        }
    }

    // Branch and bound: eigenvalues only of bodies whose cheap bound could still win.
    Decision search() {
        bound_.resize(mobility_.size());
        exact_.assign(mobility_.size(), 0);
        for (std::size_t b = 0; b < mobility_.size(); ++b)
            bound_[b] = stiffness_[b].touched() ? stiffness_[b].upper_bound(mobility_[b]) : 0;
        Decision best;
        if (const int first = most_promising(); first >= 0)
            consider(first, best);
        for (std::size_t i = 0; i < springs_.size(); ++i)
            consider(static_cast<int>(i), best);
        if (best.spring >= 0) {
            const Spring& s = springs_[best.spring];
            const int faster = bound(s.first) >= bound(s.second) ? s.first : s.second;
            best.rotation = stiffness_[faster].rotation_leads(mobility_[faster]);
        }
        return best;
    }

    int most_promising() const {
        int best = -1;
        double most = 0;
        for (std::size_t i = 0; i < springs_.size(); ++i) {
            const double sum = bound(springs_[i].first) + bound(springs_[i].second);
            if (sum > most) {
                most = sum;
                best = static_cast<int>(i);
            }
        }
        return best;
    }

    void consider(int spring, Decision& best) {
        const Spring& s = springs_[spring];
        for (const int body : {s.first, s.second}) {
            if (bound(s.first) + bound(s.second) <= best.squared_frequency)
                return;
            if (body != held && !exact_[body]) {
                bound_[body] = stiffness_[body].largest_eigenvalue(mobility_[body]);
                exact_[body] = 1;
            }
        }
        const double sum = bound(s.first) + bound(s.second);
        if (sum > best.squared_frequency) {
            best.squared_frequency = sum;
            best.spring = spring;
        }
    }

    double bound(int body) const { return body == held ? 0 : bound_[body]; }
};

} // namespace grainfall::time_step
