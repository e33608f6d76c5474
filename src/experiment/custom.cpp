// SPDX-License-Identifier: GPL-3.0-or-later
#include "experiment/custom.h"

#include "experiment/specimen.h"

#include <algorithm>
#include <cmath>

namespace grainfrac {

namespace {

int wall_named(const Model& model, const std::string& name)
{
    return static_cast<int>(std::find(model.walls.begin(), model.walls.end(), name) - model.walls.begin());
}

Stage make_stage(const Case& c, const StageSpec& s, const Model& model)
{
    Stage stage;
    stage.name = s.name;
    for (const WallSpec& w : c.walls) {
        stage.wall_velocity.push_back(w.velocity);
        stage.ramp = std::max(stage.ramp, w.ramp);
    }
    for (const StageMotion& m : s.motions)
        stage.wall_velocity[static_cast<std::size_t>(wall_named(model, m.wall))] = m.velocity;
    if (s.ramp > 0.0) stage.ramp = s.ramp;
    stage.local_damping = s.local_damping.value_or(c.control.local_damping);
    stage.fracture = s.fracture;
    stage.duration = s.duration;
    stage.load_drop = s.load_drop;
    stage.displacement = s.max_displacement;
    stage.unbalanced_force_ratio = s.unbalanced_force_ratio;
    return stage;
}

}  // namespace

Experiment set_up_custom(const Case& c, Model& model, State& state)
{
    Experiment e;
    e.kind = "custom";
    const Material& m = model.materials[static_cast<std::size_t>(model.groups.front().material)];
    e.wave_speed = std::sqrt(m.young_modulus / m.density);
    for (const StageSpec& s : c.stages) e.stages.push_back(make_stage(c, s, model));
    double longest = 0.0;
    for (const Stage& s : e.stages) {
        longest += s.duration.value_or(0.0);
        for (std::size_t w = 0; w < s.wall_velocity.size() && e.specimen.loaded_wall < 0; ++w) {
            if (norm(s.wall_velocity[w]) == 0.0) continue;
            const Vec3 d = normalized(s.wall_velocity[w]), size = specimen_extent(model, state).size();
            e.specimen.loaded_wall = static_cast<std::int32_t>(w);
            e.specimen.load_direction = d;
            e.specimen.length = std::fabs(d.x) * size.x + std::fabs(d.y) * size.y + std::fabs(d.z) * size.z;
            e.specimen.stress_area =
                std::fabs(d.x) * size.y * size.z + std::fabs(d.y) * size.z * size.x + std::fabs(d.z) * size.x * size.y;
        }
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
