// SPDX-License-Identifier: GPL-3.0-or-later
// Equilibrium by dynamic relaxation: the steps of the core with fictitious masses, all bodies equally fast, and a drag
// of twice the lowest frequency that is still excited (Underwood 1983): that of the Rayleigh quotient
// -v.dF/(dt v.M v) of the present motion, but not far above the slowest one of the relaxation before: a local
// disturbance starts with fast motion, and a drag to match would make the slow one crawl. Nothing breaks or softens
// meanwhile unless the model says so; friction slides.
#pragma once

#include "fracture/held_friction.h"
#include "model/model.h"
#include "model/state.h"
#include "motion/time_step.h"

#include <functional>

namespace grainfrac {

struct RelaxSettings {
    double tolerance = 1e-6;  ///< mean residual of the free bodies over the mean force of the interactions [-]
    int most_steps = 200000;
    bool fracture = false;  ///< bonds may break or soften on the way
};

struct Relaxed {
    int steps = 0;
    double residual = 0.0;  ///< [-]
    bool at_rest = false;   ///< else most_steps passed, or it was interrupted
};

/// Fictitious masses serve as long as the bonds only get softer and nothing has moved far; masses of the state are its
/// own again when relax() returns.
class Relaxation {
public:
    Relaxation(const Model& model, const State& state);
    /// After a move that changed the arms of forces.
    void renew_masses(const Model& model, const State& state);
    /// Driven bodies stay where they are. Time does not advance, the step count does. `interrupted` is asked now and
    /// then. With `friction` what slides does so in one way from where that began, whatever it does in between.
    Relaxed relax(Model& model, State& state, const RelaxSettings& settings,
                  const std::function<bool()>& interrupted = {}, const HeldFriction* friction = nullptr);

    template <class Visit>  // all that it remembers
    void for_each_member(Visit&& visit)
    {
        auto& [masses, largest_force, slowest] = *this;
        visit("masses", masses);
        visit("largest_force", largest_force);
        visit("slowest", slowest);
    }

private:
    std::vector<FictitiousMass> masses_;
    double largest_force_ = 0.0;  ///< mean of the interactions, over all relaxations [N]
    double slowest_ = 0.0;        ///< frequency of the motion at the end of the last relaxation [1/s]
};

}  // namespace grainfrac
