// SPDX-License-Identifier: GPL-3.0-or-later
#include "experiment/brazilian.h"

#include "experiment/specimen.h"
#include "experiment/walls.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace grainfrac {

namespace {

/// Platens reach beyond the disc's faces by this share of its height on either side.
constexpr double platen_overhang = 0.1;
/// Half width of flat platens over the disc's diameter: a wider arc is no Brazilian test.
constexpr double default_half_width = 0.05;
/// Jaws of the suggested method (ISRM 1978): radius 1.5 times the disc's.
constexpr double jaw_radius_factor = 1.5;
/// Flat platens: thickness over width.
constexpr double platen_thickness = 0.5;

struct Jaw {
    Vec3 center, up, side;
    double depth = 0.0, half_width = 0.0;
};

void flat_platen(const Jaw& j, double radius, int wall, Model& model, State& state)
{
    add_plate(model, state, wall, j.center + 2.0 * radius * j.up, -j.up, j.side, 2.0 * j.half_width, j.depth,
              2.0 * platen_thickness * j.half_width);
}

/// Plates tangent to the jaw's circle, one for each facet of the disc that the contact covers, centred on the pole.
void curved_platen(const Jaw& j, double radius, double jaw_radius, double facet_angle, int wall, Model& model,
                   State& state)
{
    const double width = 2.0 * jaw_radius * std::tan(0.5 * facet_angle);
    const Vec3 jaw_center = j.center + (2.0 * radius - jaw_radius) * j.up;
    const int each_side = static_cast<int>(std::asin(std::min(1.0, j.half_width / jaw_radius)) / facet_angle);
    for (int k = -each_side; k <= each_side; ++k) {
        const double angle = k * facet_angle;
        const Vec3 out = std::cos(angle) * j.up + std::sin(angle) * j.side;
        const Vec3 along = std::cos(angle) * j.side - std::sin(angle) * j.up;
        add_plate(model, state, wall, jaw_center + jaw_radius * out, -out, along, width, j.depth, width);
    }
}

}  // namespace

Experiment set_up_brazilian(const Case& c, Model& model, State& state)
{
    const RegionSpec& region = c.parts.front().region;
    const double diameter = region.diameter, height = region.height;
    Jaw jaw;
    jaw.center = region.center;
    jaw.up = c.test.direction == "x" ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    jaw.side = c.test.direction == "x" ? Vec3{0, 1, 0} : Vec3{1, 0, 0};
    jaw.depth = height * (1.0 + 2.0 * platen_overhang);
    jaw.half_width = c.test.contact_half_width.value_or(default_half_width * diameter);

    Experiment e;
    e.kind = "brazilian";
    int walls[2] = {0, 0};  // top, bottom; the input's own walls come first
    for (const int sign : {1, -1}) {
        Jaw j = jaw;
        j.up = static_cast<double>(sign) * jaw.up;
        const int wall = add_wall(model, sign > 0 ? "platen_top" : "platen_bottom");
        walls[sign > 0 ? 0 : 1] = wall;
        if (c.test.platen == "curved") {
            const double jaw_radius =
                c.test.platen_radius > 0.0 ? c.test.platen_radius : jaw_radius_factor * 0.5 * diameter;
            curved_platen(j, 0.5 * diameter, jaw_radius, 2.0 * std::numbers::pi / region.facets, wall, model, state);
        } else {
            flat_platen(j, 0.5 * diameter, wall, model, state);
        }
        if (!move_to_touch(model, state, wall, -j.up)) {
            throw InputError("test.contact_half_width",
                             "the platen passes between the grains; widen it or refine the grains");
        }
    }

    e.specimen.length = diameter;
    e.specimen.stress_area = 0.5 * std::numbers::pi * diameter * height;
    e.specimen.load_direction = -jaw.up;
    e.specimen.loaded_wall = walls[0];
    e.specimen.opposite_wall = walls[1];

    set_loading_stage(c, model, diameter, e);
    return e;
}

}  // namespace grainfrac
