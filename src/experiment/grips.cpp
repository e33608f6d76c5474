// SPDX-License-Identifier: GPL-3.0-or-later
#include "experiment/grips.h"

#include "experiment/specimen.h"
#include "experiment/walls.h"
#include "generate/sphere_region.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

namespace grainfrac {

namespace {

/// Bits of Bodies::held.
constexpr std::int32_t all_axes = 7, held_rotation = 8;

std::int32_t bits_of(const std::vector<std::string>& hold)
{
    std::int32_t bits = 0;
    for (const std::string& h : hold) bits |= h == "rotation" ? held_rotation : 1 << axis_of(h);
    return bits;
}

std::vector<int> bodies_of(const Model& model, const Bodies& b, const GripSpec& spec)
{
    std::vector<int> all;
    for (int i = 0; i < b.size(); ++i) {
        const Group& g = model.groups[static_cast<std::size_t>(b.group[i])];
        if (!g.is_wall && g.name == spec.part) all.push_back(i);
    }
    if (all.empty()) return all;
    if (spec.at == "first") return {all.front()};
    if (spec.at == "last") return {all.back()};
    const SphereRegion region(spec.region);
    std::erase_if(all, [&](int i) { return !region.contains(b.position[i]); });
    return all;
}

void hold(Bodies& b, int i, std::int32_t bits)
{
    if ((bits & all_axes) == all_axes) {
        b.inverse_mass.at(i) = 0.0;
        b.velocity.at(i) = {};
        if ((bits & held_rotation) != 0) b.inverse_inertia.at(i) = {};
    } else {
        b.held.at(i) = bits;
    }
    if ((bits & held_rotation) != 0) b.angular_momentum.at(i) = b.angular_velocity.at(i) = {};
}

}  // namespace

void add_grip(Model& model, State& state, const GripSpec& spec, const std::string& key)
{
    Bodies& b = state.bodies;
    const std::vector<int> taken = bodies_of(model, b, spec);
    if (taken.empty())
        throw InputError(key + (spec.at.empty() ? ".region" : ".part"),
                         fmt::format("no body of part \"{}\" has its centre inside", spec.part));
    const int wall = add_wall(model, spec.name);
    const std::int32_t bits = bits_of(spec.hold);
    for (const int i : taken) {
        if (b.wall[i] >= 0)
            throw InputError(key, fmt::format("body {} of \"{}\" is held by grip \"{}\" already", b.id[i], spec.part,
                                              model.walls[static_cast<std::size_t>(b.wall[i])]));
        hold(b, i, bits);
        b.wall.at(i) = wall;
    }
}

void release_grip(const Model& model, State& state, int wall)
{
    Bodies& b = state.bodies;
    for (int i = 0; i < b.size(); ++i) {
        if (b.wall[i] != wall || model.groups[static_cast<std::size_t>(b.group[i])].is_wall) continue;
        const bool driven = b.inverse_mass[i] == 0.0;
        for (int k = 0; k < 3; ++k) {
            if (driven || (b.held[i] >> k) % 2 != 0)
                b.external_work.at(i) += 0.5 * b.mass[i] * b.velocity[i][k] * b.velocity[i][k];
        }
        b.inverse_mass.at(i) = 1.0 / b.mass[i];
        const Vec3 I = b.inertia[i];
        b.inverse_inertia.at(i) = {1.0 / I.x, 1.0 / I.y, 1.0 / I.z};
        b.held.at(i) = 0;
        b.wall.at(i) = -1;
    }
}

}  // namespace grainfrac
