// SPDX-License-Identifier: GPL-3.0-or-later
// The quasi-static path of a pull-out as a row of equilibria, snap-back included.
//
// Damage control: between two events damage is frozen, and the model linear but for friction. At rest, the state is
// scaled until the first point of the interface reaches its strength (a point of the path); then a chosen amount of
// damage is done at once, as if the state were a little further, and the model comes to rest again. Whether the grip
// goes on or back in between is not prescribed, so that the path turns where it must (docs/theory/pull_out.md).
// Displacement control: the grip goes on by steps and everything softens while it comes to rest; where the path turns
// back, the stress falls. Bonds of spheres break at rest: the grip stops where the first of them bears its strength, a
// point of the path; the next is where the rest can bear what is left.
#pragma once

#include "experiment/pull_out.h"
#include "fracture/bond_strength.h"
#include "fracture/held_friction.h"
#include "motion/energy.h"
#include "motion/relax.h"

#include <functional>
#include <optional>

namespace grainfrac {

struct PathSettings {
    bool by_damage = true;      ///< else by displacement
    double damage_step = 0.01;  ///< mean damage of an event [-]
    double shift = 0.0;         ///< of the grip: of the first event, and of the steps of displacement control [m]
    double slide = 0.0;         ///< of the grip once nothing is left to soften [m]
    bool slides = false;        ///< go on when all is broken: friction is left
    RelaxSettings relax;
};

class PullOutPath {
public:
    PullOutPath(const PullOut& pull_out, const PathSettings& settings, const Model& model, const State& state);

    /// not_softening: at rest, but no scaling brought it to where the interface softens.
    enum class Found { equilibrium, end, not_at_rest, not_softening };
    /// The next state of the path. State::time goes on by one: it counts equilibria.
    Found next(Model& model, State& state, const std::function<bool()>& interrupted);
    const Relaxed& last() const { return last_; }

    template <class Visit>  // all that it remembers from one state to the next
    void for_each_member(Visit&& visit)
    {
        auto& [pull_out, settings, relaxation, last, force_before, position_before, started, friction] = *this;
        (void)pull_out;                                  // the experiment's
        (void)friction;                                  // none between two states
        visit("may_fracture", settings.relax.fracture);  // the rest is the input's
        visit("relaxation", relaxation);
        visit("last", last);
        visit("force_before", force_before);
        visit("position_before", position_before);
        visit("started", started);
    }

private:
    static constexpr double on_surface_ = 1e-3;  ///< a state is on the failure surface within this share

    bool relax(Model& model, State& state, const std::function<bool()>& interrupted);
    Found to_softening(Model& model, State& state, const std::function<bool()>& interrupted);
    Found next_event(Model& model, State& state, const std::vector<int>& interfaces,
                     const std::function<bool()>& interrupted);
    Found balance(Model& model, State& state, const std::vector<int>& interfaces,
                  const std::function<bool()>& interrupted);
    Found event_with_friction(Model& model, State& state, const std::vector<int>& interfaces,
                              const std::function<bool()>& interrupted);
    Found creep_to_softening(Model& model, State& state, const std::vector<int>& interfaces,
                             const std::function<bool()>& interrupted);
    Found balance_with_friction(Model& model, State& state, const std::vector<int>& interfaces,
                                const std::function<bool()>& interrupted);
    bool back_to_strength(Model& model, State& state, const std::vector<int>& interfaces,
                          const std::function<bool()>& interrupted);
    bool break_bonds(Model& model, State& state, MostUsedBond most, const std::function<bool()>& interrupted);
    double next_damage(double now) const;
    double factor_to_path(const Model& model, const State& state, const std::vector<int>& interfaces) const;
    void go_on(Model& model, State& state, const std::vector<int>& interfaces, double factor);
    bool draw(Model& model, State& state, const std::vector<int>& interfaces, const std::function<bool()>& interrupted);
    void scale(const Model& model, State& state, double factor);
    void shift_fibre(Model& model, State& state, double by);
    void shorten(State& state);
    void find_forces(const Model& model, State& state);
    void book_move(Model& model, State& state, const Ledger& before);
    void remember_grip(const State& state);
    void book_scaling(State& state, double factor);
    void book_work(State& state);

    const PullOut& pull_out_;
    PathSettings settings_;
    Relaxation relaxation_;
    Relaxed last_;
    std::vector<Vec3> force_before_, position_before_;  // of the grip, for the work of its next move
    bool started_ = false;
    std::optional<HeldFriction> friction_;  // of the event that is under way
};

/// The next state of the path. Interrupted, none, and path, model and state are what they were: a relaxation is not
/// broken off and taken up again with the same bits.
std::optional<PullOutPath::Found> next_or_none(std::optional<PullOutPath>& path, Model& model, State& state,
                                               const std::function<bool()>& interrupted);

}  // namespace grainfrac
