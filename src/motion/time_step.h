// SPDX-License-Identifier: GPL-3.0-or-later
// The stable time step, from the model.
//
// For springs between pairs u^T K u <= 2 sum_i u_i^T K_ii u_i, hence omega_max^2 <= 2 max_i lambda_max(M_i^-1 K_ii)
// with K_ii = sum_q G_q^T k_q G_q, G_q = [1, -skew(x_q - c_i)]: a 6x6 problem per body, rigorous for any assembly.
// Dashpots that use the velocity of the last half step shorten the step by sqrt(1 + zeta^2) - zeta.
#pragma once

#include "model/model.h"
#include "model/state.h"

#include <cstdint>
#include <string>
#include <vector>

namespace grainfrac {

struct TimeStepBound {
    double critical = 0.0;      ///< without damping [s]
    double with_damping = 0.0;  ///< [s]
    std::int32_t body = -1;     ///< index of the body that sets it
    std::string limiter;        ///< in words: which body, what acts on it
};

/// Undamaged stiffness of every bond that still acts, every active contact, and every pair near enough to a wall to
/// touch it. `body` is -1 and the bounds are 0 while nothing acts on anything.
TimeStepBound time_step_bound(const Model& model, const State& state);
/// The bound that some bodies set.
TimeStepBound time_step_bound(const Model& model, const State& state, const std::vector<int>& bodies);

/// Mass and factor on the inertia of each body with which a step of dt would be `safety` times as long as is stable:
/// all bodies equally fast, for relaxation (Underwood 1983). 0 for bodies that nothing acts on or that are driven.
struct FictitiousMass {
    double mass = 0.0;     ///< [kg]
    double inertia = 1.0;  ///< on the true principal moments [-]
};
std::vector<FictitiousMass> fictitious_masses(const Model& model, const State& state, double dt, double safety);

}  // namespace grainfrac
