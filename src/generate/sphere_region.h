// SPDX-License-Identifier: GPL-3.0-or-later
// The region of a part as a set of points. Cylinders are round: the facets stand for them where grains are cut.
#pragma once

#include "model/case.h"

namespace grainfrac {

/// A box, or a cylinder or ball of radius `radius`.
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
    /// Shortest shift after which a sphere of radius r about x lies wholly inside; exactly zero if it does.
    Vec3 shift_inside(const Vec3& x, double r) const;
    /// Area of the surface [m^2].
    double surface() const;
};

/// Index of the axis that "x", "y" or "z" names.
int axis_index(const std::string& name);

}  // namespace grainfrac
