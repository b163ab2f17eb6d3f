// SPDX-License-Identifier: GPL-2.0-or-later
// Walls as the loop, the ledger and the time stepper see them.
#include <femlink/yade/FemWall.hpp>

#include <core/Scene.hpp>

#include <algorithm>
#include <iterator>

namespace yade {

namespace {

vector<FemWall*> walls_of(const Scene& scene) {
    vector<FemWall*> walls;
    for (const auto& engine : scene.engines)
        if (auto* wall = dynamic_cast<FemWall*>(engine.get()))
            if (!wall->dead)
                walls.push_back(wall);
    return walls;
}

} // namespace

bool is_wall(const Engine& engine) {
    return dynamic_cast<const FemWall*>(&engine);
}

bool has_walls(const Scene& scene) {
    return !walls_of(scene).empty();
}

void sort_pairs(vector<FacePair>& pairs) {
    std::sort(pairs.begin(), pairs.end(), [](const FacePair& a, const FacePair& b) {
        return a.sphere->id != b.sphere->id ? a.sphere->id < b.sphere->id : a.face->id < b.face->id;
    });
}

void prepare_walls(Scene& scene, const vector<FacePair>& pairs, FunctorLists& functors) {
    const vector<FemWall*> walls = walls_of(scene);
    for (FemWall* wall : walls) {
        wall->scene = &scene;
        if (walls.size() == 1) {
            wall->prepare(pairs, functors);
            continue;
        }
        vector<FacePair> own;
        std::copy_if(pairs.begin(), pairs.end(), std::back_inserter(own),
                     [&](const FacePair& pair) { return wall->has_face(*pair.face); });
        wall->prepare(own, functors);
    }
}

void prepare_walls(Scene& scene) {
    for (FemWall* wall : walls_of(scene))
        wall->prepare_in_scene();
}

WallEnergies wall_energies(const Scene& scene) {
    WallEnergies sum;
    for (const FemWall* wall : walls_of(scene)) {
        sum.stored += wall->storedEnergy;
        sum.dissipated += wall->dissipatedEnergy;
        sum.supplied += wall->boundaryWork;
    }
    return sum;
}

ExchangeLimit exchange_limit(const Scene& scene) {
    ExchangeLimit least;
    for (const FemWall* wall : walls_of(scene)) {
        const ExchangeLimit limit = wall->exchange_limit();
        if (limit.step < least.step)
            least = limit;
    }
    return least;
}

} // namespace yade
