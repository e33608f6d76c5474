// SPDX-License-Identifier: GPL-3.0-or-later
#include "experiment/pull_out_path.h"

#include "fracture/bond_forces.h"
#include "fracture/softening.h"
#include "motion/energy.h"
#include "motion/step.h"

#include <algorithm>
#include <cmath>

namespace grainfrac {

namespace {

/// A state is on the failure surface within this share.
constexpr double on_surface = 1e-3;
/// Scalings to get there: one without friction, a few with it.
constexpr int most_scalings = 12;
/// Towards the end events take this share of what is left, until this little is left.
constexpr double last_steps = 0.3, nothing_left = 2e-3;
/// An interface with this share of it left, or less, has nothing left to soften.
constexpr double all_broken = 1.0 - 1e-9;
constexpr int bisections = 60;
/// After a slide: bits of way, each this share of it.
constexpr int draws = 5;
constexpr double draw = 0.01;

/// Overshoot of the event that does `wanted` more mean damage, or breaks what is left.
double overshoot(const Model& model, const State& state, const std::vector<int>& interfaces, double wanted)
{
    double low = 0.0, high = 1.0;
    while (mean_damage_at(model, state, interfaces, 1.0 + high) < wanted && high < 1e6) high *= 2.0;
    for (int k = 0; k < bisections; ++k) {
        const double middle = 0.5 * (low + high);
        (mean_damage_at(model, state, interfaces, 1.0 + middle) < wanted ? low : high) = middle;
    }
    return high;
}

/// Forces and energies of the state as it is.
void step_in_place(const Model& model, State& state)
{
    Model frozen = model;
    frozen.fracture_active = false;
    step(frozen, state, 0.0);
}

}  // namespace

PullOutPath::PullOutPath(const PullOut& pull_out, const PathSettings& settings, const Model& model, const State& state)
    : pull_out_(pull_out), settings_(settings), relaxation_(model, state)
{
    remember_grip(state);
    settings_.relax.fracture = !settings.by_damage;
}

/// All displacements and turns since the start by a factor; grips too.
void PullOutPath::scale(State& state, double factor)
{
    Bodies& b = state.bodies;
    double farthest = 0.0;
    auto& position = b.position.host();
    auto& orientation = b.orientation.host();
    for (int i = 0; i < b.size(); ++i) {
        const auto k = static_cast<std::size_t>(i);
        farthest = std::max(farthest, norm(position[k] - b.start_position[i]));
        position[k] = b.start_position[i] + factor * (position[k] - b.start_position[i]);
        const Vec3 turn = factor * rotation_vector(orientation[k] * conjugate(b.start_orientation[i]));
        const double angle = norm(turn);
        orientation[k] = angle > 0.0 ? normalized(from_axis_angle(turn / angle, angle) * b.start_orientation[i])
                                     : b.start_orientation[i];
    }
    state.travel += std::fabs(factor - 1.0) * farthest;
    // incremental bonds remember forces: in proportion too
    SphereBonds& p = state.sphere_bonds;
    for (int k = 0; k < p.size(); ++k) {
        p.shear_force.at(k) = factor * p.shear_force[k];
        p.moment.at(k) = factor * p.moment[k];
        p.twist.at(k) *= factor;
    }
    ParallelBonds& q = state.parallels;
    for (int k = 0; k < q.size(); ++k) {
        q.force.at(k) = factor * q.force[k];
        q.moment.at(k) = factor * q.moment[k];
    }
}

/// What the springs take up at once is the work of this move; the grip keeps its place while all comes to rest.
void PullOutPath::shift_fibre(Model& model, State& state, double by)
{
    Bodies& b = state.bodies;
    const Ledger before = energy_ledger(model, state);
    state.travel += std::fabs(by);
    int grip = -1;
    for (int i = 0; i < b.size(); ++i) {
        if (b.group[i] == pull_out_.fibre_group) b.position.at(i) += by * pull_out_.direction;
        if (b.wall[i] == pull_out_.grip_wall) grip = i;
    }
    step_in_place(model, state);
    const Ledger after = energy_ledger(model, state);
    b.external_work.at(grip) += before.residual() - after.residual();
    remember_grip(state);
}

void PullOutPath::remember_grip(const State& state)
{
    const Bodies& b = state.bodies;
    const auto n = static_cast<std::size_t>(b.size());
    force_before_.resize(n);
    position_before_.resize(n);
    for (std::size_t k = 0; k < n; ++k) {
        force_before_[k] = b.force[static_cast<int>(k)];
        position_before_[k] = b.position[static_cast<int>(k)];
    }
}

/// Forces grow with the displacements: the mean of before and after does the work.
void PullOutPath::book_scaling(State& state, double factor)
{
    Bodies& b = state.bodies;
    for (int i = 0; i < b.size(); ++i) {
        if (b.wall[i] != pull_out_.grip_wall) continue;
        const auto k = static_cast<std::size_t>(i);
        const Vec3 after = factor * force_before_[k];
        b.external_work.at(i) -= 0.5 * dot(force_before_[k] + after, b.position[i] - position_before_[k]);
        force_before_[k] = after;
        position_before_[k] = b.position[i];
    }
}

/// Mean of the forces before and after times the way: exact while the response between is linear.
void PullOutPath::book_work(State& state)
{
    Bodies& b = state.bodies;
    for (int i = 0; i < b.size(); ++i) {
        if (b.wall[i] != pull_out_.grip_wall) continue;
        const auto k = static_cast<std::size_t>(i);
        b.external_work.at(i) -= 0.5 * dot(force_before_[k] + b.force[i], b.position[i] - position_before_[k]);
    }
    remember_grip(state);
}

bool PullOutPath::relax(Model& model, State& state, const std::function<bool()>& interrupted)
{
    step_in_place(model, state);  // the forces are those of before the move
    last_ = relaxation_.relax(model, state, settings_.relax, interrupted);
    book_work(state);
    return last_.at_rest;
}

bool PullOutPath::to_softening(Model& model, State& state, const std::function<bool()>& interrupted)
{
    const std::vector<int> interfaces = fibre_interfaces(pull_out_, state);
    for (int k = 0; k < most_scalings; ++k) {
        const double factor = factor_to_softening(model, state, interfaces);
        if (factor == 0.0 || std::fabs(factor - 1.0) < on_surface) return true;
        scale(state, factor);
        if (!relax(model, state, interrupted)) return false;
    }
    return true;
}

PullOutPath::Found PullOutPath::next(Model& model, State& state, const std::function<bool()>& interrupted)
{
    const auto rested = [&](bool ok) {
        if (!ok) return Found::not_at_rest;
        state.time += 1.0;
        return Found::equilibrium;
    };
    const std::vector<int> interfaces = fibre_interfaces(pull_out_, state);
    if (mean_damage(state, interfaces) >= all_broken) {
        if (!settings_.slides) return Found::end;
        settings_.relax.fracture = true;
        shift_fibre(model, state, settings_.slide);
        if (!relax(model, state, interrupted)) return Found::not_at_rest;
        // Moved as one it goes back a little where it stretches, against the friction. Each further bit of way halves
        // what is missing: its friction is nearer to the one that it is stretched for.
        for (int k = 0; k < draws; ++k) {
            shift_fibre(model, state, draw * settings_.slide);
            if (!relax(model, state, interrupted)) return Found::not_at_rest;
        }
        return rested(true);
    }
    if (!settings_.by_damage) {
        const double now = pull_out_state(pull_out_, state).end_displacement;
        if (started_ && now > 0.0)
            scale(state, 1.0 + settings_.shift / now);
        else
            shift_fibre(model, state, settings_.shift);
        started_ = true;
        return rested(relax(model, state, interrupted));
    }
    if (!started_) {
        shift_fibre(model, state, settings_.shift);
        started_ = true;
        if (!relax(model, state, interrupted)) return Found::not_at_rest;
        return rested(to_softening(model, state, interrupted));
    }
    // half of the overshoot before the damage, half of it in the damage: what is released is then what the law takes
    const double now = mean_damage(state, interfaces), left = 1.0 - now;
    if (left < nothing_left) {
        soften(model, state, interfaces, 1e9);
        step_in_place(model, state);
        const bool broken = mean_damage(state, interfaces) >= all_broken;
        return settings_.slides && broken ? next(model, state, interrupted) : Found::end;
    }
    const double wanted = now + std::min(settings_.damage_step, last_steps * left);
    if (factor_to_softening(model, state, interfaces) == 0.0) return Found::end;  // nothing can soften
    const double reach = 1.0 + overshoot(model, state, interfaces, wanted), half = std::sqrt(reach);
    scale(state, half);  // at rest still, but for friction and what turned
    book_scaling(state, half);
    soften(model, state, interfaces, reach / half);
    if (!relax(model, state, interrupted)) return Found::not_at_rest;
    return rested(to_softening(model, state, interrupted));
}

}  // namespace grainfrac
