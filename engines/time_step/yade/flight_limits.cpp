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

// Pa, E/(1 - nu^2); 0 for a material that is not elastic.
Real plane_modulus(const Body& body) {
    const auto* material = dynamic_cast<const ElastMat*>(body.material.get());
    return material ? material->young / (1 - material->poisson * material->poisson) : 0;
}

// m, how far a body reaches from its position; 0 for one without an end, such as a wall.
Real reach(const Body& body) {
    if (const auto* sphere = dynamic_cast<const Sphere*>(body.shape.get()))
        return sphere->radius;
    const Real half = body.bound ? 0.5 * (body.bound->max - body.bound->min).norm() : 0;
    return std::isfinite(half) ? half : 0;
}

// Smallest box that holds the velocities of all bodies, surface points of those that turn included: no two
// bodies approach faster than its diagonal, seen from any moving frame.
class VelocityBox {
public:
    void add(const Body& body) {
        const Real spin =
            dynamic_cast<const Sphere*>(body.shape.get()) ? 0 : body.state->angVel.norm() * reach(body);
        const Vector3r low = body.state->vel.array() - spin, high = body.state->vel.array() + spin;
        for (int i = 0; i < 3; ++i) {
            if (low[i] < low_[i])
                low_[i] = low[i];
            if (high[i] > high_[i])
                high_[i] = high[i];
        }
        const Real speed = body.state->vel.norm() + spin;
        if (speed > fastest_speed_) {
            fastest_speed_ = speed;
            fastest_ = body.id;
        }
    }
    Real largest_difference() const { return fastest_ < 0 ? 0 : (high_ - low_).norm(); }
    Body::id_t fastest() const { return fastest_; }

private:
    Vector3r low_ = Vector3r::Constant(ts::no_limit), high_ = Vector3r::Constant(-ts::no_limit);
    Real fastest_speed_ = 0;
    Body::id_t fastest_ = -1;
};

std::string approach(const VelocityBox& box) {
    std::ostringstream text;
    text.precision(3);
    text << "approach of " << box.fastest() << " at " << box.largest_difference() << " m/s";
    return text.str();
}

bool is_solid(const Body& body) {
    return body.shape && body.state && !body.isClump();
}

void add_rayleigh(const Scene& scene, const Body& body, StepLimit& least) {
    const auto* sphere = dynamic_cast<const Sphere*>(body.shape.get());
    const auto* material = dynamic_cast<const ElastMat*>(body.material.get());
    if (!sphere || !material || !mover(scene, body).isDynamic() || !(material->young > 0))
        return;
    const Real volume = 4 * ts::pi / 3 * sphere->radius * sphere->radius * sphere->radius;
    const Real density = body.isClumpMember() ? material->density : body.state->mass / volume;
    const Real step = ts::rayleigh_step(sphere->radius, density, material->young, material->poisson);
    if (step > 0 && step < least.step) {
        least.step = step;
        least.bodies = {body.id};
    }
}

} // namespace

FlightLimits flight_limits(const Scene& scene) {
    FlightLimits limits;
    VelocityBox box;
    Real stiffest = 0, smallest = ts::no_limit;
    for (const auto& body : *scene.bodies) {
        if (!body || !is_solid(*body))
            continue;
        box.add(*body);
        stiffest = std::max(stiffest, plane_modulus(*body));
        const Real radius = reach(*body);
        const bool counts = mover(scene, *body).isDynamic() || dynamic_cast<const Sphere*>(body->shape.get());
        if (counts && radius > 0)
            smallest = std::min(smallest, radius);
        add_rayleigh(scene, *body, limits.rayleigh);
    }
    if (!limits.rayleigh.bodies.empty())
        limits.rayleigh.reason = "Rayleigh step of " + std::to_string(limits.rayleigh.bodies[0]);

    const Real speed = box.largest_difference();
    if (!(speed > 0) || smallest == ts::no_limit)
        return limits;
    limits.displacement = {smallest / speed, {box.fastest()}, approach(box) + ", displacement"};
    // Of two bodies that meet call b the lighter one: m* >= m_b/2, R* <= R_b, E* at most with the
    // stiffest partner.
    for (const auto& body : *scene.bodies) {
        if (!body || !is_solid(*body) || !mover(scene, *body).isDynamic())
            continue;
        const Real modulus = plane_modulus(*body), radius = reach(*body);
        const Real mass = mover(scene, *body).state->mass;
        if (!(modulus > 0 && radius > 0 && mass > 0))
            continue;
        const Real pair_modulus = 1 / (1 / modulus + 1 / stiffest);
        const Real coefficient = 4.0 / 3 * pair_modulus * std::sqrt(radius);
        const Real step = ts::impact_limit(coefficient, mass / 2, speed);
        if (step < limits.impact.step)
            limits.impact = {step, {box.fastest(), body->id}, ""};
    }
    if (!limits.impact.bodies.empty())
        limits.impact.reason = approach(box) + ", impact on " + std::to_string(limits.impact.bodies[1]);
    return limits;
}

} // namespace yade
