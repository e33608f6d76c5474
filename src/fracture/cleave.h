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

/// Whether the gate is to be asked after the coming step, which then has to gather stresses.
bool gate_is_due(const State& state);

/// Looks at the grains whose time has come, plans their next looks, and returns the splits that are due. `stress`: of
/// each body if the gate is due, else nullptr.
///
/// The gate is asked every 20 steps, or the time that a wave takes through a grain if that is more. A grain that passes
/// is looked at again when it might get half way to f = 1 at the rate at which its f grew since the last look, and the
/// sooner the nearer it is.
std::vector<SplitRequest> look_for_splits(const Model& model, State& state, const std::vector<Mat3>* stress,
                                          const std::vector<CleavageRules>& rules, double dt);

/// Requests for those that reach f >= 1 and may split now, in the order of `found`.
std::vector<SplitRequest> splits_due(const State& state, const std::vector<GrainCleavage>& found,
                                     const std::vector<CleavageRules>& rules);

}  // namespace grainfrac
