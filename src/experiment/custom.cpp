// SPDX-License-Identifier: GPL-3.0-or-later
#include "experiment/custom.h"

#include "experiment/specimen.h"

#include <algorithm>
#include <cmath>

namespace grainfrac {

namespace {

/// Brake of a stage that settles, unless told.
constexpr double settling_damping = 0.7;
/// Speed of a servo where no strength sets one, over the wave speed: as for bonds that bear 1e-3 E.
constexpr double unbonded_servo_speed = 1e-5;

int wall_named(const Model& model, const std::string& name)
{
    return static_cast<int>(std::find(model.walls.begin(), model.walls.end(), name) - model.walls.begin());
}

Servo make_servo(const ServoSpec& s, const WallSpec& wall, double fastest)
{
    if (!s.given()) return {};
    const Vec3 direction = norm2(s.direction) > 0.0 ? s.direction : wall.normal;
    return {normalized(direction), s.force, s.stress.value_or(0.0), s.area, s.max_speed.value_or(fastest)};
}

/// The first wall that moves in a stage is what it loads with. `back`: the push is against the motion.
void set_load(Stage& s, int wall, bool back)
{
    const auto w = static_cast<std::size_t>(wall);
    const bool servo = norm2(s.servos[w].direction) > 0.0;
    if (s.loaded_wall >= 0 || (!servo && norm2(s.wall_velocity[w]) == 0.0)) return;
    s.loaded_wall = wall;
    s.load_direction = servo ? s.servos[w].direction : (back ? -1.0 : 1.0) * normalized(s.wall_velocity[w]);
}

/// Walls, then grips, in the order of Model::walls; a grip is a wall without a shape of its own.
std::vector<WallSpec> walls_and_grips(const Case& c)
{
    std::vector<WallSpec> all = c.walls;
    for (const GripSpec& g : c.grips) {
        WallSpec w;
        w.name = g.name;
        w.velocity = g.velocity;
        w.ramp = g.ramp;
        all.push_back(w);
    }
    return all;
}

Stage make_stage(const Case& c, const StageSpec& s, const std::vector<Stage>& before, Model& model)
{
    const std::vector<WallSpec> walls = walls_and_grips(c);
    Stage stage;
    stage.name = s.name;
    stage.wall_velocity.resize(walls.size());
    if (s.kind == "bond") {
        stage.bonds = BondsToMake{BondTable(c, model, s.name), s.bond_distance, s.bond_angle};
        return stage;
    }
    const Material& m = loaded_material(model);
    const double slow = quasi_static_speed(c, model),
                 fastest = slow > 0.0 ? slow : unbonded_servo_speed * std::sqrt(m.young_modulus / m.density);
    stage.servos.resize(walls.size());
    for (std::size_t w = 0; w < walls.size(); ++w) {
        stage.wall_velocity[w] = walls[w].velocity;
        stage.servos[w] = make_servo(walls[w].servo, walls[w], fastest);
        stage.ramp = std::max(stage.ramp, walls[w].ramp);
    }
    for (const std::string& grip : s.release) stage.released.push_back(wall_named(model, grip));
    stage.unloads = s.kind == "unload";
    for (const StageMotion& move : s.motions) {
        const int wall = wall_named(model, move.wall);
        const auto w = static_cast<std::size_t>(wall);
        stage.wall_velocity[w] = move.velocity;
        stage.servos[w] = make_servo(move.servo, walls[w], fastest);
        set_load(stage, wall, stage.unloads);
    }
    if (stage.unloads && s.motions.empty()) {
        const auto last =
            std::find_if(before.rbegin(), before.rend(), [](const Stage& b) { return b.loaded_wall >= 0; });
        for (std::size_t w = 0; w < walls.size(); ++w) stage.wall_velocity[w] = -last->wall_velocity[w];
        stage.loaded_wall = last->loaded_wall;
        stage.load_direction = last->load_direction;
    }
    for (std::size_t w = 0; w < walls.size(); ++w) set_load(stage, static_cast<int>(w), stage.unloads);
    if (s.ramp > 0.0) stage.ramp = s.ramp;
    stage.gravity = s.gravity.value_or(c.control.gravity);
    stage.local_damping = s.local_damping.value_or(s.kind == "settle" ? settling_damping : c.control.local_damping);
    stage.fracture = s.fracture;
    stage.cleavage = s.cleavage;
    stage.duration = s.duration;
    stage.load_drop = s.load_drop;
    if (stage.unloads && !s.load_drop) stage.load_drop = 1.0;
    stage.load = s.load;
    stage.stress = s.stress;
    stage.displacement = s.max_displacement;
    stage.unbalanced_force_ratio = s.unbalanced_force_ratio;
    stage.rest = s.rest;
    return stage;
}

/// The stage whose load is that of the test: the first of kind "load" that moves a wall, else the first of any kind.
int loading_stage(const Case& c, const std::vector<Stage>& stages)
{
    int first = -1;
    for (std::size_t i = 0; i < stages.size(); ++i) {
        if (stages[i].loaded_wall < 0) continue;
        if (c.stages[i].kind == "load") return static_cast<int>(i);
        if (first < 0) first = static_cast<int>(i);
    }
    return first;
}

/// Another wall that the stage moves against the loaded one, -1 if there is none.
int opposite_wall(const Stage& s)
{
    for (std::size_t w = 0; w < s.wall_velocity.size(); ++w) {
        const Vec3 v = s.wall_velocity[w];
        if (static_cast<int>(w) != s.loaded_wall && norm2(v) > 0.0 &&
            dot(v, s.load_direction) < -(1.0 - 1e-9) * norm(v))
            return static_cast<int>(w);
    }
    return -1;
}

}  // namespace

Experiment set_up_custom(const Case& c, Model& model, State& state)
{
    if (c.stages.empty())
        throw InputError("stages",
                         "missing; a run needs [test] or [[stages]]; this input is for `grainfrac calibrate`");
    Experiment e;
    e.kind = "custom";
    const Material& m = loaded_material(model);
    e.wave_speed = std::sqrt(m.young_modulus / m.density);
    double longest = 0.0;
    for (const StageSpec& s : c.stages) {
        e.stages.push_back(make_stage(c, s, e.stages, model));
        longest += s.duration.value_or(0.0);
    }
    e.reference_stage = loading_stage(c, e.stages);
    if (e.reference_stage >= 0) {
        const Stage& load = e.stages[static_cast<std::size_t>(e.reference_stage)];
        e.specimen.loaded_wall = load.loaded_wall;
        e.specimen.opposite_wall = opposite_wall(load);
        e.specimen.load_direction = load.load_direction;
        take_reference(e, model, state);
    }
    Stage& last = e.stages.back();  // what stops the test stops its last stage
    if (!last.load_drop) last.load_drop = c.test.stop.load_drop;
    if (!last.displacement && c.test.stop.strain && e.specimen.length > 0.0)
        last.displacement = *c.test.stop.strain * e.specimen.length;
    e.expected_duration = longest;
    if (c.test.stop.time)
        e.expected_duration = longest > 0.0 ? std::min(longest, *c.test.stop.time) : *c.test.stop.time;
    return e;
}

}  // namespace grainfrac
