// SPDX-License-Identifier: GPL-3.0-or-later
// Bonds that break on the path of a pull-out: of the fibre, which snaps, and of the matrix.
#include "experiment/pull_out_path.h"
#include "fracture/clusters.h"

#include <set>

namespace grainfrac {

namespace {

/// What has come off with nothing but bodies of the far face bears no share of the stress on it, and counts for it no
/// more. Unless that is all of the face.
void let_loose_go(const PullOut& p, Model& model, State& state)
{
    std::vector<std::int32_t>& bodies = model.spread_bodies.host();
    std::vector<double>& area = model.spread_area.host();
    if (bodies.empty()) return;
    const std::vector<std::int32_t> cluster = bonded_clusters(state);
    std::set<std::int32_t> held;  // clusters with something besides the face
    for (int i = 0; i < state.bodies.size(); ++i) {
        if (state.bodies.wall[i] != p.support_wall) held.insert(cluster[static_cast<std::size_t>(i)]);
    }
    const auto loose = [&](std::int32_t body) { return held.count(cluster[static_cast<std::size_t>(body)]) == 0; };
    std::vector<std::int32_t> kept_bodies;
    std::vector<double> kept_area;
    for (std::size_t k = 0; k < bodies.size(); ++k) {
        if (loose(bodies[k])) continue;
        kept_bodies.push_back(bodies[k]);
        kept_area.push_back(area[k]);
    }
    if (kept_bodies.empty() || kept_bodies.size() == bodies.size()) return;
    for (const std::int32_t body : bodies) {
        if (loose(body)) state.bodies.wall.at(body) = -1;
    }
    bodies = kept_bodies;
    area = kept_area;
}

}  // namespace

/// One after the other while the grip stays where it is, until the rest can bear what is left.
bool PullOutPath::break_bonds(Model& model, State& state, MostUsedBond most, const std::function<bool()>& interrupted)
{
    do {
        break_bond(model, state, most);
        let_loose_go(pull_out_, model, state);
        if (!relax(model, state, interrupted) || (interrupted && interrupted())) return false;
        most = most_used_bond(model, state);
    } while (most.share > 1.0);
    return true;
}

}  // namespace grainfrac
