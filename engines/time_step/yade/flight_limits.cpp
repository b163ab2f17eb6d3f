// SPDX-License-Identifier: GPL-2.0-or-later
#include <engines/time_step/yade/scene_limits.hpp>

#include <core/Bound.hpp>
#include <core/Clump.hpp>
#include <pkg/common/ElastMat.hpp>
#include <pkg/common/Sphere.hpp>

#include <sstream>

namespace yade {

namespace ts = grainfall::time_step;

namespace {

// What meets other bodies: a body with a surface.
struct Solid {
    Body::id_t id = -1;
    bool is_sphere = false;
    bool moves = false;
    Real reach = 0; // m, from its position to its farthest point; 0 for one without an end, such as a wall
    Real mass = 0;  // kg, of the clump for its members
    Real young = 0, poisson = 0, density = 0; // 0 where the material is not elastic

    Real plane_modulus() const { return young / (1 - poisson * poisson); } // Pa
};

Solid describe(const Scene& scene, const Body& body) {
    Solid solid;
    solid.id = body.id;
    if (const auto* sphere = dynamic_cast<const Sphere*>(body.shape.get())) {
        solid.is_sphere = true;
        solid.reach = sphere->radius;
    } else if (body.bound) {
        const Real half = 0.5 * (body.bound->max - body.bound->min).norm();
        solid.reach = std::isfinite(half) ? half : 0;
    }
    const Body& moving = mover(scene, body);
    solid.moves = moving.isDynamic();
    solid.mass = moving.state->mass;
    if (const auto* material = dynamic_cast<const ElastMat*>(body.material.get())) {
        solid.young = material->young;
        solid.poisson = material->poisson;
        solid.density = material->density;
    }
    if (solid.is_sphere && !body.isClumpMember())
        solid.density = solid.mass / (4 * ts::pi / 3 * solid.reach * solid.reach * solid.reach);
    return solid;
}

// Smallest box that holds the velocities of all bodies, surface points of those that turn included: no two
// bodies approach faster than its diagonal, seen from any moving frame.
class VelocityBox {
public:
    void add(const Body& body, const Solid& solid) {
        const Real spin = solid.is_sphere ? 0 : body.state->angVel.norm() * solid.reach;
        for (int i = 0; i < 3; ++i) {
            low_[i] = std::min(low_[i], body.state->vel[i] - spin);
            high_[i] = std::max(high_[i], body.state->vel[i] + spin);
        }
        const Real squared = body.state->vel.squaredNorm() + spin * spin;
        if (squared > fastest_squared_) {
            fastest_squared_ = squared;
            fastest_ = body.id;
        }
    }
    Real largest_difference() const { return fastest_ < 0 ? 0 : (high_ - low_).norm(); }
    Body::id_t fastest() const { return fastest_; }

private:
    Vector3r low_ = Vector3r::Constant(ts::no_limit), high_ = Vector3r::Constant(-ts::no_limit);
    Real fastest_squared_ = 0;
    Body::id_t fastest_ = -1;
};

std::string approach(const VelocityBox& box) {
    std::ostringstream text;
    text.precision(3);
    text << "approach of " << box.fastest() << " at " << box.largest_difference() << " m/s";
    return text.str();
}

StepLimit rayleigh_limit(const std::vector<Solid>& solids) {
    StepLimit least;
    for (const Solid& solid : solids) {
        if (!solid.is_sphere || !solid.moves || !(solid.young > 0 && solid.density > 0))
            continue;
        const Real step = ts::rayleigh_step(solid.reach, solid.density, solid.young, solid.poisson);
        if (step < least.step) {
            least.step = step;
            least.bodies = {solid.id};
        }
    }
    if (!least.bodies.empty())
        least.reason = "Rayleigh step of " + std::to_string(least.bodies[0]);
    return least;
}

// Of two bodies that meet let b be the lighter one: m* >= m_b/2, R* <= R_b, E* at most with the stiffest
// partner. The limit depends on them through m*/K alone.
StepLimit impact_limit(const std::vector<Solid>& solids, const VelocityBox& box) {
    Real stiffest = 0;
    for (const Solid& solid : solids)
        stiffest = std::max(stiffest, solid.plane_modulus());
    Real least = ts::no_limit;
    Body::id_t weakest = -1;
    for (const Solid& solid : solids) {
        if (!solid.moves || !(solid.young > 0 && solid.reach > 0 && solid.mass > 0))
            continue;
        const Real modulus = 1 / (1 / solid.plane_modulus() + 1 / stiffest);
        const Real ratio = solid.mass / 2 / (4.0 / 3 * modulus * std::sqrt(solid.reach));
        if (ratio < least) {
            least = ratio;
            weakest = solid.id;
        }
    }
    if (weakest < 0)
        return {};
    return {ts::impact_limit(1, least, box.largest_difference()),
            {box.fastest(), weakest},
            approach(box) + ", impact on " + std::to_string(weakest)};
}

} // namespace

FlightLimits flight_limits(const Scene& scene) {
    VelocityBox box;
    std::vector<Solid> solids;
    solids.reserve(scene.bodies->size());
    Real smallest = ts::no_limit;
    for (const auto& body : *scene.bodies) {
        if (!body || !body->shape || body->isClump())
            continue;
        const Solid& solid = solids.emplace_back(describe(scene, *body));
        box.add(*body, solid);
        if ((solid.moves || solid.is_sphere) && solid.reach > 0)
            smallest = std::min(smallest, solid.reach);
    }
    FlightLimits limits;
    limits.rayleigh = rayleigh_limit(solids);
    const Real speed = box.largest_difference();
    if (!(speed > 0) || smallest == ts::no_limit)
        return limits;
    limits.displacement = {smallest / speed, {box.fastest()}, approach(box) + ", displacement"};
    limits.impact = impact_limit(solids, box);
    return limits;
}

} // namespace yade
