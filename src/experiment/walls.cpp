// SPDX-License-Identifier: GPL-3.0-or-later
#include "experiment/walls.h"

#include "contact/manifold.h"
#include "experiment/specimen.h"
#include "generate/assemble.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace grainfrac {

namespace {

/// Edge radius of plates over their thickness: the face stays where it is asked for, corners are rounded by this.
constexpr double plate_rounding = 0.05;

int group_of_wall(const Model& model, int wall)
{
    const std::string& name = model.walls[static_cast<std::size_t>(wall)];
    int g = 0;
    while (
        !(model.groups[static_cast<std::size_t>(g)].is_wall && model.groups[static_cast<std::size_t>(g)].name == name))
        ++g;
    return g;
}

/// Least gap between two dilated bodies along with an upper bound for one that cannot matter: no exact distance is
/// computed for bodies whose bounding balls are farther apart than `best`.
double least_gap(const Model& model, const State& state, const std::vector<int>& wall_bodies, double best)
{
    const Bodies& b = state.bodies;
    const ShapesView shapes = view(model.shapes, Device::cpu);
    for (const int w : wall_bodies) {
        const ContactBody x{shapes, b.shape[w], b.position[w], b.orientation[w]};
        for (int i = 0; i < b.size(); ++i) {
            if (b.inverse_mass[i] == 0.0) continue;
            const double reach = shapes.bounding_radius[b.shape[i]] + shapes.bounding_radius[b.shape[w]];
            if (norm(b.position[i] - b.position[w]) - reach >= best) continue;
            const ContactBody y{shapes, b.shape[i], b.position[i], b.orientation[i]};
            best = std::min(
                best, closest_points(x.core(), y.core(), y.position - x.position).distance - x.radius() - y.radius());
        }
    }
    return best;
}

}  // namespace

bool move_to_touch(const Model& model, State& state, int wall, const Vec3& direction)
{
    std::vector<int> bodies;
    for (int i = 0; i < state.bodies.size(); ++i) {
        if (state.bodies.wall[i] == wall) bodies.push_back(i);
    }
    return move_to_touch(model, state, bodies, direction);
}

bool move_to_touch(const Model& model, State& state, const std::vector<int>& bodies, const Vec3& direction)
{
    const double closed = 1e-13 * model.nominal_length;  // gap that counts as touching: round-off of the distances
    constexpr int most_rounds = 2000;
    const std::vector<Vec3> before = state.bodies.position.host();
    double travelled = 0.0, limit = 0.0;
    for (const Vec3& x : before)
        limit = std::max(limit, 4.0 * norm(x - before[static_cast<std::size_t>(bodies.front())]));
    for (int round = 0; round < most_rounds && travelled <= limit; ++round) {
        const double gap = least_gap(model, state, bodies, std::numeric_limits<double>::max());
        if (gap <= closed) {
            for (const int i : bodies)
                state.bodies.start_position.host()[static_cast<std::size_t>(i)] = state.bodies.position[i];
            return true;
        }
        travelled += gap;
        for (const int i : bodies) state.bodies.position.host()[static_cast<std::size_t>(i)] += gap * direction;
    }
    state.bodies.position.host() = before;
    return false;
}

int add_wall(Model& model, const std::string& name)
{
    model.walls.push_back(name);
    model.wall_motion.host().push_back({});
    model.groups.push_back({name, -1, true});
    return static_cast<int>(model.walls.size()) - 1;
}

void add_plate(Model& model, State& state, int wall, const Vec3& face_center, const Vec3& normal, const Vec3& along,
               double width, double depth, double thickness)
{
    const double radius = plate_rounding * std::min({width, depth, thickness});
    const Vec3 n = normalized(normal), e = normalized(tangential(along, n)), f = cross(n, e);
    const Polyhedron box = make_box({width - 2.0 * radius, depth - 2.0 * radius, thickness - 2.0 * radius});
    const Mat3 axes = transpose(Mat3{{e, f, n}});  // columns: box axes in space
    add_wall_plate(model, state, wall, group_of_wall(model, wall), rotated(box, from_matrix(axes)),
                   face_center - (0.5 * thickness) * n, radius);
}

int add_cylinder(Model& model, State& state, int wall, const Vec3& axis, double length, const Vec3& center,
                 double radius)
{
    return add_wall_round(model, state, wall, group_of_wall(model, wall), axis, length, center, radius);
}

void add_box(Model& model, State& state, int wall, const Vec3& center, const Vec3& inside, double thickness,
             const std::vector<std::string>& open)
{
    for (int e = 0; e < 3; ++e) {
        const int f = e == 0 ? 1 : 0, g = 3 - e - f;  // as for a plate of the input
        for (const int side : {1, -1}) {
            const std::string name = std::string(side > 0 ? "+" : "-") + "xyz"[e];
            if (std::find(open.begin(), open.end(), name) != open.end()) continue;
            const Vec3 inwards = -static_cast<double>(side) * axis_vector(e);
            // corners: each plate reaches past its neighbours
            add_plate(model, state, wall, center - 0.5 * inside[e] * inwards, inwards, axis_vector(f),
                      inside[f] + 2.0 * thickness, inside[g] + 2.0 * thickness, thickness);
        }
    }
}

void add_mesh(Model& model, State& state, int wall, const TriangleMesh& mesh, double unit, const Vec3& origin)
{
    for (std::vector<Vec3> polygon : convex_facets(mesh, max_face_vertices)) {
        for (Vec3& x : polygon) x = unit * x + origin;
        const Vec3 center = polygon_centroid(polygon);
        for (Vec3& x : polygon) x -= center;
        std::vector<int> front(polygon.size());
        std::iota(front.begin(), front.end(), 0);
        const std::vector<int> back(front.rbegin(), front.rend());
        add_wall_plate(model, state, wall, group_of_wall(model, wall), make_polyhedron(polygon, {front, back}), center,
                       0.0);
    }
}

namespace {

void add_mesh(Model& model, State& state, int wall, const WallSpec& spec, const std::string& key,
              const std::string& input_file)
{
    const std::string file = std::filesystem::path(input_file).parent_path() / spec.file;
    TriangleMesh mesh;
    try {
        mesh = read_stl(file);
    } catch (const std::runtime_error& e) {
        throw InputError(key + ".file", e.what());
    }
    if (const std::string why = why_not_closed(mesh); spec.closed && !why.empty()) {
        throw InputError(key + ".file", "the surface is not closed: " + why +
                                            "; mend it, or set closed = false where an open surface is meant");
    }
    add_mesh(model, state, wall, mesh, spec.file_unit, spec.center);
}

}  // namespace

void add_wall(Model& model, State& state, const WallSpec& spec, const std::string& key, const std::string& input_file)
{
    const int wall = add_wall(model, spec.name);
    const double thickness = spec.thickness > 0.0 || spec.size.empty()
                                 ? spec.thickness
                                 : 0.1 * *std::max_element(spec.size.begin(), spec.size.end());
    if (spec.shape == "plate") {
        add_plate(model, state, wall, spec.center, spec.normal,
                  std::fabs(normalized(spec.normal).x) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}, spec.size[0],
                  spec.size[1], thickness);
    } else if (spec.shape == "box") {
        add_box(model, state, wall, spec.center, {spec.size[0], spec.size[1], spec.size[2]}, thickness, spec.open);
    } else if (spec.shape == "stl") {
        add_mesh(model, state, wall, spec, key, input_file);
    } else {
        const double length = spec.shape == "cylinder" ? spec.length : 0.0;
        add_wall_round(model, state, wall, group_of_wall(model, wall), normalized(spec.axis), length, spec.center,
                       spec.radius);
    }
}

}  // namespace grainfrac
