// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/shape_surface.h"

#include <cmath>
#include <numbers>

namespace grainfrac {

namespace {

constexpr int around = 48;   // meridians of a ball; a circle drawn so is flat by 0.2 % of its radius
constexpr int to_pole = 12;  // rings between equator and pole

/// Hemispheres of `radius` about both ends, joined: a ball if the ends coincide.
Surface capsule(const Vec3& from, const Vec3& to, double radius)
{
    const Vec3 span = to - from;
    const bool ball = norm(span) == 0.0;
    const Vec3 axis = ball ? Vec3{0, 0, 1} : normalized(span);
    const Vec3 first = any_perpendicular(axis), second = cross(axis, first);
    Surface surface;
    surface.points.push_back(from - radius * axis);
    // Rings from the pole below `from` to the one above `to`; both equators only where there is a cylinder between
    // them.
    for (int half = 0; half < 2; ++half) {
        for (int k = half == 0 ? 1 : (ball ? 1 : 0); k <= (half == 0 ? to_pole : to_pole - 1); ++k) {
            const double latitude = 0.5 * std::numbers::pi * (half == 0 ? k - to_pole : k) / to_pole;
            const Vec3 center = (half == 0 ? from : to) + radius * std::sin(latitude) * axis;
            for (int j = 0; j < around; ++j) {
                const double angle = 2.0 * std::numbers::pi * j / around;
                surface.points.push_back(center + radius * std::cos(latitude) *
                                                      (std::cos(angle) * first + std::sin(angle) * second));
            }
        }
    }
    surface.points.push_back(to + radius * axis);
    const int top = static_cast<int>(surface.points.size()) - 1, rings = (top - 1) / around;
    for (int j = 0; j < around; ++j) {
        const int next = (j + 1) % around;
        surface.faces.push_back({0, 1 + next, 1 + j});
        for (int r = 0; r + 1 < rings; ++r) {
            const int low = 1 + r * around, high = low + around;
            surface.faces.push_back({low + j, low + next, high + next, high + j});
        }
        const int last = 1 + (rings - 1) * around;
        surface.faces.push_back({last + j, last + next, top});
    }
    return surface;
}

/// Shift of a vertex that moves each of its faces out by `radius`: least squares over the faces' normals, exact for
/// three of them.
Vec3 outward_shift(const std::vector<Vec3>& normals, double radius)
{
    if (radius == 0.0) return {};
    constexpr double flattest = 1e-9;  // [-] determinant below which the normals do not span space
    Mat3 sum{};
    Vec3 right;
    for (const Vec3& n : normals) {
        sum = sum + Mat3::outer(n, n);
        right += radius * n;
    }
    const Vec3 c0 = cross(sum[1], sum[2]), c1 = cross(sum[2], sum[0]), c2 = cross(sum[0], sum[1]);
    const double determinant = dot(sum[0], c0);
    if (std::fabs(determinant) < flattest) return radius * normalized(right);
    return (right.x * c0 + right.y * c1 + right.z * c2) / determinant;
}

Surface grown_polyhedron(const Shapes& shapes, int shape)
{
    const int first_vertex = shapes.vertex_begin[shape], end_vertex = shapes.vertex_begin[shape + 1];
    Surface surface;
    std::vector<std::vector<Vec3>> normals(static_cast<std::size_t>(end_vertex - first_vertex));
    for (int f = shapes.face_begin[shape]; f < shapes.face_begin[shape + 1]; ++f) {
        surface.faces.emplace_back();
        for (int k = shapes.loop_begin[f]; k < shapes.loop_begin[f + 1]; ++k) {
            surface.faces.back().push_back(shapes.loops[k]);
            normals.at(static_cast<std::size_t>(shapes.loops[k])).push_back(shapes.face_normals[f]);
        }
    }
    for (int v = first_vertex; v < end_vertex; ++v) {
        surface.points.push_back(shapes.vertices[v] + outward_shift(normals[static_cast<std::size_t>(v - first_vertex)],
                                                                    shapes.radius[shape]));
    }
    return surface;
}

}  // namespace

Surface shape_surface(const Shapes& shapes, int shape)
{
    if (shapes.face_begin[shape + 1] > shapes.face_begin[shape]) return grown_polyhedron(shapes, shape);
    const Vec3 first = shapes.vertices[shapes.vertex_begin[shape]];
    const Vec3 last = shapes.vertices[shapes.vertex_begin[shape + 1] - 1];
    return capsule(first, last, shapes.radius[shape]);
}

}  // namespace grainfrac
