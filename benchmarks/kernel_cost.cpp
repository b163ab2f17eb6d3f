// SPDX-License-Identifier: GPL-2.0-or-later
// One law over one array of contacts, for counting its instructions (benchmarks/instruction_count.py).
//
//   kernel_cost <law> [contacts] [steps]
//
// `handwritten` is the yardstick: Hertz, rescaled Mindlin, repulsive dashpot, constant friction, dry, written
// out for that alone. `template` is the same physics from the policies. The others switch one effect on or
// off. Every law sees the same contacts. Prints the sum of forces (N), of stiffnesses (N/m) and the number of
// sliding contacts, the same for the first two.
#include <laws/friction/any.hpp>
#include <laws/hertz_mindlin.hpp>
#include <laws/pair_rules.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <random>
#include <string>
#include <vector>

namespace {

using namespace grainfall::laws;

template <class Friction, class Memory>
struct Contact {
    ContactGeometry geometry;
    ContactParameters parameters;
    Memory memory;
    Friction friction;
};

struct Handwritten {
    using Memory = ContactMemory;
    using Curve = friction::Constant;
    using Book = NoEnergy;

    static ContactForce step(const ContactGeometry& g, const ContactParameters& p, const Curve& friction,
                             ContactMemory& memory, NoEnergy&) {
        const double root = std::sqrt(g.overlap), quarter = std::sqrt(root);
        ContactForce out;
        out.normal_stiffness = 1.5 * p.normal_coefficient * root;
        out.normal = std::max(0.0, p.normal_coefficient * (g.overlap * root) -
                                       p.normal_damping * quarter * g.normal_velocity);
        const double ks = p.shear_coefficient * root;
        out.shear_stiffness = ks;

        const Vector half = 0.5 * (g.tilt + g.twist);
        const Vector turned = half.cross(memory.shear_force);
        Vector shear = memory.shear_force + (2 / (1 + half.squaredNorm())) * (turned + half.cross(turned));
        const double normal_part = shear.dot(g.normal), length2 = shear.squaredNorm();
        shear -= normal_part * g.normal;
        const double lost = normal_part * normal_part;
        if (lost > 1e-20 * length2 && lost < length2)
            shear *= std::sqrt(length2 / (length2 - lost));
        if (ks < memory.shear_stiffness)
            shear *= ks / memory.shear_stiffness;
        shear -= ks * g.shear_increment;

        Vector viscous = (-p.shear_damping * quarter / g.time_step) * g.shear_increment;
        Vector total = shear + viscous;
        const double limit = friction.mu * out.normal, limit2 = limit * limit;
        const double shear2 = shear.squaredNorm();
        if (shear2 > limit2) {
            shear *= limit / std::sqrt(shear2);
            total = shear + viscous;
            out.sliding = true;
        }
        const double total2 = total.squaredNorm();
        if (total2 > limit2) {
            total *= limit / std::sqrt(total2);
            out.sliding = true;
        }
        out.shear = total;
        memory.shear_force = shear;
        memory.shear_stiffness = ks;
        return out;
    }
};

template <class Normal, class Tangential, class Damping, class Friction, class Energy>
struct Composed {
    using Kernel = HertzMindlin<Normal, Tangential, Damping, Friction, Energy>;
    using Memory = typename Kernel::Memory;
    using Curve = Friction;
    using Book = Energy;

    static ContactForce step(const ContactGeometry& geometry, const ContactParameters& parameters,
                             const Friction& friction, Memory& memory, Energy& book) {
        return Kernel::step(geometry, parameters, friction, memory, book);
    }
};

// Uses everything a law gives, so that the compiler drops none of it.
struct Checksum {
    double force = 0, stiffness = 0;
    long sliding = 0;
};

// Never inlined, so that the counter can switch itself on and off at its entry and exit.
template <class Law>
[[gnu::noinline]] Checksum
counted_steps(std::vector<Contact<typename Law::Curve, typename Law::Memory>>& contacts, int steps) {
    typename Law::Book book;
    Checksum checksum;
    for (int i = 0; i < steps; ++i) {
        for (auto& contact : contacts) {
            const ContactForce force =
                Law::step(contact.geometry, contact.parameters, contact.friction, contact.memory, book);
            checksum.force += force.normal + force.shear.sum();
            checksum.stiffness += force.normal_stiffness + force.shear_stiffness;
            checksum.sliding += force.sliding;
        }
    }
    if constexpr (Law::Book::active)
        checksum.force += book.friction + book.viscous + book.rescaling;
    return checksum;
}

template <class Friction, class Memory>
std::vector<Contact<Friction, Memory>> some_contacts(std::size_t count, const Friction& friction) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const auto vector = [&] { return Vector(uniform(random), uniform(random), uniform(random)); };
    const ContactParameters parameters = contact_parameters(3.6e10, 8e9, 1.25e-3, 3e-5, 0.1);
    std::vector<Contact<Friction, Memory>> contacts(count,
                                                    Contact<Friction, Memory>{{}, parameters, {}, friction});
    for (auto& contact : contacts) {
        ContactGeometry& g = contact.geometry;
        g.time_step = 1e-7;
        g.overlap = 1e-7 * (1.1 + uniform(random));
        g.normal = vector().normalized();
        g.shear_increment = 1e-10 * g.normal.cross(vector());
        g.tilt = 1e-6 * g.normal.cross(vector());
        g.twist = 1e-6 * uniform(random) * g.normal;
        g.normal_velocity = 1e-3 * uniform(random);
    }
    return contacts;
}

template <class Law>
Checksum run(const typename Law::Curve& friction, std::size_t count, int steps) {
    auto contacts = some_contacts<typename Law::Curve, typename Law::Memory>(count, friction);
    return counted_steps<Law>(contacts, steps);
}

template <class Friction, class Energy = NoEnergy>
using Usual = Composed<Hertz, IncrementalTangential, RepulsiveDashpot, Friction, Energy>;

using Runner = std::function<Checksum(std::size_t, int)>;

template <class Law>
Runner runner(typename Law::Curve friction) {
    return [friction](std::size_t count, int steps) { return run<Law>(friction, count, steps); };
}

const std::map<std::string, Runner>& laws() {
    using namespace grainfall::laws::friction;
    const Constant half{0.5};
    const TableGrid grid{{0.01, 1, 20}, {0, 0.1}, {0.8, 0.7, 0.5, 0.4, 0.2, 0.2}};
    static const std::map<std::string, Runner> all{
        {"handwritten", runner<Handwritten>(half)},
        {"template", runner<Usual<Constant>>(half)},
        {"frictionless", runner<Composed<Hertz, NoTangential, RepulsiveDashpot, Constant, NoEnergy>>(half)},
        {"undamped", runner<Composed<Hertz, IncrementalTangential, NoDamping, Constant, NoEnergy>>(half)},
        {"report",
         runner<Composed<ReportNormal, ReportTangential, RepulsiveDashpot, Constant, NoEnergy>>(half)},
        {"partial-slip",
         runner<Composed<Hertz, PartialSlipTangential, RepulsiveDashpot, Constant, NoEnergy>>(half)},
        {"energy-book", runner<Usual<Constant, DissipationBook>>(half)},
        {"power-law", runner<Usual<PowerLaw>>(cole_power_law())},
        {"exponential", runner<Usual<Exponential>>(cole_exponential())},
        {"asperity", runner<Usual<Asperity>>(cole_asperity())},
        {"table", runner<Usual<Table>>(grid.at_moisture(0.05))},
        {"mixed-curves", runner<Usual<Any>>(Any(cole_power_law()))},
    };
    return all;
}

} // namespace

int main(int argc, char** argv) {
    const auto law = argc > 1 ? laws().find(argv[1]) : laws().end();
    const int count = argc > 2 ? std::atoi(argv[2]) : 1000;
    const int steps = argc > 3 ? std::atoi(argv[3]) : 100;
    if (law == laws().end() || count < 1 || steps < 1) {
        std::fprintf(stderr, "usage: kernel_cost <law> [contacts >= 1] [steps >= 1]; laws:");
        for (const auto& entry : laws())
            std::fprintf(stderr, " %s", entry.first.c_str());
        std::fprintf(stderr, "\n");
        return 2;
    }
    const Checksum sum = law->second(static_cast<std::size_t>(count), steps);
    std::printf("%.17g %.17g %ld\n", sum.force, sum.stiffness, sum.sliding);
}
