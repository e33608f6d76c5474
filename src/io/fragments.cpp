// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/fragments.h"

#include <map>

namespace grainfrac {

namespace {

double density(const Model& model, int group)
{
    const std::int32_t material = model.groups.at(static_cast<std::size_t>(group)).material;
    return material < 0 ? 0.0 : model.materials.at(static_cast<std::size_t>(material)).density;
}

}  // namespace

std::vector<Fragment> collect_fragments(const Model& model, const State& state, const SnapshotFields& fields)
{
    const Bodies& bodies = state.bodies;
    std::map<std::int32_t, Fragment> by_cluster;
    for (int i = 0; i < bodies.size(); ++i) {
        const std::int32_t cluster = fields.cluster.at(static_cast<std::size_t>(i));
        if (bodies.wall[i] >= 0 || cluster < 0) continue;
        Fragment& fragment = by_cluster[cluster];
        const double mass = bodies.mass[i], rho = density(model, bodies.group[i]);
        fragment.cluster = cluster;
        ++fragment.grains;
        fragment.mass += mass;
        fragment.volume += rho > 0.0 ? mass / rho : 0.0;
        fragment.center += mass * bodies.position[i];
        fragment.velocity += mass * bodies.velocity[i];
    }
    std::vector<Fragment> fragments;
    for (auto& [cluster, fragment] : by_cluster) {
        if (fragment.mass > 0.0) {
            fragment.center *= 1.0 / fragment.mass;
            fragment.velocity *= 1.0 / fragment.mass;
        }
        fragments.push_back(fragment);
    }
    return fragments;
}

}  // namespace grainfrac
