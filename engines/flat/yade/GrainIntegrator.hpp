// SPDX-License-Identifier: GPL-2.0-or-later
// Drop-in for NewtonIntegrator beside GrainInteractionLoop.
#pragma once

#include <engines/flat/yade/FlatGrains.hpp>

#include <core/Body.hpp>
#include <pkg/dem/NewtonIntegrator.hpp>

namespace yade {

class GrainInteractionLoop;

class GrainIntegrator : public NewtonIntegrator {
public:
    virtual ~GrainIntegrator();

    void action() override;

    // clang-format off
    YADE_CLASS_BASE_DOC_ATTRS(GrainIntegrator, NewtonIntegrator,
        "Drop-in for :yref:`NewtonIntegrator`, with the same attributes: moves the grains of :yref:`GrainInteractionLoop` in its packed arrays and "
        "all other bodies as NewtonIntegrator does. Without such a loop, or while that runs on the general path, it is NewtonIntegrator.",
    );
    // clang-format on

private:
    GrainInteractionLoop* loop() const;
    void move_other(Body& body, const grainfall::flat::StepRules& rules);
    void book(const Body& body, const Vector3r& force, const Vector3r& torque);
    void settle_books(const FlatGrains::MotionBook& grains);

    FlatGrains::MotionBook booked_; // of bodies that are no flat spheres, in this step
};
REGISTER_SERIALIZABLE(GrainIntegrator);

} // namespace yade
