// SPDX-License-Identifier: GPL-3.0-or-later
// Damage in events instead of in steps: how far a state at rest is from the next damage, and a chosen amount of it at
// once. For the quasi-static path of what softens (experiment/pull_out_path.h).
#pragma once

#include "model/model.h"
#include "model/state.h"

#include <vector>

namespace grainfrac {

/// Factor on the present jumps at which the first point of these interfaces would soften; 0 if none can. Law points
/// only: faces that fail as a whole never soften.
double factor_to_softening(const Model& model, const State& state, const std::vector<int>& interfaces);

/// Factor on the present jumps at which the damage that they cause times `reach` would release, to first order, what
/// the law takes: the mean use of the strength is then 1, by energy, of what is softened. 1 if nothing is.
double factor_to_balance(const Model& model, const State& state, const std::vector<int>& interfaces, double reach);

/// Mean damage over the area of the interfaces [-].
double mean_damage(const State& state, const std::vector<int>& interfaces);
/// What it would be with the present jumps times `reach`.
double mean_damage_at(const Model& model, const State& state, const std::vector<int>& interfaces, double reach);

/// How far beyond `surface` times the present jumps the event goes, as a share of them, that brings the mean damage to
/// `wanted`, or breaks what is left [-].
double overshoot(const Model& model, const State& state, const std::vector<int>& interfaces, double surface,
                 double wanted);

/// The damage that the present jumps times `reach` cause. What the points release at the present jumps and the law
/// does not count as fracture energy goes to inserted work, so that the account closes. Call bond_forces afterwards.
void soften(const Model& model, State& state, const std::vector<int>& interfaces, double reach);

/// What slides goes on sliding while the rest comes to rest: the friction of each broken point is put to its cap, along
/// the way that it has gone, by a spring so soft that `way` [m] of going back hardly unloads it. The friction work has
/// the difference of what the springs hold.
class Sliding {
public:
    Sliding(const Model& model, State& state, const std::vector<int>& interfaces, double way);
    /// The springs of the law again, under the same friction.
    ~Sliding();
    Sliding(const Sliding&) = delete;
    Sliding& operator=(const Sliding&) = delete;

    /// To the cap that is now, after the pressure has changed.
    void renew();

private:
    void set(bool soft);

    const Model& model_;
    State& state_;
    const std::vector<int>& interfaces_;
    double way_;
    std::vector<double> stiffness_;  // of the law, of each of `interfaces`
};

}  // namespace grainfrac
