// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/live_run.h"
#include "app/wall_clock.h"
#include "fracture/grain_stress.h"
#include "model/grain_body.h"
#include "model/validate.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace grainfrac {

namespace {

/// The geometry that no clean cut was found for, to be looked into.
void keep_refused_cut(const LiveRun& run, int body, const std::vector<SplitRequest>& due)
{
    const auto folder = run.folder.path() / "refused_cuts";
    std::error_code ignored;
    std::filesystem::create_directories(folder, ignored);
    std::ofstream out(folder / fmt::format("step_{}_grain_{}.txt", run.state.step, run.state.bodies.id[body]));
    const Polyhedron& p = run.model.grain_shapes[static_cast<std::size_t>(body)];
    const Placement place = placement(run.state.bodies, body);
    for (const SplitRequest& r : due) {
        if (r.body != body) continue;
        const Vec3 n = rotate_back(place.orientation, r.plane.normal);
        out << fmt::format("plane {:.17g} {:.17g} {:.17g} {:.17g}\n", n.x, n.y, n.z,
                           r.plane.offset - dot(r.plane.normal, place.position));
    }
    for (const Vec3& v : p.vertices) out << fmt::format("vertex {:.17g} {:.17g} {:.17g}\n", v.x, v.y, v.z);
    for (const auto& face : p.faces) out << fmt::format("face {}\n", fmt::join(face, " "));
}

bool split(LiveRun& run, const std::vector<SplitRequest>& due)
{
    const auto before = Clock::now();
    std::vector<int> parts;
    for (const SplitReport& r : split_grains(run.model, run.state, due)) {
        if (r.status == SplitStatus::done) {
            parts.insert(parts.end(), {r.body, r.new_body});
            ++run.record.splits;
            run.record.split_area += r.area;
            run.record.split_energy += r.inserted_energy;
            spdlog::debug("step {}: grain {} split", run.state.step, r.parent_id);
        } else {
            ++run.record.refused_splits[to_string(r.status)];
            if (r.status == SplitStatus::degenerate) keep_refused_cut(run, r.body, due);
        }
    }
    if (!parts.empty()) {
        if (const std::string why = why_not_valid(run.model, run.state); !why.empty())
            throw std::logic_error("a split made an impossible state: " + why);
        shorten_step_if_needed(run, time_step_bound(run.model, run.state, parts));
    }
    run.record.phases.splitting += seconds_since(before);
    return !parts.empty();
}

}  // namespace

bool split_where_due(LiveRun& run, bool ask_gate)
{
    const auto before = Clock::now();
    std::vector<Mat3> stress;
    if (ask_gate) stress = grain_stress(run.model, run.state);
    const std::vector<SplitRequest> due =
        look_for_splits(run.model, run.state, ask_gate ? &stress : nullptr, run.cleavage, run.now.dt);
    run.record.phases.looks += seconds_since(before);
    return !due.empty() && split(run, due);
}

}  // namespace grainfrac
