// SPDX-License-Identifier: GPL-3.0-or-later
// Hexagonal crystals: misorientation of two grains and what it does to the boundary between them; planes of cleavage.
#pragma once

#include "geometry/polyhedron.h"

#include <string>
#include <vector>

namespace grainfrac {

/// Least rotation angle between two crystals under the 12 proper rotations of group 622 [rad]; q: crystal to space.
double hexagonal_misorientation(const Quat& q_a, const Quat& q_b);

/// Boundary energy over its high-angle value: (t)(1 - ln t), t = theta/theta_m below theta_m, 1 above (Read and
/// Shockley 1950) [-].
double read_shockley(double theta, double theta_m);

/// Fracture energy of a boundary over G_0: 1 - chi gamma/gamma_m (Rice and Wang 1989); 1 for a perfect crystal [-].
double boundary_toughness_factor(double theta, double theta_m, double chi);

/// c/a of 6H silicon carbide (a = 3.081, c = 15.12 angstrom) [-]; what tilts planes that are neither prism nor basal.
inline constexpr double silicon_carbide_c_over_a = 15.12 / 3.081;

/// Miller-Bravais indices, h + k + i = 0. Braces name all planes that symmetry makes equal, parentheses one plane.
struct CrystalPlanes {
    int h = 0, k = 0, i = 0, l = 0;
    bool all_variants = true;
};
/// From "{10-10}", "(0001)", "{1 1 -2 0}": a minus sign stands before its digit, blanks and commas between indices may
/// be left out. Throws std::invalid_argument that says what is wrong.
CrystalPlanes parse_crystal_planes(const std::string& text);

/// Unit normals in the crystal frame (a_1 along x, c along z), one per plane: along c or else above the basal plane,
/// or in it at 0 <= angle < 180 deg from a_1; in order of that angle. Normal of (hkil): h a_1* + k a_2* + l c*.
/// {10-10}: 30, 90, 150 deg; {11-20}: 0, 60, 120 deg; (0001): c.
std::vector<Vec3> plane_normals(const CrystalPlanes& planes, double c_over_a = silicon_carbide_c_over_a);

/// Where to look for cleavage: every plane of the family through the centroid and, for {11-20} of a hexagonal prism of
/// edge `prism_side` r [m], also at -r/2 and r/2, the short diagonals of the undisturbed prism; those of {10-10}, the
/// long diagonals, pass through the centroid. In the crystal frame, offsets from the centroid, planes through it
/// first. prism_side = 0: through the centroid only.
std::vector<Plane> cleavage_planes(const CrystalPlanes& planes, double prism_side,
                                   double c_over_a = silicon_carbide_c_over_a);

}  // namespace grainfrac
