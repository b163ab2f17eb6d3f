// SPDX-License-Identifier: GPL-2.0-or-later
// Facts: Omega's member functions used here are exported; buildDynlibDatabase, private to YADE but exported,
// creates classes, fills the inheritance database and registers them with Python. DynlibDescriptor is a set
// of base names and a flag (56 bytes). Verified: symbols of libyade.so, tests/abi. Omega's own layout is not
// needed.
#pragma once

#include <lib/base/Math.hpp>
#include <lib/base/Singleton.hpp>
#include <lib/factory/ClassFactory.hpp>

#include <set>

namespace yade {

class Scene;

struct DynlibDescriptor {
    std::set<string> baseClasses;
    bool isSerializable;
};

class Omega : public Singleton<Omega> {
    void buildDynlibDatabase(const vector<string>& classes);

public:
    Omega(const Omega&) = delete;
    const shared_ptr<Scene>& getScene() const;
    const std::map<string, DynlibDescriptor>& getDynlibsDescriptor() const;
    bool isInheritingFrom_recursive(const string& klass, const string& base);
    Real getRealTime() const;
    bool isRunning();
    void pause();
};

} // namespace yade
