// SPDX-License-Identifier: GPL-3.0-or-later
#include "experiment/walls.h"

#include "generate/assemble.h"

#include <algorithm>
#include <cmath>

namespace grainfrac {

namespace {

/// Edge radius of plates over their thickness: the face stays where it is asked for, corners are rounded by this.
constexpr double plate_rounding = 0.05;

int group_of_wall(const Model& model, int wall)
{
    const std::string& name = model.walls[static_cast<std::size_t>(wall)];
    int g = 0;
    while (!(model.groups[static_cast<std::size_t>(g)].is_wall && model.groups[static_cast<std::size_t>(g)].name == name)) ++g;
    return g;
}

}  // namespace

int add_wall(Model& model, const std::string& name)
{
    model.walls.push_back(name);
    model.wall_motion.host().push_back({});
    model.groups.push_back({name, -1, true});
    return static_cast<int>(model.walls.size()) - 1;
}

void add_plate(Model& model, State& state, int wall, const Vec3& face_center, const Vec3& normal, const Vec3& along, double width,
               double depth, double thickness)
{
    const double radius = plate_rounding * std::min({width, depth, thickness});
    const Vec3 n = normalized(normal), e = normalized(tangential(along, n)), f = cross(n, e);
    const Polyhedron box = make_box({width - 2.0 * radius, depth - 2.0 * radius, thickness - 2.0 * radius});
    const Mat3 axes = transpose(Mat3{{e, f, n}});  // columns: box axes in space
    add_wall_plate(model, state, wall, group_of_wall(model, wall), rotated(box, from_matrix(axes)), face_center - (0.5 * thickness) * n, radius);
}

void add_wall(Model& model, State& state, const WallSpec& spec)
{
    const int wall = add_wall(model, spec.name);
    if (spec.shape == "plate") {
        const double thickness = spec.thickness > 0.0 ? spec.thickness : 0.1 * std::max(spec.size[0], spec.size[1]);
        add_plate(model, state, wall, spec.center, spec.normal, any_perpendicular(normalized(spec.normal)), spec.size[0], spec.size[1], thickness);
        return;
    }
    const double length = spec.shape == "cylinder" ? spec.length : 0.0;
    add_wall_round(model, state, wall, group_of_wall(model, wall), normalized(spec.axis), length, spec.center, spec.radius);
}

}  // namespace grainfrac
