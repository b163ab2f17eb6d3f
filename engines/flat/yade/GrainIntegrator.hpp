// SPDX-License-Identifier: GPL-2.0-or-later
// Drop-in for NewtonIntegrator beside GrainInteractionLoop.
#pragma once

#include <engines/flat/motion_book.hpp>

#include <core/Body.hpp>
#include <pkg/dem/NewtonIntegrator.hpp>

namespace yade {

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
    void move_other(Body& body, const grainfall::flat::StepRules& rules);
    void settle_books(const grainfall::flat::MotionBook& grains);

    grainfall::flat::MotionBook booked_; // of bodies that are no flat spheres, in this step
};
REGISTER_SERIALIZABLE(GrainIntegrator);

} // namespace yade
