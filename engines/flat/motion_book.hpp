// SPDX-License-Identifier: GPL-2.0-or-later
// What YADE's NewtonIntegrator books of the bodies that it moves: before the step, with the velocities of the
// step before. All in J.
#pragma once

#include <engines/flat/sphere_motion.hpp>

namespace grainfall::flat {

struct MotionBook {
    double translation = 0, rotation = 0, gravity_work = 0, damping = 0;

    // `own_spin`: in the axes to which the moments of inertia belong.
    void add(const Inertia& inertia, const Motion& motion, const Vector& own_spin, const Vector& force,
             const Vector& torque, const StepRules& rules) {
        translation += 0.5 * inertia.mass * motion.velocity.squaredNorm();
        rotation += 0.5 * own_spin.dot(inertia.inertia.cwiseProduct(own_spin));
        gravity_work -= rules.gravity.dot(motion.velocity) * inertia.mass * rules.time_step;
        if (rules.damping == 0 || !inertia.damped)
            return;
        const Vector push = force + inertia.mass * rules.gravity;
        damping += (motion.velocity.cwiseAbs().dot(push.cwiseAbs()) +
                    motion.spin.cwiseAbs().dot(torque.cwiseAbs())) *
                   rules.damping * rules.time_step;
    }

    MotionBook& operator+=(const MotionBook& other) {
        translation += other.translation;
        rotation += other.rotation;
        gravity_work += other.gravity_work;
        damping += other.damping;
        return *this;
    }
};

} // namespace grainfall::flat
