// SPDX-License-Identifier: GPL-3.0-or-later
// When a run can no longer be trusted, where that shows, and what to do about it.
#pragma once

#include "model/model.h"
#include "model/state.h"
#include "motion/energy.h"
#include "motion/time_step.h"

#include <string>
#include <vector>

namespace grainfrac {

/// What is asked of a run now and then.
struct StabilityLimits {
    double time_step = 0.0;                ///< [s]
    bool fixed_step = false;               ///< the user's
    const TimeStepBound* bound = nullptr;  ///< of the present state, where it is known
    double speed = 0.0;                    ///< no body is faster; 0: any speed [m/s]
    double error_before = 0.0;             ///< residual of the energy account at the last look, if it was off [J]
    const char* remedy = nullptr;          ///< of an account that does not close, where it is not the time step
};

struct Instability {
    std::string reason;       ///< cause, with its numbers, and remedy; empty: the run is stable
    std::vector<int> bodies;  ///< where it shows, worst first

    explicit operator bool() const { return !reason.empty(); }
};

/// The account is off by more than 10 %: a stable run stays below 1e-3.
bool account_is_off(const Ledger& energy);

/// A time step of the user's above the stability limit, non-finite numbers, cores that penetrate, bodies faster than
/// `speed`, an energy account that is off by more than 10 % and goes on losing. The message names bodies, their
/// strongest interaction, and what limits the time step.
Instability find_instability(const Model& model, const State& state, const Ledger& energy,
                             const StabilityLimits& limits);

}  // namespace grainfrac
