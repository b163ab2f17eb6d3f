// SPDX-License-Identifier: GPL-2.0-or-later
#include <engines/energy/yade/engine_order.hpp>

#include <core/TimeStepper.hpp>

#include <stdexcept>

namespace yade {

shared_ptr<const NewtonIntegrator> integrator_before(const Engine& ledger,
                                                     const vector<shared_ptr<Engine>>& engines) {
    shared_ptr<const NewtonIntegrator> integrator;
    const Engine* between = nullptr;
    bool behind_ledger = false;
    for (const auto& engine : engines) {
        if (engine.get() == &ledger) {
            behind_ledger = true;
        } else if (const auto newton = boost::dynamic_pointer_cast<const NewtonIntegrator>(engine)) {
            if (behind_ledger)
                throw std::runtime_error(
                    "EnergyLedger stands before NewtonIntegrator in O.engines: must stand "
                    "after it, as the last engine");
            if (integrator)
                throw std::runtime_error("EnergyLedger: two NewtonIntegrators in O.engines; must be one");
            integrator = newton;
            between = nullptr;
        } else if (!behind_ledger && (dynamic_cast<const TimeStepper*>(engine.get()) ||
                                      engine->getClassName() == "ForceResetter")) {
            between = engine.get();
        }
    }
    if (!integrator)
        throw std::runtime_error("EnergyLedger: no NewtonIntegrator in O.engines; must stand after one");
    if (between)
        throw std::runtime_error("EnergyLedger: " + between->getClassName() +
                                 " stands between NewtonIntegrator and the ledger; must stand before "
                                 "NewtonIntegrator");
    return integrator;
}

} // namespace yade
