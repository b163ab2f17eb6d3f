// SPDX-License-Identifier: GPL-2.0-or-later
// Facts: Engine is 104 bytes: scene 24, timing 32, dead 64, ompThreads 68, label 72; slots isActivated and
// action follow Serializable's. Its exported constructor sets scene to the current one. Verified: tests/abi.
#pragma once

#include <lib/base/Logging.hpp>
#include <lib/serialization/Serializable.hpp>
#include <core/Omega.hpp>
#include <core/Timing.hpp>

namespace yade {

class Scene;

class Engine : public Serializable {
public:
    Engine();
    virtual bool isActivated();
    virtual void action();

    /// Set before each step.
    Scene* scene;
    TimingInfo timingInfo;
    shared_ptr<TimingDeltas> timingDeltas;
    bool dead;
    int ompThreads;
    string label;

    YADE_ABI_STOCK_CLASS(Engine)
};

} // namespace yade

YADE_ABI_STOCK_SERIALIZERS(Engine)
