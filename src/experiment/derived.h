// SPDX-License-Identifier: GPL-3.0-or-later
// What an input implies: macroscopic constants of its bonds, scales of fracture and of loading.
#pragma once

#include "experiment/experiment.h"

#include <optional>
#include <string>
#include <vector>

namespace grainfrac {

/// The bonds between two parts, or of one with itself, in the mean.
struct PartBonds {
    int entry = -1;                 ///< of [[bonds]]; -1: none
    int number = 0;                 ///< made so far
    double spacing = 0.0;           ///< h, of the centres [m]
    double normal_stiffness = 0.0;  ///< k_n per area; of sphere bonds K_n over the section; not made yet: E/h [Pa/m]
    double shear_ratio = 0.0;       ///< k_s/k_n [-]
    /// Of one part: modulus and Poisson's ratio of the assembly where there is a closed form: in the plane of hexagonal
    /// prisms, along c of hcp and along a cube edge of fcc, of an isotropic tessellation else
    /// (docs/theory/elasticity.md).
    std::optional<double> young_modulus, poisson_ratio;
};
PartBonds part_bonds(const Case& c, const Built& built, int part_a, int part_b);

/// Fracture of bonds that soften.
struct FractureScales {
    double toughness = 0.0;     ///< K = sqrt(E G_I) [Pa m^0.5]
    double process_zone = 0.0;  ///< l_cz = E G_I/sigma_c^2 (Hillerborg 1976) [m]
    double snap_back = 0.0;     ///< G_I over sigma_c^2/(2 k_n); must be > 1 [-]
};
std::optional<FractureScales> fracture_scales(const Case& c, const PartBonds& bonds, double young_modulus);

/// Least tensile strength of bonds that can break; 0: none can [Pa].
double weakest_strength(const Case& c);
/// Closing speed of the walls that load the specimen; 0: none does at a told speed [m/s].
double closing_speed(const Experiment& e);

/// Lines for `check`, without a comment sign.
std::vector<std::string> derived_lines(const Case& c, const Built& built);

}  // namespace grainfrac
