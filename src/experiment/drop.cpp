// SPDX-License-Identifier: GPL-3.0-or-later
#include "experiment/drop.h"

#include "experiment/specimen.h"
#include "experiment/walls.h"
#include "motion/energy.h"

#include <algorithm>
#include <cmath>

namespace grainfrac {

namespace {

constexpr double standard_gravity = 9.81;  // [m/s^2]
/// Without side walls the floor reaches this many specimen heights and falls beyond the specimen on either side.
constexpr double floor_overhang = 4.0;
/// Height of side walls above the specimen's top, over its height.
constexpr double side_overhang = 1.0;
/// Thickness of floor and walls over the specimen's height: nothing may pass through them between two steps.
constexpr double wall_thickness = 0.5;
/// Rest has to last for this share of the time of fall: a heap at the top of a bounce hardly moves either.
constexpr double rest_falls = 0.25;
/// Guess of a run's length over the time of fall.
constexpr double expected_falls = 4.0;

void add_sides(double gap, double floor, int vertical, double up, const Extent& x, Model& model, State& state)
{
    const int wall = add_wall(model, "sides");
    const double height = x.size()[vertical], top = (up > 0 ? x.high : x.low)[vertical] + up * side_overhang * height,
                 tall = std::fabs(top - floor), thickness = wall_thickness * height;
    for (const int e : {(vertical + 1) % 3, (vertical + 2) % 3}) {
        const int f = 3 - vertical - e;
        for (const int side : {1, -1}) {
            Vec3 face = x.center();
            face[e] = (side > 0 ? x.high : x.low)[e] + side * gap;
            face[vertical] = 0.5 * (floor + top);
            // corners: each plate reaches past its neighbours
            const double width = x.size()[f] + 2.0 * (gap + thickness);
            add_plate(model, state, wall, face, -static_cast<double>(side) * axis_vector(e), axis_vector(f), width,
                      tall, thickness);
        }
    }
}

double first_contact(const std::vector<CurvePoint>& curve)
{
    const auto hit = std::find_if(curve.begin(), curve.end(), [](const CurvePoint& p) { return p.load > 0.0; });
    return hit == curve.end() ? -1.0 : hit->time;
}

/// First row of the history that bears load; as fine as output.history.
std::vector<NamedResult> results(const Experiment&, const std::vector<CurvePoint>& curve)
{
    return {{"first_contact_s", first_contact(curve)}};
}

}  // namespace

Experiment set_up_drop(const Case& c, Model& model, State& state)
{
    if (norm(model.gravity) == 0.0) model.gravity = {0.0, 0.0, -standard_gravity};
    const double g = norm(model.gravity), h = c.test.drop_height;
    const int vertical = model.gravity.x != 0.0 ? 0 : (model.gravity.y != 0.0 ? 1 : 2);
    const double up = model.gravity[vertical] < 0.0 ? 1.0 : -1.0;
    const Vec3 upwards = up * axis_vector(vertical);
    const Extent x = specimen_extent(model, state);
    const double height = x.size()[vertical], lowest = (up > 0 ? x.low : x.high)[vertical];
    const double weight = total_momentum(model, state).mass * g;

    Experiment e;
    e.kind = c.test.kind;
    e.quasi_static = false;
    model.resolve_impacts = true;
    e.results = results;
    const Material& m = loaded_material(model);
    e.wave_speed = std::sqrt(m.young_modulus / m.density);

    // the floor first touches the rounded grains, then sinks by the height of the fall
    const int floor = add_wall(model, "floor");
    const int a = (vertical + 1) % 3, b = (vertical + 2) % 3;
    const double reach = c.test.side_gap ? 2.0 * (*c.test.side_gap + height) : 2.0 * floor_overhang * (height + h);
    Vec3 face = x.center();
    face[vertical] = lowest - up * wall_thickness * height;
    const int plate = state.bodies.size();
    add_plate(model, state, floor, face, upwards, axis_vector(a), x.size()[a] + reach, x.size()[b] + reach,
              wall_thickness * std::max(height, h));
    if (!move_to_touch(model, state, floor, upwards))
        throw InputError("test.drop_height", "no grain lies above the floor");
    for (auto* positions : {&state.bodies.position, &state.bodies.start_position})
        positions->host()[static_cast<std::size_t>(plate)] -= h * upwards;
    if (c.test.side_gap) add_sides(*c.test.side_gap, lowest - up * h, vertical, up, x, model, state);

    e.specimen.loaded_wall = floor;
    e.specimen.load_direction = upwards;
    const double fall = std::sqrt(2.0 * h / g);
    e.facts = {{"drop_height_m", h}, {"fall_time_s", fall}, {"impact_speed_m_per_s", g * fall}, {"weight_N", weight}};

    Stage stage;
    stage.name = "fall";
    stage.wall_velocity.resize(model.walls.size());
    for (std::size_t w = 0; w < c.walls.size(); ++w) stage.wall_velocity[w] = c.walls[w].velocity;
    stage.local_damping = c.control.local_damping;
    stage.duration = c.test.stop.time;
    if (c.test.stop.rest) stage.rest_energy = *c.test.stop.rest * weight * (h > 0.0 ? h : height);
    stage.weight = weight;
    stage.rest_time = rest_falls * (fall > 0.0 ? fall : std::sqrt(2.0 * height / g));
    e.stages = {stage};
    e.expected_duration = stage.duration.value_or(expected_falls * (fall > 0.0 ? fall : std::sqrt(2.0 * height / g)));
    return e;
}

}  // namespace grainfrac
