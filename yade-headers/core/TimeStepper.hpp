// SPDX-License-Identifier: GPL-2.0-or-later
// Facts: TimeStepper is 112 bytes: active 104, timeStepUpdateInterval 108 (true, 1); slot computeTimeStep
// follows Engine's; isActivated and action are its own. YADE finds steppers by dynamic_cast. Verified:
// tests/abi.
#pragma once

#include <core/GlobalEngine.hpp>
#include <core/Interaction.hpp>
#include <core/Scene.hpp>

namespace yade {

class TimeStepper : public GlobalEngine {
public:
    TimeStepper() : active(true), timeStepUpdateInterval(1) {}
    virtual void computeTimeStep(Scene*);
    bool isActivated() override;
    void action() override;

    bool active;
    unsigned int timeStepUpdateInterval;

    YADE_ABI_STOCK_CLASS(TimeStepper)
};

} // namespace yade

YADE_ABI_STOCK_SERIALIZERS(TimeStepper)
