// SPDX-License-Identifier: GPL-2.0-or-later
#include <engines/time_step/yade/scene_limits.hpp>

#include <laws/yade/GrainEffectPhys.hpp>

#include <core/Interaction.hpp>
#include <pkg/dem/ScGeom.hpp>

namespace yade {

namespace ts = grainfall::time_step;

namespace {

ts::Mobility mobility(const Body& body) {
    const State& state = *body.state;
    ts::Mobility free;
    Vector3r spin = Vector3r::Zero();
    for (int i = 0; i < 3; ++i) {
        if (!(state.blockedDOFs & (State::DOF_X << i)) && state.mass > 0)
            free.translation[i] = 1 / std::sqrt(state.mass);
        if (!(state.blockedDOFs & (State::DOF_RX << i)) && state.inertia[i] > 0)
            spin[i] = 1 / std::sqrt(state.inertia[i]);
    }
    // As NewtonIntegrator has it: inertia along the body's axes for aspherical bodies that turn freely, along
    // the global ones for all others.
    if (body.isAspherical() && !(state.blockedDOFs & State::DOF_RXRYRZ)) {
        const Matrix3r axes = state.ori.toRotationMatrix();
        free.rotation = axes * spin.asDiagonal() * axes.transpose();
    } else {
        free.rotation = spin.asDiagonal();
    }
    return free;
}

struct ContactStiffness {
    ts::Stiffness spring;  // N/m
    ts::Stiffness dashpot; // N s/m
};

// N/m, slope of a bridge's attraction at the touch, where it is steepest (Willett et al. 2000, Eq 12). An
// attraction that falls with distance is a spring of negative stiffness and makes no step unstable; counted
// with its size, the fall of the force is resolved.
Real bridge_stiffness(const GrainPhys& phys) {
    const LiquidBridge* bridge = bridge_of(phys);
    return bridge && bridge->formed ? 2.1 * bridge->contactForce * bridge->inverseLength : 0;
}

// Tangent stiffness and damping of a contact that `mass` [kg] goes on to load at `approach` [m/s] until it
// stops: so the step need not change during an impact. Other springs between two bodies, such as the tangent
// of a liquid bridge, belong here. Contacts that are not of GrainPhys count with the stiffness they have.
ContactStiffness stiffness_ahead(const NormShearPhys& phys, Real overlap, Real mass, Real approach) {
    ContactStiffness ahead;
    const auto* grain = dynamic_cast<const GrainPhys*>(&phys);
    if (overlap < 0) {
        if (grain)
            ahead.spring.normal = bridge_stiffness(*grain);
        return ahead;
    }
    ahead.spring = {phys.kn, phys.ks};
    if (!grain)
        return ahead;
    const Real hertz = 1.5 * grain->normalCoefficient * std::sqrt(overlap);
    const Real factor = hertz > 0 && phys.kn > 0 ? phys.kn / hertz : 1; // of the normal law in use
    const Real reached = ts::overlap_reached(factor * grain->normalCoefficient, overlap, mass, approach);
    const Real root = std::sqrt(reached);
    ahead.spring.normal = 1.5 * factor * grain->normalCoefficient * root;
    ahead.spring.shear =
        overlap > 0 ? phys.ks * std::sqrt(reached / overlap) : grain->shearCoefficient * root;
    if (grain->normalDamping > 0) {
        const Real quarter = std::sqrt(root);
        ahead.dashpot.normal = grain->normalDamping * quarter;
        ahead.dashpot.shear = ahead.spring.shear > 0 ? grain->shearDamping * quarter : 0;
    }
    return ahead;
}

// Which body of the network a body is; those that nothing moves are `held`.
std::vector<int> number_bodies(const Scene& scene, ts::ContactNetwork& network) {
    std::vector<int> numbers(scene.bodies->size(), ts::ContactNetwork::held);
    for (const auto& body : *scene.bodies)
        if (body && !body->isClumpMember() && body->isDynamic())
            numbers[body->id] = network.add_body(mobility(*body));
    for (const auto& body : *scene.bodies)
        if (body && body->isClumpMember())
            numbers[body->id] = numbers[body->clumpId];
    return numbers;
}

Vector3r velocity_at(const State& state, const Vector3r& lever) {
    return state.vel + state.angVel.cross(lever);
}

bool make_spring(const Scene& scene, const ts::ContactNetwork& network, const std::vector<int>& numbers,
                 const Interaction& contact, ts::Spring& spring) {
    const auto* geom = dynamic_cast<const ScGeom*>(contact.geom.get());
    const auto* phys = dynamic_cast<const NormShearPhys*>(contact.phys.get());
    if (!geom || !phys)
        return false;
    spring.first = numbers[contact.getId1()];
    spring.second = numbers[contact.getId2()];
    spring.normal = geom->normal;
    Real inverse_mass = 0;
    for (const int body : {spring.first, spring.second})
        if (body != ts::ContactNetwork::held)
            inverse_mass += network.mobility(body).inverse_mass(geom->normal);

    const Body& first = *(*scene.bodies)[contact.getId1()];
    const Body& second = *(*scene.bodies)[contact.getId2()];
    Vector3r shift = Vector3r::Zero(), shift_velocity = Vector3r::Zero();
    if (scene.isPeriodic) {
        shift = scene.cell->intrShiftPos(contact.cellDist);
        shift_velocity = scene.cell->intrShiftVel(contact.cellDist);
    }
    const Vector3r point = geom->contactPoint;
    const Vector3r closing = velocity_at(*first.state, point - first.state->pos) - shift_velocity -
                             velocity_at(*second.state, point - second.state->pos - shift);
    const Real approach = inverse_mass > 0 ? closing.dot(geom->normal) : 0;
    const Real mass = inverse_mass > 0 ? 1 / inverse_mass : 0;
    const ContactStiffness ahead = stiffness_ahead(*phys, geom->penetrationDepth, mass, approach);
    spring.first_lever = point - mover(scene, first).state->pos;
    spring.second_lever = point - mover(scene, second).state->pos - shift;
    spring.stiffness = ahead.spring;
    spring.damping = ahead.dashpot;
    return ahead.spring.normal > 0 || ahead.spring.shear > 0;
}

std::string contact_name(const Interaction& contact) {
    return "contact of " + std::to_string(contact.getId1()) + " and " + std::to_string(contact.getId2());
}

} // namespace

StepLimit contact_limit(const Scene& scene, ts::ContactNetwork& network, Real guess) {
    network.clear();
    const std::vector<int> numbers = number_bodies(scene, network);
    std::vector<const Interaction*> contacts;
    ts::Spring spring;
    for (const auto& contact : *scene.interactions) {
        if (!contact->isReal() || !make_spring(scene, network, numbers, *contact, spring))
            continue;
        network.add(spring);
        contacts.push_back(contact.get());
    }
    const ts::StabilityLimit found = network.limit(guess);
    if (found.spring < 0)
        return {};
    const Interaction& deciding = *contacts[found.spring];
    const char* motion = found.rotation ? ", rotation" : ", translation";
    return {found.step, {deciding.getId1(), deciding.getId2()}, contact_name(deciding) + motion};
}

StepLimit report_limit(const Scene& scene) {
    Real least = ts::no_limit;
    const Interaction* deciding = nullptr;
    for (const auto& contact : *scene.interactions) {
        if (!contact->isReal())
            continue;
        const auto* geom = dynamic_cast<const ScGeom*>(contact->geom.get());
        const auto* phys = dynamic_cast<const GrainPhys*>(contact->phys.get());
        if (!geom || !phys || geom->penetrationDepth <= 0)
            continue;
        Real mass = ts::no_limit; // of the smaller one; a held body is heavier than any
        for (const Body::id_t id : {contact->getId1(), contact->getId2()}) {
            const Body& body = mover(scene, *(*scene.bodies)[id]);
            if (body.isDynamic())
                mass = std::min(mass, body.state->mass);
        }
        const Real step = ts::report_step(mass, phys->normalCoefficient, geom->penetrationDepth);
        if (step < least) {
            least = step;
            deciding = contact.get();
        }
    }
    if (!deciding)
        return {};
    return {least, {deciding->getId1(), deciding->getId2()}, contact_name(*deciding) + ", Eq 7-8"};
}

} // namespace yade
