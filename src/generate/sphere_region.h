// SPDX-License-Identifier: GPL-3.0-or-later
// The region of a part as a set of points. Cylinders are round: the facets stand for them where grains are cut.
#pragma once

#include "model/case.h"

namespace grainfrac {

/// Point of view of one region: a box, or a cylinder or ball of radius `radius`.
struct SphereRegion {
    enum class Shape { box, cylinder, ball } shape = Shape::box;
    Vec3 center;          ///< [m]
    Vec3 half;            ///< of the box around it [m]
    double radius = 0.0;  ///< cylinder, ball [m]
    int axis = 2;         ///< cylinder

    explicit SphereRegion(const RegionSpec& spec);
    double volume() const;
    /// Smallest full length [m].
    double thinnest() const;
    /// Inclusive; what is beyond the surface by 1e-9 of the region's size is inside still.
    bool contains(const Vec3& x) const;
    /// The nearest point for the centre of a sphere of radius r that is to lie wholly inside; x itself if it does.
    Vec3 drawn_in(const Vec3& x, double r) const;
};

/// Index of the axis that "x", "y" or "z" names.
int axis_index(const std::string& name);

}  // namespace grainfrac
