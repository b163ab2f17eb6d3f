// SPDX-License-Identifier: GPL-2.0-or-later
#include <femlink/explicit/explicit_continuum.hpp>

#include <gtest/gtest.h>

#include <random>

namespace {

using namespace grainfall::femlink;

SolidMaterial sand(SolidLaw law) {
    SolidMaterial m;
    m.law = law;
    m.elastic = {20e6, 0.3, 1600};
    m.yield_stress = 20e3;
    m.hardening = 2e6;
    m.cohesion = 5e3;
    m.friction_angle = 0.5;
    m.dilatancy = 0.1;
    return m;
}

HexMesh distorted_block() {
    HexMesh mesh = box({0.2, 0.2, 0.2}, {2, 2, 2}, Held::bottom);
    std::mt19937 generator(7);
    std::uniform_real_distribution<double> uniform(-0.015, 0.015);
    for (Point& v : mesh.vertices)
        v += Point(uniform(generator), uniform(generator), uniform(generator));
    return mesh;
}

Positions displaced(const HexMesh& mesh, double size, unsigned seed) {
    std::mt19937 generator(seed);
    std::uniform_real_distribution<double> uniform(-size, size);
    Positions x(3, static_cast<Eigen::Index>(mesh.vertices.size()));
    for (Eigen::Index v = 0; v < x.cols(); ++v)
        x.col(v) = mesh.vertices[v] + Point(uniform(generator), uniform(generator), uniform(generator));
    return x;
}

Positions forces(CellBlock& block, const Positions& x) {
    Positions out = Positions::Zero(3, x.cols());
    block.add_forces(x.data(), out.data());
    return out;
}

std::unique_ptr<CellBlock> block_on(const HexMesh& mesh, const SolidMaterial& material, ElementKind kind) {
    std::vector<int> cells(mesh.cells.size());
    std::iota(cells.begin(), cells.end(), 0);
    return block_of(mesh, cells, material, kind, 0.3, nullptr);
}

const std::vector<ElementKind> kinds = {ElementKind::gauss, ElementKind::one_point};
const std::vector<SolidLaw> all_laws = {SolidLaw::st_venant, SolidLaw::neo_hooke, SolidLaw::j2,
                                        SolidLaw::drucker_prager};

Eigen::Matrix3d turn() {
    return Eigen::AngleAxisd(1.2, Point(1, 2, -0.5).normalized()).toRotationMatrix();
}

// A uniform deformation of a distorted mesh loads no node inside it; the stress is the same in all cells.
TEST(ExplicitContinuumCells, pass_the_patch_test_at_finite_strain) {
    const HexMesh mesh = distorted_block();
    Eigen::Matrix3d f;
    f << 1.05, 0.1, 0.02, -0.04, 0.93, 0.06, 0.01, -0.03, 1.02;
    for (const ElementKind kind : kinds) {
        for (const SolidLaw law : all_laws) {
            const auto block = block_on(mesh, sand(law), kind);
            Positions x(3, 27);
            for (int v = 0; v < 27; ++v)
                x.col(v) = f * mesh.vertices[v];
            const Positions out = forces(*block, x);
            EXPECT_LT(out.col(mesh.cells[0][7]).norm(), 1e-12 * 20e6 * 0.01); // the node inside
            std::vector<CellState> states(8);
            block->states(x.data(), states);
            for (const CellState& state : states) {
                const Symmetric off = state.stress - states[0].stress;
                EXPECT_LT(contraction(off, off), 1e-22 * 20e6 * 20e6);
            }
        }
    }
}

TEST(ExplicitContinuumCells, feel_no_rotation) {
    const HexMesh mesh = distorted_block();
    for (const ElementKind kind : kinds) {
        for (const SolidLaw law : all_laws) {
            const auto block = block_on(mesh, sand(law), kind);
            Positions x(3, 27);
            for (int v = 0; v < 27; ++v)
                x.col(v) = turn() * mesh.vertices[v];
            EXPECT_LT(forces(*block, x).norm(), 1e-12 * 20e6 * 0.01);
        }
    }
}

// Deformed into plastic flow in two steps, with a rotation in between on one side: the forces turn with it.
TEST(ExplicitContinuumCells, plastic_forces_turn_with_the_frame) {
    const HexMesh mesh = distorted_block();
    for (const ElementKind kind : kinds) {
        for (const SolidLaw law : {SolidLaw::j2, SolidLaw::drucker_prager}) {
            const auto still = block_on(mesh, sand(law), kind), turned = block_on(mesh, sand(law), kind);
            const Positions first = displaced(mesh, 0.004, 3), second = displaced(mesh, 0.008, 4);
            EXPECT_LT((forces(*turned, first) - forces(*still, first)).norm(), 1e-12);
            const Positions expected = turn() * forces(*still, second);
            const Positions found = forces(*turned, turn() * second);
            EXPECT_LT((found - expected).norm(), 1e-10 * expected.norm());
            EXPECT_GT(still->energies(second.data()).plastic, 0);
        }
    }
}

// Central differences of step 1e-6 m in cells of 0.1 m.
TEST(ExplicitContinuumCells, elastic_forces_are_the_slope_of_the_energy) {
    const HexMesh mesh = distorted_block();
    for (const ElementKind kind : kinds) {
        for (const SolidLaw law : {SolidLaw::st_venant, SolidLaw::neo_hooke}) {
            const auto block = block_on(mesh, sand(law), kind);
            const Positions x = displaced(mesh, 0.01, 5);
            const Positions direction = displaced(mesh, 1, 6);
            const auto energy = [&](double step) {
                const CellEnergies e = block->energies(Positions(x + step * direction).data());
                return e.elastic + e.hourglass;
            };
            const double slope = (energy(1e-6) - energy(-1e-6)) / 2e-6;
            const double power = -forces(*block, x).cwiseProduct(direction).sum();
            EXPECT_NEAR(slope, power, 1e-7 * std::abs(power));
        }
    }
}

// One free cell: its bound is its frequency. Leapfrog is stable below 2/omega and not above (Courant,
// Friedrichs & Lewy 1928).
TEST(ExplicitContinuum, is_stable_below_the_critical_step_and_not_above) {
    for (const ElementKind kind : kinds) {
        HexMesh mesh = box({0.1, 0.08, 0.12}, {1, 1, 1}, Held::bottom);
        mesh.boundary.clear();
        ExplicitOptions options;
        options.element = kind;
        for (const double ratio : {0.98, 1.02}) {
            options.safety = 2; // steps are given below, one a substep
            ExplicitContinuum cell(mesh, {{0, sand(SolidLaw::neo_hooke)}}, options);
            const double speed = ratio < 1 ? 1e-2 : 1e-5; // m/s; strains stay small in both
            cell.set_velocities(speed * (displaced(mesh, 1, 8) - cell.nodes()));
            const double start = cell.energies().kinetic, norm = cell.velocities().norm();
            const double step = ratio * cell.critical_step();
            const int steps = ratio < 1 ? 300 : 25;
            for (int i = 0; i < steps; ++i)
                cell.advance(step, Positions(3, 0));
            EXPECT_EQ(cell.substeps(), steps);
            if (ratio < 1) {
                EXPECT_LT(cell.velocities().norm(), 10 * norm);
                // Strain 1e-4: what is not linear shows in the fourth digit at most.
                EXPECT_NEAR(cell.energies().content() - cell.energies().work(), start, 1e-4 * start);
            } else {
                EXPECT_GT(cell.velocities().norm(), 1e3 * norm);
            }
        }
    }
}

TEST(ExplicitContinuum, substeps_follow_the_cells_as_they_flatten) {
    HexMesh mesh = box({0.1, 0.1, 0.1}, {1, 1, 1}, Held::bottom);
    ExplicitOptions options;
    ExplicitContinuum cell(mesh, {{0, sand(SolidLaw::neo_hooke)}}, options);
    const double at_rest = cell.critical_step();
    std::vector<double> state = cell.state();
    // Displacements are the first field after nine numbers: the top goes down by half.
    for (int v = 4; v < 8; ++v)
        state[9 + 3 * v + 2] = -0.05;
    cell.set_state(state);
    EXPECT_LT(cell.critical_step(), 0.55 * at_rest);
}

TEST(ExplicitContinuum, goes_on_from_a_kept_state_to_the_last_bit) {
    const HexMesh mesh = box({0.2, 0.2, 0.1}, {4, 4, 2}, Held::all_but_top);
    for (const SolidLaw law : all_laws) {
        for (const ElementKind kind : kinds) {
            ExplicitOptions options;
            options.element = kind;
            options.outer = OuterBoundary::absorbing;
            ExplicitContinuum wall(mesh, {{0, sand(law)}}, options), again(mesh, {{0, sand(law)}}, options);
            Positions load = Positions::Zero(3, wall.surface().node_count());
            load.row(2).setConstant(-40);
            load.row(0).setConstant(15);
            const double step = 0.7 * wall.critical_step();
            for (int i = 0; i < 25; ++i)
                wall.advance(1.7 * step, load);
            again.set_state(wall.state());
            for (int i = 0; i < 25; ++i) {
                wall.advance(step, 0.5 * load);
                again.advance(step, 0.5 * load);
            }
            EXPECT_EQ(wall.displacement(), again.displacement());
            EXPECT_EQ(wall.state(), again.state());
            EXPECT_EQ(wall.surface_displacement(), again.surface_displacement());
            EXPECT_GT(wall.energies().absorbed, 0);
            const bool flows = law == SolidLaw::j2 || law == SolidLaw::drucker_prager;
            EXPECT_EQ(wall.energies().plastic > 0, flows);
        }
    }
}

TEST(ExplicitContinuum, names_the_cell_that_turns_over) {
    const HexMesh mesh = box({0.2, 0.2, 0.1}, {2, 2, 1}, Held::all_but_top);
    ExplicitContinuum wall(mesh, {{0, sand(SolidLaw::j2)}}, {});
    Positions load = Positions::Zero(3, wall.surface().node_count());
    load.row(2).setConstant(-1e7);
    try {
        for (int i = 0; i < 100; ++i)
            wall.advance(1e-3, load);
        FAIL() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("has turned over"), std::string::npos) << error.what();
    }
}

TEST(ExplicitContinuum, refuses_wrong_input_in_one_sentence) {
    const HexMesh mesh = box({0.2, 0.2, 0.1}, {2, 2, 1}, Held::all_but_top);
    const auto refusal = [](const std::function<void()>& action) -> std::string {
        try {
            action();
        } catch (const std::invalid_argument& error) {
            return error.what();
        }
        return "nothing was thrown";
    };
    ExplicitContinuum wall(mesh, {{0, sand(SolidLaw::j2)}}, {});
    EXPECT_EQ(refusal([&] { wall.advance(1e-3, Positions(3, 2)); }),
              "surface_forces = list of length 2: must be of length 9 (one a node of the surface)");
    EXPECT_EQ(refusal([&] { wall.advance(-1, Positions::Zero(3, 9)); }), "dt = -1: must be > 0 and finite");
    EXPECT_EQ(refusal([&] { wall.set_state({1, 2}); }).substr(0, 26), "state = list of length 2: ");
    EXPECT_EQ(refusal([&] {
                  ExplicitContinuum(mesh, {{1, sand(SolidLaw::j2)}}, {});
              }),
              "materials = no entry 0: must be given for every region of the mesh");
}

// Layers of 0.5 m: 2000 kg/m^3 under 1000.
TEST(StressAtRest, is_the_weight_above_and_jakys_share_of_it) {
    HexMesh mesh = box({1, 1, 1}, {2, 2, 2}, Held::bottom);
    SolidMaterials materials{{0, sand(SolidLaw::drucker_prager)}, {1, sand(SolidLaw::drucker_prager)}};
    materials[0].elastic.density = 2000;
    materials[1].elastic.density = 1000;
    const double top = mesh.vertices.back()[2];
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
        mesh.regions[c] = mesh.vertices[mesh.cells[c][7]][2] > top - 0.25 ? 1 : 0;
    const StressAtRest rest(mesh, materials, {0, 0, -10});
    EXPECT_NEAR(rest.pressure({0, 0, top}), 0, 1e-9);
    EXPECT_NEAR(rest.pressure({0.1, 0, top - 0.25}), 2500, 1e-9);
    EXPECT_NEAR(rest.pressure({0, 0.2, top - 0.75}), 10000, 1e-9);
    EXPECT_NEAR(rest.pressure({0, 0, top - 1}), 15000, 1e-9);
    const double ratio = earth_pressure_at_rest(0.5235987755982988); // 30 degrees
    EXPECT_NEAR(ratio, 0.5, 1e-12);
    const Symmetric stress = rest.stress({0, 0, top - 0.75}, ratio);
    EXPECT_NEAR(stress.zz, -10000, 1e-9);
    EXPECT_NEAR(stress.xx, -5000, 1e-9);
    EXPECT_NEAR(stress.xz, 0, 1e-9);
}

TEST(StressAtRest, follows_a_gravity_that_is_aslant) {
    const HexMesh mesh = box({1, 1, 1}, {1, 1, 1}, Held::bottom);
    const SolidMaterials materials{{0, sand(SolidLaw::drucker_prager)}};
    const Point gravity = turn() * Point(0, 0, -9.81), up = -gravity.normalized();
    const Point at = mesh.vertices[0] + Point(0.5, 0.5, 0.5);
    const StressAtRest rest(mesh, materials, gravity);
    const Eigen::Matrix3d stress = as_eigen(rest.stress(at, 0.4));
    const double vertical = rest.pressure(at);
    EXPECT_GT(vertical, 0);
    EXPECT_LT((stress * up + vertical * up).norm(), 1e-9 * vertical);
    EXPECT_NEAR(stress.trace(), -1.8 * vertical, 1e-9 * vertical);
}

// Whatever the mesh: what balances the stress at rest acts on its nodes.
TEST(ExplicitContinuum, sand_without_cohesion_stays_at_rest_under_its_weight) {
    const HexMesh mesh = distorted_block();
    SolidMaterial dry = sand(SolidLaw::drucker_prager);
    dry.cohesion = 0;
    for (const ElementKind kind : kinds) {
        ExplicitOptions options;
        options.element = kind;
        options.gravity = {0, 0, -9.81};
        ExplicitContinuum wall(mesh, {{0, dry}}, options);
        const auto cells = wall.cell_states();
        EXPECT_LT(cells[0].stress.zz, cells[7].stress.zz); // below, above
        EXPECT_NEAR(cells[0].stress.xx / cells[0].stress.zz, 1 - std::sin(dry.friction_angle), 1e-3);
        wall.advance(20 * wall.critical_step(), Positions::Zero(3, wall.surface().node_count()));
        EXPECT_EQ(wall.displacement().norm(), 0);
        EXPECT_NEAR(wall.energies().content(), 0, 1e-20); // J; amplitudes of hourglass springs are rounded
        for (const CellState& cell : wall.cell_states())
            EXPECT_EQ(cell.plastic_strain, 0);
    }
}

// At constant volume the mean stress stays p0, and shear ends at eta p0.
TEST(ExplicitContinuum, sand_without_cohesion_bears_the_shear_that_its_depth_gives_it) {
    HexMesh mesh = box({0.1, 0.1, 1}, {1, 1, 10}, Held::bottom);
    mesh.boundary.clear();
    SolidMaterial dry = sand(SolidLaw::drucker_prager);
    dry.cohesion = dry.dilatancy = 0;
    ExplicitOptions options;
    options.gravity = {0, 0, -9.81};
    const auto nodes = static_cast<int>(mesh.vertices.size());
    for (int node = 0; node < nodes; ++node)
        for (int axis = 0; axis < 3; ++axis)
            options.held.push_back({node, axis});
    ExplicitContinuum wall(mesh, {{0, dry}}, options);
    const auto before = wall.cell_states();
    Positions velocities(3, nodes); // simple shear, 1 % in 1 s
    for (int node = 0; node < nodes; ++node)
        velocities.col(node) << 0.01 * mesh.vertices[node][2], 0, 0;
    wall.set_velocities(velocities);
    wall.advance(1, Positions::Zero(3, wall.surface().node_count()));
    const auto after = wall.cell_states();
    const double s = std::sin(dry.friction_angle), eta = 6 * s / (std::sqrt(3.0) * (3 - s));
    for (std::size_t c = 0; c < after.size(); ++c) {
        const Symmetric shape = after[c].stress.deviator();
        EXPECT_NEAR(after[c].stress.trace(), before[c].stress.trace(), 1e-3 * -before[c].stress.trace());
        // The yield point is that of each Gauss point, the stress their mean: the cone is linear in both.
        EXPECT_NEAR(std::sqrt(contraction(shape, shape) / 2), -eta * before[c].stress.trace() / 3,
                    2e-3 * -before[c].stress.trace());
        EXPECT_GT(after[c].plastic_strain, 1e-4);
    }
}

TEST(ExplicitContinuum, asks_for_gravity_or_cohesion_and_only_for_soil) {
    const HexMesh mesh = distorted_block();
    const auto refusal = [&](const SolidMaterial& material, const Point& gravity) -> std::string {
        ExplicitOptions options;
        options.gravity = gravity;
        try {
            ExplicitContinuum(mesh, {{0, material}}, options);
        } catch (const std::invalid_argument& error) {
            return error.what();
        }
        return "nothing was thrown";
    };
    SolidMaterial dry = sand(SolidLaw::drucker_prager);
    dry.cohesion = 0;
    EXPECT_EQ(refusal(dry, Point::Zero()),
              "materials[0].cohesion = 0: must be > 0 without gravity: without both "
              "the soil has no strength");
    EXPECT_EQ(
        refusal(sand(SolidLaw::j2), {0, 0, -9.81}),
        "gravity = 9.81: must be 0 without a region of 'drucker-prager', the only law whose strength depends "
        "on the stress at rest");
    EXPECT_EQ(refusal(dry, {0, 0, std::nan("")}), "gravity[2] = nan: must be a finite number");
    dry.friction_angle = dry.dilatancy = 0;
    EXPECT_EQ(refusal(dry, {0, 0, -9.81}),
              "materials[0].cohesion = 0: must be > 0 where the friction angle is 0: "
              "without both the soil has no strength");
}

} // namespace
