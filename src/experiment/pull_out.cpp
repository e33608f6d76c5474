// SPDX-License-Identifier: GPL-3.0-or-later
#include "experiment/pull_out.h"

#include "experiment/specimen.h"
#include "experiment/walls.h"
#include "fracture/softening.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

namespace grainfrac {

namespace {

/// A fibre is along an axis within this [-].
constexpr double along_axis = 1e-9;
/// Levels nearer than this share of a fibre's piece are one.
constexpr double same_level = 0.25;
/// Bodies of the matrix whose centres are within this share of their size of the lowest one are its far face.
constexpr double face_of_lattice = 0.25, face_of_others = 0.75;

int part_named(const Case& c, const std::string& name, const char* key)
{
    for (std::size_t i = 0; i < c.parts.size(); ++i) {
        if (c.parts[i].name == name) return static_cast<int>(i);
    }
    throw InputError(key, fmt::format("no such part \"{}\"", name));
}

void hold(State& state, int body, int wall, int axis)
{
    state.bodies.wall.at(body) = wall;
    state.bodies.held.at(body) = 1 << axis;
}

/// Coordinates along the pull of the bodies of a group: lowest and highest.
struct Range {
    double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
};
Range range_of(const State& state, int group, const Vec3& direction)
{
    Range r;
    for (int i = 0; i < state.bodies.size(); ++i) {
        if (state.bodies.group[i] != group) continue;
        const double x = dot(state.bodies.position[i], direction);
        r.low = std::min(r.low, x);
        r.high = std::max(r.high, x);
    }
    return r;
}

/// Least distance of two levels of a group along the pull.
double level_distance(const State& state, int group, const Vec3& direction)
{
    std::vector<double> levels;
    for (int i = 0; i < state.bodies.size(); ++i) {
        if (state.bodies.group[i] == group) levels.push_back(dot(state.bodies.position[i], direction));
    }
    std::sort(levels.begin(), levels.end());
    const double round_off = 1e-6 * (levels.back() - levels.front());
    double least = std::numeric_limits<double>::max();
    for (std::size_t i = 1; i < levels.size(); ++i) {
        if (levels[i] - levels[i - 1] > round_off) least = std::min(least, levels[i] - levels[i - 1]);
    }
    return least;
}

/// Of the last piece of the fibre, from the embedded end to the loaded one.
Vec3 direction_of(const PartSpec& part, const State& state, int group)
{
    if (part.generator == "taken") return axis_vector(axis_of(part.region.axis));
    int last = state.bodies.size() - 1;
    while (last > 0 && state.bodies.group[last] != group) --last;
    return normalized(state.bodies.position[last] - state.bodies.position[last - 1]);
}

/// Damage control does damage to the interface of the fibre alone: all else must hold, and the interface must not.
void check_only_the_interface_softens(const Case& c, const PullOut& p, const Model& model, const State& state)
{
    for (const int i : fibre_interfaces(p, state)) {
        if (model.interface_laws[state.interfaces.law[i]].failure != FailureUnit::point)
            throw InputError("test.control",
                             "\"damage\" needs an interface that yields: give yield_slip in its [[bonds]], or use "
                             "\"displacement\"");
    }
    for (std::size_t k = 0; k < c.bonds.size(); ++k) {
        const BondSpec& b = c.bonds[k];
        if (b.shear_stiffness > 0.0 || b.failure == "unbreakable") continue;
        throw InputError(fmt::format("bonds[{}].failure", k),
                         "must be \"unbreakable\" with test.control = \"damage\", in which only the interface of the "
                         "fibre breaks; or use \"displacement\" or \"speed\"");
    }
}

/// Results that the whole path tells.
std::vector<NamedResult> results(const Experiment& e, const std::vector<CurvePoint>&)
{
    const std::vector<PullOutState>& path = e.pull_out->path;
    if (path.empty()) return {};
    const auto largest = [&](double PullOutState::*what) {
        return std::max_element(path.begin(), path.end(),
                                [&](const PullOutState& x, const PullOutState& y) { return x.*what < y.*what; });
    };
    const auto peak = largest(&PullOutState::end_stress), slip = largest(&PullOutState::exit_slip),
               shift = largest(&PullOutState::end_displacement);
    double work = 0.0;
    for (std::size_t i = 1; i < path.size(); ++i) {
        work += 0.5 * (path[i].end_stress + path[i - 1].end_stress) *
                (path[i].end_displacement - path[i - 1].end_displacement);
    }
    std::vector<NamedResult> r = {{"peak_stress_Pa", peak->end_stress},
                                  {"exit_slip_at_peak_m", peak->exit_slip},
                                  {"end_displacement_at_peak_m", peak->end_displacement},
                                  {"largest_exit_slip_m", slip->exit_slip},
                                  {"stress_at_largest_slip_Pa", slip->end_stress},
                                  {"largest_end_displacement_m", shift->end_displacement},
                                  {"stress_at_largest_displacement_Pa", shift->end_stress},
                                  {"work_J_per_m2", work},
                                  {"last_mean_damage", path.back().mean_damage}};
    const auto yield =
        std::find_if(path.begin(), path.end(), [](const PullOutState& s) { return s.mean_damage > 0.0; });
    if (yield != path.begin() && yield != path.end()) {
        const PullOutState& y = *(yield - 1);
        r.push_back({"first_yield_stress_Pa", y.end_stress});
        r.push_back({"first_yield_exit_slip_m", y.exit_slip});
        r.push_back({"first_yield_embedded_slip_m", y.embedded_slip});
        r.push_back({"first_yield_end_displacement_m", y.end_displacement});
    }
    return r;
}

}  // namespace

std::vector<int> fibre_interfaces(const PullOut& p, const State& state)
{
    std::vector<int> found;
    for (int i = 0; i < state.interfaces.size(); ++i) {
        const bool a = state.bodies.group[state.interfaces.a[i]] == p.fibre_group,
                   b = state.bodies.group[state.interfaces.b[i]] == p.fibre_group;
        if (a != b) found.push_back(i);
    }
    return found;
}

FibreProfile fibre_profile(const PullOut& p, const State& state)
{
    struct Level {
        double area = 0.0, slip = 0.0, pull = 0.0, damage = 0.0, position = 0.0;
    };
    std::map<std::int64_t, Level> levels;
    const InterfaceBonds& f = state.interfaces;
    const Bodies& b = state.bodies;
    for (const int i : fibre_interfaces(p, state)) {
        const bool a_is_fibre = b.group[f.a[i]] == p.fibre_group;
        const int fibre = a_is_fibre ? f.a[i] : f.b[i];
        const double z = dot(b.start_position[fibre], p.direction) - p.embedded_end;
        Level& l = levels[std::llround(z / (same_level * p.piece))];
        const double sign = a_is_fibre ? -1.0 : 1.0, A = f.area[i];
        double slip = 0.0, weight = 0.0;
        for (int q = f.point_begin[i]; q < f.point_begin[i + 1]; ++q) {
            const Vec3 on_a = b.position[f.a[i]] + rotate(b.orientation[f.a[i]], state.points.position_a[q]),
                       on_b = b.position[f.b[i]] + rotate(b.orientation[f.b[i]], state.points.position_b[q]);
            slip += state.points.weight[q] * sign * dot(on_b - on_a, p.direction);
            weight += state.points.weight[q];
        }
        l.area += A;
        l.position += A * z;
        l.slip += A * slip / weight;
        l.pull -= sign * dot(state.slots.force[i], p.direction);
        l.damage += A * f.damage[i];
    }
    FibreProfile profile;
    double carried = 0.0;  // by the shear so far [N]
    for (const auto& [key, l] : levels) {
        profile.position.push_back(l.position / l.area);
        profile.slip.push_back(l.slip / l.area);
        profile.shear.push_back(l.pull / l.area);
        profile.damage.push_back(l.damage / l.area);
        profile.stress.push_back((carried + 0.5 * l.pull) / p.section);
        carried += l.pull;
    }
    return profile;
}

PullOutState pull_out_state(const PullOut& p, const State& state)
{
    PullOutState s;
    const Bodies& b = state.bodies;
    double pull = 0.0, grip = 0.0, support = 0.0;
    int grips = 0, supports = 0;
    for (int i = 0; i < b.size(); ++i) {
        const double shift = dot(b.position[i] - b.start_position[i], p.direction);
        if (b.wall[i] == p.grip_wall) {
            pull -= dot(b.force[i], p.direction);
            grip += shift;
            ++grips;
        } else if (b.wall[i] == p.support_wall) {
            support += shift;
            ++supports;
        }
    }
    s.end_stress = pull / p.section;
    // from the last sphere to where the fibre leaves the matrix it is stretched by what it is pulled with
    const double half = 0.5 * p.piece * s.end_stress / p.young_modulus;
    s.end_displacement = grip / std::max(grips, 1) - support / std::max(supports, 1) + half;
    const FibreProfile profile = fibre_profile(p, state);
    if (!profile.slip.empty()) {
        s.exit_slip = profile.slip.back() + half;
        s.embedded_slip = profile.slip.front();
    }
    s.mean_damage = mean_damage(state, fibre_interfaces(p, state));
    return s;
}

Experiment set_up_pull_out(const Case& c, Model& model, State& state)
{
    PullOut p;
    p.fibre_group = part_named(c, c.test.fibre, "test.fibre");
    p.matrix_group = part_named(c, c.test.matrix, "test.matrix");
    const PartSpec& part = c.parts[static_cast<std::size_t>(p.fibre_group)];
    const PartSpec& matrix = c.parts[static_cast<std::size_t>(p.matrix_group)];
    p.direction = direction_of(part, state, p.fibre_group);
    int axis = -1;
    for (int k = 0; k < 3; ++k) {
        if (std::fabs(std::fabs(p.direction[k]) - 1.0) < along_axis) axis = k;
    }
    if (axis < 0)
        throw InputError("test.fibre", "the loaded end of the fibre must point along an axis in a pull_out test");
    p.young_modulus =
        model.materials[static_cast<std::size_t>(model.groups[static_cast<std::size_t>(p.fibre_group)].material)]
            .young_modulus;

    p.grip_wall = add_wall(model, "grip");
    p.support_wall = add_wall(model, "support");
    const Range fibre = range_of(state, p.fibre_group, p.direction);
    const bool lattice = part.generator == "taken";
    if (lattice && part.region.shape != "cylinder" && part.region.shape != "disc")
        throw InputError(fmt::format("parts[{}].region.shape", p.fibre_group),
                         "must be \"cylinder\" for a fibre that is pulled out: it has the section of the circle");
    p.piece = level_distance(state, p.fibre_group, p.direction);
    p.embedded_end = fibre.low - 0.5 * p.piece;
    int ends = 0;
    for (int i = 0; i < state.bodies.size(); ++i) {
        if (state.bodies.group[i] != p.fibre_group) continue;
        if (dot(state.bodies.position[i], p.direction) < fibre.high - same_level * p.piece) continue;
        hold(state, i, p.grip_wall, axis);
        ++ends;
    }
    const double radius = lattice ? 0.5 * part.region.diameter : part.fibre.radius.value_or(0.5 * part.diameter);
    p.section = std::numbers::pi * radius * radius * (lattice ? 1 : ends);
    p.length = fibre.high - fibre.low + p.piece;

    const Range held = range_of(state, p.matrix_group, p.direction);
    const bool packed = matrix.kind == "spheres" && (matrix.generator == "hcp" || matrix.generator == "fcc");
    for (int i = 0; i < state.bodies.size(); ++i) {
        if (state.bodies.group[i] != p.matrix_group) continue;
        const double size = 2.0 * model.shapes.bounding_radius[state.bodies.shape[i]];
        if (dot(state.bodies.position[i], p.direction) - held.low > (packed ? face_of_lattice : face_of_others) * size)
            continue;
        if (c.test.support == "held")
            hold(state, i, p.support_wall, axis);
        else
            state.bodies.wall.at(i) = p.support_wall;
    }
    if (c.test.support == "uniform") {
        model.spread_supports = {p.support_wall};
        model.spread_direction = p.direction;
    }
    if (fibre_interfaces(p, state).empty())
        throw InputError("test.fibre",
                         fmt::format("no interface between \"{}\" and \"{}\"; required: [[bonds]] of law = "
                                     "\"interface\" between them",
                                     c.test.fibre, c.test.matrix));

    if (c.test.control == "damage") check_only_the_interface_softens(c, p, model, state);

    Experiment e;
    e.kind = c.test.kind;
    e.results = results;
    e.specimen.loaded_wall = p.grip_wall;
    e.specimen.load_direction = p.direction;
    e.specimen.length = p.length;
    e.specimen.stress_area = p.section;
    e.specimen.compression = false;
    e.facts = {{"embedded_length_m", p.length}, {"fibre_section_m2", p.section}};
    const Material& m =
        model.materials[static_cast<std::size_t>(model.groups[static_cast<std::size_t>(p.fibre_group)].material)];
    e.wave_speed = std::sqrt(m.young_modulus / m.density);

    Stage pull;
    pull.name = "pull";
    pull.local_damping = c.control.local_damping;
    pull.wall_velocity.resize(model.walls.size());
    for (std::size_t w = 0; w < c.walls.size(); ++w) pull.wall_velocity[w] = c.walls[w].velocity;
    if (c.test.control == "speed") {
        pull.wall_velocity[static_cast<std::size_t>(p.grip_wall)] = c.test.platen_speed * p.direction;
        pull.ramp = c.test.ramp.value_or(10.0 * p.length / e.wave_speed);
        pull.duration = c.test.stop.time;
        pull.load_drop = c.test.stop.load_drop;
        if (c.test.stop.strain) pull.displacement = *c.test.stop.strain * p.length;
        e.speed_of_each_wall = c.test.platen_speed;
        if (pull.displacement) e.expected_duration = *pull.displacement / c.test.platen_speed + 0.5 * pull.ramp;
        if (pull.duration) e.expected_duration = *pull.duration;
    } else {
        p.quasi_static = true;
        e.expected_duration = 1.5 / c.test.damage_step;  // time counts equilibria
        e.quasi_static = false;                          // inertia has no say at all
    }
    e.stages = {pull};
    e.pull_out = std::move(p);
    return e;
}

}  // namespace grainfrac
