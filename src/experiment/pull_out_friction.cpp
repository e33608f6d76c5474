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

}  // namespace

/// Damage where the state is, and then the grip to where the next of it releases what it takes. What slides has one way
/// for all that, from the state before to the one that is found: how the model came to rest, and where the grip was
/// tried, leaves nothing behind.
PullOutPath::Found PullOutPath::event_with_friction(Model& model, State& state, const std::vector<int>& interfaces,
                                                    const std::function<bool()>& interrupted)
{
    const double wanted = next_damage(mean_damage(state, interfaces));
    soften(model, state, interfaces, 1.0 + overshoot(model, state, interfaces, 1.0, wanted));
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

}  // namespace grainfrac
