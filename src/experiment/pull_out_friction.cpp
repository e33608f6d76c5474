// SPDX-License-Identifier: GPL-3.0-or-later
// Events of a pull-out whose broken interface rubs.
#include "experiment/pull_out_path.h"
#include "fracture/softening.h"

#include <algorithm>
#include <cmath>

namespace grainfrac {

namespace {

/// The grip moves on or back as the last two places say (secant rule), at most by this share of what is there.
constexpr double most_move = 0.3;
constexpr int most_moves = 30;
/// A cap that changes on the way, with the stress or with the closing, has no potential: there friction remembers each
/// way back, and the grip creeps, rather less than the last two moves say.
constexpr double near_surface = 3e-3, first_share = 0.4, not_beyond = 0.8, most_overdone = 10.0, most_creep = 0.1;
constexpr int most_creeps = 100;

bool caps_change(const Model& model, const State& state, const std::vector<int>& interfaces)
{
    const InterfaceBonds& f = state.interfaces;
    return model.fibres_contract || std::any_of(interfaces.begin(), interfaces.end(), [&](int i) {
               return model.interface_laws[f.law[i]].residual_friction > 0.0 && f.normal_stiffness[i] > 0.0;
           });
}

}  // namespace

/// Damage where the state is, and then the grip to where the next of it releases what it takes. What slides has one way
/// for all that, from the state before to the one that is found: how the model came to rest, and where the grip was
/// tried, leaves nothing behind.
PullOutPath::Found PullOutPath::event_with_friction(Model& model, State& state, const std::vector<int>& interfaces,
                                                    const std::function<bool()>& interrupted)
{
    const double wanted = next_damage(mean_damage(state, interfaces));
    soften(model, state, interfaces, 1.0 + overshoot(model, state, interfaces, 1.0, wanted));
    if (caps_change(model, state, interfaces)) {
        if (!relax(model, state, interrupted)) return Found::not_at_rest;
        return creep_to_softening(model, state, interfaces, interrupted);
    }
    friction_.emplace(state);
    const Found found = relax(model, state, interrupted) ? balance_with_friction(model, state, interfaces, interrupted)
                                                         : Found::not_at_rest;
    friction_.reset();
    return found;
}

/// The load falls where the grip goes back, whatever slides: one place is right.
PullOutPath::Found PullOutPath::balance_with_friction(Model& model, State& state, const std::vector<int>& interfaces,
                                                      const std::function<bool()>& interrupted)
{
    const auto missing = [&] { return factor_to_path(model, state, interfaces) - 1.0; };
    double place = 1.0, lacks = missing();                           // place: of the grip, over that at the beginning
    double place_before = 0.0, lacked = 0.0, low = 0.0, high = 0.0;  // 0: not known
    for (int k = 0; k < most_moves; ++k) {
        if (std::fabs(lacks) < on_surface_) return Found::equilibrium;
        (lacks > 0.0 ? low : high) = place;
        double next = place * (1.0 + lacks);
        if (place_before > 0.0 && (lacked - lacks) * (place - place_before) > 0.0)
            next = place + lacks * (place - place_before) / (lacked - lacks);
        next = std::clamp(next, place * (1.0 - most_move), place * (1.0 + most_move));
        if (low > 0.0 && high > 0.0 && (next <= low || next >= high)) next = 0.5 * (low + high);
        const Ledger held = energy_ledger(model, state);
        scale(model, state, next / place);
        book_move(model, state, held);
        if (!relax(model, state, interrupted)) return Found::not_at_rest;
        place_before = place;
        lacked = lacks;
        place = next;
        lacks = missing();
    }
    return Found::not_softening;
}

/// No further on than must be. A little too far, and the interface softens for it; back it goes where that would be
/// another event's damage.
PullOutPath::Found PullOutPath::creep_to_softening(Model& model, State& state, const std::vector<int>& interfaces,
                                                   const std::function<bool()>& interrupted)
{
    const double most_damage = mean_damage(state, interfaces) + settings_.damage_step;
    double before = 0.0, moved = 0.0;  // what was missing at the last move, and the move, over what is there
    for (int k = 0; k < most_creeps; ++k) {
        const double factor = factor_to_softening(model, state, interfaces), missing = factor - 1.0;
        if (factor == 0.0 || std::fabs(missing) < near_surface) return Found::equilibrium;
        if (missing < 0.0 && mean_damage_at(model, state, interfaces, 1.0) <= most_damage) {
            soften(model, state, interfaces, 1.0);
            before = 0.0;
        } else {
            double move = first_share * missing;
            if (missing * before > 0.0) {
                const double wanted = not_beyond * moved * missing / (before - missing);
                move *= std::clamp(wanted / move, 1.0 / most_overdone, most_overdone);
            }
            move = std::clamp(move, -most_creep, most_creep);
            before = missing;
            moved = move;
            const Ledger held = energy_ledger(model, state);
            scale(model, state, 1.0 + move);
            book_move(model, state, held);
        }
        if (!relax(model, state, interrupted)) return Found::not_at_rest;
    }
    return Found::not_softening;
}

}  // namespace grainfrac
