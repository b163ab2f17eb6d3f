// SPDX-License-Identifier: GPL-2.0-or-later
// As many contacts as a scalar has lanes, read from the packed arrays and written back to them.
//
// Which lane a contact falls into does not change what comes of it. Where fewer contacts are left than there
// are lanes, the last one fills the others, and what comes of these is dropped.
#pragma once

#include <engines/flat/contacts.hpp>
#include <engines/flat/touch.hpp>

#include <laws/energy.hpp>
#include <laws/sphere_kinematics.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <variant>
#include <vector>

namespace grainfall::flat {

using laws::VectorOf;

// The vector whose lanes are value(0), value(1), ...
template <class Scalar, class Value>
[[gnu::always_inline]] inline VectorOf<Scalar> packed_vector(const Value& value) {
    return {laws::packed<Scalar>([&](int lane) { return value(lane)[0]; }),
            laws::packed<Scalar>([&](int lane) { return value(lane)[1]; }),
            laws::packed<Scalar>([&](int lane) { return value(lane)[2]; })};
}
[[gnu::always_inline]] inline const Vector& lane_of(const Vector& vector, int) {
    return vector;
}
[[gnu::always_inline]] inline Vector lane_of(const laws::LaneVector& vectors, int lane) {
    return {vectors.x.pack[lane], vectors.y.pack[lane], vectors.z.pack[lane]};
}

template <class Scalar>
[[gnu::always_inline]] inline TouchAt<double> lane_of(const TouchAt<Scalar>& at, int lane) {
    using laws::lane_of;
    return {{flat::lane_of(at.touch.normal, lane), lane_of(at.touch.overlap, lane),
             lane_of(at.touch.radius1, lane), lane_of(at.touch.radius2, lane)},
            lane_of(at.arm1, lane),
            lane_of(at.arm2, lane)};
}

template <class Scalar>
inline laws::ContactGeometry lane_of(const laws::ContactGeometryOf<Scalar>& geometry, int lane) {
    using laws::lane_of;
    return {lane_of(geometry.overlap, lane),
            flat::lane_of(geometry.normal, lane),
            flat::lane_of(geometry.shear_increment, lane),
            flat::lane_of(geometry.tilt, lane),
            flat::lane_of(geometry.twist, lane),
            lane_of(geometry.normal_velocity, lane),
            geometry.time_step};
}
template <class Scalar>
inline laws::ContactForce lane_of(const laws::ContactForceOf<Scalar>& force, int lane) {
    using laws::lane_of;
    return {lane_of(force.normal, lane), flat::lane_of(force.shear, lane),
            lane_of(force.normal_stiffness, lane), lane_of(force.shear_stiffness, lane),
            lane_of(force.sliding, lane)};
}

template <class Scalar>
class ContactBlock {
public:
    static constexpr int width = laws::width_of<Scalar>;

    ContactBlock(const Bodies& bodies, const ContactState* states, std::size_t begin, std::size_t end)
        : bodies_(bodies), states_(states), begin_(begin),
          last_(static_cast<int>(std::min<std::size_t>(end - begin, width)) - 1) {}

    int count() const { return last_ + 1; }
    // Index of a lane's contact.
    std::size_t operator[](int lane) const {
        return begin_ + static_cast<std::size_t>(std::min(lane, last_));
    }
    const ContactState& state(int lane) const { return states_[(*this)[lane]]; }
    std::size_t first(int lane) const { return static_cast<std::size_t>(state(lane).first); }
    std::size_t second(int lane) const { return static_cast<std::size_t>(state(lane).second); }

    [[gnu::always_inline]] TouchAt<Scalar> touch_of_spheres() const {
        const auto place1 = [this](int lane) -> const Place& { return bodies_.places[first(lane)]; };
        const auto place2 = [this](int lane) -> const Place& { return bodies_.places[second(lane)]; };
        const VectorOf<Scalar> branch =
            packed_vector<Scalar>([&](int lane) -> const Vector& { return place2(lane).centre; }) -
            packed_vector<Scalar>([&](int lane) -> const Vector& { return place1(lane).centre; });
        const Scalar radius1 = laws::packed<Scalar>([&](int lane) { return place1(lane).radius; });
        const Scalar radius2 = laws::packed<Scalar>([&](int lane) { return place2(lane).radius; });
        using std::sqrt;
        TouchAt<Scalar> result;
        const Scalar distance = sqrt(branch.squaredNorm());
        result.touch = laws::touch_of_spheres(branch, distance, radius1, radius2);
        result.arm1 = radius1 - 0.5 * result.touch.overlap;
        result.arm2 = radius2 - 0.5 * result.touch.overlap;
        return result;
    }

    // Of spheres with obstacles of one kind.
    [[gnu::noinline]] TouchAt<Scalar> touch_of_obstacles(Partner kind) const {
        switch (kind) {
        case Partner::box:
            return touch_each(&touch_of_box);
        case Partner::solid:
            return touch_each(&touch_of_solid);
        default:
            return touch_each(&touch_of_plane);
        }
    }

    // Lanes without a contact of their own.
    [[gnu::always_inline]] laws::MaskOf<Scalar> empty() const {
        return laws::packed<Scalar>([](int lane) { return double(lane); }) >
               Scalar(static_cast<double>(last_));
    }

    // From the centres of the obstacles, wherever these are, to the contact points.
    [[gnu::noinline]] VectorOf<Scalar> obstacle_levers(const TouchAt<Scalar>& at) const {
        return packed_vector<Scalar>([&](int lane) -> Vector {
            const TouchAt<double> here = flat::lane_of(at, lane);
            return bodies_.places[second(lane)].centre - here.arm2 * here.touch.normal -
                   bodies_.places[first(lane)].centre;
        });
    }

    [[gnu::always_inline]] VectorOf<Scalar> spin1() const { return of_first(&Motion::spin); }
    [[gnu::always_inline]] VectorOf<Scalar> spin2() const { return of_second(&Motion::spin); }

    // `member`: Motion::velocity or Motion::spin.
    [[gnu::always_inline]] VectorOf<Scalar> of_first(Vector Motion::*member) const {
        return packed_vector<Scalar>(
            [&](int lane) -> const Vector& { return bodies_.motions[first(lane)].*member; });
    }
    [[gnu::always_inline]] VectorOf<Scalar> of_second(Vector Motion::*member) const {
        return packed_vector<Scalar>(
            [&](int lane) -> const Vector& { return bodies_.motions[second(lane)].*member; });
    }

    // The normal of the last step; zero before the first.
    [[gnu::always_inline]] VectorOf<Scalar> normal_before() const {
        const Scalar known =
            laws::packed<Scalar>([&](int lane) { return state(lane).shear_stiffness > 0 ? 1. : 0.; });
        return known * packed_vector<Scalar>([&](int lane) -> const Vector& { return state(lane).normal; });
    }
    // Of the second bodies seen from the first.
    [[gnu::always_inline]] VectorOf<Scalar> velocity() const {
        return of_second(&Motion::velocity) - of_first(&Motion::velocity);
    }
    // The same at the contact points.
    [[gnu::always_inline]] VectorOf<Scalar> velocity_at_contact(const TouchAt<Scalar>& at,
                                                                Partner kind) const {
        const VectorOf<Scalar> lever = kind == Partner::sphere ? VectorOf<Scalar>(at.arm1 * at.touch.normal)
                                                               : VectorOf<Scalar>(obstacle_levers(at));
        return velocity() - at.arm2 * spin2().cross(at.touch.normal) - spin1().cross(lever);
    }

    // m/s, along the normals. The contact points of spheres and planes have no arm across them.
    [[gnu::always_inline]] Scalar normal_velocity(const TouchAt<Scalar>& at, Partner kind) const {
        return at.touch.normal.dot(has_surface_motion(kind) ? velocity_at_contact(at, kind) : velocity());
    }

    // YADE reckons the shear on boxes and solids at the contact point itself; as for spheres only where a
    // sphere's centre is within a box.
    [[gnu::noinline]] void put_surface_motion(const TouchAt<Scalar>& at, Partner kind,
                                              laws::ContactGeometryOf<Scalar>& geometry) const {
        const VectorOf<Scalar> velocity = velocity_at_contact(at, kind);
        const Scalar approach = velocity.dot(at.touch.normal);
        const VectorOf<Scalar> slip = Scalar(geometry.time_step) * (velocity - approach * at.touch.normal);
        geometry.normal_velocity = approach;
        geometry.shear_increment = packed_vector<Scalar>([&](int lane) -> Vector {
            const TouchAt<double> here = flat::lane_of(at, lane);
            const bool within = kind == Partner::box && here.touch.overlap >= here.touch.radius2;
            return flat::lane_of(within ? geometry.shear_increment : slip, lane);
        });
    }

    [[gnu::always_inline]] void recall(laws::ContactMemoryOf<Scalar>& memory) const {
        memory.shear_force =
            packed_vector<Scalar>([&](int lane) -> const Vector& { return state(lane).shear_force; });
        memory.shear_stiffness = laws::packed<Scalar>([&](int lane) { return state(lane).shear_stiffness; });
    }
    [[gnu::always_inline]] void recall(const std::vector<DashpotMemory>& dashpots,
                                       laws::DissipationBookOf<Scalar>& book) const {
        const auto of = [&](int lane) -> const DashpotMemory& { return dashpots[(*this)[lane]]; };
        book.normal_viscous_force = laws::packed<Scalar>([&](int lane) { return of(lane).normal; });
        book.shear_viscous_force =
            packed_vector<Scalar>([&](int lane) -> const Vector& { return of(lane).shear; });
    }
    // Into the array, but for the lanes that are idle.
    void keep(const laws::DissipationBookOf<Scalar>& book, const laws::MaskOf<Scalar>& idle,
              std::vector<DashpotMemory>& dashpots) const {
        for (int lane = 0; lane < count(); ++lane)
            if (!laws::lane_of(idle, lane))
                dashpots[(*this)[lane]] = {laws::lane_of(book.normal_viscous_force, lane),
                                           flat::lane_of(book.shear_viscous_force, lane)};
    }

    [[gnu::always_inline]] laws::ContactParametersOf<Scalar>
    parameters(const std::vector<ContactConstants>& constants) const {
        const auto of = [&](int lane) -> const laws::ContactParameters& {
            return constants[(*this)[lane]].parameters;
        };
        return {laws::packed<Scalar>([&](int lane) { return of(lane).normal_coefficient; }),
                laws::packed<Scalar>([&](int lane) { return of(lane).shear_coefficient; }),
                laws::packed<Scalar>([&](int lane) { return of(lane).normal_damping; }),
                laws::packed<Scalar>([&](int lane) { return of(lane).shear_damping; })};
    }

    // Into the arrays; all lanes touch.
    [[gnu::always_inline]] void keep(const VectorOf<Scalar>& normal,
                                     const laws::ContactMemoryOf<Scalar>& memory,
                                     ContactState* states) const {
        for (int lane = 0; lane < width; ++lane) {
            ContactState& state = states[(*this)[lane]];
            state.normal = flat::lane_of(normal, lane);
            state.shear_force = flat::lane_of(memory.shear_force, lane);
            state.shear_stiffness = laws::lane_of(memory.shear_stiffness, lane);
        }
    }
    // Forces on two spheres; that along the normal has no arm about their centres.
    [[gnu::always_inline]] void push(const TouchAt<Scalar>& at, const laws::ContactForceOf<Scalar>& force,
                                     Load* loads) const {
        const VectorOf<Scalar> force_on_2 = force.normal * at.touch.normal + force.shear;
        const VectorOf<Scalar> turn = at.touch.normal.cross(force.shear);
        const VectorOf<Scalar> torque1 = at.arm1 * turn, torque2 = at.arm2 * turn;
        // One after the other: two lanes may push the same sphere.
        for (int lane = 0; lane < width; ++lane) {
            Load& load1 = loads[first(lane)];
            Load& load2 = loads[second(lane)];
            load1.force -= flat::lane_of(force_on_2, lane);
            load1.torque -= flat::lane_of(torque1, lane);
            load2.force += flat::lane_of(force_on_2, lane);
            load2.torque -= flat::lane_of(torque2, lane);
        }
    }

private:
    using TouchOfObstacle = TouchAt<double> (*)(const Obstacle&, const Place&, const Place&);

    [[gnu::always_inline]] TouchAt<Scalar> touch_each(TouchOfObstacle touch) const {
        TouchAt<double> each[width];
        for (int lane = 0; lane < width; ++lane)
            each[lane] = touch(bodies_.obstacle(state(lane).first), bodies_.places[first(lane)],
                               bodies_.places[second(lane)]);
        TouchAt<Scalar> result;
        result.touch.normal =
            packed_vector<Scalar>([&](int lane) -> const Vector& { return each[lane].touch.normal; });
        result.touch.overlap = laws::packed<Scalar>([&](int lane) { return each[lane].touch.overlap; });
        result.touch.radius1 = laws::packed<Scalar>([&](int lane) { return each[lane].touch.radius1; });
        result.touch.radius2 = laws::packed<Scalar>([&](int lane) { return each[lane].touch.radius2; });
        result.arm1 = 0;
        result.arm2 = laws::packed<Scalar>([&](int lane) { return each[lane].arm2; });
        return result;
    }

    const Bodies& bodies_;
    const ContactState* states_;
    std::size_t begin_;
    int last_;
};

// Friction of the contacts of a block. A curve is evaluated only in the lanes where it is `open` how large
// friction is.
template <class Curve, class Scalar>
struct BlockFriction {
    const Curve* curves[laws::width_of<Scalar>];

    [[gnu::always_inline]] Scalar lower_bound() const {
        return laws::packed<Scalar>([&](int lane) { return curves[lane]->lower_bound(); });
    }
    [[gnu::always_inline]] Scalar coefficient(const Scalar& load, const laws::MaskOf<Scalar>& open) const {
        Scalar mu;
        evaluate(load, open, mu);
        return mu;
    }
    [[gnu::always_inline]] Scalar coefficient(const Scalar& load) const {
        return coefficient(load, laws::MaskOf<Scalar>(true));
    }

private:
    [[gnu::noinline]] void evaluate(const Scalar& load, const laws::MaskOf<Scalar>& open, Scalar& mu) const {
        mu = laws::packed<Scalar>([&](int lane) {
            return laws::lane_of(open, lane) ? curves[lane]->coefficient(laws::lane_of(load, lane))
                                             : curves[lane]->lower_bound();
        });
    }
};
template <class Scalar>
struct BlockFriction<laws::friction::Constant, Scalar> {
    Scalar mu;

    const Scalar& lower_bound() const { return mu; }
    const Scalar& coefficient(const Scalar&, const laws::MaskOf<Scalar>&) const { return mu; }
    const Scalar& coefficient(const Scalar&) const { return mu; }
};

template <class Curve, class Scalar>
[[gnu::always_inline]] inline BlockFriction<Curve, Scalar>
friction_of(const ContactBlock<Scalar>& block, const std::vector<ContactConstants>& constants,
            const std::vector<laws::friction::Any>& curves) {
    BlockFriction<Curve, Scalar> result;
    if constexpr (std::is_same_v<Curve, laws::friction::Constant>) {
        result.mu = laws::packed<Scalar>([&](int lane) { return constants[block[lane]].friction; });
    } else {
        for (int lane = 0; lane < block.width; ++lane) {
            const laws::friction::Any& any = curves[block[lane]];
            if constexpr (std::is_same_v<Curve, laws::friction::Any>)
                result.curves[lane] = &any;
            else
                result.curves[lane] = std::get_if<Curve>(&any.curve());
        }
    }
    return result;
}

} // namespace grainfall::flat
