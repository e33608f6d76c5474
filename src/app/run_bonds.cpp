// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/live_run.h"
#include "experiment/bond_stage.h"
#include "model/validate.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <stdexcept>

namespace grainfrac {

Ending bond_stage(LiveRun& run, const Stage& stage)
{
    const auto refused = [&](const std::string& why) {
        return Ending{exit_code::wrong_input, fmt::format("stages[{}]: {}", run.now.stage, why)};
    };
    BondsMade made;
    try {
        made = make_bonds(run.model, run.state, *stage.bonds, run.input.simulation.seed);
    } catch (const InputError& e) {
        return refused(fmt::format("{}: {}", e.problems.front().key, e.problems.front().message));
    }
    if (made.number == 0) {
        return refused(fmt::format("no faces of grains lie against each other within bond_distance = {:.4g} m",
                                   stage.bonds->distance));
    }
    if (const std::string why = why_not_valid(run.model, run.state); !why.empty())
        throw std::logic_error("new bonds made an impossible state: " + why);
    run.record.bonding_energy -= made.removed_energy;
    const Vec3 p = made.before.linear, L = made.before.angular;
    spdlog::info(
        "{} bonds of {:.4g} m^2 made; taken out to begin without stress: {:.4g} J, momentum ({:.3g}, {:.3g}, "
        "{:.3g}) "
        "kg m/s, angular momentum ({:.3g}, {:.3g}, {:.3g}) kg m^2/s",
        made.number, made.area, made.removed_energy, p.x, p.y, p.z, L.x, L.y, L.z);
    if (!run.input.control.time_step) {
        choose_step(run);
    } else if (const TimeStepBound bound = time_step_bound(run.model, run.state); run.now.dt > bound.with_damping) {
        return {exit_code::wrong_input, fmt::format("control.time_step: must be <= {:.4g} s, the stability limit "
                                                    "once the bonds are made ({})",
                                                    bound.with_damping, bound.limiter)};
    }
    run.now.broken = -1;  // fragments are to be counted anew
    record_row(run, stage);
    return {exit_code::done, fmt::format("{} bonds made", made.number)};
}

}  // namespace grainfrac
