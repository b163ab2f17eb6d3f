// SPDX-License-Identifier: GPL-2.0-or-later
#include <engines/flat/contact_block.hpp>
#include <laws/friction/constant.hpp>
#include <laws/hertz_mindlin.hpp>

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace {

using namespace grainfall::laws;
namespace flat = grainfall::flat;

using Damping = RepulsiveDashpot;
using Friction = flat::BlockFriction<friction::Constant, Lanes>;
using OneByOne = HertzMindlin<Hertz, IncrementalTangential, Damping, friction::Constant, DissipationBook>;
using SideBySide = HertzMindlin<Hertz, IncrementalTangential, Damping, Friction, DissipationBookOf<Lanes>>;

// Grains of 5 mm that roll and slide over each other: neighbours in an array, each touching the next.
struct Row {
    flat::Bodies bodies;
    std::vector<flat::ContactState> states;
    std::vector<flat::ContactConstants> constants;

    explicit Row(int contacts) {
        std::mt19937 random(7);
        std::uniform_real_distribution<double> any(-1, 1);
        const auto vector = [&](double scale) {
            return Vector(scale * any(random), scale * any(random), scale * any(random));
        };
        for (int i = 0; i <= contacts; ++i) {
            bodies.places.push_back({Vector(4.99e-3 * i, 0, 0) + vector(4e-6), 2.5e-3});
            bodies.motions.push_back({vector(0.02), vector(5)});
            bodies.inertias.push_back({1, Vector::Ones(), 0, false});
        }
        for (int i = 0; i < contacts; ++i) {
            flat::ContactState state{i, i + 1, Vector::UnitX(), {}, 0};
            if (i % 3) { // the others are new
                state.shear_force = 3 * Vector(0, any(random), any(random));
                state.shear_stiffness = 2e4 * (1 + 0.5 * any(random));
            }
            states.push_back(state);
            flat::ContactConstants constant{};
            constant.parameters = {3e8, 2.5e8, 30, 25};
            constant.friction = 0.1 + 0.1 * (i % 5);
            constants.push_back(constant);
        }
    }
};

constexpr double time_step = 1e-5; // s

template <class Law, class Scalar, class Book>
ContactForceOf<Scalar> step(const Row& row, const flat::ContactBlock<Scalar>& block,
                            ContactMemoryOf<Scalar>& memory, Book& book) {
    const flat::TouchAt<Scalar> at = block.touch_of_spheres();
    ContactGeometryOf<Scalar> geometry;
    put_motion<Scalar>(geometry, at.touch, block.velocity(), block.spin1(), block.spin2(), time_step);
    put_rotation<Scalar>(geometry, block.normal_before(), block.spin1(), block.spin2());
    block.recall(memory);
    const auto friction = flat::friction_of<friction::Constant>(block, row.constants, {});
    if constexpr (width_of<Scalar> == 1)
        return Law::step(geometry, block.parameters(row.constants), friction::Constant{friction.mu}, memory,
                         book);
    else
        return Law::step(geometry, block.parameters(row.constants), friction, memory, book);
}

TEST(ContactsSideBySide, get_the_forces_and_books_that_they_get_one_by_one) {
    const Row row(403);
    int sliding = 0;
    for (std::size_t i = 0; i < row.states.size(); i += Lanes::width) {
        const flat::ContactBlock<Lanes> block(row.bodies, row.states.data(), i, row.states.size());
        ContactMemoryOf<Lanes> memories;
        DissipationBookOf<Lanes> books;
        const ContactForceOf<Lanes> forces = step<SideBySide>(row, block, memories, books);
        for (int lane = 0; lane < block.count(); ++lane) {
            const flat::ContactBlock<double> one(row.bodies, row.states.data(), block[lane], block[lane] + 1);
            ContactMemory memory;
            DissipationBook book;
            const ContactForce force = step<OneByOne>(row, one, memory, book);
            const double scale = force.normal, tolerance = 1e-13 * scale;
            ASSERT_GT(scale, 0);
            EXPECT_NEAR(lane_of(forces.normal, lane), force.normal, tolerance);
            EXPECT_LT((flat::lane_of(forces.shear, lane) - force.shear).norm(), tolerance);
            EXPECT_LT((flat::lane_of(memories.shear_force, lane) - memory.shear_force).norm(), tolerance);
            EXPECT_EQ(lane_of(forces.sliding, lane), force.sliding);
            const double work =
                scale * 0.02 * time_step + shear_elastic_energy(row.states[block[lane]].shear_force, 1e4);
            EXPECT_NEAR(lane_of(books.friction, lane), book.friction, 1e-13 * work);
            EXPECT_NEAR(lane_of(books.viscous, lane), book.viscous, 1e-13 * work);
            EXPECT_NEAR(lane_of(books.rescaling, lane), book.rescaling, 1e-13 * work);
            sliding += force.sliding;
        }
    }
    EXPECT_GT(sliding, 20);
    EXPECT_LT(sliding, 380);
}

TEST(ContactsSideBySide, do_not_depend_on_their_lane_to_the_last_bit) {
    const Row row(7);
    const auto in_lane = [&](std::size_t begin, int lane) {
        const flat::ContactBlock<Lanes> block(row.bodies, row.states.data(), begin, 7);
        ContactMemoryOf<Lanes> memories;
        DissipationBookOf<Lanes> books;
        return flat::lane_of(step<SideBySide>(row, block, memories, books).shear, lane);
    };
    for (int lane = 0; lane < 4; ++lane)
        EXPECT_EQ(in_lane(static_cast<std::size_t>(3 - lane), lane), in_lane(3, 0)) << lane;
}

TEST(ABlock, fills_lanes_without_a_contact_with_its_last_and_calls_them_empty) {
    const Row row(6);
    const flat::ContactBlock<Lanes> block(row.bodies, row.states.data(), 4, 6);
    EXPECT_EQ(block.count(), 2);
    for (int lane = 0; lane < 4; ++lane) {
        EXPECT_EQ(block[lane], lane == 0 ? 4u : 5u);
        EXPECT_EQ(lane_of(block.empty(), lane), lane >= 2);
    }
}

TEST(ABlock, pushes_spheres_that_two_lanes_share_with_both_forces) {
    const Row row(4); // body 1 is the second of lane 0 and the first of lane 1, ...
    const flat::ContactBlock<Lanes> block(row.bodies, row.states.data(), 0, 4);
    ContactMemoryOf<Lanes> memories;
    DissipationBookOf<Lanes> books;
    const ContactForceOf<Lanes> force = step<SideBySide>(row, block, memories, books);
    const flat::TouchAt<Lanes> at = block.touch_of_spheres();
    std::vector<flat::Load> loads(5);
    block.push(at, force, loads.data());
    Vector sum = Vector::Zero();
    for (int body = 0; body < 5; ++body) {
        Vector expected = Vector::Zero();
        const auto of_lane = [&](int lane) -> Vector {
            return lane_of(force.normal, lane) * flat::lane_of(at.touch.normal, lane) +
                   flat::lane_of(force.shear, lane);
        };
        if (body > 0)
            expected += of_lane(body - 1);
        if (body < 4)
            expected -= of_lane(body);
        EXPECT_LT((loads[static_cast<std::size_t>(body)].force - expected).norm(), 1e-12);
        sum += loads[static_cast<std::size_t>(body)].force;
    }
    EXPECT_LT(sum.norm(), 1e-12); // action and reaction
}

TEST(LargerOfTwo, takes_the_first_where_the_other_is_not_a_number_as_the_standard_one) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(larger(0.0, none), std::max(0.0, none));
    EXPECT_EQ(lane_of(larger(Lanes(0), Lanes(none)), 2), 0);
    EXPECT_EQ(larger(1.0, 2.0), 2);
    EXPECT_EQ(lane_of(larger(Lanes(3), Lanes(2)), 1), 3);
}

} // namespace
