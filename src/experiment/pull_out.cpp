// SPDX-License-Identifier: GPL-3.0-or-later
#include "experiment/pull_out.h"

#include "experiment/fibre_interface.h"
#include "experiment/specimen.h"
#include "experiment/walls.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace grainfrac {

namespace {

/// A fibre is along an axis within this [-].
constexpr double along_axis = 1e-9;
/// Bodies of the matrix whose centres are within this share of their size of the lowest one are its far face.
constexpr double face_of_lattice = 0.25, face_of_others = 0.75;
/// Ends of a fibre of taken spheres without layers: this share of their size.
constexpr double end_of_others = 0.75;

int part_named(const Case& c, const std::string& name, const char* key)
{
    for (std::size_t i = 0; i < c.parts.size(); ++i) {
        if (c.parts[i].name == name) return static_cast<int>(i);
    }
    throw InputError(key, fmt::format("no such part \"{}\"", name));
}

const Material& material_of(const Model& model, int group)
{
    return model.materials[static_cast<std::size_t>(model.groups[static_cast<std::size_t>(group)].material)];
}

int axis_along(const Vec3& direction)
{
    for (int k = 0; k < 3; ++k) {
        if (std::fabs(std::fabs(direction[k]) - 1.0) < along_axis) return k;
    }
    throw InputError("test.fibre",
                     "must run along an axis in a pull_out test: from `from` to `to`, or its last piece from point to "
                     "point");
}

void hold(State& state, int body, int wall, int axis)
{
    state.bodies.wall.at(body) = wall;
    state.bodies.held.at(body) = 1 << axis;
}

/// The pull goes along the line of the fibre, whatever way its last piece has. Nodes with patches, what of their fibre
/// lies in the matrix, and the grip at the last node of each chain.
void place_chains(const FibreSpec& line, const std::vector<FibreChain>& chains, State& state, PullOut& p)
{
    const auto at = [&](int body) { return state.bodies.start_position[body]; };
    std::vector<double> area(static_cast<std::size_t>(state.bodies.size()), 0.0);
    const InterfaceBonds& f = state.interfaces;
    for (const int i : fibre_interfaces(p, state)) area[static_cast<std::size_t>(fibre_side(p, state, i))] += f.area[i];
    const std::vector<int>& first = chains.front().nodes;
    p.direction = line.shape == "points" ? normalized(at(first.back()) - at(first[first.size() - 2]))
                                         : normalized(line.to - line.from);
    const int axis = axis_along(p.direction);
    const double radius = chains.front().radius;
    p.piece = chains.front().way[1] - chains.front().way[0];
    p.fibres = static_cast<int>(chains.size());
    for (const FibreChain& c : chains) {
        std::vector<std::size_t> tied;
        double length = 0.0;
        for (std::size_t k = 0; k < c.nodes.size(); ++k) {
            const int before = c.nodes[k > 0 ? k - 1 : 0], after = c.nodes[std::min(k + 1, c.nodes.size() - 1)];
            p.along[static_cast<std::size_t>(c.nodes[k])] = normalized(at(after) - at(before));
            const double patches = area[static_cast<std::size_t>(c.nodes[k])];
            if (patches == 0.0) continue;
            tied.push_back(k);
            length += patches / (2.0 * std::numbers::pi * radius);
        }
        hold(state, c.nodes.back(), p.grip_wall, axis);
        p.beyond_grip += (c.whole - c.way.back()) / p.fibres;
        if (tied.empty()) throw InputError("test.fibre", "one of the fibres has no interface with the matrix");
        p.length += length / p.fibres;
        const auto covered = [&](std::size_t k) {
            return area[static_cast<std::size_t>(c.nodes[k])] / (2.0 * std::numbers::pi * radius);
        };
        // the first patch covers what is left of it beyond half of the way to the second
        const auto beyond = [&](std::size_t end, std::size_t next) {
            const double gap = tied.size() > 1 ? std::fabs(c.way[next] - c.way[end]) : covered(end);
            return std::max(0.0, covered(end) - 0.5 * gap);
        };
        const double begin =
            c.way[tied.front()] - beyond(tied.front(), tied[std::min<std::size_t>(1, tied.size() - 1)]);
        for (const std::size_t k : tied) p.place[static_cast<std::size_t>(c.nodes[k])] = c.way[k] - begin;
        p.before_exit += beyond(tied.back(), tied[tied.size() > 1 ? tied.size() - 2 : 0]) / p.fibres;
        p.at_end[static_cast<std::size_t>(c.nodes[tied.front()])] |= first_in_matrix;
        p.at_end[static_cast<std::size_t>(c.nodes[tied.back()])] |= last_in_matrix;
    }
    p.section = std::numbers::pi * radius * radius * p.fibres;
}

/// A fibre of spheres of the packing is pulled along the axis of its region, by its uppermost layer.
void place_taken(const PartSpec& part, const Model& model, State& state, PullOut& p)
{
    const int axis = axis_of(part.region.axis);
    const Bodies& b = state.bodies;
    p.direction = axis_vector(axis);
    const double radius = 0.5 * part.region.diameter;
    p.section = std::numbers::pi * radius * radius;
    const InterfaceBonds& f = state.interfaces;
    double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest(), top = high;
    double size = 0.0, first = low;
    for (const int i : fibre_interfaces(p, state)) {
        const int body = fibre_side(p, state, i);
        const double z = b.position[body][axis];
        p.length += f.area[i] / (2.0 * std::numbers::pi * radius);
        low = std::min(low, z);
        high = std::max(high, z);
        first = std::min(first, z - f.slip_limit[i]);  // where its matrix begins
        p.place[static_cast<std::size_t>(body)] = f.slip_limit[i];
        size = std::max(size, 2.0 * model.shapes.radius[b.shape[body]]);
    }
    for (int i = 0; i < b.size(); ++i) {
        if (b.group[i] != p.fibre_group) continue;
        top = std::max(top, b.position[i][axis]);
        p.along[static_cast<std::size_t>(i)] = p.direction;
    }
    const double layer = even_levels(state, p.fibre_group, axis),
                 depth = layer > 0.0 ? 0.5 * layer : end_of_others * size;
    p.piece = layer > 0.0 ? layer : size;
    for (int i = 0; i < b.size(); ++i) {
        if (b.group[i] != p.fibre_group) continue;
        const double z = b.position[i][axis];
        if (z > top - depth) hold(state, i, p.grip_wall, axis);
        if (p.place[static_cast<std::size_t>(i)] < 0.0) continue;
        if (z < low + depth) p.at_end[static_cast<std::size_t>(i)] |= first_in_matrix;
        if (z > high - depth) p.at_end[static_cast<std::size_t>(i)] |= last_in_matrix;
    }
    p.before_exit = std::max(0.0, first + p.length - high);
    p.beyond_grip = std::max(0.0, first + p.length - top);
}

/// The bodies of the matrix' far face: each held, or all together.
void support(const Case& c, Model& model, State& state, const PullOut& p)
{
    const Bodies& b = state.bodies;
    const PartSpec& matrix = c.parts[static_cast<std::size_t>(p.matrix_group)];
    const bool packed = matrix.kind == "spheres" && (matrix.generator == "hcp" || matrix.generator == "fcc");
    double lowest = std::numeric_limits<double>::max();
    for (int i = 0; i < b.size(); ++i) {
        if (b.group[i] == p.matrix_group) lowest = std::min(lowest, dot(b.position[i], p.direction));
    }
    const int axis = axis_along(p.direction);
    for (int i = 0; i < b.size(); ++i) {
        if (b.group[i] != p.matrix_group) continue;
        const double radius = model.shapes.bounding_radius[b.shape[i]];
        if (dot(b.position[i], p.direction) - lowest > (packed ? face_of_lattice : face_of_others) * 2.0 * radius)
            continue;
        if (c.test.support == "held") {
            hold(state, i, p.support_wall, axis);
            continue;
        }
        state.bodies.wall.at(i) = p.support_wall;
        model.spread_bodies.host().push_back(i);
        model.spread_area.host().push_back(radius * radius);
    }
    model.spread_direction = p.direction;
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

bool nothing_presses(const PullOut& p, const State& state)
{
    const std::vector<int> all = fibre_interfaces(p, state);
    return std::all_of(all.begin(), all.end(), [&](int i) { return state.interfaces.normal_stiffness[i] == 0.0; });
}

}  // namespace

Experiment set_up_pull_out(const Case& c, Model& model, State& state)
{
    PullOut p;
    p.fibre_group = part_named(c, c.test.fibre, "test.fibre");
    p.matrix_group = part_named(c, c.test.matrix, "test.matrix");
    const PartSpec& part = c.parts[static_cast<std::size_t>(p.fibre_group)];
    if (fibre_interfaces(p, state).empty())
        throw InputError("test.fibre",
                         fmt::format("no interface between \"{}\" and \"{}\"; required: [[bonds]] of law = "
                                     "\"interface\" between them",
                                     c.test.fibre, c.test.matrix));
    p.young_modulus = material_of(model, p.fibre_group).young_modulus;
    p.grip_wall = add_wall(model, "grip");
    p.support_wall = add_wall(model, "support");
    const auto bodies = static_cast<std::size_t>(state.bodies.size());
    p.place.assign(bodies, -1.0);
    p.along.resize(bodies);
    p.at_end.assign(bodies, 0);
    if (part.generator == "taken")
        place_taken(part, model, state, p);
    else
        place_chains(part.fibre, fibre_chains(c, state, p.fibre_group), state, p);
    support(c, model, state, p);
    if (c.test.control == "damage") check_only_the_interface_softens(c, p, model, state);

    Experiment e;
    e.kind = c.test.kind;
    e.results = pull_out_results;
    e.specimen.loaded_wall = p.grip_wall;
    e.specimen.load_direction = p.direction;
    e.specimen.length = p.length;
    e.specimen.stress_area = p.section;
    e.specimen.compression = false;
    e.facts = {{"embedded_length_m", p.length}, {"fibre_section_m2", p.section}};
    e.wave_speed = std::sqrt(p.young_modulus / material_of(model, p.fibre_group).density);
    if (part.generator == "chain" && part.fibre.shape != "straight" && nothing_presses(p, state)) {
        e.warnings.push_back(fmt::format(
            "the interface of \"{}\" has no normal_stiffness: fibre and matrix do not press on each other, so that its "
            "bends bear on nothing",
            part.name));
    }

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
