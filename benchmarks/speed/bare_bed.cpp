// SPDX-License-Identifier: GPL-2.0-or-later
#include "bare_bed.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace grainfall::bench {

namespace {

using Law = laws::HertzMindlin<laws::Hertz, laws::IncrementalTangential, laws::RepulsiveDashpot,
                               laws::friction::Constant>;

constexpr double gravity = 9.81; // m/s2

PairClass pair_class(double radius_1, double radius_2, double mass_1, double mass_2) {
    const Grain grain;
    const laws::ElasticMaterial material{grain.young, grain.poisson};
    PairClass result;
    result.radius_1 = radius_1;
    result.radius_2 = radius_2;
    result.parameters = laws::contact_parameters(laws::effective_modulus(material, material),
                                                 laws::effective_shear_modulus(material, material),
                                                 laws::effective_radius(radius_1, radius_2),
                                                 laws::effective_mass(mass_1, mass_2), grain.damping_ratio);
    return result;
}

void forget(BareContact& contact) {
    contact.memory = {};
    contact.normal.setZero();
}

// Force on the second body of a contact that touches; `sliding` is the velocity of the second body's surface
// seen from the first's, `turning` the sum of spins.
inline Vector force_of(BareContact& contact, const laws::ContactParameters& parameters, const Vector& normal,
                       double overlap, double normal_velocity, const Vector& sliding, const Vector& turning,
                       double time_step, Vector& shear) {
    const laws::friction::Constant friction{Grain().friction};
    laws::ContactGeometry geometry;
    geometry.overlap = overlap;
    geometry.normal = normal;
    geometry.normal_velocity = normal_velocity;
    geometry.time_step = time_step;
    geometry.shear_increment = (sliding - normal.dot(sliding) * normal) * time_step;
    // The old normal is zero at first touch, and with it both turns.
    geometry.tilt = contact.normal.cross(normal);
    geometry.twist = (0.5 * time_step * contact.normal.dot(turning)) * contact.normal;
    laws::NoEnergy book;
    const laws::ContactForce force = Law::step(geometry, parameters, friction, contact.memory, book);
    contact.normal = normal;
    shear = force.shear;
    return force.normal * normal + force.shear;
}

// Flattened: one loop body for the compiler, law and all.
[[gnu::flatten]] void add_sphere_forces(PairClass& pairs, const std::vector<Motion>& bodies,
                                        std::vector<Load>& loads, double time_step) {
    const double r1 = pairs.radius_1, r2 = pairs.radius_2, sum = r1 + r2;
    for (BareContact& contact : pairs.contacts) {
        const Motion &one = bodies[contact.first], &two = bodies[contact.second];
        const Vector branch = two.position - one.position;
        const double square = branch.squaredNorm();
        if (square >= sum * sum) {
            if (contact.memory.shear_stiffness > 0)
                forget(contact);
            continue;
        }
        const double distance = std::sqrt(square), overlap = sum - distance;
        const Vector normal = branch / distance;
        const Vector relative = two.velocity - one.velocity;
        // The lever arms grow with the centres' approach, as in YADE: no ratcheting.
        const Vector sliding = (sum / distance) * relative - (r1 * one.spin + r2 * two.spin).cross(normal);
        Vector shear;
        const Vector force = force_of(contact, pairs.parameters, normal, overlap, relative.dot(normal),
                                      sliding, one.spin + two.spin, time_step, shear);
        const Vector moment = normal.cross(shear);
        Load &load_1 = loads[contact.first], &load_2 = loads[contact.second];
        load_1.force -= force;
        load_2.force += force;
        load_1.torque -= (r1 - 0.5 * overlap) * moment;
        load_2.torque -= (r2 - 0.5 * overlap) * moment;
    }
}

[[gnu::flatten]] void add_wall_forces(PairClass& pairs, const std::array<Plane, 5>& planes,
                                      const std::vector<Motion>& bodies, std::vector<Load>& loads,
                                      double time_step) {
    const double radius = pairs.radius_1;
    for (BareContact& contact : pairs.contacts) {
        const Motion& grain = bodies[contact.first];
        const Plane& plane = planes[contact.second];
        const double overlap = radius - (plane.offset - plane.outward.dot(grain.position));
        if (overlap <= 0) {
            forget(contact);
            continue;
        }
        const Vector& normal = plane.outward;
        const Vector sliding = -grain.velocity - (radius - overlap) * grain.spin.cross(normal);
        Vector shear;
        const Vector force = force_of(contact, pairs.parameters, normal, overlap, -grain.velocity.dot(normal),
                                      sliding, 2 * grain.spin, time_step, shear);
        Load& load = loads[contact.first];
        load.force -= force;
        load.torque -= (radius - overlap) * normal.cross(shear);
    }
}

// Gives the new list, ascending like the old one, what the old one remembers.
void carry_over(const std::vector<BareContact>& from, std::vector<BareContact>& to) {
    const auto key = [](const BareContact& c) { return std::pair(c.first, c.second); };
    auto old = from.begin();
    for (BareContact& contact : to) {
        while (old != from.end() && key(*old) < key(contact))
            ++old;
        if (old != from.end() && key(*old) == key(contact))
            contact = *old;
    }
}

} // namespace

BareBed::BareBed(std::vector<Motion> bodies, const std::vector<double>& radii,
                 const std::vector<double>& masses, double side, double skin, double time_step)
    : bodies_(std::move(bodies)), loads_(bodies_.size()), grain_count_(bodies_.size()), radius_(radii[0]),
      mass_(masses[0]), skin_(skin), time_step_(time_step) {
    const double half = side / 2;
    planes_ = {Plane{-Vector::UnitX(), half}, Plane{Vector::UnitX(), half}, Plane{-Vector::UnitY(), half},
               Plane{Vector::UnitY(), half}, Plane{-Vector::UnitZ(), 0}};
    grains_ = pair_class(radius_, radius_, mass_, mass_);
    walls_ = pair_class(radius_, laws::infinite, mass_, laws::infinite);
    if (radii.back() != radius_) {
        --grain_count_;
        projectile_radius_ = radii.back();
        projectile_mass_ = masses.back();
        projectile_ = pair_class(radius_, projectile_radius_, mass_, projectile_mass_);
    }
    find_pairs();
}

void BareBed::step(double drag) {
    add_forces();
    move(drag);
}

void BareBed::add_forces() {
    if (!fixed_list_ && moved_too_far())
        find_pairs();
    add_sphere_forces(grains_, bodies_, loads_, time_step_);
    add_sphere_forces(projectile_, bodies_, loads_, time_step_);
    add_wall_forces(walls_, planes_, bodies_, loads_, time_step_);
}

void BareBed::move(double drag) {
    const auto advance = [this](std::size_t i, double mass, double radius, double kept) {
        Motion& body = bodies_[i];
        Load& load = loads_[i];
        body.velocity = kept * (body.velocity + (time_step_ / mass) * load.force);
        body.velocity.z() -= kept * gravity * time_step_;
        body.spin = kept * (body.spin + (time_step_ / (0.4 * mass * radius * radius)) * load.torque);
        body.position += time_step_ * body.velocity;
        load = Load();
    };
    const double kept = 1 - drag * time_step_;
    for (std::size_t i = 0; i < grain_count_; ++i)
        advance(i, mass_, radius_, kept);
    if (grain_count_ < bodies_.size())
        advance(grain_count_, projectile_mass_, projectile_radius_, 1);
}

bool BareBed::moved_too_far() const {
    const double limit = 0.25 * skin_ * skin_;
    for (std::size_t i = 0; i < bodies_.size(); ++i)
        if ((bodies_[i].position - listed_at_[i]).squaredNorm() > limit)
            return true;
    return false;
}

void BareBed::find_pairs() {
    std::vector<BareContact> pairs = grain_pairs(2 * radius_ + skin_);
    carry_over(grains_.contacts, pairs);
    grains_.contacts = std::move(pairs);

    std::vector<BareContact> on_walls, on_projectile;
    for (std::size_t i = 0; i < grain_count_; ++i) {
        const Vector& x = bodies_[i].position;
        for (std::size_t wall = 0; wall < planes_.size(); ++wall) {
            if (planes_[wall].offset - planes_[wall].outward.dot(x) < radius_ + skin_)
                on_walls.push_back(
                    {static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(wall), {}, Vector::Zero()});
        }
        const double reach = radius_ + projectile_radius_ + skin_;
        if (grain_count_ < bodies_.size() &&
            (x - bodies_[grain_count_].position).squaredNorm() < reach * reach)
            on_projectile.push_back({static_cast<std::uint32_t>(i),
                                     static_cast<std::uint32_t>(grain_count_),
                                     {},
                                     Vector::Zero()});
    }
    carry_over(walls_.contacts, on_walls);
    carry_over(projectile_.contacts, on_projectile);
    walls_.contacts = std::move(on_walls);
    projectile_.contacts = std::move(on_projectile);

    listed_at_.resize(bodies_.size());
    std::transform(bodies_.begin(), bodies_.end(), listed_at_.begin(),
                   [](const Motion& body) { return body.position; });
    ++rebuilds_;
}

// Pairs of grains nearer than `reach`, ascending, by cells as wide as the reach.
std::vector<BareContact> BareBed::grain_pairs(double reach) const {
    Vector low = bodies_[0].position, high = low;
    for (std::size_t i = 1; i < grain_count_; ++i) {
        low = low.cwiseMin(bodies_[i].position);
        high = high.cwiseMax(bodies_[i].position);
    }
    const Eigen::Array3i cells = ((high - low) / reach).array().floor().cast<int>() + 1;
    const auto cell_of = [&](const Vector& x) -> Eigen::Array3i {
        return ((x - low) / reach).array().cast<int>();
    };
    const auto index = [&](const Eigen::Array3i& c) {
        return (static_cast<std::size_t>(c.z()) * cells.y() + c.y()) * cells.x() + c.x();
    };
    std::vector<std::uint32_t> start(static_cast<std::size_t>(cells.cast<long>().prod()) + 1, 0);
    for (std::size_t i = 0; i < grain_count_; ++i)
        ++start[index(cell_of(bodies_[i].position)) + 1];
    for (std::size_t c = 1; c < start.size(); ++c)
        start[c] += start[c - 1];
    std::vector<std::uint32_t> members(grain_count_), filled(start.begin(), start.end() - 1);
    for (std::size_t i = 0; i < grain_count_; ++i)
        members[filled[index(cell_of(bodies_[i].position))]++] = static_cast<std::uint32_t>(i);

    std::vector<BareContact> pairs;
    std::vector<std::uint32_t> partners;
    for (std::size_t i = 0; i < grain_count_; ++i) {
        const Vector& x = bodies_[i].position;
        const Eigen::Array3i centre = cell_of(x), from = (centre - 1).max(0), to = (centre + 2).min(cells);
        partners.clear();
        for (int z = from.z(); z < to.z(); ++z) {
            for (int y = from.y(); y < to.y(); ++y) {
                const std::size_t row = index({0, y, z});
                for (std::uint32_t m = start[row + from.x()]; m < start[row + to.x()]; ++m) {
                    const std::uint32_t j = members[m];
                    if (j > i && (bodies_[j].position - x).squaredNorm() < reach * reach)
                        partners.push_back(j);
                }
            }
        }
        std::sort(partners.begin(), partners.end());
        for (const std::uint32_t j : partners)
            pairs.push_back({static_cast<std::uint32_t>(i), j, {}, Vector::Zero()});
    }
    return pairs;
}

double BareBed::gap(const PairClass& pairs, const BareContact& contact) const {
    const Vector& x = bodies_[contact.first].position;
    if (&pairs == &walls_) {
        const Plane& plane = planes_[contact.second];
        return plane.offset - plane.outward.dot(x) - radius_;
    }
    return (bodies_[contact.second].position - x).norm() - pairs.radius_1 - pairs.radius_2;
}

void BareBed::keep_contacts_only(double limit) {
    find_pairs();
    for (PairClass* pairs : {&grains_, &walls_, &projectile_}) {
        const auto far = [&](const BareContact& contact) { return gap(*pairs, contact) >= limit; };
        auto& list = pairs->contacts;
        list.erase(std::remove_if(list.begin(), list.end(), far), list.end());
    }
    fixed_list_ = true;
}

std::size_t BareBed::touching_in_list() const {
    std::size_t count = 0;
    for (const PairClass* pairs : {&grains_, &walls_, &projectile_})
        for (const BareContact& contact : pairs->contacts)
            count += gap(*pairs, contact) < 0;
    return count;
}

std::size_t BareBed::touching() const {
    BareBed anew = *this;
    anew.find_pairs();
    return anew.touching_in_list();
}

std::size_t BareBed::pairs() const {
    return grains_.contacts.size() + walls_.contacts.size() + projectile_.contacts.size();
}

double BareBed::kinetic_energy() const {
    double energy = 0;
    for (std::size_t i = 0; i < grain_count_; ++i)
        energy +=
            0.5 * mass_ *
            (bodies_[i].velocity.squaredNorm() + 0.4 * radius_ * radius_ * bodies_[i].spin.squaredNorm());
    return energy;
}

} // namespace grainfall::bench
