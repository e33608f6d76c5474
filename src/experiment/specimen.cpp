// SPDX-License-Identifier: GPL-3.0-or-later
#include "experiment/specimen.h"

#include "experiment/derived.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace grainfrac {

namespace {

/// Shares of the peak between which the modulus is taken: past the first touch of ragged ends, before damage.
constexpr double modulus_from = 0.1, modulus_to = 0.4;
/// The ramp lasts this many passages of a wave through the specimen.
constexpr double ramp_passages = 10.0;
/// Nominal strain at failure over sigma_t/E, for the guess of a run's length: compliance of contacts included.
constexpr double expected_strains = 8.0;

/// Of a grain its corners; of a sphere those of the box around it; of a wall none.
std::vector<Vec3> placed_vertices(const Model& model, const Bodies& b, int i)
{
    if (is_sphere(model, b, i)) {
        const double r = model.shapes.radius[b.shape[i]];
        return {b.position[i] - Vec3{r, r, r}, b.position[i] + Vec3{r, r, r}};
    }
    std::vector<Vec3> v = model.grain_shapes[static_cast<std::size_t>(i)].vertices;
    for (Vec3& x : v) x = b.position[i] + rotate(b.orientation[i], x);
    return v;
}

}  // namespace

int axis_of(const std::string& name)
{
    return name == "x" ? 0 : (name == "y" ? 1 : 2);
}

Vec3 axis_vector(int axis)
{
    Vec3 e;
    e[axis] = 1.0;
    return e;
}

Extent specimen_extent(const Model& model, const State& state)
{
    Extent e;
    for (int i = 0; i < state.bodies.size(); ++i) {
        for (const Vec3& x : placed_vertices(model, state.bodies, i)) {
            for (int k = 0; k < 3; ++k) {
                e.low[k] = std::min(e.low[k], x[k]);
                e.high[k] = std::max(e.high[k], x[k]);
            }
        }
    }
    return e;
}

double length_along(const Vec3& size, const Vec3& d)
{
    return std::fabs(d.x) * size.x + std::fabs(d.y) * size.y + std::fabs(d.z) * size.z;
}

double section_across(const Vec3& size, const Vec3& d)
{
    return std::fabs(d.x) * size.y * size.z + std::fabs(d.y) * size.z * size.x + std::fabs(d.z) * size.x * size.y;
}

const Material& loaded_material(const Model& model)
{
    const Material* least = nullptr;
    for (const Group& g : model.groups) {
        if (g.material < 0) continue;  // a wall
        const Material& m = model.materials[static_cast<std::size_t>(g.material)];
        if (least == nullptr || m.density * m.young_modulus < least->density * least->young_modulus) least = &m;
    }
    return *least;
}

double quasi_static_speed(const Case& c, const Model& model)
{
    const Material& m = loaded_material(model);
    return 0.01 * weakest_strength(c) / std::sqrt(m.density * m.young_modulus);
}

double mean_section(const Model& model, const State& state, int axis)
{
    const Extent x = specimen_extent(model, state);
    const double length = x.size()[axis];
    const Bodies& b = state.bodies;
    double sum = 0.0;
    for (int i = 0; i < b.size(); ++i) {
        const std::int32_t m = model.groups[static_cast<std::size_t>(b.group[i])].material;
        if (m < 0) continue;  // a wall
        const double volume = b.mass[i] / model.materials[static_cast<std::size_t>(m)].density;
        const double s = std::sin(std::numbers::pi * (b.position[i][axis] - x.low[axis]) / length);
        sum += volume * s * s;
    }
    return sum / (0.5 * length);
}

int grip_end(const Model& model, State& state, int wall, int axis, int sign, double length)
{
    const Extent x = specimen_extent(model, state);
    Bodies& b = state.bodies;
    int gripped = 0;
    for (int i = 0; i < b.size(); ++i) {
        if (b.inverse_mass[i] == 0.0) continue;
        const double depth = sign > 0 ? x.high[axis] - b.position[i][axis] : b.position[i][axis] - x.low[axis];
        if (depth > length) continue;
        const auto k = static_cast<std::size_t>(i);
        b.inverse_mass.host()[k] = 0.0;
        b.inverse_inertia.host()[k] = {};
        b.velocity.host()[k] = b.angular_momentum.host()[k] = b.angular_velocity.host()[k] = {};
        b.wall.host()[k] = wall;
        ++gripped;
    }
    return gripped;
}

int pin_grain(Model& model, State& state, int wall, const Vec3& place, const HalfSpace& half)
{
    Bodies& b = state.bodies;
    int pin = -1;
    for (int i = 0; i < b.size(); ++i) {
        if (b.inverse_mass[i] == 0.0 || half.side * (b.position[i][half.axis] - half.place) < 0.0) continue;
        if (pin < 0 || norm(b.position[i] - place) < norm(b.position[pin] - place)) pin = i;
    }
    if (pin < 0) return pin;
    const auto k = static_cast<std::size_t>(pin);
    b.inverse_mass.host()[k] = 0.0;
    b.velocity.host()[k] = {};
    b.wall.host()[k] = wall;
    InterfaceBonds& f = state.interfaces;
    std::map<std::int32_t, std::int32_t> holding;  // law -> the same without failure
    for (int i = 0; i < f.size(); ++i) {
        if (f.a[i] != pin && f.b[i] != pin) continue;
        const auto [entry, is_new] = holding.try_emplace(f.law[i], model.interface_laws.size());
        if (is_new) {
            InterfaceLaw law = model.interface_laws[f.law[i]];
            law.failure = FailureUnit::unbreakable;
            model.interface_laws.host().push_back(law);
        }
        f.law.host()[static_cast<std::size_t>(i)] = entry->second;
    }
    return pin;
}

double mean_position(const State& state, int wall, int axis)
{
    double sum = 0.0;
    int n = 0;
    for (int i = 0; i < state.bodies.size(); ++i) {
        if (state.bodies.wall[i] != wall) continue;
        sum += state.bodies.position[i][axis];
        ++n;
    }
    return sum / n;
}

void set_loading_stage(const Case& c, const Model& model, double ramp_length, Experiment& e)
{
    const Material& m = loaded_material(model);
    e.wave_speed = std::sqrt(m.young_modulus / m.density);
    e.speed_of_each_wall = 0.5 * c.test.platen_speed;
    const Specimen& s = e.specimen;

    Stage load;
    load.name = "load";
    load.wall_velocity.resize(model.walls.size());
    for (std::size_t w = 0; w < c.walls.size(); ++w) load.wall_velocity[w] = c.walls[w].velocity;
    load.wall_velocity[static_cast<std::size_t>(s.loaded_wall)] = e.speed_of_each_wall * s.load_direction;
    load.wall_velocity[static_cast<std::size_t>(s.opposite_wall)] = -e.speed_of_each_wall * s.load_direction;
    load.ramp = c.test.ramp.value_or(ramp_passages * ramp_length / e.wave_speed);
    load.local_damping = c.control.local_damping;
    load.duration = c.test.stop.time;
    load.load_drop = c.test.stop.load_drop;
    if (c.test.stop.strain) load.displacement = *c.test.stop.strain * s.length;
    e.stages = {load};

    double strength = 0.0;
    for (const BondSpec& b : c.bonds) strength = std::max(strength, b.tensile_strength);
    const auto expect = [&](double duration) {
        e.expected_duration = e.expected_duration > 0.0 ? std::min(e.expected_duration, duration) : duration;
    };
    if (strength > 0.0)
        expect(expected_strains * strength / m.young_modulus * s.length / c.test.platen_speed + 0.5 * load.ramp);
    if (load.displacement) expect(*load.displacement / c.test.platen_speed + 0.5 * load.ramp);
    if (load.duration) expect(*load.duration);
}

double fact(const Experiment& e, const std::string& name)
{
    return std::find_if(e.facts.begin(), e.facts.end(), [&](const NamedResult& f) { return f.name == name; })->value;
}

double secant_modulus(const std::vector<CurvePoint>& curve)
{
    const auto peak = std::max_element(curve.begin(), curve.end(),
                                       [](const CurvePoint& a, const CurvePoint& b) { return a.stress < b.stress; });
    if (peak == curve.end() || peak->stress <= 0.0) return 0.0;
    const auto first_above = [&](double share) {
        return std::find_if(curve.begin(), peak, [&](const CurvePoint& p) { return p.stress >= share * peak->stress; });
    };
    const auto low = first_above(modulus_from), high = first_above(modulus_to);
    return high->strain > low->strain ? (high->stress - low->stress) / (high->strain - low->strain) : 0.0;
}

}  // namespace grainfrac
