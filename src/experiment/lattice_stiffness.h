// SPDX-License-Identifier: GPL-3.0-or-later
// Springs between spheres that make a packing of wanted modulus and Poisson ratio, in closed form. Every packing has
//
//   nu = (1 - lambda)/(p + lambda),   lambda = K_s/K_n = (1 - p nu)/(1 + nu),   -1 < nu <= 1/p
//
// with p = 5 for hexagonal close packing loaded along c (and face-centred cubic along [111]), p = 3 for face-centred
// cubic along [100] and for hexagonal prisms in their plane, p = 4 for an isotropic random packing. Moments between
// spheres do not enter. The lattices are exact where nothing but their inside counts; the random form is the mean of a
// uniform strain, so an upper bound.
#pragma once

#include <optional>

namespace grainfrac {

/// honeycomb: hexagonal prisms pulled in their plane, with interfaces (Kawai 1978); K_n is then per area, and the
/// density the distance of the centres.
enum class Packing { hcp, fcc, random, honeycomb };

/// Springs of all bonds of a packing.
struct LatticeStiffness {
    double normal;       ///< K_n [N/m]
    double shear_ratio;  ///< K_s/K_n [-]
};

/// Modulus and Poisson ratio along the axis that is loaded.
struct LatticeElasticity {
    double young_modulus;  ///< [Pa]
    double poisson_ratio;  ///< [-]
};

/// Largest Poisson ratio that springs of this packing reach [-].
double largest_poisson_ratio(Packing packing);

/// Empty where nu is not in (-1, largest_poisson_ratio].
/// @param density what the bonds are to the modulus, E = K_n density f(lambda): of a lattice one over the distance of
/// the centres [1/m]; of a random packing the sum of w l^2 over its bonds of length l and stiffness w K_n, over its
/// volume
std::optional<LatticeStiffness> lattice_stiffness(Packing packing, double E, double nu, double density);

/// For a ratio that is given, whatever nu comes of it.
LatticeStiffness lattice_stiffness_at(Packing packing, double E, double shear_ratio, double density);

/// The same the other way round.
LatticeElasticity lattice_elasticity(Packing packing, const LatticeStiffness& springs, double density);

/// Hexagonal close packing of spheres of this diameter, loaded along c.
std::optional<LatticeStiffness> hcp_stiffness(double E, double nu, double diameter);

/// Face-centred cubic packing, loaded along [100].
std::optional<LatticeStiffness> fcc_stiffness(double E, double nu, double diameter);

/// Isotropic random packing; density as above.
std::optional<LatticeStiffness> random_stiffness(double E, double nu, double density);

}  // namespace grainfrac
