// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/figure.h"
#include "io/results.h"
#include "io/shape_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace grainfrac {

namespace {

/// Faces whose normal is nearer to z than this (cosine) lie in the picture's plane and have no trace in it.
constexpr double flat_face = 0.7;
// Between grains tension, shear, mixed; through grains. The colours of paraview/view.py.
constexpr std::array kind_inks{Ink::red, Ink::blue, Ink::purple, Ink::green};

std::size_t kind_of(const CrackFace& crack)
{
    return static_cast<std::size_t>(crack.mode == 1 ? 3 : crack.cause);
}

struct Outline {
    std::vector<double> x, y;
};

Outline closed(const std::vector<Vec3>& polygon)
{
    Outline outline;
    for (std::size_t k = 0; k <= polygon.size() && !polygon.empty(); ++k) {
        outline.x.push_back(polygon[k % polygon.size()].x);
        outline.y.push_back(polygon[k % polygon.size()].y);
    }
    return outline;
}

Outline circle(const Vec3& center, double radius)
{
    constexpr int corners = 24;
    std::vector<Vec3> polygon;
    for (int k = 0; k < corners; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / corners;
        polygon.push_back(center + radius * Vec3{std::cos(angle), std::sin(angle), 0.0});
    }
    return closed(polygon);
}

/// Convex hull of the points' projections on xy (Andrew's monotone chain), counter-clockwise.
std::vector<Vec3> hull_xy(std::vector<Vec3> points)
{
    std::sort(points.begin(), points.end(),
              [](const Vec3& a, const Vec3& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
    const auto turn = [](const Vec3& o, const Vec3& a, const Vec3& b) {
        return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
    };
    std::vector<Vec3> hull;
    for (int pass = 0; pass < 2; ++pass) {
        const std::size_t start = hull.size();
        for (const Vec3& p : points) {
            while (hull.size() >= start + 2 && turn(hull[hull.size() - 2], hull.back(), p) <= 0.0) hull.pop_back();
            hull.push_back(p);
        }
        if (!hull.empty()) hull.pop_back();
        std::reverse(points.begin(), points.end());
    }
    return hull;
}

std::vector<Vec3> placed(const std::vector<Vec3>& points, const Bodies& bodies, int i)
{
    std::vector<Vec3> result;
    for (const Vec3& p : points) result.push_back(bodies.position[i] + rotate(bodies.orientation[i], p));
    return result;
}

/// Where the plane at height z cuts a convex polyhedron: the hull of the cut edges' points; empty if it misses.
std::vector<Vec3> section(const std::vector<Vec3>& vertices, const std::vector<std::vector<int>>& faces, double z)
{
    std::vector<Vec3> points;
    for (const auto& loop : faces) {
        for (std::size_t k = 0; k < loop.size(); ++k) {
            const Vec3& p = vertices[static_cast<std::size_t>(loop[k])];
            const Vec3& q = vertices[static_cast<std::size_t>(loop[(k + 1) % loop.size()])];
            if ((p.z < z) != (q.z < z)) points.push_back(p + (z - p.z) / (q.z - p.z) * (q - p));
        }
    }
    return points.size() < 3 ? std::vector<Vec3>{} : hull_xy(points);
}

struct Picture {
    std::vector<Outline> grains, walls;
    Range x{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    Range y = x;  ///< of the grains [m]
};

Picture outlines(const Model& model, const State& state)
{
    const Bodies& bodies = state.bodies;
    Picture picture;
    Range depth = picture.x;
    std::vector<int> grains, spheres;
    for (int i = 0; i < bodies.size(); ++i) {
        if (is_sphere(model, bodies, i)) {
            spheres.push_back(i);
            const Vec3 x = bodies.position[i];
            const double r = model.shapes.radius[bodies.shape[i]];
            for (const double side : {-r, r}) {
                picture.x.add(x.x + side);
                picture.y.add(x.y + side);
                depth.add(x.z + side);
            }
            continue;
        }
        if (bodies.wall[i] >= 0) {
            picture.walls.push_back(
                closed(hull_xy(placed(shape_surface(model.shapes, bodies.shape[i]).points, bodies, i))));
            continue;
        }
        const Polyhedron& shape = model.grain_shapes[static_cast<std::size_t>(i)];
        if (shape.faces.empty()) continue;
        grains.push_back(i);
        for (const Vec3& p : placed(shape.vertices, bodies, i)) {
            picture.x.add(p.x);
            picture.y.add(p.y);
            depth.add(p.z);
        }
    }
    // Not the very middle, where two layers of grains may meet.
    const double z = depth.low + 0.47 * (depth.high - depth.low);
    for (const int i : grains) {
        const Polyhedron& shape = model.grain_shapes[static_cast<std::size_t>(i)];
        const std::vector<Vec3> cut = section(placed(shape.vertices, bodies, i), shape.faces, z);
        if (!cut.empty()) picture.grains.push_back(closed(cut));
    }
    for (const int i : spheres) {
        const double r = model.shapes.radius[bodies.shape[i]], h = z - bodies.position[i].z;
        if (std::fabs(h) < r) picture.grains.push_back(circle(bodies.position[i], std::sqrt(r * r - h * h)));
    }
    return picture;
}

/// The longest extent of a face seen along z; nothing for faces that lie in the plane.
std::optional<Outline> trace(const CrackFace& crack)
{
    if (std::fabs(crack.normal.z) > flat_face || crack.polygon.empty()) return std::nullopt;
    const Vec3 along = normalized(cross(Vec3{0, 0, 1}, crack.normal));
    const auto [first, last] =
        std::minmax_element(crack.polygon.begin(), crack.polygon.end(),
                            [&](const Vec3& a, const Vec3& b) { return dot(a, along) < dot(b, along); });
    return Outline{{first->x, last->x}, {first->y, last->y}};
}

/// Axes ranges of equal scale that hold the specimen, and the frame that shows them so.
void fit(const Picture& picture, Frame& frame, Range& x, Range& y)
{
    constexpr double page_aspect = 4.0 / 3.0, room = 0.08;
    x = picture.x.widened(room);
    y = picture.y.widened(room);
    const double width = (frame.right - frame.left) * page_aspect, height = frame.top - frame.bottom;
    const double scale = std::max((x.high - x.low) / width, (y.high - y.low) / height);  // [m] per page height
    const auto stretch = [](Range& range, double extent) {
        const double middle = 0.5 * (range.low + range.high);
        range = {middle - 0.5 * extent, middle + 0.5 * extent};
    };
    stretch(x, scale * width);
    stretch(y, scale * height);
}

Outline scaled(Outline outline, double factor)
{
    for (double& v : outline.x) v *= factor;
    for (double& v : outline.y) v *= factor;
    return outline;
}

}  // namespace

void plot_crack_map(const std::filesystem::path& stem, const Model& model, const State& state,
                    const std::vector<CrackFace>& cracks)
{
    const Picture picture = outlines(model, state);
    Frame frame{0.09, 0.75, 0.12, 0.88};
    Range x, y;
    fit(picture, frame, x, y);
    const double extent = std::max({std::fabs(x.low), std::fabs(x.high), std::fabs(y.low), std::fabs(y.high)});
    const Prefix prefix = prefix_for(extent);
    const auto draw = [&](const Outline& outline, Ink ink, double width) {
        const Outline s = scaled(outline, prefix.factor);
        draw_line(s.x, s.y, ink, width);
    };
    std::array<int, kind_inks.size()> count{};
    for (const CrackFace& crack : cracks) ++count.at(kind_of(crack));
    const Range shown_x{x.low * prefix.factor, x.high * prefix.factor},
        shown_y{y.low * prefix.factor, y.high * prefix.factor};
    const double crack_width = cracks.size() > 2000 ? 2.0 : 3.5;
    draw_figure(stem, [&] {
        draw_title("Crack map", "grains cut at mid depth, cracks of the whole depth");
        draw_plain_window(frame, shown_x, shown_y);
        for (const Outline& wall : picture.walls) {
            const Outline s = scaled(wall, prefix.factor);
            fill_polygon(s.x, s.y, Ink::pale_grey);
            draw(wall, Ink::grey, 1.5);
        }
        for (const Outline& grain : picture.grains) draw(grain, Ink::light_grey, 0.8);
        for (const CrackFace& crack : cracks) {
            const auto line = trace(crack);
            if (line) draw(*line, kind_inks.at(kind_of(crack)), crack_width);
        }
        // Last, over the walls that reach out of the picture.
        draw_axes(frame, shown_x, shown_y, "x [" + prefix.name + "m]", "y [" + prefix.name + "m]", {.grid = false});
        std::vector<LegendEntry> legend{{Ink::light_grey, 1.5, "grains"}, {Ink::pale_grey, 1.0, "walls", true}};
        const auto crack_entry = [&](std::size_t kind, const char* name) {
            legend.push_back({kind_inks.at(kind), 3.5, fmt::format("{} ({})", name, count.at(kind))});
        };
        crack_entry(0, "boundary: tension");
        crack_entry(1, "boundary: shear");
        crack_entry(2, "boundary: mixed");
        crack_entry(3, "through grains");
        draw_legend(frame.right + 0.02, frame.top - 0.02, legend);
    });
}

}  // namespace grainfrac
