// SPDX-License-Identifier: GPL-2.0-or-later
// The deformable walls of a scene as others see them, without what they are made of.
#pragma once

#include <core/Body.hpp>
#include <core/Interaction.hpp>
#include <core/Scene.hpp>

#include <engines/flat/yade/functor_lists.hpp>

#include <limits>

namespace yade {

/// A face and a sphere that are near each other.
struct FacePair {
    shared_ptr<Interaction> contact; // body 1: the face
    Body* face;
    Body* sphere;
};
/// By sphere, then by face.
void sort_pairs(vector<FacePair>& pairs);

/// J
struct WallEnergies {
    Real stored = 0, dissipated = 0;
    Real supplied = 0; // by moving outer boundaries
};

/// Longest step [s] at which contacts and walls with inertia may exchange forces and motion, and who sets it.
struct ExchangeLimit {
    Real step = std::numeric_limits<Real>::infinity();
    vector<int> contact; // face, sphere
};

bool is_wall(const Engine& engine);
bool has_walls(const Scene& scene);
/// Solves the walls of a scene whose loop knows the pairs that are near, sorted.
void prepare_walls(Scene& scene, const vector<FacePair>& pairs, FunctorLists& functors);
/// The same where YADE's collider has found them.
void prepare_walls(Scene& scene);
WallEnergies wall_energies(const Scene& scene);
ExchangeLimit exchange_limit(const Scene& scene);

} // namespace yade
