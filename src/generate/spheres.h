// SPDX-License-Identifier: GPL-3.0-or-later
// Spheres and the bonds between them: the one place where they enter a model, whatever packed them.
#pragma once

#include "fracture/sphere_bond_law.h"
#include "model/model.h"
#include "model/state.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace grainfrac {

/// One sphere, or a node of a fibre: then its mass is that of a piece of a cylinder.
struct SphereSpec {
    Vec3 position;        ///< [m]
    double radius = 0.0;  ///< of contacts [m]
    std::int32_t material = 0, group = 0;
    double section_radius = 0.0;  ///< node: of the fibre; 0: a sphere [m]
    double piece = 0.0;           ///< link of a chain: length of fibre that it stands for [m]
    std::int32_t chain = -1;      ///< chain it is a link of; neighbours in the list are neighbours in the chain
    Vec3 velocity;                ///< [m/s]
    Vec3 angular_velocity;        ///< [rad/s]
};

/// Returns the body's index.
int add_sphere(Model& model, State& state, const SphereSpec& sphere);

/// Two bodies that a bond is to join; `area` is the section that carries it.
struct SpherePair {
    int a = 0, b = 0;      ///< a < b
    double radius = 0.0;   ///< R of the section [m]
    BondSprings springs;   ///< [N/m], [N m]
    std::int32_t law = 0;  ///< into Model::sphere_bond_laws
    double strength = 1.0;
};

/// Pairs of spheres of a list whose gap is at most `gap_factor` times the sum of their radii, sorted. Indices into the
/// list.
std::vector<std::pair<int, int>> touching_spheres(const std::vector<SphereSpec>& spheres, double gap_factor);

/// K_n, K_s, K_b, K_t of a circular bond: k_n A, k_s A, k_n I, k_s J (Potyondy and Cundall 2004); per area [Pa/m].
BondSprings circular_bond(double normal_stiffness, double shear_stiffness, double radius, bool moments);

/// Bond from centre to centre, unstressed where the bodies are now. Arms share the distance as the contact radii do.
/// The caller adds pairs in sorted order.
void add_sphere_bond(Model& model, State& state, const SpherePair& pair);
/// After all bonds are made: equal ones share their kind, and arrays that no law of the model needs are taken away.
void settle(const Model& model, SphereBonds& bonds);

}  // namespace grainfrac
