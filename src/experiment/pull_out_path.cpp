// SPDX-License-Identifier: GPL-3.0-or-later
#include "experiment/pull_out_path.h"

#include "fracture/bond_forces.h"
#include "fracture/bond_strength.h"
#include "fracture/softening.h"
#include "motion/energy.h"
#include "motion/step.h"

#include <algorithm>
#include <cmath>

namespace grainfrac {

namespace {

/// One scaling gets there; what turned asks for another.
constexpr int most_scalings = 12;
/// Towards the end events take this share of what is left, until this little is left.
constexpr double last_steps = 0.3, nothing_left = 2e-3;
/// Once this little is left, some patches may be gone around the fibre and others not, so that it can turn freely: what
/// does not soon come to rest is broken.
constexpr double little_left = 0.02;
constexpr int steps_for_little = 20000;
/// An interface with this share of it left, or less, has nothing left to soften.
constexpr double all_broken = 1.0 - 1e-9;
/// Share of a patch that has slid out of the matrix until the next step retires it: without weight it would have
/// neither slip nor damage.
constexpr double nothing_to_rub = 1e-9;
/// After a slide the pressure changes with the stress, and the stress with it: this near it is enough.
constexpr double same_pull = 1e-4;
constexpr int most_draws = 30;

/// Whether what softens has friction; `begun`: only what has begun to.
bool rubs(const Model& model, const State& state, const std::vector<int>& interfaces, bool begun)
{
    const InterfaceBonds& f = state.interfaces;
    return std::any_of(interfaces.begin(), interfaces.end(), [&](int i) {
        const InterfaceLaw law = model.interface_laws[f.law[i]];
        return (f.damage[i] > 0.0 || !begun) && law.friction_cap(f.normal_stiffness[i], f.pressure_at_rest[i]) > 0.0;
    });
}

}  // namespace

PullOutPath::PullOutPath(const PullOut& pull_out, const PathSettings& settings, const Model& model, const State& state)
    : pull_out_(pull_out), settings_(settings), relaxation_(model, state)
{
    remember_grip(state);
    settings_.relax.fracture = !settings.by_damage;
}

/// All displacements and turns since the start by a factor; grips too.
void PullOutPath::scale(const Model& model, State& state, double factor)
{
    Bodies& b = state.bodies;
    double farthest = 0.0;
    auto& position = b.position.host();
    auto& orientation = b.orientation.host();
    for (int i = 0; i < b.size(); ++i) {
        const auto k = static_cast<std::size_t>(i);
        const Vec3 way = position[k] - b.start_position[i];
        position[k] = b.start_position[i] + factor * (position[k] - b.start_position[i]);
        const Vec3 turned = rotation_vector(orientation[k] * conjugate(b.start_orientation[i])), turn = factor * turned;
        const double angle = norm(turn);
        farthest = std::max(farthest, norm(way) + norm(turned) * model.shapes.bounding_radius[b.shape[i]]);
        orientation[k] = angle > 0.0 ? normalized(from_axis_angle(turn / angle, angle) * b.start_orientation[i])
                                     : b.start_orientation[i];
    }
    state.travel += std::fabs(factor - 1.0) * farthest;
    // incremental bonds remember forces: in proportion too
    SphereBonds& p = state.sphere_bonds;
    for (int k = 0; k < p.shear_force.size(); ++k) {  // none where no law has a history
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

/// The grip keeps its place while all comes to rest.
void PullOutPath::shift_fibre(Model& model, State& state, double by)
{
    Bodies& b = state.bodies;
    const Ledger before = energy_ledger(model, state);
    state.travel += std::fabs(by);
    for (int i = 0; i < b.size(); ++i) {
        if (b.group[i] == pull_out_.fibre_group) b.position.at(i) += by * pull_out_.direction;
    }
    shorten(state);
    book_move(model, state, before);
}

/// A patch leaves the friction at once, when the fibre's end has slid to its middle. The next one stands for what is
/// left of it, and then for less of its own: what rubs gets shorter with the slip, not by pieces.
void PullOutPath::shorten(State& state)
{
    const InterfaceBonds& f = state.interfaces;
    for (const int i : fibre_interfaces(pull_out_, state)) {
        if (f.retired[i] != 0 || f.damage[i] < 1.0) continue;
        const double left = f.slip_limit[i] - slip_of(pull_out_, state, i, fibre_side(pull_out_, state, i));
        const double share = left < pull_out_.piece ? std::max(nothing_to_rub, 0.5 + left / pull_out_.piece) : 1.0;
        double weight = 0.0;
        for (int q = f.point_begin[i]; q < f.point_begin[i + 1]; ++q) weight += state.points.weight[q];
        for (int q = f.point_begin[i]; q < f.point_begin[i + 1]; ++q)
            state.points.weight.at(q) *= share * f.area[i] / weight;
    }
}

/// Of a move that the grip alone did not make: what springs take up at once and friction loses is its work.
void PullOutPath::book_move(Model& model, State& state, const Ledger& before)
{
    find_forces(model, state);
    const Ledger after = energy_ledger(model, state);
    Bodies& b = state.bodies;
    int grip = 0;
    while (b.wall[grip] != pull_out_.grip_wall) ++grip;
    b.external_work.at(grip) += before.residual() - after.residual();
    remember_grip(state);
}

/// Forces and energies of the state as it is.
void PullOutPath::find_forces(const Model& model, State& state)
{
    Model frozen = model;
    frozen.fracture_active = false;
    if (friction_) friction_->put_back(model.device, state);
    step(frozen, state, 0.0);
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
    find_forces(model, state);    // the forces are those of before the move
    const HeldBonds hold(model);  // what it goes through on the way is no load of theirs
    last_ = relaxation_.relax(model, state, settings_.relax, interrupted, friction_ ? &*friction_ : nullptr);
    book_work(state);
    return last_.at_rest;
}

PullOutPath::Found PullOutPath::to_softening(Model& model, State& state, const std::function<bool()>& interrupted)
{
    const std::vector<int> interfaces = fibre_interfaces(pull_out_, state);
    for (int k = 0; k < most_scalings; ++k) {
        const double factor = factor_to_softening(model, state, interfaces);
        if (factor == 0.0 || std::fabs(factor - 1.0) < on_surface_) return Found::equilibrium;
        scale(model, state, factor);
        if (!relax(model, state, interrupted)) return Found::not_at_rest;
    }
    return Found::not_softening;
}

/// All displacements by a factor, and the damage that they cause half-way: what it releases is then, to second order,
/// what the law takes. The rest of the damage comes while the model comes to rest.
void PullOutPath::go_on(Model& model, State& state, const std::vector<int>& interfaces, double factor)
{
    const double half = std::sqrt(factor);
    const auto move = [&] {
        const Ledger before = energy_ledger(model, state);
        scale(model, state, half);
        book_move(model, state, before);
    };
    move();
    soften(model, state, interfaces, half);
    find_forces(model, state);
    move();
}

/// All of it slides: moved as one the fibre stretches back against the friction, which must not mind.
bool PullOutPath::draw(Model& model, State& state, const std::vector<int>& interfaces,
                       const std::function<bool()>& interrupted)
{
    const PullOut& p = pull_out_;
    double before = 0.0;
    relaxation_.renew_masses(model, state);  // friction acts ever farther from the nodes
    {
        Sliding sliding(model, state, interfaces, settings_.slide);
        for (int k = 0; k < most_draws; ++k) {
            if (!relax(model, state, interrupted)) return false;
            const double now = pull_out_state(p, state).end_stress;
            if (std::fabs(now - before) <= same_pull * std::fabs(now)) break;
            before = now;
            sliding.renew();
        }
    }
    return relax(model, state, interrupted);
}

/// The grip has gone too far for a bond: back to where it bears its strength. With friction, which remembers the way
/// back, it is left where it is.
bool PullOutPath::back_to_strength(Model& model, State& state, const std::vector<int>& interfaces,
                                   const std::function<bool()>& interrupted)
{
    double share = most_used_bond(model, state).share, off = share - 1.0;
    if (off <= on_surface_ || rubs(model, state, interfaces, true)) return true;
    const State too_far = state;
    const Relaxation relaxation_there = relaxation_;
    const Relaxed last_there = last_;
    for (int k = 0; k < most_scalings; ++k) {
        const Ledger before = energy_ledger(model, state);
        scale(model, state, 1.0 / share);
        book_move(model, state, before);
        if (!relax(model, state, interrupted)) return false;
        share = most_used_bond(model, state).share;
        if (std::fabs(share - 1.0) <= on_surface_) return true;
        if (share <= 0.0 || std::fabs(share - 1.0) > std::fabs(off)) break;
        off = share - 1.0;
    }
    state = too_far;  // what broke before has moved so that all is no longer in proportion
    relaxation_ = relaxation_there;
    last_ = last_there;
    remember_grip(state);
    return true;
}

PullOutPath::Found PullOutPath::next(Model& model, State& state, const std::function<bool()>& interrupted)
{
    const auto counted = [&](Found found) {
        if (found == Found::equilibrium) state.time += 1.0;
        return found;
    };
    const auto rested = [&](bool ok) { return counted(ok ? Found::equilibrium : Found::not_at_rest); };
    const std::vector<int> interfaces = fibre_interfaces(pull_out_, state);
    if (const MostUsedBond most = most_used_bond(model, state); most.share >= 1.0 - on_surface_)
        return rested(break_bonds(model, state, most, interrupted));
    if (mean_damage(state, interfaces) >= all_broken) {
        if (!settings_.slides) return Found::end;
        settings_.relax.fracture = true;
        shift_fibre(model, state, settings_.slide);
        return rested(draw(model, state, interfaces, interrupted));
    }
    if (!settings_.by_damage) {
        const double now = pull_out_state(pull_out_, state).end_displacement;
        if (started_ && now > 0.0) {
            go_on(model, state, interfaces, 1.0 + settings_.shift / now);
        } else {
            shift_fibre(model, state, settings_.shift);
        }
        started_ = true;
        return rested(relax(model, state, interrupted) && back_to_strength(model, state, interfaces, interrupted));
    }
    if (!started_) {
        shift_fibre(model, state, settings_.shift);
        started_ = true;
        if (!relax(model, state, interrupted)) return Found::not_at_rest;
        return counted(to_softening(model, state, interrupted));
    }
    const double left = 1.0 - mean_damage(state, interfaces);
    if (left >= nothing_left) {
        const RelaxSettings patient = settings_.relax;
        if (left < little_left) settings_.relax.most_steps = std::min(patient.most_steps, steps_for_little);
        const Found found = next_event(model, state, interfaces, interrupted);
        settings_.relax = patient;
        const bool lost = found == Found::not_at_rest || found == Found::not_softening;
        if (!lost || left >= little_left || (interrupted && interrupted())) return counted(found);
    }
    soften(model, state, interfaces, 1e9);
    find_forces(model, state);
    const bool broken = mean_damage(state, interfaces) >= all_broken;
    return settings_.slides && broken ? next(model, state, interrupted) : Found::end;
}

std::optional<PullOutPath::Found> next_or_none(std::optional<PullOutPath>& path, Model& model, State& state,
                                               const std::function<bool()>& interrupted)
{
    const PullOutPath last_path = *path;
    const State last_state = state;
    const Buffer<std::int32_t> spread_bodies = model.spread_bodies;  // what comes off a face leaves the model's list
    const Buffer<double> spread_area = model.spread_area;
    const PullOutPath::Found found = path->next(model, state, interrupted);
    if (!interrupted()) return found;
    path.emplace(last_path);
    state = last_state;
    model.spread_bodies = spread_bodies;
    model.spread_area = spread_area;
    return std::nullopt;
}

/// Half of the overshoot before the damage, half of it in the damage: what is released is then what the law takes.
PullOutPath::Found PullOutPath::next_event(Model& model, State& state, const std::vector<int>& interfaces,
                                           const std::function<bool()>& interrupted)
{
    const double now = mean_damage(state, interfaces), surface = factor_to_softening(model, state, interfaces);
    if (surface == 0.0) return Found::end;  // nothing can soften
    if (rubs(model, state, interfaces, false)) return event_with_friction(model, state, interfaces, interrupted);
    const double half = std::sqrt(1.0 + overshoot(model, state, interfaces, surface, next_damage(now)));
    scale(model, state, surface * half);  // at rest still, but for what turned
    book_scaling(state, surface * half);
    soften(model, state, interfaces, half);
    if (!relax(model, state, interrupted)) return Found::not_at_rest;
    const Found found = to_softening(model, state, interrupted);
    return found == Found::equilibrium ? balance(model, state, interfaces, interrupted) : found;
}

double PullOutPath::next_damage(double now) const
{
    return now + std::min(settings_.damage_step, last_steps * (1.0 - now));
}

/// With the first point at its strength the others of the softening zone are a little below theirs, since damage comes
/// by steps. The state that stands for this damage is that at which the next of it releases what it takes.
double PullOutPath::factor_to_path(const Model& model, const State& state, const std::vector<int>& interfaces) const
{
    const double now = mean_damage(state, interfaces);
    if (1.0 - now < nothing_left) {
        const double factor = factor_to_softening(model, state, interfaces);
        return factor > 0.0 ? factor : 1.0;
    }
    const double reach = 1.0 + overshoot(model, state, interfaces, 1.0, next_damage(now));
    return factor_to_balance(model, state, interfaces, reach);
}

PullOutPath::Found PullOutPath::balance(Model& model, State& state, const std::vector<int>& interfaces,
                                        const std::function<bool()>& interrupted)
{
    if (1.0 - mean_damage(state, interfaces) < nothing_left) return Found::equilibrium;
    scale(model, state, factor_to_path(model, state, interfaces));
    return relax(model, state, interrupted) ? Found::equilibrium : Found::not_at_rest;
}

}  // namespace grainfrac
