// SPDX-License-Identifier: GPL-3.0-or-later
// Which grains split now: candidate planes of each crystal, the tractions across them, the criterion.
#pragma once

#include "fracture/cleavage.h"
#include "fracture/split_grains.h"
#include "model/model.h"
#include "model/state.h"

#include <vector>

namespace grainfrac {

/// One family of planes of a crystal: those that symmetry makes equal share the law.
struct CleavageFamily {
    CleavageLaw law;
    std::vector<Plane> planes;  ///< crystal frame, offsets from the grain's centre [m]
    SplitRules split;           ///< of grains that split along it
};

/// How grains of one part cleave.
struct CleavageRules {
    std::vector<CleavageFamily> families;  ///< empty: never
    CleavageGate gate;
    bool surface_flaws = true;  ///< flaws at the edge of the plane, where they are worst; false: in its middle
    double pause = 0.0;         ///< between splits of one lineage: one elastic transit [s]
};

/// How near a grain is to cleaving.
struct GrainCleavage {
    Cleavage worst;            ///< where in space; f = 0 if the gate held it back
    std::int32_t family = -1;  ///< of the worst plane
    Plane plane;               ///< the worst, in space
    double nearest = 0.0;      ///< f of the worst of the planes that were not refused before [-]
    SplitRequest due;          ///< along the worst of the planes that were not refused before; body -1: none has f >= 1
};

/// The worst plane of every grain; entries of walls, and of grains that the gate holds back, are empty. `stress`: of
/// each body, as grain_stress gives it. `rules`: one per group (part). Needs the slots of the last step.
/// Independent of thread count. Ties go to the first family and plane.
std::vector<GrainCleavage> find_cleavage(const Model& model, const State& state, const std::vector<Mat3>& stress,
                                         const std::vector<CleavageRules>& rules);

/// The same for some grains, an entry for each of `bodies`, whatever the gate says.
std::vector<GrainCleavage> find_cleavage(const Model& model, const State& state,
                                         const std::vector<CleavageRules>& rules, const std::vector<int>& bodies);

/// Grains that are to be looked at now, by their own plan.
std::vector<int> due_for_a_look(const State& state, const std::vector<CleavageRules>& rules);

/// Sets the step of the next look that asks the gate: the time that a wave takes through a grain from now. Of `bodies`,
/// returns those that the gate lets pass; the others are asked again then.
std::vector<int> ask_the_gate(State& state, const std::vector<Mat3>& stress, const std::vector<CleavageRules>& rules,
                              const std::vector<int>& bodies, double dt);

/// Plans the next look at each grain that was looked at: when it might get half way to f = 1 at the rate at which its f
/// grew since the last look, and the sooner the nearer it is. `found`: of `bodies`.
void plan_looks(State& state, const std::vector<int>& bodies, const std::vector<GrainCleavage>& found,
                const std::vector<CleavageRules>& rules, double dt);

/// Requests for those that reach f >= 1 and may split now, in the order of `found`.
std::vector<SplitRequest> splits_due(const State& state, const std::vector<GrainCleavage>& found,
                                     const std::vector<CleavageRules>& rules);

}  // namespace grainfrac
