// SPDX-License-Identifier: GPL-2.0-or-later
// Life of a liquid bridge: it forms when the grains touch, outlives the contact, ruptures when they are
// farther apart than its rupture distance, and forms again only at the next touch.
//
//   Form    WillettNumeric | WillettClosed
//   Film    NoFilm | SqueezeFilm
//   Energy  NoEnergy | BridgeBook
//
// The hysteresis costs energy: a bridge takes the work of the whole pull up to rupture and has given none
// before the touch. Separation < 0 is overlap. Forces act along the contact normal; the bridge knows nothing
// of the contact's own force, so that the Coulomb limit goes on reading what presses the surfaces together:
// elastic and dashpot force, which the attraction has raised by itself.
#pragma once

#include <laws/bridge/lubrication.hpp>
#include <laws/bridge/willett.hpp>
#include <laws/energy.hpp>

#include <cmath>
#include <limits>

namespace grainfall::laws::bridge {

struct BridgeParameters {
    ForceCurve curve;
    FilmParameters film;
    double rupture_distance = 0; // m
};

struct BridgeMemory {
    bool formed = false;
    // m, of the last step; nan before the first.
    double separation = std::numeric_limits<double>::quiet_NaN();
    double attraction = 0;    // N, of the last step
    double viscous_force = 0; // N, of the last step, on body 2 along the normal
    double work = 0;          // J, done against the attraction since the bridge formed
};

// N, on body 2 along the normal; without the film's part where it is known to be none.
template <class Film>
double normal_force(const BridgeMemory& memory) {
    return Film::active ? memory.viscous_force - memory.attraction : -memory.attraction;
}

// Work is the mean of the forces before and after each displacement, times the displacement, as in
// energy.hpp: kinetic + elastic + `work` of all bridges + what is booked here stays constant.
struct BridgeBook {
    static constexpr bool active = true;
    double rupture = 0; // J, work that went into bridges which ruptured
    double viscous = 0; // J
};

enum class BridgeState { waiting, holding, ended };

template <class Form, class Film, class Energy>
struct LiquidBridge {
    // One step. `waiting`: not yet touched, but near enough to be kept. `ended`: ruptured, or too far apart.
    static BridgeState step(double separation, double normal_velocity, double time_step,
                            const BridgeParameters& parameters, BridgeMemory& memory, Energy& book) {
        const bool apart = separation >= parameters.rupture_distance;
        if (!memory.formed) {
            if (separation > 0)
                return apart ? BridgeState::ended : BridgeState::waiting;
            memory.formed = true;
        }
        const BridgeMemory before = memory;
        memory.separation = separation;
        memory.attraction = apart ? 0 : Form::force(parameters.curve, separation);
        if constexpr (Film::active) {
            memory.viscous_force =
                apart ? 0 : -Film::damping(parameters.film, separation, time_step) * normal_velocity;
        }
        if constexpr (Energy::active) {
            const double displacement =
                std::isnan(before.separation) ? normal_velocity * time_step : separation - before.separation;
            memory.work += 0.5 * (before.attraction + memory.attraction) * displacement;
            if constexpr (Film::active)
                book.viscous -= 0.5 * (before.viscous_force + memory.viscous_force) * displacement;
            if (apart)
                book.rupture += memory.work;
        }
        if (!apart)
            return BridgeState::holding;
        memory = BridgeMemory{};
        return BridgeState::ended;
    }
};

} // namespace grainfall::laws::bridge
