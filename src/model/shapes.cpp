// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/shapes.h"

#include <algorithm>
#include <numbers>
#include <set>
#include <stdexcept>

namespace grainfrac {

namespace {

void open_lists(Shapes& s)
{
    if (!s.vertex_begin.empty()) return;
    s.vertex_begin.host() = {0};
    s.edge_begin.host() = {0};
    s.face_begin.host() = {0};
    s.loop_begin.host() = {0};
}

int close_shape(Shapes& s, double radius, double point_area, double largest_face, double bounding_radius)
{
    s.largest_face.host().push_back(largest_face);
    s.radius.host().push_back(radius);
    s.point_area.host().push_back(point_area);
    s.bounding_radius.host().push_back(bounding_radius);
    s.vertex_begin.host().push_back(s.vertices.size());
    s.edge_begin.host().push_back(s.edges.size());
    s.face_begin.host().push_back(s.face_normals.size());
    return s.size() - 1;
}

}  // namespace

int add_shape(Shapes& shapes, const Polyhedron& core, double radius)
{
    open_lists(shapes);
    double reach = 0.0, faces_area = 0.0, largest_face = 0.0;
    for (const Vec3& v : core.vertices) reach = std::max(reach, norm(v));
    std::set<std::pair<int, int>> edges;
    for (std::size_t f = 0; f < core.faces.size(); ++f) {
        const auto& loop = core.faces[f];
        if (loop.size() > static_cast<std::size_t>(max_face_vertices)) {
            throw std::invalid_argument("a contact face has " + std::to_string(loop.size()) + " vertices; at most " +
                                        std::to_string(max_face_vertices) + " are possible");
        }
        shapes.face_normals.host().push_back(core.planes[f].normal);
        shapes.face_offsets.host().push_back(core.planes[f].offset);
        shapes.loops.host().insert(shapes.loops.host().end(), loop.begin(), loop.end());
        shapes.loop_begin.host().push_back(shapes.loops.size());
        const double area = norm(area_vector(face_polygon(core, static_cast<int>(f))));
        faces_area += area;
        largest_face = std::max(largest_face, area);
        for (std::size_t k = 0; k < loop.size(); ++k) edges.insert(std::minmax(loop[k], loop[(k + 1) % loop.size()]));
    }
    for (const auto& [from, to] : edges) shapes.edges.host().push_back({from, to});
    auto& vertices = shapes.vertices.host();
    vertices.insert(vertices.end(), core.vertices.begin(), core.vertices.end());
    // A quarter of the mean face: the smallest one of a cut grain may be next to nothing, and contacts with it too
    // soft.
    const double mean_face = core.faces.empty() ? 0.0 : faces_area / static_cast<double>(core.faces.size());
    return close_shape(shapes, radius, 0.25 * mean_face, largest_face, reach + radius);
}

int add_sphere_shape(Shapes& shapes, double radius)
{
    open_lists(shapes);
    shapes.vertices.host().push_back({});
    return close_shape(shapes, radius, 0.0, std::numbers::pi * radius * radius, radius);
}

int add_ball_shape(Shapes& shapes, double radius)
{
    open_lists(shapes);
    shapes.vertices.host().push_back({});
    const double section = std::numbers::pi * radius * radius;
    return close_shape(shapes, radius, section, section, radius);
}

int add_cylinder_shape(Shapes& shapes, const Vec3& axis, double length, double radius)
{
    open_lists(shapes);
    shapes.vertices.host().push_back(-0.5 * length * axis);
    shapes.vertices.host().push_back(0.5 * length * axis);
    shapes.edges.host().push_back({0, 1});
    return close_shape(shapes, radius, 0.0, 2.0 * radius * length, 0.5 * length + radius);
}

ShapesView view(const Shapes& s, Device device)
{
    return {s.radius.read(device),       s.bounding_radius.read(device), s.point_area.read(device),
            s.vertex_begin.read(device), s.edge_begin.read(device),      s.face_begin.read(device),
            s.vertices.read(device),     s.edges.read(device),           s.face_normals.read(device),
            s.face_offsets.read(device), s.loop_begin.read(device),      s.loops.read(device)};
}

}  // namespace grainfrac
