// SPDX-License-Identifier: GPL-3.0-or-later
#include "experiment/bending.h"

#include "experiment/specimen.h"
#include "experiment/walls.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace grainfrac {

namespace {

/// Radius of rollers over the height of the beam.
constexpr double default_roller = 0.5;
/// Rollers reach beyond the beam by this share of its thickness on either side.
constexpr double roller_overhang = 0.1;
/// S/W at which the factor of the three-point test is tabulated.
constexpr double tabulated_span = 4.0;

struct Beam {
    int along = 0, up = 1, across = 2;  ///< axes: length, load, rollers
    Extent box;
    double height = 0.0, thickness = 0.0;  ///< [m]
};

Beam measure_beam(const Case& c, const Model& model, const State& state)
{
    Beam b;
    b.up = axis_of(c.test.direction);
    b.along = b.up == 0 ? 1 : 0;
    b.across = 3 - b.up - b.along;
    b.box = specimen_extent(model, state);
    b.thickness = b.box.size()[b.across];
    b.height = mean_section(model, state, b.along) / b.thickness;
    return b;
}

/// Rollers of one wall at `places` along the beam, above (side 1) or below it (-1), each moved to touch by itself.
int add_rollers(const std::string& name, const char* key, const Beam& beam, int side, const std::vector<double>& places,
                double radius, Model& model, State& state)
{
    const int wall = add_wall(model, name);
    const Vec3 out = static_cast<double>(side) * axis_vector(beam.up);
    const double reach = beam.thickness * (1.0 + 2.0 * roller_overhang);
    for (const double place : places) {
        Vec3 center = beam.box.center();
        center[beam.along] += place;
        center[beam.up] = (side > 0 ? beam.box.high : beam.box.low)[beam.up] + side * 2.0 * radius;
        const int body = add_cylinder(model, state, wall, axis_vector(beam.across), reach, center, radius);
        if (!move_to_touch(model, state, std::vector<int>{body}, -out))
            throw InputError(key, "a roller passes beside the specimen or between its grains");
    }
    return wall;
}

std::vector<NamedResult> results(const Experiment&, const std::vector<CurvePoint>& curve)
{
    return {{"flexural_modulus_Pa", secant_modulus(curve)}};
}

/// K at the peak load, the fracture toughness if the notch then began to grow.
std::vector<NamedResult> notch_results(const Experiment& e, const std::vector<CurvePoint>& curve)
{
    double peak = 0.0;
    for (const CurvePoint& p : curve) peak = std::max(peak, p.stress);
    const double a = fact(e, "notch_depth_m"), factor = fact(e, "notch_factor");
    return {{"fracture_toughness_Pa_sqrt_m", peak * std::sqrt(std::numbers::pi * a) * factor}};
}

}  // namespace

double notch_factor(double alpha, double span_ratio)
{
    const double pure = 1.122 + alpha * (-1.40 + alpha * (7.33 + alpha * (-13.08 + alpha * 14.0)));
    if (span_ratio <= 0.0) return pure;
    const double one_roller = (1.99 - alpha * (1.0 - alpha) * (2.15 + alpha * (-3.93 + 2.7 * alpha))) /
                              (std::sqrt(std::numbers::pi) * (1.0 + 2.0 * alpha) * std::pow(1.0 - alpha, 1.5));
    return pure + std::min(1.0, tabulated_span / span_ratio) * (one_roller - pure);
}

Experiment set_up_bending(const Case& c, Model& model, State& state)
{
    const TestSpec& test = c.test;
    const Beam beam = measure_beam(c, model, state);
    const double span = test.outer_span, inner = test.kind == "three_point_bending" ? 0.0 : test.inner_span;
    const double length = beam.box.size()[beam.along],
                 radius = test.roller_radius.value_or(default_roller * beam.height);
    const double arm = 0.5 * (span - inner);
    if (span > length)
        throw InputError("test.outer_span", fmt::format("must be <= {:.6g} m, the length of the specimen: the supports "
                                                        "would stand beside it",
                                                        length));
    if (2.0 * radius >= std::min(span, inner > 0.0 ? inner : span)) {
        throw InputError("test.roller_radius",
                         fmt::format("must be < {:.6g} m, half of the smaller span, or two rollers "
                                     "overlap",
                                     0.5 * std::min(span, inner > 0.0 ? inner : span)));
    }

    Experiment e;
    e.kind = test.kind;
    e.results = results;
    const std::vector<double> loading = inner > 0.0 ? std::vector<double>{-0.5 * inner, 0.5 * inner} : std::vector{0.0};
    e.specimen.loaded_wall = add_rollers("roller_top", "test.inner_span", beam, 1, loading, radius, model, state);
    e.specimen.opposite_wall =
        add_rollers("roller_bottom", "test.outer_span", beam, -1, {-0.5 * span, 0.5 * span}, radius, model, state);
    e.specimen.load_direction = -axis_vector(beam.up);
    e.specimen.stress_area = beam.thickness * beam.height * beam.height / (3.0 * arm);
    e.specimen.length = arm * (3.0 * span - 4.0 * arm) / (3.0 * beam.height);
    e.facts = {{"beam_height_m", beam.height}, {"beam_thickness_m", beam.thickness}, {"outer_span_m", span}};
    if (inner > 0.0) e.facts.push_back({"inner_span_m", inner});
    e.facts.push_back({"roller_radius_m", radius});
    if (test.kind == "notched_beam") {
        if (test.notch_depth >= beam.height)
            throw InputError("test.notch_depth",
                             fmt::format("must be < {:.6g} m, the height of the beam", beam.height));
        e.facts.push_back({"notch_depth_m", test.notch_depth});
        e.facts.push_back(
            {"notch_factor", notch_factor(test.notch_depth / beam.height, inner > 0.0 ? 0.0 : span / beam.height)});
        e.results = notch_results;
    }
    // the slowest bending wave: half a wave over the span L takes about 2 L^2/(w c_0)
    set_loading_stage(c, model, span * std::max(1.0, span / beam.height), e);
    return e;
}

}  // namespace grainfrac
