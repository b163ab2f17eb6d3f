// SPDX-License-Identifier: GPL-2.0-or-later
// How much liquid a bridge holds and which body it came from.
//
// Where a volume is stated it counts: each body that states one gives half of it to a bridge with another
// that does, all of it to one that does not. Otherwise each grain shares the water it carries,
//
//   V_grain = w m/rho_w,   equally among a fixed number z of bridges,
//
// w gravimetric moisture, m mass of the dry grain. Two equal grains of density rho make
// V* = (8 pi/3) w rho/(rho_w z): 0.085 for quartz at w = 0.023, z = 6.
#pragma once

#include <laws/damping.hpp>

#include <algorithm>
#include <cmath>

namespace grainfall::laws::bridge {

inline constexpr double water_density = 1000; // kg/m3

// m3, water carried by a grain of this dry mass.
inline double carried_water(double moisture, double mass) {
    return moisture * mass / water_density;
}

// V* of a bridge between two equal grains that share their water.
inline double relative_volume_of_equal_grains(double moisture, double density, double bridges_per_grain) {
    return 8 * detail::pi / 3 * moisture * density / (water_density * bridges_per_grain);
}

struct WaterSource {
    double stated_volume = 0; // m3 of a bridge; nan where the moisture decides
    double shared_volume = 0; // m3, this body's share by its moisture
    double surface_tension = 0;
    double viscosity = 0;
    double contact_angle = 0;
};

struct BridgeWater {
    double from_first = 0, from_second = 0; // m3
    double surface_tension = 0;             // N/m, mean of the two by the liquid each gives
    double viscosity = 0;                   // Pa s, likewise
    double contact_angle = 0;               // rad, mean of the two

    double volume() const { return from_first + from_second; }
};

inline BridgeWater bridge_water(const WaterSource& first, const WaterSource& second) {
    const bool stated_1 = !std::isnan(first.stated_volume);
    const bool stated_2 = !std::isnan(second.stated_volume);
    BridgeWater water;
    if (stated_1 || stated_2) {
        const double part = stated_1 && stated_2 ? 0.5 : 1.0;
        water.from_first = stated_1 ? part * first.stated_volume : 0;
        water.from_second = stated_2 ? part * second.stated_volume : 0;
    } else {
        water.from_first = first.shared_volume;
        water.from_second = second.shared_volume;
    }
    if (!(water.volume() > 0))
        return water;
    const double weight = water.from_first / water.volume();
    water.surface_tension = weight * first.surface_tension + (1 - weight) * second.surface_tension;
    water.viscosity = weight * first.viscosity + (1 - weight) * second.viscosity;
    water.contact_angle = 0.5 * (first.contact_angle + second.contact_angle);
    return water;
}

} // namespace grainfall::laws::bridge
