// SPDX-License-Identifier: GPL-3.0-or-later
#include "experiment/start_overlap.h"

#include "contact/find_contacts.h"
#include "contact/find_pairs.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

namespace grainfrac {

namespace {

/// Bodies may touch each other and walls at the start, not lie in them by more than this share of the rounding: what
/// the overlap holds would throw them apart.
constexpr double most_overlap = 0.05;

/// Of the input that a body is of, gripped or supported or not; -1: a wall's own.
int part_of(const Case& c, const State& state, int body)
{
    const int group = state.bodies.group[body];
    return group < static_cast<int>(c.parts.size()) ? group : -1;
}

std::string name_of(const Case& c, const Model& model, const State& state, int body)
{
    if (part_of(c, state, body) < 0)
        return fmt::format("wall \"{}\"", model.walls[static_cast<std::size_t>(state.bodies.wall[body])]);
    return fmt::format("{} {} of \"{}\"", is_sphere(model, state.bodies, body) ? "sphere" : "grain",
                       state.bodies.id[body], model.groups[static_cast<std::size_t>(state.bodies.group[body])].name);
}

/// The key to blame: the wall if one takes part, else the part of the second body.
std::string key_of(const Case& c, const Model& model, const State& state, int a, int b)
{
    for (const int body : {a, b}) {
        if (part_of(c, state, body) >= 0) continue;
        for (std::size_t k = 0; k < c.walls.size(); ++k) {
            if (c.walls[k].name == model.walls[static_cast<std::size_t>(state.bodies.wall[body])])
                return fmt::format("walls[{}]", k);
        }
        return "test.kind";
    }
    return fmt::format("parts[{}]", part_of(c, state, std::max(a, b)));
}

bool is_chain(const Case& c, int part)
{
    return part >= 0 && c.parts[static_cast<std::size_t>(part)].kind == "spheres" &&
           c.parts[static_cast<std::size_t>(part)].generator == "chain";
}

/// Which of the copies of a chain a body is in; they are one after the other.
int copy_of(const PartSpec& part, const State& state, int body)
{
    const std::vector<std::int32_t>& group = state.bodies.group.host();
    const auto all = std::count(group.begin(), group.end(), group[static_cast<std::size_t>(body)]);
    const auto before = std::count(group.begin(), group.begin() + body, group[static_cast<std::size_t>(body)]);
    return static_cast<int>(before / (all / static_cast<std::ptrdiff_t>(part.copies.size() + 1)));
}

/// Nodes of a chain are where its line has them: it is their size that does not fit, or the hole around them.
void check_chain(const Case& c, const Model& model, const State& state, int a, int b)
{
    if (!is_chain(c, part_of(c, state, a))) std::swap(a, b);
    const int chain = part_of(c, state, a), other = part_of(c, state, b);
    if (!is_chain(c, chain) || other < 0) return;
    const PartSpec& part = c.parts[static_cast<std::size_t>(chain)];
    const Bodies& bodies = state.bodies;
    const double apart = norm(bodies.position[a] - bodies.position[b]);
    const std::string key = fmt::format("parts[{}].diameter", chain);
    if (other == chain) {
        const bool copies = copy_of(part, state, a) != copy_of(part, state, b);
        throw InputError(
            key, fmt::format("must be <= {:.4g} m{}: so far are spheres {} and {} of \"{}\" apart, which are "
                             "{}",
                             apart, copies ? ", or set its copies farther apart" : "", bodies.id[a], bodies.id[b],
                             part.name, copies ? "of two copies" : "no neighbours along it"));
    }
    const double left = apart - model.shapes.radius[bodies.shape[b]];
    if (!is_sphere(model, bodies, b) || left <= 0.0) return;
    throw InputError(key, fmt::format("must be <= {:.4g} m, or fibre.radius larger than {:.4g} m: sphere {} of \"{}\" "
                                      "lies in {}",
                                      2.0 * left, part.fibre.radius.value_or(0.5 * part.diameter), bodies.id[a],
                                      part.name, name_of(c, model, state, b)));
}

}  // namespace

void check_nothing_overlaps(const Case& c, const Model& model, State state)
{
    find_pairs(model, state);
    find_contacts(model, state);
    const Contacts& contacts = state.contacts;
    int worst = -1;
    double most = most_overlap;
    for (int i = 0; i < contacts.size(); ++i) {
        const double radii = model.shapes.radius[state.bodies.shape[contacts.a[i]]] +
                             model.shapes.radius[state.bodies.shape[contacts.b[i]]];
        if (contacts.point[i].depth > most * radii) {
            most = contacts.point[i].depth / radii;
            worst = i;
        }
    }
    if (worst < 0) return;
    const int a = contacts.a[worst], b = contacts.b[worst];
    check_chain(c, model, state, a, b);
    throw InputError(
        key_of(c, model, state, a, b),
        fmt::format("{} and {} overlap at the start, by {} m{}; move them apart", name_of(c, model, state, a),
                    name_of(c, model, state, b), fmt::format("{:.3g}", contacts.point[worst].depth),
                    contacts.point[worst].overlap_energy > 0.0 ? "" : " or more"));
}

}  // namespace grainfrac
