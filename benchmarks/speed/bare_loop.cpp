// SPDX-License-Identifier: GPL-2.0-or-later
// Steps a bed with nothing around the contact law, and times it.
//
//   bare_loop <bed in> <bed out> side=<m> steps=<n> [time_step=1e-5] [skin=2.5e-4] [drag=0] [warm_up=0]
//             [contacts_only=0]
//
// A bed is a file of doubles, 11 a body: position, velocity, spin, radius, mass; SI. `drag` (1/s) settles.
// `contacts_only`: after the warm-up only pairs nearer than this gap (m) are kept, so that the timed steps
// see touching pairs and no search: what the physics costs by itself. Prints one line of JSON; times are of
// the processor, of one step. `missed` counts overlapping pairs that the list no longer held.
#include "bare_bed.hpp"

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>

namespace {

using namespace grainfall::bench;
using Row = std::array<double, 11>;

std::vector<Row> read(const std::string& path) {
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    if (!file)
        throw std::runtime_error("cannot read " + path);
    const auto bytes = static_cast<std::size_t>(file.tellg());
    if (bytes == 0 || bytes % sizeof(Row) != 0)
        throw std::runtime_error(path + " is not a bed: its size is no multiple of 11 doubles");
    std::vector<Row> rows(bytes / sizeof(Row));
    file.seekg(0);
    file.read(reinterpret_cast<char*>(rows.data()), static_cast<std::streamsize>(bytes));
    return rows;
}

void write(const std::string& path, std::vector<Row> rows, const BareBed& bed) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const Motion& body = bed.bodies()[i];
        for (int k = 0; k < 3; ++k) {
            rows[i][k] = body.position[k];
            rows[i][3 + k] = body.velocity[k];
            rows[i][6 + k] = body.spin[k];
        }
    }
    std::ofstream file(path, std::ios::binary);
    file.write(reinterpret_cast<const char*>(rows.data()),
               static_cast<std::streamsize>(rows.size() * sizeof(Row)));
    if (!file)
        throw std::runtime_error("cannot write " + path);
}

BareBed make_bed(const std::vector<Row>& rows, const std::map<std::string, double>& options) {
    std::vector<Motion> bodies;
    std::vector<double> radii, masses;
    for (const Row& row : rows) {
        bodies.push_back({{row[0], row[1], row[2]}, {row[3], row[4], row[5]}, {row[6], row[7], row[8]}});
        radii.push_back(row[9]);
        masses.push_back(row[10]);
    }
    return BareBed(bodies, radii, masses, options.at("side"), options.at("skin"), options.at("time_step"));
}

std::map<std::string, double> read_options(int argc, char** argv) {
    std::map<std::string, double> options{{"side", 0}, {"steps", 0},   {"time_step", 1e-5}, {"skin", 2.5e-4},
                                          {"drag", 0}, {"warm_up", 0}, {"contacts_only", 0}};
    for (int i = 3; i < argc; ++i) {
        const std::string word = argv[i];
        const auto equals = word.find('=');
        const auto option = options.find(word.substr(0, equals));
        if (equals == std::string::npos || option == options.end())
            throw std::runtime_error("unknown option " + word);
        option->second = std::stod(word.substr(equals + 1));
    }
    if (!(options["side"] > 0) || !(options["steps"] >= 1))
        throw std::runtime_error("side must be > 0 and steps >= 1");
    return options;
}

double processor_seconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

void run(const std::string& in, const std::string& out, const std::map<std::string, double>& options) {
    const std::vector<Row> rows = read(in);
    BareBed bed = make_bed(rows, options);
    const double drag = options.at("drag");
    for (int i = 0; i < options.at("warm_up"); ++i)
        bed.step(drag);
    if (options.at("contacts_only") > 0)
        bed.keep_contacts_only(options.at("contacts_only"));
    const int rebuilds_before = bed.rebuilds();
    const int steps = static_cast<int>(options.at("steps"));
    double forces = 0, motion = 0;
    for (int i = 0; i < steps; ++i) {
        const double start = processor_seconds();
        bed.add_forces();
        const double middle = processor_seconds();
        bed.move(drag);
        forces += middle - start;
        motion += processor_seconds() - middle;
    }
    write(out, rows, bed);
    const std::size_t touching = bed.touching();
    std::printf("{\"step_seconds\": %.9g, \"force_seconds\": %.9g, \"motion_seconds\": %.9g, "
                "\"contacts\": %zu, \"missed\": %zu, \"pairs\": %zu, \"rebuilds\": %d, "
                "\"kinetic_energy_J\": %.9g}\n",
                (forces + motion) / steps, forces / steps, motion / steps, touching,
                touching - bed.touching_in_list(), bed.pairs(), bed.rebuilds() - rebuilds_before,
                bed.kinetic_energy());
}

} // namespace

int main(int argc, char** argv) {
    try {
        if (argc < 3)
            throw std::runtime_error(
                "usage: bare_loop <bed in> <bed out> side=<m> steps=<n> [option=value ...]");
        run(argv[1], argv[2], read_options(argc, argv));
    } catch (const std::exception& error) {
        std::fprintf(stderr, "bare_loop: %s\n", error.what());
        return 2;
    }
}
