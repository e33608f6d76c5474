// SPDX-License-Identifier: GPL-3.0-or-later
#include "experiment/uniaxial.h"

#include "experiment/specimen.h"
#include "experiment/walls.h"

#include <algorithm>

namespace grainfrac {

namespace {

/// Platens reach beyond the specimen by this share of its width on either side: it may bulge.
constexpr double platen_overhang = 0.25;
/// Thickness of platens over their larger width.
constexpr double platen_thickness = 0.2;
/// Grips take the grains whose centre is within this many mean spacings of the end: one row, or both of a staggered
/// pair.
constexpr double default_grip = 1.1;

void platens(int axis, Model& model, State& state, int (&walls)[2])
{
    const Extent x = specimen_extent(model, state);
    const int e = (axis + 1) % 3, f = (axis + 2) % 3;  // in the platen's plane
    const double width = x.size()[e] * (1.0 + 2.0 * platen_overhang),
                 depth = x.size()[f] * (1.0 + 2.0 * platen_overhang);
    for (const int sign : {1, -1}) {
        const int wall = add_wall(model, sign > 0 ? "platen_top" : "platen_bottom");
        walls[sign > 0 ? 0 : 1] = wall;
        const Vec3 up = static_cast<double>(sign) * axis_vector(axis);
        Vec3 face = x.center();
        face[axis] = (sign > 0 ? x.high : x.low)[axis];
        add_plate(model, state, wall, face, -up, axis_vector(e), width, depth,
                  platen_thickness * std::max(width, depth));
        if (!move_to_touch(model, state, wall, -up))
            throw InputError("test.direction", "no platen meets the specimen along this axis");
    }
}

void grips(const Case& c, int axis, Model& model, State& state, int (&walls)[2])
{
    const double length = c.test.grip_length.value_or(default_grip * model.nominal_length);
    if (2.0 * length >= specimen_extent(model, state).size()[axis])
        throw InputError("test.grip_length", "the two grips meet; must be less than half of the specimen's length");
    for (const int sign : {1, -1}) {
        const int wall = add_wall(model, sign > 0 ? "grip_top" : "grip_bottom");
        walls[sign > 0 ? 0 : 1] = wall;
        if (grip_end(model, state, wall, axis, sign, length) == 0)
            throw InputError("test.grip_length", "no grain has its centre within this length of the end; raise it");
    }
}

std::vector<NamedResult> results(const Experiment&, const std::vector<CurvePoint>& curve)
{
    return {{"modulus_Pa", secant_modulus(curve)}};
}

}  // namespace

Experiment set_up_uniaxial(const Case& c, Model& model, State& state)
{
    const int axis = axis_of(c.test.direction);
    const bool tension = c.test.kind == "uniaxial_tension", gripped = tension || c.test.ends == "gripped";
    Experiment e;
    e.kind = c.test.kind;
    e.results = results;
    e.specimen.stress_area = mean_section(model, state, axis);
    e.specimen.length = specimen_extent(model, state).size()[axis];
    int walls[2] = {0, 0};  // top, bottom; the input's own walls come first
    if (gripped) {
        grips(c, axis, model, state, walls);
        e.specimen.length = mean_position(state, walls[0], axis) - mean_position(state, walls[1], axis);
    } else {
        platens(axis, model, state, walls);
    }
    e.specimen.loaded_wall = walls[0];
    e.specimen.opposite_wall = walls[1];
    e.specimen.compression = !tension;
    e.specimen.load_direction = (tension ? 1.0 : -1.0) * axis_vector(axis);
    e.facts = {{"specimen_length_m", e.specimen.length}, {"section_m2", e.specimen.stress_area}};
    set_loading_stage(c, model, e.specimen.length, e);
    return e;
}

}  // namespace grainfrac
