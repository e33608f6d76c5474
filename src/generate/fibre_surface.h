// SPDX-License-Identifier: GPL-3.0-or-later
// The surface of a fibre as patches, each between a node or sphere of the fibre and a body of the matrix. Their normals
// are radial and their areas add up to that of the cylinder, all along it: a bond along the line of two centres would
// carry but a part of the axial slip (docs/theory/pull_out.md).
#pragma once

#include "geometry/shared_faces.h"
#include "model/model.h"
#include "model/state.h"

#include <vector>

namespace grainfrac {

/// A chain of nodes in the matrix.
struct FibreChain {
    std::vector<int> nodes;   ///< bodies, from the embedded end to the loaded one
    std::vector<double> way;  ///< from the end of the fibre to each of them, along it [m]
    double whole = 0.0;       ///< length of the fibre [m]
    double radius = 0.0;      ///< a [m]

    /// Half-way to the neighbours, to the end of the fibre at the first and last one [m].
    double reach_back(std::size_t k) const { return k == 0 ? way[0] : 0.5 * (way[k] - way[k - 1]); }
    double reach_on(std::size_t k) const { return k + 1 == way.size() ? whole - way[k] : 0.5 * (way[k + 1] - way[k]); }
};

/// Direction of the fibre at a node, towards the loaded end.
Vec3 fibre_tangent(const State& state, const std::vector<int>& nodes, std::size_t k);

/// A rectangle of `length` along the fibre and `width` across about `center`, between a node and a body of the matrix.
SharedFace fibre_patch(int fibre, int matrix, const Vec3& center, const Vec3& outward, const Vec3& along, double length,
                       double width);

/// One patch for each body of the matrix that a node sees beside it: the nearest spheres around it, with the patch at
/// their centres, and the grains around it (grain_patches). A patch of a sphere is as wide as its share of the circle
/// and as long as the fibre half-way to the next nodes that have some, so that the patches cover what lies in the
/// matrix.
std::vector<SharedFace> chain_patches(const Model& model, const State& state, const FibreChain& chain,
                                      const std::vector<char>& is_matrix);

/// A fibre made of the spheres of a lattice: a patch, all of one area, for each pair of bonded neighbours across the
/// surface of the cylinder; midway between them.
struct FibreLattice {
    Vec3 axis;               ///< unit [-]
    Vec3 center;             ///< a point of the axis [m]
    double radius = 0.0;     ///< a [m]
    double length = 0.0;     ///< [m]
    bool radial = true;      ///< normals: radial, else along the line of the centres
    bool same_level = true;  ///< only pairs whose line is square to the axis
};
std::vector<SharedFace> lattice_patches(const State& state, const FibreLattice& fibre,
                                        const std::vector<std::pair<int, int>>& pairs);

}  // namespace grainfrac
