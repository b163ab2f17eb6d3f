// SPDX-License-Identifier: GPL-2.0-or-later
// Energy balance of a scene, booked into O.energy.
#pragma once

#include <lib/base/Math.hpp>
#include <core/GlobalEngine.hpp>

#include <engines/energy/balance.hpp>
#include <engines/energy/leapfrog.hpp>
#include <laws/yade/attribute_checks.hpp>

namespace yade {

class FlatGrains;
class NewtonIntegrator;
class State;
struct EarlierMotion;

class EnergyLedger : public GlobalEngine {
public:
    virtual ~EnergyLedger() = default;
    void action() override;
    void validate() const;
    void postLoad(EnergyLedger&) { validate(); }
    void preSave(EnergyLedger&);

    /// Brings the balance up to the last step that was made; see the Python description.
    void update();
    /// Forgets all books; the balance starts at the next step.
    void restart();

    /// Will it look at every body and contact in the coming step? If not, only at what the flat path does not
    /// hold.
    bool needs_every_body(const Scene& in) const;

    Real residual();
    Real relativeResidual();
    boost::python::dict table();

    // clang-format off
    YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(EnergyLedger, GlobalEngine,
        "Energy balance of the scene [J]: what moves, stores, dissipates and supplies energy, and the residual that no book explains. Place "
        "it after :yref:`NewtonIntegrator`, as the last engine; it switches :yref:`O.trackEnergy<Omega.trackEnergy>` on. The balance "
        "starts at the first step with the ledger. Terms are booked so that the leapfrog's own half steps cancel (see "
        "docs/physics/energy.md): the residual is the error of the time integration in the contacts. Into O.energy go the terms of "
        ":yref:`table<EnergyLedger.table>` as ledgerKineticTranslation and so on, besides grainFriction, grainViscous, "
        "grainRescaling and grainBridge, which the contact law books. Motion counts as imposed where :yref:`State.blockedDOFs` says so and is taken "
        "from the velocities. Bodies added or erased, and velocities or positions of free bodies set by hand, show in the residual "
        "until :yref:`restart<EnergyLedger.restart>`; so does work of forces that other engines add.",
        ((int, iterPeriod, 100, , "Steps between two balances [-], >= 1. Works are summed in every step; this is how often stored energies are counted and O.energy and the maxima are brought up to date. Residual and table are for the last step whenever the simulation stands still."))
        ((Real, energyInPlay, 0, Attr::readonly, "Largest so far of the kinetic energy and of the energy that has changed hands since the start [J]."))
        ((Real, largestResidual, 0, Attr::readonly, "Largest magnitude of the residual at the balances so far [J]."))
        ((Real, stepChangeEnergy, 0, Attr::readonly, "Energy that the integrator itself made because the time step changed [J]; it is part of the residual. Rotation of bodies with unequal moments of inertia is not in it: YADE integrates that to first order anyway."))
        ((long, lastStep, -1, Attr::readonly, "Last step that the ledger has booked [-]."))
        ((long, balancedStep, -1, Attr::readonly, "Step of the last balance [-]."))
        ((long, firstStep, -1, Attr::readonly, "Step at which the balance started [-]."))
        ((Real, lastTimeStep, 0, Attr::hidden, "dt of the last step."))
        ((vector<Real>, now, , Attr::hidden, "Terms at the last balance, in the order of grainfall::energy::Term."))
        ((vector<Real>, start, , Attr::hidden, "The same when the balance started."))
        ((vector<Real>, motion, , Attr::hidden, "Kinetic energy of translation and rotation, potential energy at `countedStep`."))
        ((long, countedStep, -1, Attr::hidden, "Step that `motion` belongs to."))
        ((vector<Real>, works, , Attr::hidden, "Done and pending: imposed motion, permanent load, damping."))
        ((Real, broughtKinetic, 0, Attr::hidden, "Kinetic energy of what was let go less that of what was caught."))
        ((vector<Vector3r>, velocities, , Attr::hidden, "By body, after the last step."))
        ((vector<Vector3r>, spins, , Attr::hidden, "By body, after the last step."))
        ((vector<int>, blocked, , Attr::hidden, "State.blockedDOFs by body in the last step; -1 for none."))
        ,
        forget();
        ,
        .def(CheckedAttributes<EnergyLedger>().add("iterPeriod", &EnergyLedger::iterPeriod))
        .add_property("residual", &EnergyLedger::residual,
            "Energy that appeared (> 0) or vanished without explanation since the start [J].")
        .add_property("relativeResidual", &EnergyLedger::relativeResidual,
            "Magnitude of the residual over energyInPlay [-]; 0 while nothing has moved.")
        .def("table", &EnergyLedger::table,
            "All terms by name [J]: stored (kineticTranslation, kineticRotation, potential, elasticNormal, elasticShear, bridge, farField: deformable walls), dissipated since the "
            "start or since the contact law began to book (friction, viscous, rescaling, bridgeRupture, numericalDamping), supplied (imposedMotion, "
            "permanentLoad, shearKinematics), and residual, relativeResidual, energyInPlay, largestResidual, stepChangeEnergy.")
        .def("update", &EnergyLedger::update,
            "Strike a balance now, for the last step. For engines that run after the ledger; in a scene that stands still the other "
            "members do it themselves.")
        .def("restart", &EnergyLedger::restart,
            "Forget all books; the balance starts anew with the next step. For after bodies were changed by hand.")
    );
    // clang-format on
    DECLARE_LOGGER;

private:
    vector<const Engine*> checked_order_;
    shared_ptr<const NewtonIntegrator> integrator_;
    bool forces_are_those_of_last_step_ = false;

    const FlatGrains* grains_ = nullptr; // in this step; null on the general path

    void forget();
    EarlierMotion earlier_motion(int id, const State& state) const;
    void name_integrator_works() const;
    void find_integrator();
    void check_scene() const;
    template <class Add>
    grainfall::energy::StepSums sum_over_bodies(const Add& add);
    void book_works(bool count_all);
    void count_motion();
    void balance();
    void write_energies();
    bool can_balance() const;
};
REGISTER_SERIALIZABLE(EnergyLedger);

} // namespace yade
