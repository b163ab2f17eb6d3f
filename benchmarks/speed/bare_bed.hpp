// SPDX-License-Identifier: GPL-2.0-or-later
// A bed of equal grains in a box, stepped with as little as possible around the contact law.
//
// Contacts of one class (grain on grain, on wall, on the projectile) lie in one array with one set of
// parameters; bodies lie in one array in the order of the file. One thread, one material, constant friction,
// no YADE. It is the yardstick of the speed benchmark, and settles its beds. SI units.
#pragma once

#include <laws/friction/constant.hpp>
#include <laws/hertz_mindlin.hpp>
#include <laws/pair_rules.hpp>

#include <Eigen/Geometry>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace grainfall::bench {

using laws::Vector;

// Table 1's grain; the restitution is that which gives stock YADE's dashpot for 0.5.
struct Grain {
    double young = 2.8e9;              // Pa, G = 1e9 Pa
    double poisson = 0.4;              // -
    double friction = 0.5;             // -
    double damping_ratio = 0.19668148; // -, sqrt(5/6) |ln e|/sqrt(ln^2 e + pi^2) at e = 0.5
};

struct Motion {
    Vector position, velocity, spin;
};

struct Load {
    Vector force = Vector::Zero(), torque = Vector::Zero();
};

struct BareContact {
    std::uint32_t first = 0, second = 0;
    laws::ContactMemory memory;
    Vector normal = Vector::Zero(); // of the last step; zero while there is no contact
};

// Open box standing on z = 0 with its axis on the z axis; the walls -x, +x, -y, +y and the floor.
struct Plane {
    Vector outward = Vector::Zero(); // from the grain to the wall
    double offset = 0;               // m, outward . x on the wall
};

struct PairClass {
    double radius_1 = 0, radius_2 = 0; // m
    laws::ContactParameters parameters;
    std::vector<BareContact> contacts;
};

class BareBed {
public:
    // `radii`, `masses`: equal for all grains; the last body may differ: the projectile.
    BareBed(std::vector<Motion> bodies, const std::vector<double>& radii, const std::vector<double>& masses,
            double side, double skin, double time_step);

    void step(double drag);
    void add_forces();
    // `drag`: 1/s, background drag on the velocities of the grains, for settling.
    void move(double drag);

    // Drops the pairs that are further apart than `gap`, m, and never looks for new ones again.
    void keep_contacts_only(double gap);
    // Pairs of bodies, and bodies and walls, that overlap, counted anew from the positions.
    std::size_t touching() const;
    std::size_t touching_in_list() const;
    std::size_t pairs() const;
    double kinetic_energy() const; // J, of the grains

    const std::vector<Motion>& bodies() const { return bodies_; }
    int rebuilds() const { return rebuilds_; }

private:
    bool moved_too_far() const;
    void find_pairs();
    std::vector<BareContact> grain_pairs(double reach) const;
    double gap(const PairClass& pair_class, const BareContact& contact) const;

    std::vector<Motion> bodies_;
    std::vector<Load> loads_;
    std::vector<Vector> listed_at_; // positions when the pairs were found
    std::array<Plane, 5> planes_;
    PairClass grains_, walls_, projectile_;
    std::size_t grain_count_ = 0;
    double radius_ = 0, mass_ = 0, projectile_radius_ = 0, projectile_mass_ = 0;
    double skin_ = 0, time_step_ = 0;
    int rebuilds_ = 0;
    bool fixed_list_ = false;
};

} // namespace grainfall::bench
