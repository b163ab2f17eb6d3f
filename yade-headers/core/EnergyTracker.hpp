// SPDX-License-Identifier: GPL-2.0-or-later
// Facts: EnergyTracker is 176 bytes: sums 24, names 88, reset flags 136. findId (exported) gives a name its
// index and returns at once for an index above 0; entries made with reset=true are zeroed at each step. A
// first findId from a parallel region may move memory that another thread is adding to: register names
// beforehand. Verified: tests/abi.
#pragma once

#include <lib/base/openmp-accu.hpp>
#include <lib/serialization/Serializable.hpp>

namespace yade {

class EnergyTracker : public Serializable {
public:
    EnergyTracker();
    void findId(const string& name, int& id, bool reset = false, bool newIfNotFound = true);
    void set(const Real& value, const string& name, int& id) {
        if (id < 0)
            findId(name, id);
        energies.set(id, value);
    }
    void add(const Real& value, const string& name, int& id, bool reset = false) {
        if (id < 0)
            findId(name, id, reset);
        energies.add(id, value);
    }

    OpenMPArrayAccumulator<Real> energies;
    std::map<string, int> names;
    vector<bool> resetStep;

    YADE_ABI_STOCK_CLASS(EnergyTracker)
};

} // namespace yade
