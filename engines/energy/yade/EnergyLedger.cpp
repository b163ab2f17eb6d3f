// SPDX-License-Identifier: GPL-2.0-or-later
#include <engines/energy/yade/EnergyLedger.hpp>

#include <engines/energy/yade/engine_order.hpp>
#include <engines/energy/yade/newton_motion.hpp>
#include <engines/flat/yade/GrainInteractionLoop.hpp>
#include <femlink/yade/scene_walls.hpp>
#include <laws/validation.hpp>
#include <laws/yade/GrainPhys.hpp>
#include <laws/yade/stored_energy.hpp>

#include <core/Interaction.hpp>
#include <core/InteractionContainer.hpp>
#include <core/Omega.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <stdexcept>

namespace yade {

YADE_PLUGIN((EnergyLedger));
CREATE_LOGGER(EnergyLedger);

namespace ge = grainfall::energy;
using ge::Term;

namespace {

#pragma omp declare reduction(+ : ge::StepSums : omp_out += omp_in)

ge::Amounts amounts(const vector<Real>& values) {
    ge::Amounts result;
    std::copy(values.begin(), values.end(), result.value.begin());
    return result;
}

/// Sum in O.energy under a name; 0 where there is none.
Real booked(const EnergyTracker& energy, const char* name) {
    const auto place = energy.names.find(name);
    return place == energy.names.end() ? 0 : energy.energies.get(place->second);
}

/// "potential" -> "ledgerPotential"
string name_in_tracker(const string& term) {
    string name = "ledger" + term;
    name[6] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[6])));
    return name;
}

/// Steps past a work kept as two numbers, done and pending.
void step_work(vector<Real>& works, size_t place, const ge::HalfWorks& halves) {
    ge::TrapezoidWork work{works[place], works[place + 1]};
    work.step(halves.before, halves.after);
    works[place] = work.done;
    works[place + 1] = work.pending;
}

} // namespace

void EnergyLedger::validate() const {
    if (iterPeriod < 1)
        grainfall::laws::reject("EnergyLedger.iterPeriod", iterPeriod, ">= 1");
}

void EnergyLedger::forget() {
    now.assign(ge::term_count, 0);
    start.assign(ge::term_count, 0);
    works.assign(6, 0);
    motion.assign(3, 0);
    broughtKinetic = energyInPlay = largestResidual = stepChangeEnergy = lastTimeStep = 0;
    firstStep = lastStep = countedStep = balancedStep = -1;
    velocities.clear();
    spins.clear();
    blocked.clear();
}

void EnergyLedger::preSave(EnergyLedger&) {
    if (!Omega::instance().isRunning())
        update();
}

void EnergyLedger::restart() {
    forget();
}

void EnergyLedger::action() {
    find_integrator();
    grains_ = flat_grains(*scene);
    check_scene();
    scene->trackEnergy = true;
    if (lastStep >= 0 && scene->iter != lastStep + 1) {
        LOG_WARN("steps " << lastStep + 1 << " to " << scene->iter - 1
                          << " were made without the ledger: the balance starts anew.");
        forget();
    }
    const bool first = firstStep < 0;
    if (first) {
        firstStep = scene->iter;
        lastTimeStep = scene->dt;
        name_integrator_works();
    }
    const bool due = first || (scene->iter - firstStep) % iterPeriod == 0;
    book_works(due);
    lastStep = scene->iter;
    lastTimeStep = scene->dt;
    forces_are_those_of_last_step_ = true;
    if (due)
        balance();
}

/// NewtonIntegrator names them when it first books them, from all its threads at once, and loses what another
/// thread books meanwhile.
void EnergyLedger::name_integrator_works() const {
    int index = -1;
    scene->energy->findId("gravWork", index, false, true);
    index = -1;
    if (integrator_->damping != 0)
        scene->energy->findId("nonviscDamp", index, false, true);
}

/// The engines are looked at again only when they have changed.
void EnergyLedger::find_integrator() {
    const auto same = [](const shared_ptr<Engine>& engine, const Engine* checked) {
        return engine.get() == checked;
    };
    const auto& engines = scene->engines;
    const bool unchanged = integrator_ && engines.size() == checked_order_.size() &&
                           std::equal(engines.begin(), engines.end(), checked_order_.begin(), same);
    if (!unchanged) {
        integrator_ = integrator_before(*this, engines);
        checked_order_.clear();
        for (const auto& engine : engines)
            checked_order_.push_back(engine.get());
    }
    if (integrator_->dead)
        throw std::runtime_error("EnergyLedger: NewtonIntegrator.dead = True: must be False (or set "
                                 "EnergyLedger.dead too)");
}

void EnergyLedger::check_scene() const {
    if (integrator_->densityScaling)
        throw std::runtime_error("NewtonIntegrator.densityScaling = True: must be False with EnergyLedger; "
                                 "scaled masses have no energy balance");
    const Cell& cell = *scene->cell;
    if (scene->isPeriodic && !(cell.velGrad.isZero(0) && cell.prevVelGrad.isZero(0)))
        throw std::runtime_error("O.cell.velGrad is not zero: must be zero with EnergyLedger, which does not "
                                 "know the work of a deforming cell");
    if (!scene->forces.synced)
        throw std::runtime_error("EnergyLedger: an engine adds forces after NewtonIntegrator; EnergyLedger "
                                 "must stand before it");
}

bool EnergyLedger::needs_every_body(const Scene& in) const {
    const bool due = firstStep < 0 || (in.iter - firstStep) % iterPeriod == 0;
    return due || !integrator_ || integrator_->damping != 0 || in.forces.getPermForceUsed() ||
           in.dt != lastTimeStep || lastStep + 1 != in.iter;
}

/// Sum over the bodies that the integrator moves; `add(id, body, sums)` runs in several threads. Where
/// nothing is known of the grains of the flat path they are left out: they are free and exchange energy with
/// contacts and gravity only.
template <class Add>
ge::StepSums EnergyLedger::sum_over_bodies(const Add& add) {
    const auto& bodies = scene->bodies->body;
    const int count = static_cast<int>(bodies.size());
    ge::StepSums sums;
    if (grains_ && !grains_->states_are_published()) {
        for (const Body* body : grains_->others())
            if (!body->isClumpMember() && (integrator_->mask <= 0 || (body->groupMask & integrator_->mask)))
                add(body->id, *body, sums);
        return sums;
    }
#pragma omp parallel for schedule(static) reduction(+ : sums) if (count > 1000)
    for (int id = 0; id < count; ++id) {
        const Body* body = bodies[id].get();
        const bool moved = body && !body->isClumpMember() &&
                           (integrator_->mask <= 0 || (body->groupMask & integrator_->mask));
        if (moved)
            add(id, *body, sums);
        else
            blocked[id] = -1;
    }
    return sums;
}

/// What the ledger or the flat path remembers; the present motion where neither does.
EarlierMotion EnergyLedger::earlier_motion(int id, const State& state) const {
    if (blocked[id] < 0)
        return {state.vel, state.angVel, static_cast<int>(state.blockedDOFs)};
    if (grains_ && grains_->is_flat(id)) {
        const auto& before = grains_->earlier_motion(id);
        return {before.velocity, before.spin, blocked[id]};
    }
    return {velocities[id], spins[id], blocked[id]};
}

/// Works of this step. A free body with neither damping nor load exchanges energy with contacts and gravity
/// only: it is passed over unless its energy is asked for.
void EnergyLedger::book_works(bool count_all) {
    const NewtonStep step(*integrator_, scene->forces, {scene->dt, lastTimeStep});
    const bool every_body = count_all || step.damping != 0 || step.has_loads || scene->dt != lastTimeStep;
    const size_t count = scene->bodies->body.size();
    velocities.resize(count);
    spins.resize(count);
    blocked.resize(count, -1);
    const auto add = [&](int id, const Body& body, ge::StepSums& sums) {
        const State& state = *body.state;
        const int is_blocked = static_cast<int>(state.blockedDOFs);
        if (every_body || is_blocked || blocked[id] > 0)
            add_body(body, earlier_motion(id, state), scene->forces, step, sums);
        velocities[id] = state.vel;
        spins[id] = state.angVel;
        blocked[id] = is_blocked;
    };
    const ge::StepSums sums = sum_over_bodies(add);
    step_work(works, 0, sums.imposed);
    step_work(works, 2, sums.load);
    step_work(works, 4, sums.damping);
    broughtKinetic += sums.brought_kinetic;
    stepChangeEnergy += sums.step_change;
    start[static_cast<size_t>(Term::potential)] += sums.brought_potential;
    if (every_body) {
        motion = {sums.kinetic_translation, sums.kinetic_rotation, sums.potential};
        countedStep = scene->iter;
    }
}

/// Kinetic and potential energy of the last step, in which there was no damping.
void EnergyLedger::count_motion() {
    NewtonStep step(*integrator_, scene->forces, {lastTimeStep, lastTimeStep});
    step.damping = 0;
    const auto add = [&](int id, const Body& body, ge::StepSums& sums) {
        add_body(body, {velocities[id], spins[id], blocked[id]}, scene->forces, step, sums);
    };
    const ge::StepSums sums = sum_over_bodies(add);
    motion = {sums.kinetic_translation, sums.kinetic_rotation, sums.potential};
    countedStep = lastStep;
}

/// Counts what the contacts hold and have lost. Valid until the next step turns to the contacts.
void EnergyLedger::balance() {
    if (countedStep != lastStep)
        count_motion();
    Real normal = 0, shear = 0, bridge = 0;
    int unknown = -1;
    const InteractionContainer& contacts = *scene->interactions;
    const int count = static_cast<int>(scene->interactions->size());
#pragma omp parallel for schedule(static) reduction(+ : normal, shear, bridge) reduction(max : unknown) if (count > 1000)
    for (int i = 0; i < count; ++i) {
        const Interaction& contact = *contacts[i];
        if (!contact.isReal())
            continue;
        if (!dynamic_cast<const GrainPhys*>(contact.phys.get()))
            unknown = std::max(unknown, i);
        const StoredEnergy stored = stored_energy(contact);
        normal += stored.normal;
        shear += stored.shear;
        bridge += stored.bridge;
    }
    if (unknown >= 0) {
        const Interaction& contact = *contacts[unknown];
        throw std::runtime_error("EnergyLedger: contact " + std::to_string(contact.getId1()) + "-" +
                                 std::to_string(contact.getId2()) + " is a " + contact.phys->getClassName() +
                                 ": must be a GrainPhys, whose stored energy is known");
    }
    ge::Amounts values;
    values[Term::kinetic_translation] = motion[0];
    values[Term::kinetic_rotation] = motion[1];
    values[Term::potential] = motion[2];
    values[Term::imposed_motion] = works[0] + broughtKinetic;
    const WallEnergies walls = wall_energies(*scene);
    values[Term::far_field] = walls.stored;
    values[Term::far_field_dissipation] = walls.dissipated;
    values[Term::imposed_motion] += walls.supplied;
    values[Term::permanent_load] = works[2];
    values[Term::numerical_damping] = 0 - works[4];
    values[Term::elastic_normal] = normal;
    values[Term::elastic_shear] = shear;
    values[Term::bridge] = bridge;
    for (const ge::TermName& term : ge::term_names)
        if (term.booked_by_law)
            values[term.term] = booked(*scene->energy, term.booked_by_law);
    now.assign(values.value.begin(), values.value.end());
    if (balancedStep < 0)
        start = now;
    balancedStep = lastStep;
    energyInPlay = std::max(energyInPlay, ge::energy_in_play(values, amounts(start)));
    largestResidual = std::max(largestResidual, std::abs(ge::residual(values, amounts(start))));
    write_energies();
}

void EnergyLedger::write_energies() {
    const auto write = [this](const string& name, Real value) {
        int place = -1;
        scene->energy->set(value, name_in_tracker(name), place);
    };
    for (const ge::TermName& term : ge::term_names)
        if (!term.booked_by_law)
            write(term.name, amounts(now)[term.term]);
    write("residual", ge::residual(amounts(now), amounts(start)));
}

/// Do forces and contacts still stand as the last step left them? Forces are not saved with a scene.
bool EnergyLedger::can_balance() const {
    const auto is_this = [this](const shared_ptr<Engine>& engine) { return engine.get() == this; };
    return forces_are_those_of_last_step_ && (!grains_ || grains_->states_are_published()) &&
           std::any_of(scene->engines.begin(), scene->engines.end(), is_this) &&
           scene->iter <= lastStep + 1 && scene->forces.synced && scene->forces.lastReset <= lastStep &&
           velocities.size() == scene->bodies->body.size();
}

void EnergyLedger::update() {
    scene = Omega::instance().getScene().get();
    grains_ = flat_grains(*scene);
    if (balancedStep != lastStep && can_balance())
        balance();
}

Real EnergyLedger::residual() {
    if (!Omega::instance().isRunning()) // else the contacts may be changing in another thread
        update();
    return ge::residual(amounts(now), amounts(start));
}

Real EnergyLedger::relativeResidual() {
    const Real size = std::abs(residual());
    return energyInPlay > 0 ? size / energyInPlay : 0;
}

boost::python::dict EnergyLedger::table() {
    const Real left_over = residual();
    boost::python::dict terms;
    for (const ge::TermName& term : ge::term_names)
        terms[term.name] = amounts(now)[term.term];
    terms["residual"] = left_over;
    terms["relativeResidual"] = relativeResidual();
    terms["energyInPlay"] = energyInPlay;
    terms["largestResidual"] = largestResidual;
    terms["stepChangeEnergy"] = stepChangeEnergy;
    return terms;
}

} // namespace yade
